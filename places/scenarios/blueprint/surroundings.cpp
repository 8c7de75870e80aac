#include "places/scenarios/blueprint/surroundings.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/geometry/angle.h"

namespace throng::scenarios {

using Eigen::Vector2d;
using nlohmann::json;

namespace {

constexpr double kRoadM = 7;      // wide
constexpr double kPavementM = 3;  // between the road and what is behind it
constexpr double kDeepestM = 20;  // of what is behind it
constexpr double kCarFromRoadM = 1.2;

/// One side of the rectangle around the scenario, seen from within: along it, and outwards.
struct Edge {
  Vector2d middle;
  Vector2d along;
  Vector2d outward;
  double half_m;

  Vector2d at(double along_m, double outward_m) const {
    return middle + along_m * along + outward_m * outward;
  }
  /// Corners of a box, counter-clockwise.
  std::pair<Vector2d, Vector2d> box(double begin_m, double end_m, double near_m,
                                    double far_m) const {
    const Vector2d a = at(begin_m, near_m);
    const Vector2d b = at(end_m, far_m);
    return {a.cwiseMin(b), a.cwiseMax(b)};
  }
};

std::array<Edge, 4> frame_edges(const Frame& frame, double from_m) {
  const Vector2d middle = 0.5 * (frame.min + frame.max);
  const Vector2d half = 0.5 * frame.size() + Vector2d::Constant(frame.depth_m + from_m);
  const Vector2d x = Vector2d::UnitX() * half.x();
  const Vector2d y = Vector2d::UnitY() * half.y();
  return {{{middle - y, Vector2d::UnitX(), -Vector2d::UnitY(), half.x()},
           {middle + x, Vector2d::UnitY(), Vector2d::UnitX(), half.y()},
           {middle + y, -Vector2d::UnitX(), Vector2d::UnitY(), half.x()},
           {middle - x, -Vector2d::UnitY(), -Vector2d::UnitX(), half.y()}}};
}

void add_street(const Edge& edge, Random& random, json& blueprint) {
  constexpr double kParkingM = 6.2;  // along the kerb, for a car
  blueprint["ground"]["markings"].push_back(
      {{"kind", "dashes"},
       {"from", point_json(edge.at(-edge.half_m, 0.5 * kRoadM))},
       {"to", point_json(edge.at(edge.half_m, 0.5 * kRoadM))}});
  const double parked = random.uniform(0.1, 0.7);
  const double yaw_deg = std::atan2(edge.along.y(), edge.along.x()) / kDegree;
  for (double along = -edge.half_m + kRoadM; along < edge.half_m - kRoadM; along += kParkingM) {
    if (random.uniform() > parked) continue;
    const Vector2d at = edge.at(along + random.uniform(-0.6, 0.6), kRoadM - kCarFromRoadM);
    blueprint["props"].push_back({{"kind", "car"},
                                  {"position", point_json(at)},
                                  {"yaw_deg", random.uniform() < 0.5 ? yaw_deg : yaw_deg + 180},
                                  {"look", random.below(1000)}});
  }
}

void add_lawn(const Edge& edge, Random& random, json& blueprint) {
  const auto [low, high] =
      edge.box(-edge.half_m, edge.half_m, kRoadM + kPavementM, kRoadM + kPavementM + kDeepestM);
  add_area(low, high, "grass", true, blueprint);
  const Vector2d inset = Vector2d::Constant(2);
  blueprint["scatter"].push_back(
      {{"kinds", {"tree"}},
       {"area", outline_json(low + inset, high - inset)},
       {"count", static_cast<int>(edge.half_m * random.uniform(0.2, 0.6))},
       {"seed", random.below(1'000'000)},
       {"apart_m", 5}});
}

void add_houses(const Edge& edge, Random& random, json& blueprint) {
  constexpr double kMinWidthM = 9;
  const double near_m = kRoadM + kPavementM;
  const double tall_m = random.uniform(8, 15);
  double begin = -edge.half_m;
  while (edge.half_m - begin > kMinWidthM) {
    const double end = std::min(edge.half_m, begin + random.uniform(kMinWidthM, 22));
    const double far_m = near_m + random.uniform(9, 14);
    const auto [low, high] = edge.box(begin, end, near_m, far_m);
    json& buildings = blueprint["buildings"];
    buildings.push_back(house_json(fmt::format("over_the_road{}", buildings.size() + 1), low, high,
                                   tall_m * random.uniform(0.6, 1.1), random));
    begin = end + (random.uniform() < 0.3 ? random.uniform(3, 8) : 0);
  }
}

}  // namespace

void add_surroundings(const Frame& frame, double from_m, double density, Random& random,
                      json& blueprint) {
  const std::array<Edge, 4> edges = frame_edges(frame, from_m);
  for (const Edge& edge : edges) {  // as wide as the corners need, so that the kerbs meet
    const auto [low, high] = edge.box(-edge.half_m - kRoadM, edge.half_m + kRoadM, 0, kRoadM);
    add_area(low, high, "asphalt", false, blueprint);
  }
  for (const Edge& edge : edges) {
    constexpr double kOuterM = kRoadM + kPavementM;
    const auto [low, high] =
        edge.box(-edge.half_m - kOuterM, edge.half_m + kOuterM, kRoadM, kOuterM);
    add_area(low, high, "pavers", false, blueprint);
  }
  for (const Edge& edge : edges) {
    add_street(edge, random, blueprint);
    if (random.uniform() < 0.25 + 0.6 * density) {
      add_houses(edge, random, blueprint);
    } else {
      add_lawn(edge, random, blueprint);
    }
  }
}

}  // namespace throng::scenarios
