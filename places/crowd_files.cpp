#include "places/crowd_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "places/behavior_file.h"
#include "places/blocked.h"

namespace throng::places {

using Eigen::Vector2d;
using world::Exit;
using world::Scenario;

namespace {

constexpr double kClearanceM = 0.45;
constexpr double kSourceBehindM = 6;  // beyond the door that people come in by
constexpr double kSlimmestM = 0.195;  // radius

/// `more` is what the group has beside its generators.
std::string agent_group(const std::string& profile, const std::string& state,
                        const std::string& generators, const std::string& more = "") {
  return fmt::format(
      "  <AgentGroup>\n    <ProfileSelector type=\"const\" name=\"{}\"/>\n"
      "    <StateSelector type=\"const\" name=\"{}\"/>\n{}{}  </AgentGroup>\n",
      profile, state, generators, more);
}

std::string facing_element(const Facing& facing) {
  switch (facing.kind) {
    case Facing::Kind::towards:
      return fmt::format(
          "    <Facing type=\"towards\" x=\"{:.2f}\" y=\"{:.2f}\" spread=\"{:.4g}\"/>\n",
          facing.point.x(), facing.point.y(), facing.spread_deg);
    case Facing::Kind::direction:
      return fmt::format("    <Facing type=\"direction\" angle=\"{:.4g}\" spread=\"{:.4g}\"/>\n",
                         facing.angle_deg, facing.spread_deg);
    case Facing::Kind::random:
      break;
  }
  return "    <Facing type=\"random\"/>\n";
}

/// Those who stand in line look to its head unless it says otherwise.
Facing facing_of(const Line& line) {
  if (line.facing) return *line.facing;
  const Vector2d ahead = line.from - line.to;
  if (ahead.norm() == 0) return {};
  constexpr double kDegrees = 180 / std::numbers::pi;
  return {Facing::Kind::direction, {}, kDegrees * std::atan2(ahead.y(), ahead.x())};
}

std::string agent_at(const Vector2d& place) {
  return fmt::format("      <Agent p_x=\"{:.2f}\" p_y=\"{:.2f}\"/>\n", place.x(), place.y());
}

std::string explicit_places(const std::vector<Vector2d>& places) {
  std::string text = "    <Generator type=\"explicit\">\n";
  for (const Vector2d& place : places) text += agent_at(place);
  return text + "    </Generator>\n";
}

std::string vertices(const std::vector<Vector2d>& outline) {
  std::string text;
  for (const Vector2d& corner : outline) {
    text += fmt::format("<Vertex p_x=\"{:.3f}\" p_y=\"{:.3f}\"/>", corner.x(), corner.y());
  }
  return text;
}

std::string lines_of(const People& people, std::vector<Vector2d>& taken) {
  std::string text;
  for (const Line& line : people.lines) {
    std::vector<Vector2d> places;
    for (int i = 0; i < line.count; ++i) {
      const double share = line.count > 1 ? static_cast<double>(i) / (line.count - 1) : 0;
      places.push_back(line.from + share * (line.to - line.from));
    }
    text += agent_group("person", state_of(Doing::wait), explicit_places(places),
                        facing_element(facing_of(line)));
    taken.insert(taken.end(), places.begin(), places.end());
  }
  return text;
}

std::string groups_of(const People& people, const Solids& solids, std::vector<Vector2d>& taken,
                      std::vector<Problem>& problems) {
  std::string text;
  for (std::size_t i = 0; i < people.groups.size(); ++i) {
    const Group& group = people.groups[i];
    const Standing standing = stand(group.area, group.count, solids, kClearanceM, taken);
    if (standing.count < group.count) {
      problems.push_back(
          {"", fmt::format("/people/groups/{}/count", i), std::to_string(group.count),
           fmt::format("at most {}, as many as have room in the area", standing.count)});
    }
    if (standing.count == 0) continue;
    const std::string generator = fmt::format(
        "    <Generator type=\"scatter\" count=\"{}\" apart=\"{:.3f}\" clearance=\"{:.3f}\" "
        "obstacleSet=\"1\">\n      {}\n    </Generator>\n",
        standing.count, standing.apart_m, kClearanceM, vertices(group.area));
    text += agent_group("person", state_of(group.doing), generator,
                        group.doing == Doing::wait ? facing_element(group.facing) : "");
  }
  return text;
}

/// Places side by side along a segment where there is room.
std::vector<Vector2d> places_along(const Vector2d& from, const Vector2d& to, const Solids& solids) {
  constexpr double kApartM = 0.8;
  std::vector<Vector2d> places;
  const double length = (to - from).norm();
  const int count = std::max(1, static_cast<int>(length / kApartM));
  for (int i = 0; i < count; ++i) {
    const Vector2d place = from + (i + 0.5) / count * (to - from);
    if (solids.is_clear(place, kClearanceM)) places.push_back(place);
  }
  return places;
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
std::string arrivals_of(const Source& source, double closed_s) {
  const std::string closed =
      std::isfinite(closed_s) ? fmt::format(" closed_from=\"{:.6g}\"", closed_s) : "";
  if (source.table.empty()) {
    constexpr double kSecondsPerMinute = 60;
    return fmt::format("    <Arrivals type=\"rate\" per_second=\"{:.6g}\" end=\"{:.6g}\"{}/>\n",
                       source.per_minute / kSecondsPerMinute, source.until_s, closed);
  }
  std::string text = fmt::format("    <Arrivals type=\"table\"{}>", closed);
  for (const auto& [time_s, count] : source.table) {
    text += fmt::format("<At time=\"{:.6g}\" count=\"{}\"/>", time_s, count);
  }
  return text + "</Arrivals>\n";
}

std::string sources_of(const Scenario& scenario, const People& people, const Solids& solids,
                       std::vector<Problem>& problems) {
  std::string text;
  const std::vector<BlockedDisc> discs = blocked_discs(people);
  for (std::size_t i = 0; i < people.sources.size(); ++i) {
    const Source& source = people.sources[i];
    Vector2d from = source.from;
    Vector2d to = source.to;
    double closed_s = std::numeric_limits<double>::infinity();
    if (source.exit) {
      const Exit& exit = scenario.exits[*source.exit];
      closed_s = reached_s(exit.from, exit.to, discs);
      from = exit.from + kSourceBehindM * exit.outward;
      to = exit.to + kSourceBehindM * exit.outward;
    }
    const std::vector<Vector2d> places = places_along(from, to, solids);
    if (places.empty()) {
      problems.push_back({"", fmt::format("/people/sources/{}", i),
                          "nothing but walls where people are to come from", "free ground there"});
      continue;
    }
    // Nobody comes in by a door or a road that a disaster has reached.
    closed_s = std::min(closed_s, reached_s(from, to, discs));
    const std::string state =
        source.towards ? state_towards(scenario.exits[*source.towards]) : state_of(source.doing);
    text += agent_group("person", state, explicit_places(places), arrivals_of(source, closed_s));
  }
  return text;
}

std::string obstacle(const std::vector<Vector2d>& outline) {
  return fmt::format("    <Obstacle closed=\"1\">{}</Obstacle>\n", vertices(outline));
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

/// What shuts a door: from its line to beyond the place where those are bound who take it.
std::vector<Vector2d> shutter(const Exit& exit) {
  constexpr double kDeepM = 1.4;
  const Vector2d along = exit.to - exit.from;
  const bool leads_left = Vector2d(-along.y(), along.x()).dot(exit.outward) > 0;
  const Vector2d right = leads_left ? exit.from : exit.to;
  const Vector2d left = leads_left ? exit.to : exit.from;
  return {right, left, left + kDeepM * exit.outward, right + kDeepM * exit.outward};
}

std::string obstacles_of(const Scenario& scenario, const People& people, const Solids& solids) {
  std::string text = "  <ObstacleSet type=\"explicit\" class=\"1\">\n";
  for (const auto& outline : solids.outlines()) text += obstacle(outline);
  text += "  </ObstacleSet>\n";
  const std::vector<BlockedDisc> discs = blocked_discs(people);
  if (!discs.empty()) {
    text +=
        "  <!-- What is in the way of those who have noticed it, at first and as it grows. -->\n";
  }
  for (const BlockedDisc& disc : discs) {
    std::string outlines = obstacle(octagon(disc.middle, disc.radius_m));
    for (const Exit& exit : scenario.exits) {
      if (first_to_reach(exit, discs) == &disc) outlines += obstacle(shutter(exit));
    }
    text += fmt::format("  <ObstacleSet type=\"explicit\" class=\"{}\">\n{}  </ObstacleSet>\n",
                        disc.obstacle_class, outlines);
  }
  return text;
}

std::string profiles_of(const People& people) {
  std::string text = fmt::format(
      "  <AgentProfile name=\"person\">\n"
      "    <Common max_angle_vel=\"360\" max_neighbors=\"10\" obstacleSet=\"1\" "
      "neighbor_dist=\"5\" class=\"1\"\n            max_speed=\"3\" max_accel=\"5\">\n"
      "      <Property name=\"pref_speed\" dist=\"n\" mean=\"{:.3g}\" stddev=\"{:.3g}\"/>\n"
      // So alike that all of them share one mesh of ways (crowd/auto_navigation.h).
      "      <Property name=\"r\" dist=\"u\" min=\"{:.3g}\" max=\"0.24\"/>\n"
      "    </Common>\n  </AgentProfile>\n",
      people.speed_mps, 0.19 * people.speed_mps, kSlimmestM);
  if (people.dangers.empty()) return text;
  text +=
      "  <AgentProfile name=\"danger\">\n"
      "    <Common max_neighbors=\"0\" neighbor_dist=\"0\" obstacleSet=\"0\" r=\"0.3\" "
      "class=\"2\" pref_speed=\"0\"\n            max_speed=\"0\"/>\n  </AgentProfile>\n"
      "  <AgentProfile name=\"attacker\">\n"
      "    <Common max_neighbors=\"6\" neighbor_dist=\"3\" obstacleSet=\"1\" r=\"0.22\" "
      "class=\"2\" pref_speed=\"1.6\"\n            max_speed=\"2.5\"/>\n  </AgentProfile>\n";
  return text;
}

/// One group each, before all others: their numbers are those of the blueprint's list.
std::string dangers_of(const People& people) {
  std::string text;
  for (const Danger& danger : people.dangers) {
    const bool moves = danger.seen.kind == world::DisasterKind::attacker;
    text += agent_group(moves ? "attacker" : "danger", moves ? "Attack" : "Danger",
                        explicit_places({danger.seen.position}));
  }
  return text;
}

/// Where strollers go where the blueprint does not say: some of the places where they start.
std::vector<Vector2d> usual_spots(const People& people, const Solids& solids) {
  constexpr int kSpots = 24;
  std::vector<Vector2d> spots;
  for (const Group& group : people.groups) {
    if (group.doing != Doing::stroll) continue;
    stand(group.area, kSpots, solids, 2 * kClearanceM, spots);
  }
  return spots;
}

}  // namespace

CrowdFiles write_crowd(const Scenario& scenario, const People& people,
                       std::vector<Problem>& problems) {
  const Solids solids(scenario);
  People complete = people;
  if (complete.spots.empty()) complete.spots = usual_spots(people, solids);
  CrowdFiles files;
  files.scene =
      "<?xml version=\"1.0\"?>\n<Experiment version=\"2.0\">\n"
      "  <SpatialQuery type=\"kd-tree\" test_visibility=\"0\"/>\n"
      "  <Common time_step=\"0.1\"/>\n";
  if (people.in_groups > 0) {
    files.scene += fmt::format("  <SocialGroups share=\"{:.3g}\"/>\n", people.in_groups);
  }
  std::vector<Vector2d> taken;
  files.scene += profiles_of(people) + dangers_of(people) + lines_of(people, taken);
  files.scene += groups_of(people, solids, taken, problems) +
                 sources_of(scenario, people, solids, problems) +
                 obstacles_of(scenario, people, solids) + "</Experiment>\n";
  files.behavior = behavior_text(scenario, complete);
  return files;
}

}  // namespace throng::places
