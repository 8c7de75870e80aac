#include "world/props.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>

#include "base/compute/random.h"
#include "base/geometry/angle.h"
#include "base/geometry/polygon.h"
#include "base/geometry/rectangle.h"
#include "base/geometry/triangulate.h"
#include "world/json_reader.h"
#include "world/scenario.h"

namespace throng::world {

namespace {

constexpr double kMaxCoordinateM = 100'000;
constexpr double kMinScale = 0.2;
constexpr double kMaxScale = 5;
constexpr int kMaxScattered = 2000;
constexpr std::uint64_t kThinning = std::uint64_t{1} << 42;  // apart from other uses of the stream

/// Whether the convex outlines share a point (separating axes).
bool overlap(std::span<const Eigen::Vector2d> a, std::span<const Eigen::Vector2d> b) {
  const auto separated_by_edge_of = [](std::span<const Eigen::Vector2d> of,
                                       std::span<const Eigen::Vector2d> other) {
    for (std::size_t i = 0; i < of.size(); ++i) {
      const Eigen::Vector2d edge = of[(i + 1) % of.size()] - of[i];
      const Eigen::Vector2d out(edge.y(), -edge.x());
      if (std::all_of(other.begin(), other.end(),
                      [&](const Eigen::Vector2d& p) { return out.dot(p - of[i]) > 0; })) {
        return true;
      }
    }
    return false;
  };
  return !separated_by_edge_of(a, b) && !separated_by_edge_of(b, a);
}

bool stands_in(const Building& building, const std::array<Eigen::Vector2d, 4>& corners) {
  for (const auto& triangle : geometry::triangulate(building.footprint)) {
    const std::array<Eigen::Vector2d, 3> part = {building.footprint[triangle[0]],
                                                 building.footprint[triangle[1]],
                                                 building.footprint[triangle[2]]};
    if (geometry::signed_area(part) > 1e-9 && overlap(part, corners)) return true;
  }
  return false;
}

bool blocks(const Exit& exit, const std::array<Eigen::Vector2d, 4>& corners) {
  const Eigen::Vector2d depth = kClearOfExitsM * exit.outward;
  std::array<Eigen::Vector2d, 4> clear = {exit.from - depth, exit.to - depth, exit.to + depth,
                                          exit.from + depth};
  if (geometry::signed_area(clear) < 0) std::reverse(clear.begin(), clear.end());
  return overlap(clear, corners);
}

struct Refusal {
  std::string found;
  std::string expected;
};

/// Why a prop may not stand where it does.
std::optional<Refusal> find_refusal(const Prop& prop, const Scenario& scenario) {
  const auto corners = prop_footprint(prop);
  for (const Building& building : scenario.buildings) {
    if (building.footprint.size() < 3 || !stands_in(building, corners)) continue;
    return Refusal{fmt::format("a place in building \"{}\"", building.id),
                   "a place outside every building"};
  }
  for (const Exit& exit : scenario.exits) {
    if (exit.width_m() <= 0 || !blocks(exit, corners)) continue;
    return Refusal{
        fmt::format("a position that blocks exit \"{}\"", exit.id),
        fmt::format("a place at least {} m in front of or behind every exit", kClearOfExitsM)};
  }
  return std::nullopt;
}

std::optional<PropKind> read_kind(const JsonValue& value) {
  const std::string name = value.text();
  const auto& types = prop_types();
  const auto found = std::find_if(types.begin(), types.end(),
                                  [&](const PropType& type) { return type.name == name; });
  if (found != types.end()) return static_cast<PropKind>(found - types.begin());
  std::vector<std::string_view> names;
  names.reserve(types.size());
  for (const PropType& type : types) names.push_back(type.name);
  value.reject(fmt::format("one of: {}", fmt::join(names, ", ")));
  return std::nullopt;
}

std::uint32_t look_hash(int seed, std::uint64_t index) {
  return Random(static_cast<std::uint64_t>(seed), Stream::environment, index).bits();
}

Prop read_prop(const JsonValue& item, std::uint64_t index) {
  item.fields({"kind", "position"}, {"yaw_deg", "scale", "look"});
  Prop prop;
  prop.kind = read_kind(item["kind"]).value_or(PropKind::tree);
  prop.position = item["position"].vector2(kMaxCoordinateM);
  if (item["yaw_deg"].exists()) prop.yaw_rad = item["yaw_deg"].number(-360, 360) * kDegree;
  if (item["scale"].exists()) prop.scale = item["scale"].number(kMinScale, kMaxScale);
  prop.look = item["look"].exists()
                  ? static_cast<std::uint32_t>(item["look"].integer(0, 1'000'000'000))
                  : look_hash(0, index);
  return prop;
}

std::vector<Eigen::Vector2d> read_area(const JsonValue& value) {
  std::vector<Eigen::Vector2d> area;
  for (const JsonValue& corner : value.items(3)) area.push_back(corner.vector2(kMaxCoordinateM));
  if (area.size() >= 3 && !geometry::is_simple(area)) {
    value.reject("edges that touch each other", "a polygon whose edges do not cross");
    area.clear();
  }
  return area;
}

/// Darts thrown at the area: one is kept when it is clear of everything and `apart_m` away from
/// the others.
void scatter_over(const JsonValue& item, const Scenario& scenario, std::vector<Prop>& props) {
  item.fields({"kinds", "area", "count", "seed"}, {"apart_m", "yaw_deg"});
  std::vector<PropKind> kinds;
  for (const JsonValue& kind : item["kinds"].items(1)) {
    if (const auto known = read_kind(kind)) kinds.push_back(*known);
  }
  const std::vector<Eigen::Vector2d> area = read_area(item["area"]);
  const int count = item["count"].integer(1, kMaxScattered);
  const int seed = item["seed"].integer(0, 1'000'000'000);
  const double apart_m = item["apart_m"].exists() ? item["apart_m"].number(0, 1000) : 3;
  if (kinds.empty() || area.size() < 3) return;
  const auto [low, high] = geometry::bounding_box(area);
  constexpr int kDartsPerProp = 30;
  int placed = 0;
  for (int dart = 0; dart < kDartsPerProp * count && placed < count; ++dart) {
    Random random(static_cast<std::uint64_t>(seed), Stream::environment,
                  static_cast<std::uint64_t>(dart) + 1);
    Prop prop;
    prop.position = {random.uniform(low.x(), high.x()), random.uniform(low.y(), high.y())};
    prop.kind = kinds[random.below(static_cast<std::uint32_t>(kinds.size()))];
    prop.yaw_rad = item["yaw_deg"].exists() ? item["yaw_deg"].number(-360, 360) * kDegree
                                            : random.uniform(0, 2 * std::numbers::pi);
    prop.scale = random.uniform(0.9, 1.15);
    prop.look = random.bits();
    const bool close = std::any_of(props.begin(), props.end(), [&](const Prop& other) {
      return (other.position - prop.position).norm() < apart_m;
    });
    if (close || geometry::distance_to(area, prop.position) > 0 || find_refusal(prop, scenario))
      continue;
    props.push_back(prop);
    ++placed;
  }
}

}  // namespace

const std::array<PropType, kPropKinds>& prop_types() {
  static const std::array<PropType, kPropKinds> types = {{{"tree", {0.25, 0.25}},
                                                          {"bench", {0.9, 0.3}},
                                                          {"lamp_post", {0.12, 0.12}},
                                                          {"bin", {0.28, 0.28}},
                                                          {"car", {2.15, 0.9}},
                                                          {"bollard", {0.1, 0.1}},
                                                          {"stall", {1.5, 1.1}},
                                                          {"barrier", {1.25, 0.25}},
                                                          {"fence", {1.5, 0.06}},
                                                          {"kiosk", {1.5, 1.25}},
                                                          {"tent", {3, 3}},
                                                          {"stage", {8, 4.5}},
                                                          {"train", {10, 1.45}},
                                                          {"fountain", {2.6, 2.6}},
                                                          {"bush", {0.7, 0.7}},
                                                          {"planter", {0.9, 0.4}}}};
  return types;
}

std::array<Eigen::Vector2d, 4> prop_footprint(const Prop& prop) {
  const PropType& type = prop_types().at(static_cast<std::size_t>(prop.kind));
  return geometry::turned_rectangle(prop.position, prop.scale * type.half_size, prop.yaw_rad);
}

double distance_to(const Prop& prop, const Eigen::Vector2d& point) {
  return geometry::distance_to(prop_footprint(prop), point);
}

std::vector<Prop> read_props(const JsonValue& props, const JsonValue& scatter,
                             const Scenario& scenario) {
  std::vector<Prop> read;
  for (const JsonValue& item : props.items()) {
    read.push_back(read_prop(item, read.size()));
    if (const auto refusal = find_refusal(read.back(), scenario)) {
      item["position"].reject(refusal->found, refusal->expected);
    }
  }
  for (const JsonValue& item : scatter.items()) scatter_over(item, scenario, read);
  return read;
}

void thin_out(Scenario& scenario, double share, std::uint64_t seed) {
  std::vector<Prop> kept;
  for (std::size_t i = 0; i < scenario.props.size(); ++i) {
    const bool stays = i < scenario.placed_props ||
                       Random(seed, Stream::environment, kThinning + i).uniform() < share;
    if (stays) kept.push_back(scenario.props[i]);
  }
  scenario.props = std::move(kept);
}

}  // namespace throng::world
