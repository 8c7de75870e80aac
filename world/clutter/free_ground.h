// Ground that is free for clutter: outside of buildings, exits, crossings and other props, and away
// from people.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "world/scenario.h"

namespace throng::world {

class FreeGround {
 public:
  /// `scenario` must outlive this object.
  explicit FreeGround(const Scenario& scenario);

  /// Whether nothing is in the way of a prop, and nobody passes.
  bool is_free(const Prop& prop) const;
  /// Takes the prop's ground and a margin around it.
  void take(const Prop& prop);

  /// The material of the ground at a point; empty outside of it.
  std::string_view material_at(const Eigen::Vector2d& point) const;

 private:
  void add(std::span<const Eigen::Vector2d> corners);
  void add_exit(const Exit& exit);
  /// The first and the last bucket in which a polygon lies.
  std::pair<Eigen::Vector2i, Eigen::Vector2i> buckets(
      std::span<const Eigen::Vector2d> corners) const;

  const Scenario& scenario_;
  std::vector<std::vector<Eigen::Vector2d>> taken_;
  std::unordered_map<std::int64_t, std::vector<std::uint32_t>> taken_in_;  ///< by bucket
  std::unordered_map<std::int64_t, std::vector<std::uint32_t>> areas_in_;  ///< by bucket
};

}  // namespace throng::world
