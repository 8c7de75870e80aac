// How near bodies come to each other, for reports.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace throng::crowd {

struct PairDistances {
  /// Between two middles; not a number when there are no two.
  double nearest_m = std::numeric_limits<double>::quiet_NaN();
  std::size_t overlapping = 0;  ///< pairs nearer than kTouching of the sum of their radii
};

/// Bodies that only touch do not overlap: as the series that were measured with Menge have it.
constexpr double kTouching = 0.999;

/// Measures pairs in about n log n, not n^2. Keeps its memory for the next time.
class PairDistancesMeter {
 public:
  /// Over those whose `present` is not 0 and whose position is a number.
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
