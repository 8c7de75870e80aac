#include "world/fields/prop_fields.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>

#include "base/compute/random.h"
#include "base/geometry/angle.h"
#include "base/geometry/polygon.h"
#include "base/geometry/rectangle.h"
#include "base/geometry/triangulate.h"
#include "world/clutter/clutter.h"
#include "world/clutter/sitters.h"
#include "world/fields/document_values.h"
#include "world/scenario.h"
#include "world/stand_seats.h"

namespace throng::world {

using fields::at;
using fields::FieldLocation;
using fields::FieldTable;
using nlohmann::json;

namespace {

constexpr double kMinScale = 0.2;
constexpr double kMaxScale = 5;
constexpr int kMaxScattered = 2000;
constexpr double kMaxStrewnM = 6000;  // of ground

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

std::vector<std::string> kind_names() {
  std::vector<std::string> names;
  names.reserve(prop_types().size());
  for (const PropType& type : prop_types()) names.emplace_back(type.name);
  return names;
}

PropKind kind_named(const json& name) {
  const std::vector<std::string> names = kind_names();
  return static_cast<PropKind>(std::find(names.begin(), names.end(), name) - names.begin());
}

std::uint32_t look_hash(int seed, std::uint64_t index) {
  return Random(static_cast<std::uint64_t>(seed), Stream::environment, index).bits();
}

}  // namespace

const FieldTable<Prop>& prop_fields() {
  static const FieldTable<Prop> fields = [] {
    FieldTable<Prop> table;
    table.add_word("kind", "", kind_names(), at(&Prop::kind), "Kind of prop.").required();
    table.add("position", "", "m", points(), at(&Prop::position), "Position of the prop.")
        .required();
    table
        .add_read(
            "yaw_deg", headings_deg(),
            [](Prop& prop, const json& value, const FieldLocation& /*place*/) {
              prop.yaw_rad = value.get<double>() * kDegree;
            },
            "Heading from +x, counter-clockwise.")
        .measured_in("°")
        .with_default(0);
    table.add("scale", "", "", prop_scales(), at(&Prop::scale), "Size relative to the usual one.");
    table
        .add("look", "", "", fields::integers(0, kMaxId), at(&Prop::look),
             "Number that chooses colors and shape; default: by the prop's index in the list.")
        .without_default();
    return table;
  }();
  return fields;
}

namespace {

/// Props that a seed places.
struct Scatter {
  std::vector<PropKind> kinds;
  std::vector<Eigen::Vector2d> area;
  int count = 0;
  int seed = 0;
  double apart_m = 3;
  std::optional<double> yaw_deg;
};

const FieldTable<Scatter>& scatter_fields() {
  static const FieldTable<Scatter> fields = [] {
    FieldTable<Scatter> table;
    table
        .add_read(
            "area", polygons(),
            [](Scatter& scatter, const json& value, const FieldLocation& place) {
              scatter.area = read_polygon(value, place);
            },
            "Corners of the area, in order; the edges must not cross.")
        .measured_in("m")
        .required();
    table
        .add_read(
            "kinds", fields::open_lists(1, prop_kinds().rules),
            [](Scatter& scatter, const json& value, const FieldLocation& /*place*/) {
              for (const json& name : value) scatter.kinds.push_back(kind_named(name));
            },
            "Kinds to choose from.")
        .required();
    table
        .add("count", "", "", fields::integers(1, kMaxScattered), at(&Scatter::count),
             "Max number; props that find no space are left out.")
        .required();
    table
        .add("seed", "", "", fields::integers(0, kMaxId), at(&Scatter::seed),
             "Seed of positions and looks.")
        .required();
    table.add("apart_m", "", "m", fields::numbers(0, 1000), at(&Scatter::apart_m),
              "Min distance from other props.");
    table.add("yaw_deg", "", "°", headings_deg(), at(&Scatter::yaw_deg),
              "Heading from +x, counter-clockwise; default: any.");
    return table;
  }();
  return fields;
}

/// Darts thrown at the area: one is kept when it is clear of everything and `apart_m` away from
/// the others.
void scatter_over(const Scatter& scatter, const Scenario& scenario, std::vector<Prop>& props) {
  const auto& [kinds, area, count, seed, apart_m, yaw_deg] = scatter;
  const auto [low, high] = geometry::bounding_box(area);
  constexpr int kDartsPerProp = 30;
  int placed = 0;
  for (int dart = 0; dart < kDartsPerProp * count && placed < count; ++dart) {
    Random random(static_cast<std::uint64_t>(seed), Stream::environment,
                  static_cast<std::uint64_t>(dart) + 1);
    Prop prop;
    prop.position = {random.uniform(low.x(), high.x()), random.uniform(low.y(), high.y())};
    prop.kind = kinds[random.below(static_cast<std::uint32_t>(kinds.size()))];
    prop.yaw_rad = yaw_deg ? *yaw_deg * kDegree : random.uniform(0, 2 * std::numbers::pi);
    prop.scale = random.uniform(0.9, 1.15);
    prop.look = random.bits();
    const bool close = std::any_of(props.begin(), props.end(), [&](const Prop& other) {
      return (other.position - prop.position).norm() < scatter.apart_m;
    });
    if (close || geometry::distance_to(area, prop.position) > 0 || find_refusal(prop, scenario))
      continue;
    props.push_back(prop);
    ++placed;
  }
}

const FieldTable<Clutter>& clutter_fields() {
  static const FieldTable<Clutter> fields = [] {
    std::vector<std::string> names;
    for (std::size_t kind = 0; kind < kPropKinds; ++kind) {
      if (is_strewn(static_cast<PropKind>(kind))) names.emplace_back(prop_types().at(kind).name);
    }
    FieldTable<Clutter> table;
    table
        .add("seed", "", "", fields::integers(0, kMaxId), at(&Clutter::seed),
             "Seed of kinds, positions and looks.")
        .required();
    table.add("density", "", "", fields::numbers(0, 1), at(&Clutter::density),
              "Share of the suitable places that are taken.");
    table
        .add_read(
            "kinds", fields::open_lists(1, fields::one_of_words(names).rules),
            [](Clutter& clutter, const json& value, const FieldLocation& /*place*/) {
              for (const json& name : value) clutter.kinds.push_back(kind_named(name));
            },
            "Kinds to choose from; default: all of these.")
        .without_default();
    return table;
  }();
  return fields;
}

const FieldTable<Sitters>& sitter_fields() {
  static const FieldTable<Sitters> fields = [] {
    FieldTable<Sitters> table;
    table
        .add("share", "", "", fields::numbers(0, 1), at(&Sitters::share),
             "Share of all seats that are taken.")
        .required();
    table.add("seed", "", "", fields::integers(0, kMaxId), at(&Sitters::seed),
              "Chooses the seats.");
    return table;
  }();
  return fields;
}

}  // namespace

fields::Values prop_kinds() { return fields::one_of_words(kind_names()); }

fields::Values prop_scales() { return fields::numbers(kMinScale, kMaxScale); }

fields::Values scatter_lists() {
  return fields::open_lists(0, fields::object_with(scatter_fields().schema()).rules);
}

void check_props(Scenario& scenario, const json& list, const FieldLocation& place) {
  scenario.placed_props = scenario.props.size();
  for (std::size_t i = 0; i < list.size(); ++i) {
    Prop& prop = scenario.props[i];
    const FieldLocation item = place.below(i);
    if (!list[i].is_object() || !list[i].contains("look")) prop.look = look_hash(0, i);
    if (item.has_problem()) continue;
    if (const auto refusal = find_refusal(prop, scenario)) {
      item.below("position").reject(refusal->found, refusal->expected);
    }
    if (std::optional<Stand> deck = stage_deck(prop)) scenario.stands.push_back(std::move(*deck));
  }
}

fields::Values clutter_values() { return fields::object_with(clutter_fields().schema()); }

void strew_clutter(Scenario& scenario, const json& value, const FieldLocation& place) {
  Clutter clutter;
  clutter_fields().read_checked(value, clutter, place);
  // It stands beside all that the other fields say.
  if (!place.problems.empty()) return;
  const Eigen::Vector2d size = scenario.ground.max - scenario.ground.min;
  if (size.maxCoeff() > kMaxStrewnM) {
    place.reject(fmt::format("clutter on a ground of {:.0f} m by {:.0f} m", size.x(), size.y()),
                 fmt::format("a ground of at most {} m by {} m", kMaxStrewnM, kMaxStrewnM));
    return;
  }
  strew(clutter, scenario);
}

fields::Values sitter_values() { return fields::object_with(sitter_fields().schema()); }

void read_sitters(Scenario& scenario, const json& value, const FieldLocation& place) {
  Sitters sitters;
  sitter_fields().read_checked(value, sitters, place);
  if (place.problems.empty()) seat_people(sitters, scenario);
}

void scatter_props(Scenario& scenario, const json& list, const FieldLocation& place) {
  const std::vector<Scatter> scatters = scatter_fields().read_list(list, place);
  for (std::size_t i = 0; i < scatters.size(); ++i) {
    if (!place.below(i).has_problem()) scatter_over(scatters[i], scenario, scenario.props);
  }
}

}  // namespace throng::world
