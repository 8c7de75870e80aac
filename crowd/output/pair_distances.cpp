#include "crowd/output/pair_distances.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace throng::crowd {

namespace {

constexpr double kMinCellM = 0.05;
constexpr double kMaxCellM = 1e9;  // larger than any distance between two places

/// Calls visit(a, b) for each pair of entries in the same cell or in cells side by side. The
/// entries are sorted by row, then column.
template <typename Placed, typename Visit>
void for_near_pairs(const std::vector<Placed>& placed, const Visit& visit) {
  std::size_t below = 0;  // the first entry that may be near in the next row
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const Placed& a = placed[i];
    for (std::size_t j = i + 1; j < placed.size(); ++j) {
      if (placed[j].row != a.row || placed[j].column > a.column + 1) break;
      visit(a, placed[j]);
    }
    const auto is_before = [&](const Placed& b) {
      return std::tie(b.row, b.column) < std::make_tuple(a.row + 1, a.column - 1);
    };
    while (below < placed.size() && is_before(placed[below])) ++below;
    for (std::size_t j = below; j < placed.size(); ++j) {
      if (placed[j].row != a.row + 1 || placed[j].column > a.column + 1) break;
      visit(a, placed[j]);
    }
  }
}

}  // namespace

void PairDistancesMeter::sort_into_cells(std::span<const Eigen::Vector2f> positions,
                                         double cell_m) {
  for (Placed& each : placed_) {
    const Eigen::Vector2f& p = positions[each.agent];
    each.row = static_cast<std::int64_t>(std::floor(p.y() / cell_m));
    each.column = static_cast<std::int64_t>(std::floor(p.x() / cell_m));
  }
  std::sort(placed_.begin(), placed_.end(), [](const Placed& a, const Placed& b) {
    return std::tie(a.row, a.column, a.agent) < std::tie(b.row, b.column, b.agent);
  });
}

PairDistances PairDistancesMeter::measure(std::span<const Eigen::Vector2f> positions,
                                          std::span<const float> radii_m,
                                          std::span<const std::uint8_t> present) {
  constexpr float kMaxDistanceM = 1e9F;
  placed_.clear();
  double largest_m = 0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    // Also false for what is not a number.
    const bool near =
        positions[i].cwiseAbs().maxCoeff() < kMaxDistanceM && positions[i].allFinite();
    if (present[i] == 0 || !near) continue;
    placed_.push_back({0, 0, static_cast<std::uint32_t>(i)});
    largest_m = std::max(largest_m, static_cast<double>(radii_m[i]));
  }
  PairDistances found;
  if (placed_.size() < 2) return found;
  // In cells this wide all pairs that may overlap are near. When no two are as near as that, wider
  // cells find the nearest ones.
  for (double cell_m = std::max(2 * largest_m, kMinCellM);; cell_m *= 2) {
    sort_into_cells(positions, cell_m);
    const bool first = cell_m < 2 * std::max(2 * largest_m, kMinCellM);
    for_near_pairs(placed_, [&](const Placed& a, const Placed& b) {
      const double distance_m =
          (positions[a.agent].cast<double>() - positions[b.agent].cast<double>()).norm();
      found.nearest_m = std::fmin(found.nearest_m, distance_m);
      const double touching_m = kTouching * (double{radii_m[a.agent]} + radii_m[b.agent]);
      if (first && distance_m < touching_m) ++found.overlapping;
    });
    if (found.nearest_m <= cell_m || cell_m > 2 * kMaxCellM) return found;
  }
}

}  // namespace throng::crowd
