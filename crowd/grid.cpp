#include "crowd/grid.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace throng::crowd {

namespace {

constexpr float kSmallestReach = 0.5F;  // m
constexpr float kRounding = 1e-3F;      // m; nobody at the edge of the reach is missed

int cell_of(float coordinate, float cell_size) {
  return static_cast<int>(std::floor(coordinate / cell_size));
}

bool nearer(float distance_sq, std::uint32_t id, float than_distance_sq, std::uint32_t than_id) {
  return distance_sq < than_distance_sq || (distance_sq == than_distance_sq && id < than_id);
}

}  // namespace

std::uint32_t Grid::bucket(int column, int row) const {
  // Rows start at scattered places (the golden ratio's multiples), so that a crowd of any shape
  // spreads over all buckets.
  return (static_cast<std::uint32_t>(row) * 0x9E3779B1U + static_cast<std::uint32_t>(column)) &
         bucket_mask_;
}

void Grid::build(const Agents& agents) {
  const std::size_t count = agents.count();
  const std::size_t buckets = std::bit_ceil(std::max<std::size_t>(64, 2 * count));
  bucket_mask_ = static_cast<std::uint32_t>(buckets - 1);
  bucket_begin_.assign(buckets + 1, 0);
  bucket_of_.resize(count);

  std::size_t present = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (agents.present[i] == 0) continue;
    const Eigen::Vector2f& p = agents.position[i];
    bucket_of_[i] = bucket(cell_of(p.x(), kCellSize), cell_of(p.y(), kCellSize));
    ++bucket_begin_[bucket_of_[i]];
    ++present;
  }
  std::uint32_t end = 0;
  for (std::uint32_t& begin : bucket_begin_) begin = end += begin;

  id_.resize(present);
  row_.resize(present);
  position_.resize(present);
  velocity_.resize(present);
  radius_.resize(present);
  // Backwards, so that each bucket's end counts down to its begin and ids ascend within it.
  for (std::size_t i = count; i-- > 0;) {
    if (agents.present[i] == 0) continue;
    const std::uint32_t slot = --bucket_begin_[bucket_of_[i]];
    id_[slot] = static_cast<std::uint32_t>(i);
    row_[slot] = cell_of(agents.position[i].y(), kCellSize);
    position_[slot] = agents.position[i];
    velocity_[slot] = agents.velocity[i];
    radius_[slot] = agents[Property::radius][i];
  }
}

std::size_t Grid::scan(std::size_t slot, float reach, std::span<Neighbor> found) const {
  const Eigen::Vector2f centre = position_[slot];
  const std::uint32_t buckets = bucket_mask_ + 1;
  const float padded = reach + kRounding;
  const int first_column = cell_of(centre.x() - padded, kCellSize);
  const int last_column = cell_of(centre.x() + padded, kCellSize);
  const auto columns =
      std::min(static_cast<std::uint32_t>(last_column - first_column) + 1, buckets);
  const int first_row = cell_of(centre.y() - padded, kCellSize);
  const int last_row = cell_of(centre.y() + padded, kCellSize);

  float limit = reach * reach;
  std::size_t count = 0;
  const auto consider = [&](std::uint32_t other) {
    const float d = (position_[other] - centre).squaredNorm();
    if (d > limit || other == slot) return;
    std::size_t at = count;
    if (count == found.size()) {
      const Neighbor& last = found.back();
      if (!nearer(d, id_[other], last.distance_sq, id_[last.slot])) return;
      --at;
    } else {
      ++count;
    }
    for (; at > 0; --at) {
      const Neighbor& before = found[at - 1];
      if (!nearer(d, id_[other], before.distance_sq, id_[before.slot])) break;
      found[at] = before;
    }
    found[at] = {d, other};
    if (count == found.size()) limit = found.back().distance_sq;
  };
  const auto scan_slots = [&](std::uint32_t begin_bucket, std::uint32_t end_bucket, int row) {
    const std::uint32_t end = bucket_begin_[end_bucket];
    for (std::uint32_t other = bucket_begin_[begin_bucket]; other < end; ++other) {
      if (row_[other] == row) consider(other);
    }
  };
  for (int row = first_row; row <= last_row; ++row) {
    const std::uint32_t begin = bucket(first_column, row);
    const std::uint32_t end = begin + columns;
    scan_slots(begin, std::min(end, buckets), row);
    if (end > buckets) scan_slots(0, end - buckets, row);
  }
  return count;
}

std::size_t Grid::nearest(std::size_t slot, float range, std::span<Neighbor> found,
                          float& reach) const {
  if (found.empty() || range <= 0) return 0;
  float radius = std::clamp(reach, std::min(kSmallestReach, range), range);
  std::size_t count = scan(slot, radius, found);
  while (count < found.size() && radius < range) {
    radius = std::min(2 * radius, range);
    count = scan(slot, radius, found);
  }
  while (count > 0 && !(found[count - 1].distance_sq < range * range)) --count;
  constexpr float kMargin = 1.2F;  // people move a little between steps
  reach = count == found.size() ? kMargin * std::sqrt(found[count - 1].distance_sq) : range;
  return count;
}

}  // namespace throng::crowd
