#include "places/scenarios/blueprint/crowd_scene.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/geometry/angle.h"
#include "crowd/description/builder.h"
#include "crowd/description/options.h"
#include "places/scenarios/blueprint/blocked.h"
#include "places/scenarios/blueprint/closing_doors.h"
#include "places/scenarios/blueprint/crowd_behavior.h"

namespace throng::scenarios {

using crowd::Attribute;
using crowd::decimals_text;
using crowd::Node;
using crowd::SceneBuilder;
using crowd::describe::significant_text;
using Eigen::Vector2d;
using world::Exit;
using world::Scenario;
namespace describe = crowd::describe;

namespace {

constexpr double kClearanceM = 0.45;
constexpr double kSourceBehindM = 6;  // beyond the door that people come in by
constexpr double kSlimmestM = crowd::kAdultRadiusM - 0.015;  // radius
constexpr double kWidestM = crowd::kAdultRadiusM + 0.015;
constexpr int kOutlineDecimals = 3;

Node facing_element(const Facing& facing) {
  const std::string spread = significant_text(facing.spread_deg, 4);
  switch (facing.kind) {
    case Facing::Kind::towards:
      return describe::typed("Facing", "towards",
                             {{"x", decimals_text(facing.point.x(), 2)},
                              {"y", decimals_text(facing.point.y(), 2)},
                              {"spread", spread}});
    case Facing::Kind::direction:
      return describe::typed(
          "Facing", "direction",
          {{"angle", significant_text(facing.angle_deg, 4)}, {"spread", spread}});
    case Facing::Kind::random:
      break;
  }
  return describe::typed("Facing", "random");
}

/// People in a queue look to its head unless the blueprint says otherwise.
Facing line_facing(const Line& line) {
  if (line.facing) return *line.facing;
  const Vector2d ahead = line.from - line.to;
  if (ahead.norm() == 0) return {};
  return {Facing::Kind::direction, {}, 1 / kDegree * std::atan2(ahead.y(), ahead.x())};
}

Node agents_at(const std::vector<Vector2d>& points) {
  constexpr int kDecimals = 2;
  return describe::agents_at(points, kDecimals);
}

/// The profile of a group, line or source by its index in the blueprint: everybody's, or its own.
std::string profile_name(const std::optional<SampledValue>& own_speed_mps, const char* list,
                         std::size_t index) {
  return own_speed_mps ? fmt::format("person_{}_{}", list, index) : "person";
}

void add_lines(const People& people, std::vector<Vector2d>& taken, SceneBuilder& scene) {
  for (std::size_t i = 0; i < people.lines.size(); ++i) {
    const Line& line = people.lines[i];
    std::vector<Vector2d> points;
    for (int rank = 0; rank < line.count; ++rank) {
      const double share = line.count > 1 ? static_cast<double>(rank) / (line.count - 1) : 0;
      points.push_back(line.from + share * (line.to - line.from));
    }
    scene.comment(fmt::format("/people/lines/{}", i));
    scene.add_group({profile_name(line.speed_mps, "line", i),
                     state_name(Doing::wait),
                     agents_at(points),
                     {facing_element(line_facing(line))}});
    taken.insert(taken.end(), points.begin(), points.end());
  }
}

void add_groups(const People& people, const Solids& solids, std::vector<Vector2d>& taken,
                std::vector<Problem>& problems, SceneBuilder& scene) {
  for (std::size_t i = 0; i < people.groups.size(); ++i) {
    const Group& group = people.groups[i];
    const Standing standing = stand(group.area, group.count, solids, kClearanceM, taken);
    if (standing.count < group.count) {
      problems.push_back(
          {"", fmt::format("/people/groups/{}/count", i), std::to_string(group.count),
           fmt::format("at most {}, as many as have room in the area", standing.count)});
    }
    if (standing.count == 0) continue;
    std::vector<Node> more;
    if (stays(group.doing)) more.push_back(facing_element(group.facing));
    scene.comment(fmt::format("/people/groups/{}", i));
    scene.add_group({profile_name(group.speed_mps, "group", i), state_name(group.doing),
                     describe::typed("Generator", "scatter",
                                     {{"count", standing.count},
                                      {"apart", decimals_text(standing.apart_m, 3)},
                                      {"clearance", decimals_text(kClearanceM, 3)},
                                      {"obstacleSet", 1}},
                                     describe::vertices(group.area, kOutlineDecimals)),
                     std::move(more)});
  }
}

/// Places side by side along a segment where there is room.
std::vector<Vector2d> places_along(const Vector2d& from, const Vector2d& to, const Solids& solids) {
  constexpr double kApartM = 0.8;
  std::vector<Vector2d> points;
  const double length = (to - from).norm();
  const int count = std::max(1, static_cast<int>(length / kApartM));
  for (int i = 0; i < count; ++i) {
    const Vector2d point = from + (i + 0.5) / count * (to - from);
    if (solids.is_clear(point, kClearanceM)) points.push_back(point);
  }
  return points;
}

/// When a disaster first reaches the segment; infinite when none does.
double reached_s(const Vector2d& from, const Vector2d& to, const std::vector<BlockedDisc>& discs) {
  Exit segment;
  segment.from = from;
  segment.to = to;
  const BlockedDisc* const disc = first_to_reach(segment, discs);
  return disc == nullptr ? std::numeric_limits<double>::infinity() : disc->from_s;
}

/// From `closed_s` on nobody comes.
Node make_arrivals(const Source& source, double closed_s) {
  std::vector<Attribute> closed;
  if (std::isfinite(closed_s)) closed = {{"closed_from", significant_text(closed_s, 6)}};
  // Spectators come down one by one.
  if (source.of_stand) closed.push_back({"in_groups", "no"});
  if (source.table.empty()) {
    constexpr double kSecondsPerMinute = 60;
    Node rate =
        describe::typed("Arrivals", "rate",
                        {{"per_second", significant_text(source.per_minute / kSecondsPerMinute, 6)},
                         {"end", significant_text(source.until_s, 6)}});
    for (const Attribute& attribute : closed) rate.set(attribute);
    return rate;
  }
  Node table = describe::typed("Arrivals", "table", std::move(closed));
  for (const auto& [time_s, count] : source.table) {
    table.add(Node("At", {{"time", significant_text(time_s, 6)}, {"count", count}}));
  }
  return table;
}

void add_sources(const Scenario& scenario, const People& people, const Solids& solids,
                 std::vector<Problem>& problems, SceneBuilder& scene) {
  const std::vector<BlockedDisc> discs = blocked_discs(people);
  for (std::size_t i = 0; i < people.sources.size(); ++i) {
    const Source& source = people.sources[i];
    Vector2d from = source.from;
    Vector2d to = source.to;
    double closed_s = std::numeric_limits<double>::infinity();
    if (source.exit) {
      const Exit& exit = scenario.exits[*source.exit];
      closed_s = closing_time_s(exit, discs);
      from = exit.from + kSourceBehindM * exit.outward;
      to = exit.to + kSourceBehindM * exit.outward;
    }
    const std::vector<Vector2d> points = places_along(from, to, solids);
    if (points.empty()) {
      problems.push_back({"", fmt::format("/people/sources/{}", i),
                          "nothing but walls where people are to come from", "free ground there"});
      continue;
    }
    // Nobody comes in by a door or a road that a disaster has reached.
    closed_s = std::min(closed_s, reached_s(from, to, discs));
    const std::string state =
        source.towards ? state_towards(scenario.exits[*source.towards]) : state_name(source.doing);
    scene.comment(source.of_stand ? fmt::format("/stands/{}/spectators", *source.of_stand)
                                  : fmt::format("/people/sources/{}", i));
    scene.add_group({profile_name(source.speed_mps, "source", i),
                     state,
                     agents_at(points),
                     {make_arrivals(source, closed_s)}});
  }
}

/// About a disc: people keep their bodies out of it, and so their middles out of the disc.
std::vector<Vector2d> octagon(const Vector2d& middle, double disc_m) {
  const double side_m = std::max(disc_m - kSlimmestM, 0.5 * disc_m);
  const double corner_m = side_m / std::cos(std::numbers::pi / 8);
  std::vector<Vector2d> corners;
  for (int i = 0; i < 8; ++i) {
    const double angle = std::numbers::pi * (i + 0.5) / 4;
    corners.push_back(middle + corner_m * Vector2d(std::cos(angle), std::sin(angle)));
  }
  return corners;
}

void add_obstacles(const Scenario& scenario, const People& people, const Solids& solids,
                   const std::vector<ClosingDoor>& doors, SceneBuilder& scene) {
  scene.add_obstacles(solids.outlines(), 1, kOutlineDecimals);
  const std::vector<BlockedDisc> discs = blocked_discs(people);
  if (!discs.empty()) {
    scene.comment("Obstacles of those who have noticed the disaster, at first and as it grows.");
  }
  for (const BlockedDisc& disc : discs) {
    std::vector<std::vector<Vector2d>> outlines = {octagon(disc.middle, disc.radius_m)};
    for (const Exit& exit : scenario.exits) {
      if (first_to_reach(exit, discs) == &disc) outlines.push_back(shutter(exit));
    }
    scene.add_obstacles(outlines, static_cast<int>(disc.obstacle_class), kOutlineDecimals);
  }
  if (!doors.empty()) scene.comment("Exits that are closed or close.");
  for (const ClosingDoor& door : doors) {
    scene.add_obstacles({shutter(door.exit)}, static_cast<int>(door.obstacle_class),
                        kOutlineDecimals);
  }
}

void add_person(std::string name, const SampledValue& speed_mps, SceneBuilder& scene) {
  std::vector<Attribute> speed = {{"name", "pref_speed"}};
  for (const Attribute& attribute : speed_mps.attributes()) speed.push_back(attribute);
  scene.add_profile(
      {.name = std::move(name),
       .common = {{"max_angle_vel", 360},
                  {"max_neighbors", 10},
                  {"obstacleSet", 1},
                  {"neighbor_dist", 8},
                  {"class", 1},
                  {"max_speed", 3},
                  {"max_accel", 5}},
       .properties = {
           Node("Property", std::move(speed)),
           // So alike that all of them share one mesh (crowd/navigation/auto_navigation.h).
           describe::property("r", describe::Sampled::uniform(kSlimmestM, kWidestM))}});
}

void add_profiles(const People& people, SceneBuilder& scene) {
  add_person("person", people.speed_mps, scene);
  const auto add_own = [&](const auto& list, const char* name) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      const std::optional<SampledValue>& own = list[i].speed_mps;
      if (own) add_person(profile_name(own, name, i), *own, scene);
    }
  };
  add_own(people.groups, "group");
  add_own(people.lines, "line");
  add_own(people.sources, "source");
  if (people.dangers.empty()) return;
  scene.add_profile({.name = "danger",
                     .common = {{"max_neighbors", 0},
                                {"neighbor_dist", 0},
                                {"obstacleSet", 0},
                                {"r", 0.3},
                                {"class", 2},
                                {"pref_speed", 0},
                                {"max_speed", 0}}});
  scene.add_profile({.name = "attacker",
                     .common = {{"max_neighbors", 6},
                                {"neighbor_dist", 3},
                                {"obstacleSet", 1},
                                {"r", 0.22},
                                {"class", 2},
                                {"pref_speed", 1.6},
                                {"max_speed", 2.5}}});
}

