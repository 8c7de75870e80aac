#include "validation/walking.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "base/geometry/angle.h"
#include "validation/flow.h"
#include "validation/run.h"

namespace throng::validation {

using Eigen::Vector2d;
using Eigen::Vector2f;

namespace {

constexpr double kStuckS = 10;  // of getting nowhere

/// The positions of people, which give later the share of those who have got nowhere.
class Snapshot {
 public:
  explicit Snapshot(const crowd::Simulation& crowd)
      : present_(crowd.present().begin(), crowd.present().end()),
        positions_(crowd.positions().begin(), crowd.positions().end()) {}

  /// The share of those who are still there that are less than 1 m away.
  double share_stuck(const crowd::Simulation& crowd) const {
    std::size_t stuck = 0;
    std::size_t all = 0;
    for (std::size_t i = 0; i < positions_.size(); ++i) {
      if (present_[i] == 0 || crowd.present()[i] == 0) continue;
      ++all;
      stuck += (crowd.positions()[i] - positions_[i]).norm() < 1 ? 1 : 0;
    }
    return all == 0 ? 0 : static_cast<double>(stuck) / static_cast<double>(all);
  }

 private:
  std::vector<std::uint8_t> present_;
  std::vector<Vector2f> positions_;
};

/// Steps, and calls act(agent) for those who have left.
class Leavers {
 public:
  explicit Leavers(crowd::Simulation& crowd)
      : crowd_(crowd), was_(crowd.present().begin(), crowd.present().end()) {}

  template <typename Act>
  void step(const Act& act) {
    crowd_.step();
    for (std::size_t i = 0; i < was_.size(); ++i) {
      if (was_[i] != 0 && crowd_.present()[i] == 0) act(i);
      was_[i] = crowd_.present()[i];
    }
  }

