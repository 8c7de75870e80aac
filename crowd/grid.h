// Who is near whom: agents sorted by the cell of a uniform grid without bounds.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "crowd/agents.h"

namespace throng::crowd {

/// A copy of what neighbours may know of the agents that are present, sorted by cell, so that those
/// who are near in space are near in memory. Cells are hashed into buckets such that a row's
/// neighbouring cells stay neighbours: a query scans one run of slots per row.
class Grid {
 public:
  struct Neighbor {
    float distance_sq = 0;  ///< m^2, between centres
    std::uint32_t slot = 0;
  };

  /// Sorts the agents anew; allocates only when their number has grown.
  void build(const Agents& agents);

  std::size_t size() const { return id_.size(); }
  std::uint32_t id(std::size_t slot) const { return id_[slot]; }
  const Eigen::Vector2f& position(std::size_t slot) const { return position_[slot]; }
  const Eigen::Vector2f& velocity(std::size_t slot) const { return velocity_[slot]; }
  float radius(std::size_t slot) const { return radius_[slot]; }

  /// The agents nearest to the one in `slot`, nearer than `range`, at most found.size(); sorted by
  /// distance, ties by id. Returns how many there are. `reach` is a guess of how far they are,
  /// which is updated for the next time and does not change the result.
  std::size_t nearest(std::size_t slot, float range, std::span<Neighbor> found, float& reach) const;

 private:
  static constexpr float kCellSize = 1.0F;  // m; a few people fit in

  std::uint32_t bucket(int column, int row) const;
  std::size_t scan(std::size_t slot, float reach, std::span<Neighbor> found) const;

  std::uint32_t bucket_mask_ = 0;
  std::vector<std::uint32_t> bucket_begin_;  // first slot of each bucket, then the end
  std::vector<std::uint32_t> bucket_of_;     // of each agent
  std::vector<std::uint32_t> id_;
  std::vector<int> row_;
  std::vector<Eigen::Vector2f> position_;
  std::vector<Eigen::Vector2f> velocity_;
  std::vector<float> radius_;
};

}  // namespace throng::crowd
