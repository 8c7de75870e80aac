#include "validation/flow.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace throng::validation {

using Eigen::Vector2d;

namespace {

Polygon regular_polygon(double radius, bool clockwise) {
  constexpr int kCorners = 120;
  Polygon polygon;
  polygon.reserve(kCorners);
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * M_PI * (clockwise ? -i : i) / kCorners;
    polygon.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return polygon;
}

/// Unit vectors around the origin, as Menge's files have them.
std::string around_field(double half_size) {
  constexpr double kCell = 0.5;  // m
  const int cells = static_cast<int>(std::ceil(2 * half_size / kCell));
  std::string text = fmt::format("{0} {0}\n{1}\n{2} {2}\n", cells, kCell, -half_size);
  for (int row = 0; row < cells; ++row) {
    for (int column = 0; column < cells; ++column) {
      const Vector2d place =
          Vector2d(column + 0.5, row + 0.5) * kCell - Vector2d::Constant(half_size);
      const Vector2d direction = place.norm() > 0 ? place.normalized() : Vector2d(1, 0);
      text += fmt::format("{:.5f} {:.5f}\n", -direction.y(), direction.x());
    }
  }
  return text;
}

}  // namespace

double weidmann_speed_mps(double density) {
  constexpr double kFree = 1.34;
  constexpr double kJam = 5.4;
  if (density <= 0) return kFree;
  return std::max(0.0, kFree * (1 - std::exp(-1.913 * (1 / density - 1 / kJam))));
}

TestScene ring(const Ring& spec) {
  const double inner = spec.radius_m - spec.width_m / 2;
  const double outer = spec.radius_m + spec.width_m / 2;
  const double half = spec.width_m / 2 - std::min(0.25, spec.width_m / 4);
  const double length = 2 * M_PI * spec.radius_m;
  TestScene scene;
  Group group;
  for (const Vector2d& place : lattice({0, -half}, {length, half}, spec.people)) {
    const double angle = place.x() / spec.radius_m;
    group.places.push_back((spec.radius_m + place.y()) *
                           Vector2d(std::cos(angle), std::sin(angle)));
  }
  group.aside_m = 0.1 * std::sqrt(2 * half * length / static_cast<double>(spec.people));
  group.speed = spec.speed;
  scene.groups = {group};
  scene.walls = {regular_polygon(inner, false), regular_polygon(outer, true)};
  scene.files = {{"around.txt", around_field(outer + 1)}};
  scene.behavior.add_state(
      "Walk",
      {describe::select_own_place(),
       describe::velocity("vel_field", {{"file_name", "around.txt"}, {"use_nearest", false}})});
  return scene;
}

double mean_ring_speed(crowd::Simulation& crowd, double from_s, double until_s) {
  while (crowd.time_s() < from_s) crowd.step();
  double sum = 0;
  std::size_t samples = 0;
  while (crowd.time_s() < until_s) {
    crowd.step();
    for (std::size_t i = 0; i < crowd.agent_count(); ++i) {
      const Vector2d place = crowd.positions()[i].cast<double>();
      const Vector2d along = Vector2d(-place.y(), place.x()).normalized();
      sum += along.dot(crowd.velocities()[i].cast<double>());
      ++samples;
    }
  }
  return sum / static_cast<double>(samples);
}

DensitySpeed walk_in_ring(const Tested& tested, double density, std::uint64_t seed, Ring corridor) {
  const double area = 2 * M_PI * corridor.radius_m * corridor.width_m;
  corridor.people = static_cast<std::size_t>(std::lround(density * area));
  crowd::Simulation crowd = load(ring(corridor), tested, seed);
  return {density, mean_ring_speed(crowd, 20, 50)};
}

namespace {

/// The wall on one side of a door: on the left of those who leave (1) or on their right (-1).
Polygon jamb(const Bottleneck& door, double outer_m, double side) {
  const double half = door.width_m / 2;
  const double cut = std::min(door.corner_cut_m, door.room_m / 2 - half);
  const double depth = std::min(cut, door.wall_m);
  Polygon corners = {{0, side * outer_m}, {0, side * (half + cut)}};
  if (depth > 0) corners.emplace_back(depth, side * half);
  if (depth < door.wall_m) corners.emplace_back(door.wall_m, side * half);
  corners.emplace_back(door.wall_m, side * outer_m);
  if (side < 0) std::reverse(corners.begin(), corners.end());
  return corners;
}

}  // namespace

std::vector<Bottleneck> drawn_doors(double width_m, bool all) {
  using Lengths = std::vector<double>;
  constexpr std::size_t kPeople = 75;
  std::vector<Bottleneck> doors;
  for (const double depth_m : all ? Lengths{0.1, 0.4, 1.1} : Lengths{0.1, 1.1}) {
    for (const double room_m : all ? Lengths{1.8, 2.4, 5.6} : Lengths{2.4}) {
      for (const double cut_m : all ? Lengths{0, 0.05, 0.15, 0.3} : Lengths{0, 0.15}) {
        doors.push_back({width_m, depth_m, kPeople, room_m, cut_m});
      }
    }
  }
  return doors;
}

TestScene room_with_door(const Bottleneck& door) {
  constexpr double kWall = 1;          // m
  constexpr double kMaxDensity = 2.5;  // 1/m^2, before people move
  constexpr double kAsideM = 0.1;      // at random
  const double side = door.room_m / 2;
  const double length =
      std::max(10.0, static_cast<double>(door.people) / (kMaxDensity * door.room_m));
  const double outer = side + kWall;
  TestScene scene;
  scene.walls = {box(-length - kWall, -outer, 0, -side), box(-length - kWall, side, 0, outer),
                 box(-length - kWall, -side, -length, side), jamb(door, outer, -1),
                 jamb(door, outer, 1)};
  Group group;
  const double reach = side - 0.25;
  group.places = lattice({-length + 0.5, -reach}, {-0.5, reach}, door.people);
  group.aside_m = kAsideM;
  scene.groups = {group};
  const double beyond = door.wall_m + 6;
  scene.behavior.goal_box(0, beyond, -2, beyond + 2, 2).walk_to(0).leave_at_goal();
  return scene;
}

double central_rate(const std::vector<double>& times_s, std::size_t people) {
  const std::size_t first = people / 10;
  const std::size_t last = people * 8 / 10;
  if (first == 0 || times_s.size() < last) return 0;
  return static_cast<double>(last - first) / (times_s[last - 1] - times_s[first - 1]);
}

double specific_flow(const Tested& tested, const Bottleneck& bottleneck, std::uint64_t seed) {
  crowd::Simulation crowd = load(room_with_door(bottleneck), tested, seed);
  std::vector<bool> passed(crowd.agent_count(), false);
  std::vector<double> times_s;
  const std::size_t last = bottleneck.people * 8 / 10;
  constexpr double kMaxDurationS = 300;  // s
  while (times_s.size() < last && crowd.time_s() < kMaxDurationS) {
    crowd.step();
    for (std::size_t i = 0; i < crowd.agent_count(); ++i) {
      if (passed[i] || crowd.positions()[i].x() <= 0) continue;
      passed[i] = true;
      times_s.push_back(crowd.time_s());
    }
  }
  return central_rate(times_s, bottleneck.people) / bottleneck.width_m;
}

}  // namespace throng::validation