 private:
  crowd::Simulation& crowd_;
  std::vector<std::uint8_t> was_;
};

}  // namespace

ExitRun leave_room(const Tested& tested, std::uint64_t seed) {
  TestScene scene;
  scene.walls = {box(-9, -3.5, 0, -2.5), box(-9, 2.5, 0, 3.5), box(-9, -2.5, -8, 2.5),
                 box(0, -3.5, 0.2, -0.5), box(0, 0.5, 0.2, 3.5)};
  Group group;
  group.places = lattice({-7.7, -2.2}, {-0.3, 2.2}, 100);
  group.aside_m = 0.05;
  scene.groups = {group};
  scene.behavior.goal_box(0, 6, -2, 8, 2).walk_to(0).leave_at_goal();
  crowd::Simulation crowd = load(scene, tested, seed);
  double last_s = 0;
  std::size_t out = 0;
  double overlap = 0;
  std::vector<bool> passed(crowd.agent_count(), false);
  while (out < 100 && crowd.time_s() < 400) {
    crowd.step();
    overlap = std::max(overlap, deepest_overlap_m(crowd));
    for (std::size_t i = 0; i < 100; ++i) {
      if (passed[i] || crowd.positions()[i].x() <= 0.1F) continue;
      passed[i] = true;
      ++out;
      last_s = crowd.time_s();
    }
  }
  return {out == 100, out > 0 ? static_cast<double>(out) / last_s : 0, overlap};
}

TestScene square_scene(double density) {
  TestScene scene;
  scene.walls = {box(-16, -16, 16, -15), box(-16, 15, 16, 16), box(-16, -15, -15, 15),
                 box(15, -15, 16, 15)};
  Group group;
  group.places =
      lattice({-14, -14}, {14, 14}, static_cast<std::size_t>(std::lround(density * 900)));
  group.aside_m = 0.1;
  scene.groups = {group};
  std::vector<crowd::Node> goals;
  for (int i = 0; i < 64; ++i) {
    const int row = i / 8;
    goals.push_back(describe::circle_goal(i, {-12.25 + 3.5 * (i % 8), -12.25 + 3.5 * row}, 1.5));
  }
  scene.behavior.add_goal_set(0, std::move(goals));
  for (const char* state : {"Walk", "On"}) {
    scene.behavior.add_state(state,
                             {describe::select_goal("random", 0), describe::velocity("goal")});
  }
  scene.behavior.add_transition("Walk", "On", describe::goal_reached());
  scene.behavior.add_transition("On", "Walk", describe::goal_reached());
  return scene;
}

SquareRun cross_square(const Tested& tested, double density, std::uint64_t seed) {
  crowd::Simulation crowd = load(square_scene(density), tested, seed);
  constexpr double kEndS = 120;
  while (crowd.time_s() < kEndS - kStuckS) crowd.step();
  const Snapshot before(crowd);
  const std::size_t people = crowd.agent_count();
  double speed = 0;
  double accel_sq = 0;
  std::size_t samples = 0;
  std::vector<Vector2f> v(crowd.velocities().begin(), crowd.velocities().end());
  while (crowd.time_s() < kEndS) {
    crowd.step();
    for (std::size_t i = 0; i < people; ++i, ++samples) {
      speed += crowd.velocities()[i].norm();
      accel_sq += ((crowd.velocities()[i] - v[i]) / 0.1F).squaredNorm();
    }
    v.assign(crowd.velocities().begin(), crowd.velocities().end());
  }
  return {before.share_stuck(crowd), speed / static_cast<double>(samples),
          std::sqrt(accel_sq / static_cast<double>(samples))};
}

TestScene two_rooms(std::size_t others) {
  TestScene scene;
  scene.walls = {box(-11, -6, -10, 6), box(20, -6, 21, 6), box(-10, -6, 20, -5),
                 box(-10, 5, 20, 6),   box(0, -5, 10, -1), box(0, 1, 10, 5)};
  Group there;
  there.places = lattice({-9.5, -4.5}, {-0.5, 4.5}, 100);
  there.state = "There";
  scene.groups = {there};
  if (others > 0) {
    Group back;
    back.places = lattice({10.5, -4.5}, {19.5, 4.5}, others);
    back.state = "Back";
    scene.groups.push_back(back);
  }
  scene.behavior.goal_box(0, 17, -4.5, 19.5, 4.5)
      .goal_box(1, -9.5, -4.5, -7, 4.5)
      .walk_to(0, "There")
      .walk_to(1, "Back")
      .leave_at_goal("There,Back");
  return scene;
}

CounterRun pass_corridor(const Tested& tested, std::size_t others, std::uint64_t seed) {
  crowd::Simulation crowd = load(two_rooms(others), tested, seed);
  while (crowd.time_s() < 600 && count_present(crowd) > 0) crowd.step();
  return {crowd.time_s(), count_present(crowd)};
}

TwoWayRun walk_both_ways(const Tested& tested, double each, std::uint64_t seed) {
  TestScene scene;
  scene.walls = {box(-30, -3, 30, -2), box(-30, 2, 30, 3)};
  constexpr double kBeginS = 60;
  constexpr double kEndS = 600;
  const auto people = static_cast<std::size_t>(each * 4 * kEndS);
  for (const bool there : {true, false}) {
    Group group;
    const double x = there ? -16 : 16;
    for (std::size_t i = 0; i < people; ++i) {
      group.places.emplace_back(x - (there ? 1 : -1) * 0.5 * static_cast<double>(i / 7 % 8),
                                -1.65 + 0.55 * static_cast<double>(i % 7));
    }
    group.state = there ? "There" : "Back";
    group.more = {describe::typed(
        "Arrivals", "rate", {{"per_second", each * 4}, {"end", kEndS}, {"process", "poisson"}})};
    scene.groups.push_back(group);
  }
  scene.behavior.goal_box(0, 20, -2, 24, 2)
      .goal_box(1, -24, -2, -20, 2)
      .walk_to(0, "There")
      .walk_to(1, "Back")
      .leave_at_goal("There,Back");
  crowd::Simulation crowd = load(scene, tested, seed);
  while (crowd.time_s() < kBeginS) crowd.step();
  std::array<std::size_t, 2> out{};
  Leavers leavers(crowd);
  const auto count = [&](std::size_t agent) { ++out[agent < people ? 0 : 1]; };
  while (crowd.time_s() < kEndS - kStuckS) leavers.step(count);
  const Snapshot before(crowd);
  while (crowd.time_s() < kEndS) leavers.step(count);
  constexpr double kMeterSeconds = 4 * (kEndS - kBeginS);
  return {static_cast<double>(out[0]) / kMeterSeconds, static_cast<double>(out[1]) / kMeterSeconds,
          before.share_stuck(crowd)};
}

double corridor_flow(const Tested& tested, const Passage& passage, std::uint64_t seed) {
  constexpr double kTurn = 10;   // m from the origin
  constexpr double kThin = 0.2;  // m
  const double width = passage.width_m;
  TestScene scene;
  Group group;
  const double first = passage.queued ? kTurn - 0.5 : -0.5;
  const double per_m2 = passage.queued ? 3 : 2;
  group.places = lattice({-40, 0.3}, {first, width - 0.3},
                         static_cast<std::size_t>(per_m2 * (first + 40.5) * width));
  group.aside_m = 0.05;
  scene.groups = {group};
  scene.walls = {box(-43, -1, -42, width + 1)};
  if (passage.turn == Turn::none) {
    scene.walls.push_back(box(-42, -1, 40, 0));
    scene.walls.push_back(box(-42, width, 40, width + 1));
    scene.behavior.goal_box(0, 20 + width, 0.3, 24 + width, width - 0.3);
  } else {
    const double end = 19 + width;
    scene.walls.push_back(box(-42, -1, kTurn + width + 1, 0));
    scene.walls.push_back(box(kTurn + width, 0, kTurn + width + 1, end));
    if (passage.turn == Turn::block) {
      scene.walls.push_back(box(-42, width, kTurn, end));
    } else {
      scene.walls.push_back(box(-42, width, kTurn, width + kThin));
      scene.walls.push_back(box(kTurn - kThin, width + kThin, kTurn, end));
    }
    scene.behavior.goal_box(0, kTurn + 0.3, width + 10, kTurn + width - 0.3, width + 14);
  }
  scene.behavior.walk_to(0).leave_at_goal();
  crowd::Simulation crowd = load(scene, tested, seed);
  std::vector<double> times;
  const std::size_t people = crowd.agent_count();
  const std::size_t last = people * 8 / 10;
  Leavers leavers(crowd);
  while (times.size() < last && crowd.time_s() < 600) {
    leavers.step([&](std::size_t) { times.push_back(crowd.time_s()); });
  }
  return central_rate(times, people) / width;
}

MeetingRun meet(const Tested& tested, double aside, std::uint64_t seed) {
  TestScene scene;
  Group group;
  group.places = {{-12, 0}};
  group.aside_m = 0;
  group.state = "There";
  group.speed = Sampled::constant(1.34);
  Group other = group;
  other.places = {{12, aside}};
  other.state = "Back";
  scene.groups = {group, other};
  scene.behavior.goal_box(0, 20, -2, 24, 2)
      .goal_box(1, -24, -2, -20, 2)
      .walk_to(0, "There")
      .walk_to(1, "Back");
  crowd::Simulation crowd = load(scene, tested, seed);
  double turned_s = -1;
  double accel = 0;
  float nearest_m = std::numeric_limits<float>::infinity();
  std::array<Vector2f, 2> v{};
  while (crowd.time_s() < 2) crowd.step();
  for (std::size_t i = 0; i < 2; ++i) v[i] = crowd.velocities()[i];
  while (crowd.positions()[0].x() < crowd.positions()[1].x() && crowd.time_s() < 60) {
    crowd.step();
    for (std::size_t i = 0; i < 2; ++i) {
      accel = std::max(accel,
                       static_cast<double>((crowd.velocities()[i] - v[i]).norm()) / crowd.dt_s());
      v[i] = crowd.velocities()[i];
    }
    if (turned_s < 0 && std::abs(crowd.velocities()[0].y()) > 0.03F) turned_s = crowd.time_s();
    nearest_m = std::min(nearest_m, (crowd.positions()[0] - crowd.positions()[1]).norm());
  }
  const bool passed = crowd.positions()[0].x() >= crowd.positions()[1].x() &&
                      nearest_m >= 2 * static_cast<float>(crowd::kAdultRadiusM);
  return {passed, turned_s < 0 ? 0 : crowd.time_s() - turned_s, accel};
}

QueueRun stand_in_queue(const Tested& tested, std::uint64_t seed) {
  crowd::Simulation crowd = load(room_with_door({0.8, 0.2, 150}), tested, seed);
  while (crowd.time_s() < 20) crowd.step();
  std::vector<float> heading(crowd.yaws_rad().begin(), crowd.yaws_rad().end());
  std::vector<std::uint8_t> walks(heading.size(), 0);
  double flips = 0;
  double stops = 0;
  double seconds = 0;
  while (crowd.time_s() < 60) {
    crowd.step();
    for (std::size_t i = 0; i < heading.size(); ++i) {
      if (crowd.present()[i] == 0 || crowd.positions()[i].x() > 0) continue;
      seconds += crowd.dt_s();
      const float turn = geometry::turn_rad(heading[i], crowd.yaws_rad()[i]);
      if (std::abs(turn) > 1.5708F) {
        ++flips;
        heading[i] = crowd.yaws_rad()[i];
      }
      const float speed = crowd.velocities()[i].norm();
      if (walks[i] != 0 && speed < 0.05F) {
        ++stops;
        walks[i] = 0;
      } else if (speed > 0.2F) {
        walks[i] = 1;
      }
    }
  }
  std::size_t passed = 0;
  for (const Vector2f& place : crowd.positions()) passed += place.x() > 0 ? 1 : 0;
  // A model of fast people may have emptied the room by then.
  const double minutes = std::max(seconds, crowd.dt_s()) / 60;
  return {passed, flips / minutes, stops / minutes};
}

}  // namespace throng::validation
