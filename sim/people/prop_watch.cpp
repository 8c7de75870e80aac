#include "sim/people/prop_watch.h"

#include <fmt/core.h>

#include <cmath>

#include "world/props.h"

namespace throng::sim {

namespace {

/// The inner part of what a prop covers, along each side: who brushes past its edge is not in it.
world::Prop shrink_to_core(world::Prop prop) {
  constexpr double kCore = 0.6;
  prop.scale *= kCore;
  return prop;
}

}  // namespace

PropWatch::PropWatch(const world::Scenario& scenario) : scenario_(&scenario) {
  for (std::size_t i = 0; i < scenario.props.size(); ++i) {
    const world::Prop& prop = scenario.props[i];
    const double reach_m = prop.scale * world::prop_type(prop.kind).half_size.norm();
    const Eigen::Vector2d reach = Eigen::Vector2d::Constant(reach_m);
    const Cell low = cell_of(prop.position - reach);
    const Cell high = cell_of(prop.position + reach);
    for (int x = low.first; x <= high.first; ++x) {
      for (int y = low.second; y <= high.second; ++y) props_in_[{x, y}].push_back(i);
    }
  }
}

PropWatch::Cell PropWatch::cell_of(const Eigen::Vector2d& point) {
  return {static_cast<int>(std::floor(point.x())), static_cast<int>(std::floor(point.y()))};
}

void PropWatch::look(std::span<const Eigen::Vector2f> positions,
                     std::span<const std::uint8_t> there, double time_s) {
  if (props_in_.empty()) return;
  for (std::size_t agent = 0; agent < positions.size(); ++agent) {
    if (there[agent] == 0) continue;
    const Eigen::Vector2d at = positions[agent].cast<double>();
    const auto cell = props_in_.find(cell_of(at));
    if (cell == props_in_.end()) continue;
    for (const std::size_t i : cell->second) {
      const world::Prop& prop = scenario_->props[i];
      if (!noted_.contains(i) && world::distance_to(shrink_to_core(prop), at) <= 0) {
        record(i, agent, at, time_s);
      }
    }
  }
}

void PropWatch::record(std::size_t number, std::size_t agent, const Eigen::Vector2d& at,
                       double time_s) {
  noted_.insert(number);
  const world::Prop& prop = scenario_->props[number];
  const bool placed = number < scenario_->placed_props;
  const bool is_clutter = number >= scenario_->props.size() - scenario_->strewn_props;
  // People of a blueprint have no numbers, and its props are obstacles.
  const bool is_built = scenario_->built_crowd != nullptr;
  problems_.push_back(
      {scenario_->id,
       placed       ? fmt::format("/props/{}/position", number)
       : is_clutter ? std::string("/clutter")
                    : std::string("/scatter"),
       fmt::format("a {} at ({:.2f}, {:.2f}), in which {} is at ({:.2f}, {:.2f}) after {:.1f} s",
                   world::prop_type(prop.kind).name, prop.position.x(), prop.position.y(),
                   is_built ? "a person" : fmt::format("agent {}", agent), at.x(), at.y(), time_s),
       !placed    ? "areas in which nobody walks"
       : is_built ? "a place where nobody walks"
                  : "a place where nobody walks, or where the crowd's scene has an obstacle"});
}

}  // namespace throng::sim
