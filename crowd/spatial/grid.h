// Neighbor search in an unbounded uniform grid.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/compute/instruction_set.h"
#include "crowd/agents/agents.h"

namespace throng::crowd {

/// Copies of the positions, velocities and radii of present agents, sorted by cell, so that agents
/// near in space are near in memory. Cells are hashed into buckets that keep the order of a row: a
/// query scans one run of slots per row. If the crowd fills its area, consecutive rows are adjacent
/// too. Const member functions may be called from several threads.
class Grid {
 public:
  struct Neighbor {
    float distance_sq = 0;  ///< m^2, between centers
    std::uint32_t slot = 0;
  };

  /// Position (m) and velocity (m/s) of an agent; kernels load it as four floats.
  struct Body {
    Eigen::Vector2f position;
    Eigen::Vector2f velocity;
  };

  /// Buffers of a search, reused to avoid allocations; one per thread.
  class Candidates {
   public:
    /// Reserves memory for searches of at most `max_neighbors` neighbors.
    explicit Candidates(std::size_t max_neighbors = 0);

   private:
    friend struct NearestKernel;
    void make_room(std::size_t max_neighbors);

    std::vector<float> distance_sq_;
    std::vector<std::int32_t> slot_;
    std::vector<Neighbor> sorted_;
    std::size_t count_ = 0;
  };

  explicit Grid(InstructionSet set = best_instruction_set());

  /// Sorts the agents, on all threads. Allocates only if their number has grown.
  void build(const Agents& agents);

  std::size_t size() const { return size_; }
  std::uint32_t id(std::size_t slot) const { return id_[slot]; }
  const Body& body(std::size_t slot) const { return body_[slot]; }
  const Eigen::Vector2f& position(std::size_t slot) const { return body_[slot].position; }
  const Eigen::Vector2f& velocity(std::size_t slot) const { return body_[slot].velocity; }
  float radius(std::size_t slot) const { return radius_[slot]; }

  /// Returns the agents nearest to the one in `slot`, nearer than `range` (m) and at most
  /// `max_neighbors`, sorted by distance, then by id. The result is valid until the next search
  /// with `candidates`. `reach` is an estimate of their distance from the previous search; it is
  /// updated and does not change the result.
  std::span<const Neighbor> nearest(std::size_t slot, float range, std::size_t max_neighbors,
                                    float& reach, Candidates& candidates) const {
    return nearest_(*this, slot, range, max_neighbors, reach, candidates);
  }

  /// Calls visit(slot) once for each agent within the range of a point, and for some others.
  template <typename Visit>
  void visit(const Eigen::Vector2f& point, float range, const Visit& visit) const {
    for_each_run(point, range, [&](std::size_t begin, std::size_t end, std::optional<int> row) {
      for (std::size_t slot = begin; slot < end; ++slot) {
        if (!row || row_[slot] == *row) visit(slot);
      }
    });
  }

 private:
  friend struct NearestKernel;
  using Nearest = std::span<const Neighbor>(const Grid&, std::size_t slot, float range,
                                            std::size_t max_neighbors, float& reach, Candidates&);

  static constexpr float kCellWidth = 1.0F;   // m; holds a few people
  static constexpr float kCellHeight = 2.0F;  // m; for fewer and longer runs
  static constexpr std::size_t kPadding = 8;  // searches load whole vectors

  struct Extent {
    Eigen::Vector2f low;
    Eigen::Vector2f high;
  };

  static Nearest* pick_nearest(InstructionSet set);
  static int column_at(float x) { return cell_of(x / kCellWidth); }
  static int row_at(float y) { return cell_of(y / kCellHeight); }
  /// Distant cells are merged.
  static int cell_of(float cells) {
    constexpr float kFar = 1e9F;
    const float near = std::min(kFar, std::max(-kFar, cells));  // in this order for NaN
    const int towards_zero = static_cast<int>(near);
    return towards_zero - (static_cast<float>(towards_zero) > near ? 1 : 0);
  }
  std::uint32_t bucket(int column, int row) const {
    return (static_cast<std::uint32_t>(row) * row_stride_ + static_cast<std::uint32_t>(column) -
            first_cell_) &
           bucket_mask_;
  }

  /// Calls look(begin, end, row) for runs of slots that contain all agents within the range of a
  /// point. If row is set, only slots of that row count: other rows share its buckets and would be
  /// visited twice.
  template <typename Look>
  void for_each_run(const Eigen::Vector2f& point, float range, const Look& look) const {
    constexpr float kRounding = 1e-3F;  // m; no agent at the edge is missed
    const float padded = range + kRounding;
    const int first_row = row_at(point.y() - padded);
    const int last_row = row_at(point.y() + padded);
    const int first_column = column_at(point.x() - padded);
    const int last_column = column_at(point.x() + padded);
    const auto buckets = static_cast<std::size_t>(bucket_mask_) + 1;
    const auto columns = static_cast<std::size_t>(last_column - first_column) + 1;
    const auto rows = static_cast<std::size_t>(last_row - first_row) + 1;
    constexpr std::size_t kRowCost = 8;  // number of slots scanned in the time of starting a row
    if (columns > buckets || rows * kRowCost > size_) {
      look(std::size_t{0}, size_, std::optional<int>());
      return;
    }
    for (int row = first_row; row <= last_row; ++row) {
      const std::size_t begin = bucket(first_column, row);
      const std::size_t end = begin + columns;
      look(std::size_t{bucket_begin_[begin]}, std::size_t{bucket_begin_[std::min(end, buckets)]},
           std::optional(row));
      if (end > buckets) {
        look(std::size_t{0}, std::size_t{bucket_begin_[end - buckets]}, std::optional(row));
      }
    }
  }

  Extent extent_of(const Agents& agents);
  void lay_out(const Agents& agents);
  void count_parts(const Agents& agents);
  void split(const Agents& agents);
  void sort_part(const Agents& agents, std::size_t part);

  Nearest* nearest_;
  std::size_t size_ = 0;
  std::uint32_t bucket_mask_ = 0;
  std::uint32_t row_stride_ = 1;             // distance of successive rows, in buckets
  std::uint32_t first_cell_ = 0;             // hash of the cell of the first bucket
  std::vector<std::uint32_t> bucket_begin_;  // first slot of each bucket, and the end
  // Buffers for sorting.
  std::vector<Extent> extents_;
  int part_shift_ = 0;                    // a part has 2^part_shift_ buckets
  std::size_t parts_ = 1;                 // number of runs of buckets that are sorted independently
  std::vector<std::uint32_t> bucket_of_;  // per agent
  std::vector<std::uint32_t> by_part_;    // ids of agents, sorted by part, then by id
  // [run of agents][part]: first counts, then positions in by_part_.
  std::vector<std::uint32_t> place_;
  std::vector<std::uint32_t> part_begin_;  // positions in by_part_, and the end
  // Indexed by slot; arrays that are searched have padding at the end.
  std::vector<std::uint32_t> id_;
  std::vector<std::int32_t> row_;
  std::vector<float> x_;
  std::vector<float> y_;
  std::vector<Body> body_;
  std::vector<float> radius_;
};

}  // namespace throng::crowd
