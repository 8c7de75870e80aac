// Distances between bodies, for reports.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace throng::crowd {

/// Statistics of the distances between agents.
struct PairDistances {
  /// Min distance between two centers (m); NaN if there are fewer than two agents.
  double nearest_m = std::numeric_limits<double>::quiet_NaN();
  std::size_t overlapping = 0;  ///< pairs nearer than kTouching times the sum of their radii
};

/// Factor below which bodies overlap instead of touching, as in the series measured with Menge.
constexpr double kTouching = 0.999;

/// Measures all pairs in O(n log n). Reuses its memory.
class PairDistancesMeter {
 public:
  /// Measures agents whose `present` is not 0 and whose position is finite.
  PairDistances measure(std::span<const Eigen::Vector2f> positions, std::span<const float> radii_m,
                        std::span<const std::uint8_t> present);

 private:
  struct Placed {
    std::int64_t row = 0;
    std::int64_t column = 0;
    std::uint32_t agent = 0;
  };

  void sort_into_cells(std::span<const Eigen::Vector2f> positions, double cell_m);

  std::vector<Placed> placed_;
};

}  // namespace throng::crowd
