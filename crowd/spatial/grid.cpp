// Sorting is by counting, in two rounds: agents are split into parts, each with a run of buckets
// small enough for a processor's nearest cache, and then each part is sorted alone. Both rounds
// keep the order of ids, so that the result does not depend on who does what.
#include "crowd/spatial/grid.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

#include "base/compute/parallel.h"

namespace throng::crowd {

namespace {

constexpr std::size_t kMinBuckets = 64;
constexpr std::size_t kMaxPartBuckets = 4096;
constexpr std::size_t kParts = 32;        // at least, in a large crowd: work for many threads
constexpr std::size_t kPartAgents = 256;  // in a small crowd
constexpr std::size_t kRunAgents = 2048;

std::size_t count_grid_runs(std::size_t count) { return (count + kRunAgents - 1) / kRunAgents; }

}  // namespace

Grid::Grid(InstructionSet set) : nearest_(pick_nearest(set)) {}

void Grid::build(const Agents& agents) {
  lay_out(agents);
  count_parts(agents);
  id_.resize(size_ + kPadding);
  row_.resize(size_ + kPadding);
  x_.resize(size_ + kPadding);
  y_.resize(size_ + kPadding);
  // Nobody is there.
  std::fill(x_.end() - kPadding, x_.end(), std::numeric_limits<float>::quiet_NaN());
  body_.resize(size_);
  radius_.resize(size_);
  split(agents);
  parallel_ranges(parts_, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t part = begin; part < end; ++part) sort_part(agents, part);
  });
  bucket_begin_.back() = static_cast<std::uint32_t>(size_);
}

// The extent of the agents that are present; empty if none is.
Grid::Extent Grid::extent_of(const Agents& agents) {
  constexpr float kFar = 1e9F;
  const Extent nobody{Eigen::Vector2f::Constant(kFar), Eigen::Vector2f::Constant(-kFar)};
  extents_.assign(count_grid_runs(agents.count()), nobody);
  parallel_ranges(extents_.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t run = first; run < last; ++run) {
      Extent& extent = extents_[run];
      const std::size_t end = std::min((run + 1) * kRunAgents, agents.count());
      for (std::size_t i = run * kRunAgents; i < end; ++i) {
        if (agents.present[i] == 0) continue;
        extent.low = extent.low.cwiseMin(agents.position[i]);
        extent.high = extent.high.cwiseMax(agents.position[i]);
      }
    }
  });
  Extent all = nobody;
  for (const Extent& extent : extents_) {
    all.low = all.low.cwiseMin(extent.low);
    all.high = all.high.cwiseMax(extent.high);
  }
  return all;
}

// Chooses the buckets: one for each cell of the crowd's extent if those are few enough, else rows
// start at scattered places (the golden ratio's multiples), so that any crowd spreads over all.
void Grid::lay_out(const Agents& agents) {
  const std::size_t count = agents.count();
  const Extent all = extent_of(agents);
  const std::size_t max_buckets = std::bit_ceil(std::max(kMinBuckets, 2 * count));
  std::size_t buckets = max_buckets;
  row_stride_ = 0x9E3779B1U;
  first_cell_ = 0;
  const float columns = (all.high.x() - all.low.x()) / kCellWidth + 2;
  const float rows = (all.high.y() - all.low.y()) / kCellHeight + 2;
  if (columns > 0 && rows > 0 && columns * rows < static_cast<float>(max_buckets)) {
    row_stride_ = static_cast<std::uint32_t>(columns);
    first_cell_ = static_cast<std::uint32_t>(row_at(all.low.y())) * row_stride_ +
                  static_cast<std::uint32_t>(column_at(all.low.x()));
    const std::size_t cells = std::bit_ceil(static_cast<std::size_t>(columns * rows) + 1);
    buckets = std::clamp(cells, kMinBuckets, max_buckets);
  }
  bucket_mask_ = static_cast<std::uint32_t>(buckets - 1);
  const std::size_t parts = std::clamp(std::bit_floor(count / kPartAgents), std::size_t{1}, kParts);
  const std::size_t part_buckets = std::min(buckets / parts, kMaxPartBuckets);
  part_shift_ = std::countr_zero(part_buckets);
  parts_ = buckets / part_buckets;
  const std::size_t max_parts = std::max(kParts, max_buckets / kMaxPartBuckets);
  bucket_begin_.reserve(max_buckets + 1);
  place_.reserve(count_grid_runs(count) * max_parts);
  part_begin_.reserve(max_parts + 1);
  bucket_begin_.resize(buckets + 1);
  bucket_of_.resize(count);
  by_part_.resize(count);
}

// Assigns agents to buckets, counts those of each part, and finds where each run's agents go.
void Grid::count_parts(const Agents& agents) {
  const std::size_t runs = count_grid_runs(agents.count());
  place_.assign(runs * parts_, 0);
  parallel_ranges(runs, 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t run = first; run < last; ++run) {
      std::uint32_t* const counts = &place_[run * parts_];
      const std::size_t end = std::min((run + 1) * kRunAgents, agents.count());
      for (std::size_t i = run * kRunAgents; i < end; ++i) {
        if (agents.present[i] == 0) continue;
        const Eigen::Vector2f& p = agents.position[i];
        bucket_of_[i] = bucket(column_at(p.x()), row_at(p.y()));
        ++counts[bucket_of_[i] >> part_shift_];
      }
    }
  });
  part_begin_.resize(parts_ + 1);
  std::uint32_t begin = 0;
  for (std::size_t part = 0; part < parts_; ++part) {
    part_begin_[part] = begin;
    for (std::size_t run = 0; run < runs; ++run) {
      begin += std::exchange(place_[run * parts_ + part], begin);
    }
  }
  part_begin_[parts_] = begin;
  size_ = begin;
}

void Grid::split(const Agents& agents) {
  parallel_ranges(count_grid_runs(agents.count()), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t run = first; run < last; ++run) {
      std::uint32_t* const place = &place_[run * parts_];
      const std::size_t end = std::min((run + 1) * kRunAgents, agents.count());
      for (std::size_t i = run * kRunAgents; i < end; ++i) {
        if (agents.present[i] == 0) continue;
        by_part_[place[bucket_of_[i] >> part_shift_]++] = static_cast<std::uint32_t>(i);
      }
    }
  });
}

void Grid::sort_part(const Agents& agents, std::size_t part) {
  const std::span<std::uint32_t> begins(&bucket_begin_[part << part_shift_],
                                        std::size_t{1} << part_shift_);
  const std::span<const std::uint32_t> ids(by_part_.data() + part_begin_[part],
                                           by_part_.data() + part_begin_[part + 1]);
  std::fill(begins.begin(), begins.end(), 0);
  for (const std::uint32_t id : ids) ++bucket_begin_[bucket_of_[id]];
  std::uint32_t end = part_begin_[part];
  for (std::uint32_t& begin : begins) begin = end += begin;
  // Backwards, so that each bucket's end counts down to its begin and ids ascend within it.
  for (std::size_t at = ids.size(); at-- > 0;) {
    const std::uint32_t id = ids[at];
    const std::uint32_t slot = --bucket_begin_[bucket_of_[id]];
    const Eigen::Vector2f& p = agents.position[id];
    id_[slot] = id;
    row_[slot] = row_at(p.y());
    x_[slot] = p.x();
    y_[slot] = p.y();
    body_[slot] = {p, agents.velocity[id]};
    radius_[slot] = agents.breadth[id] * agents[Property::radius][id];
  }
}

}  // namespace throng::crowd
