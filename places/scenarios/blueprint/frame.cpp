#include "places/scenarios/blueprint/frame.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace throng::scenarios {

using Eigen::Vector2d;
using nlohmann::json;

namespace {

constexpr double kCornerM = 2;  // of wall between a gate and a corner, at least

double rounded(double length_m) { return std::round(length_m * 100) / 100; }

/// A stretch of a side, seen along it.
struct Stretch {
  double begin_m;
  double end_m;
};

/// The parts of a side that the gates leave.
std::vector<Stretch> frame_walls(const Frame& frame, Side side) {
  std::vector<const Gate*> gates;
  for (const Gate& gate : frame.gates) {
    if (gate.side == side) gates.push_back(&gate);
  }
  std::sort(gates.begin(), gates.end(),
            [](const Gate* a, const Gate* b) { return a->middle_m < b->middle_m; });
  // Two of the sides have the corners.
  const double over_m = side == Side::south || side == Side::north ? frame.depth_m : 0;
  std::vector<Stretch> walls;
  double begin = -over_m;
  for (const Gate* gate : gates) {
    walls.push_back({begin, gate->middle_m - 0.5 * gate->width_m});
    begin = gate->middle_m + 0.5 * gate->width_m;
  }
  walls.push_back({begin, frame.length_of(side) + over_m});
  return walls;
}

/// A box of a side's wall: along it between two lengths, and so deep outwards.
std::pair<Vector2d, Vector2d> strip_corners(const Frame& frame, Side side, const Stretch& part,
                                            double depth_m) {
  switch (side) {
    case Side::south:
      return {{frame.min.x() + part.begin_m, frame.min.y() - depth_m},
              {frame.min.x() + part.end_m, frame.min.y()}};
    case Side::north:
      return {{frame.min.x() + part.begin_m, frame.max.y()},
              {frame.min.x() + part.end_m, frame.max.y() + depth_m}};
    case Side::west:
      return {{frame.min.x() - depth_m, frame.min.y() + part.begin_m},
              {frame.min.x(), frame.min.y() + part.end_m}};
    case Side::east:
      break;
  }
  return {{frame.max.x(), frame.min.y() + part.begin_m},
          {frame.max.x() + depth_m, frame.min.y() + part.end_m}};
}

json gate_json(const Frame& frame, const Gate& gate, std::size_t number) {
  const auto [low, high] = gate_ends(frame, gate);
  constexpr std::array<std::array<int, 2>, 4> kOutward = {{{0, -1}, {1, 0}, {0, 1}, {-1, 0}}};
  return {{"id", fmt::format("exit{}", number + 1)},
          {"from", point_json(low)},
          {"to", point_json(high)},
          {"outward", kOutward.at(static_cast<std::size_t>(gate.side))}};
}

}  // namespace

std::pair<Vector2d, Vector2d> gate_ends(const Frame& frame, const Gate& gate) {
  const Stretch gap{gate.middle_m - 0.5 * gate.width_m, gate.middle_m + 0.5 * gate.width_m};
  return strip_corners(frame, gate.side, gap, 0);
}

void add_area(const Vector2d& min, const Vector2d& max, const char* material, bool kerb,
              json& blueprint) {
  json area = {{"corners", outline_json(min, max)}, {"material", material}};
  if (kerb) area["kerb"] = 1;
  blueprint["ground"]["areas"].push_back(area);
}

std::vector<Gate> spread_gates(const Frame& frame, const std::vector<Side>& sides, int count,
                               double width_m, Random& random) {
  std::vector<int> on_side(sides.size(), 0);
  const auto room = [&](std::size_t i) {
    return static_cast<int>(frame.length_of(sides[i]) / (2 * width_m + 2 * kCornerM));
  };
  for (int placed = 0, tries = 0; placed < count && tries < 8 * count; ++tries) {
    const std::size_t i = static_cast<std::size_t>(tries) % sides.size();
    if (on_side[i] > 0 && on_side[i] >= room(i)) continue;
    ++on_side[i];
    ++placed;
  }
  std::vector<Gate> gates;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const double slot_m = frame.length_of(sides[i]) / std::max(1, on_side[i]);
    const double fitting_m = std::min(width_m, slot_m - 2 * kCornerM);
    for (int k = 0; k < on_side[i]; ++k) {
      const double play_m = std::max(0.0, 0.5 * (slot_m - fitting_m) - kCornerM);
      const double middle_m = (k + 0.5) * slot_m + random.uniform(-play_m, play_m);
      gates.push_back({sides[i], rounded(middle_m), rounded(fitting_m)});
    }
  }
  return gates;
}

json point_json(const Vector2d& point) { return {rounded(point.x()), rounded(point.y())}; }

json outline_json(const Vector2d& min, const Vector2d& max) {
  return {point_json(min), point_json({max.x(), min.y()}), point_json(max),
          point_json({min.x(), max.y()})};
}

json house_json(const std::string& id, const Vector2d& min, const Vector2d& max, double height_m,
                Random& random) {
  constexpr std::array<const char*, 3> kFacades = {"plaster", "brick", "glass"};
  return {{"id", id},
          {"footprint", outline_json(min, max)},
          {"height_m", std::round(height_m * 10) / 10},
          {"facade", kFacades.at(random.below(kFacades.size()))}};
}

void build_walls(const Frame& frame, const WallStyle& style, Random& random, json& blueprint) {
  constexpr double kGardenWallM = 0.4;
  constexpr double kGardenWallHeightM = 2.2;
  json& buildings = blueprint["buildings"];
  for (const Side side : {Side::south, Side::east, Side::north, Side::west}) {
    for (const Stretch& wall : frame_walls(frame, side)) {
      double begin = wall.begin_m;
      while (wall.end_m - begin > 0.01) {
        double end = begin + random.uniform(9, 24);
        constexpr double kLeftoverM = 6;  // too little for another house
        if (wall.end_m - end < kLeftoverM) end = wall.end_m;
        const bool is_house = random.uniform() < style.density;
        const auto [low, high] =
            strip_corners(frame, side, {begin, end}, is_house ? frame.depth_m : kGardenWallM);
        const std::string id = fmt::format("house{}", buildings.size() + 1);
        const double height_m =
            is_house ? random.uniform(style.min_height_m, style.max_height_m) : kGardenWallHeightM;
        buildings.push_back(house_json(id, low, high, height_m, random));
        begin = end;
      }
    }
  }
  for (std::size_t i = 0; i < frame.gates.size(); ++i) {
    blueprint["exits"].push_back(gate_json(frame, frame.gates[i], i));
  }
}

}  // namespace throng::scenarios
