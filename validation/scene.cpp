#include "validation/scene.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace throng::validation {

using Eigen::Vector2d;

namespace {

crowd::SceneDescription describe_scene(const TestScene& scene, const Tested& tested) {
  crowd::SceneBuilder builder(scene.dt_s);
  for (const crowd::Node& constants : tested.constants) builder.add(constants);
  const auto name = [](std::size_t group) { return fmt::format("p{}", group); };
  for (std::size_t i = 0; i < scene.groups.size(); ++i) {
    const Group& group = scene.groups[i];
    builder.add_profile({.name = name(i),
                         .common = {{"r", group.radius_m},
                                    {"max_accel", 5},
                                    {"max_speed", 2.5},
                                    {"neighbor_dist", 8},
                                    {"obstacleSet", 1},
                                    {"class", i}},
                         .properties = {describe::property("pref_speed", group.speed)},
                         .models = tested.profile});
  }
  for (std::size_t i = 0; i < scene.groups.size(); ++i) {
    const Group& group = scene.groups[i];
    crowd::Node generator = describe::agents_at(group.places);
    for (crowd::Attribute& attribute : Sampled::uniform(0, group.aside_m).attributes("displace_")) {
      generator.set(std::move(attribute));
    }
    builder.add_group({name(i), group.state, std::move(generator), group.more});
  }
  if (!scene.walls.empty()) builder.add_obstacles(scene.walls, 1);
  if (!scene.later_walls.empty()) builder.add_obstacles(scene.later_walls, 2);
  return builder.build();
}

bool is_by_velocity(const std::string& model) {
  return model == "orca" || model == "weidmann" || model == "ttc" || model == "pedvo" ||
         model == "dummy";
}

}  // namespace

Polygon box(double min_x, double min_y, double max_x, double max_y) {
  return {{min_x, min_y}, {max_x, min_y}, {max_x, max_y}, {min_x, max_y}};
}

std::vector<Vector2d> lattice(const Vector2d& low, const Vector2d& high, std::size_t count) {
  const Vector2d size = high - low;
  const double spacing = std::sqrt(size.x() * size.y() / static_cast<double>(count));
  const auto rows = static_cast<std::size_t>(std::max(1.0, std::round(size.y() / spacing)));
  const std::size_t columns = (count + rows - 1) / rows;
  const Vector2d step(size.x() / static_cast<double>(columns),
                      size.y() / static_cast<double>(rows));
  std::vector<Vector2d> places;
  places.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t column = i / rows;
    const std::size_t row = i % rows;
    const Vector2d cell(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
    places.emplace_back(low + cell.cwiseProduct(step));
  }
  return places;
}

Behavior& Behavior::goal_box(int goal_set, double min_x, double min_y, double max_x, double max_y) {
  add_goal_set(goal_set, {describe::box_goal(0, {min_x, min_y}, {max_x, max_y})});
  return *this;
}

Behavior& Behavior::walk_to(int goal_set, const std::string& state) {
  add_state(state, {describe::select_goal("nearest", goal_set), describe::velocity("auto")});
  return *this;
}

Behavior& Behavior::leave_at_goal(const std::string& states) {
  add_final_state("Gone", {describe::action("leave")});
  add_transition(states, "Gone", describe::goal_reached());
  return *this;
}

std::string title(const Tested& tested) {
  if (tested.choice == crowd::ConstantsChoice::best) return tested.model;
  return fmt::format("{} ({})", tested.model,
                     crowd::kConstantsWords.at(static_cast<std::size_t>(tested.choice)));
}

crowd::Simulation load(const TestScene& scene, const Tested& tested, std::uint64_t seed) {
  crowd::LoadOptions options;
  options.seed = seed;
  options.model = tested.model;
  options.constants = tested.choice;
  options.sub_steps = is_by_velocity(tested.model) ? 0 : 4;
  crowd::BehaviorDescription behavior = scene.behavior.build();
  behavior.files = scene.files;
  return {describe_scene(scene, tested), behavior, options};
}

}  // namespace throng::validation