/// One group each, before all others: their numbers are those of the blueprint's list.
void add_dangers(const People& people, SceneBuilder& scene) {
  for (std::size_t i = 0; i < people.dangers.size(); ++i) {
    const Danger& danger = people.dangers[i];
    scene.comment(fmt::format("/disasters/{}", i));
    const bool moves = danger.seen.kind == world::DisasterKind::attacker;
    scene.add_group({moves ? "attacker" : "danger", moves ? "Attack" : "Danger",
                     agents_at({danger.seen.position})});
  }
}

/// Strollers' goals if the blueprint names none: some of the points where they start, or anywhere
/// inside if all of them arrive later.
std::vector<Vector2d> usual_spots(const Scenario& scenario, const People& people,
                                  const Solids& solids) {
  constexpr int kSpots = 24;
  std::vector<Vector2d> spots;
  for (const Group& group : people.groups) {
    if (group.doing != Doing::stroll) continue;
    stand(group.area, kSpots, solids, 2 * kClearanceM, spots);
  }
  const bool any_arrive = std::any_of(
      people.sources.begin(), people.sources.end(),
      [](const Source& source) { return source.doing == Doing::stroll && !source.towards; });
  if (spots.empty() && any_arrive) {
    stand(scenario.inside.corners(), kSpots, solids, 2 * kClearanceM, spots);
  }
  return spots;
}

}  // namespace

crowd::CrowdDescription crowd_of_people(const Scenario& scenario, const People& people,
                                        std::vector<Problem>& problems) {
  const Solids solids(scenario);
  People complete = people;
  if (complete.spots.empty()) complete.spots = usual_spots(scenario, people, solids);
  SceneBuilder scene;
  if (people.in_groups > 0) {
    scene.add(Node("SocialGroups", {{"share", significant_text(people.in_groups, 3)}}));
  }
  std::vector<Vector2d> taken;
  add_profiles(people, scene);
  add_dangers(people, scene);
  add_lines(people, taken, scene);
  add_groups(people, solids, taken, problems, scene);
  add_sources(scenario, people, solids, problems, scene);
  const std::vector<ClosingDoor> doors =
      closing_doors(scenario.exits, blocked_discs(people), problems);
  add_obstacles(scenario, people, solids, doors, scene);
  return {scene.build(), describe_behavior(scenario, complete, doors)};
}

}  // namespace throng::scenarios
