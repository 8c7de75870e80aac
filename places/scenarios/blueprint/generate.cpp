#include "places/scenarios/blueprint/generate.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/compute/random.h"
#include "places/scenarios/blueprint/frame.h"
#include "places/scenarios/blueprint/planting.h"
#include "places/scenarios/blueprint/surroundings.h"

namespace throng::scenarios {

using Eigen::Vector2d;
using nlohmann::json;

namespace {

constexpr std::uint64_t kPlaceIndex = std::uint64_t{1} << 44;  // apart from other uses

std::uint64_t kind_number(std::string_view kind) {
  return static_cast<std::uint64_t>(std::find(kPlaceKinds.begin(), kPlaceKinds.end(), kind) -
                                    kPlaceKinds.begin());
}

/// A scenario under construction.
class Site {
 public:
  Site(const GeneratorSpec& spec, const Vector2d& size, double depth_m)
      : spec_(spec), random_(spec.seed, Stream::environment, kPlaceIndex + kind_number(spec.kind)) {
    frame_.min = -0.5 * size;
    frame_.max = 0.5 * size;
    frame_.depth_m = depth_m;
    blueprint_ = {{"buildings", json::array()},
                  {"props", json::array()},
                  {"scatter", json::array()},
                  {"exits", json::array()},
                  {"drones", json::array()}};
    if (spec.clutter > 0) blueprint_["clutter"] = {{"seed", spec.seed}, {"density", spec.clutter}};
    blueprint_["ground"]["areas"] = json::array();
    blueprint_["ground"]["markings"] = json::array();
  }

  const GeneratorSpec& spec() const { return spec_; }
  Random& random() { return random_; }
  Frame& frame() { return frame_; }
  json& blueprint() { return blueprint_; }
  /// For the frame with its gates.
  Planting planting() {
    constexpr std::uint64_t kPlanting = 100;
    return {
        frame_,
        Random(spec_.seed, Stream::environment, kPlaceIndex + kPlanting + kind_number(spec_.kind)),
        blueprint_};
  }

  double gate_width_m(double min_width_m, double max_width_m) {
    const double drawn = random_.uniform(min_width_m, max_width_m);
    return spec_.exit_width_m > 0 ? spec_.exit_width_m : drawn;
  }
  int gate_count(int min_count, int max_count) {
    const int drawn =
        min_count +
        static_cast<int>(random_.below(static_cast<std::uint32_t>(max_count - min_count + 1)));
    return spec_.exits > 0 ? spec_.exits : drawn;
  }

  void area(const Vector2d& min, const Vector2d& max, const char* material, bool kerb = false) {
    add_area(min, max, material, kerb, blueprint_);
  }
  void prop(const char* kind, const Vector2d& at, double yaw_deg = 0) {
    blueprint_["props"].push_back({{"kind", kind},
                                   {"position", point_json(at)},
                                   {"yaw_deg", yaw_deg},
                                   {"look", random_.below(1000)}});
  }
  /// Props all over an area, `density` times as many as have room at full clutter.
  void scatter(const std::vector<const char*>& kinds, const Vector2d& min, const Vector2d& max,
               double per_m2, double apart_m) {
    const Vector2d size = max - min;
    if (size.minCoeff() <= 0) return;
    const int count = static_cast<int>(spec_.clutter * per_m2 * size.x() * size.y());
    if (count < 1) return;
    blueprint_["scatter"].push_back({{"kinds", kinds},
                                     {"area", outline_json(min, max)},
                                     {"count", std::min(count, 400)},
                                     {"seed", random_.below(1'000'000)},
                                     {"apart_m", apart_m}});
  }

  /// Ground, crowd and drone; `free_m2` is where people can be.
  json finish(const char* material, double free_m2) {
    const Vector2d walls = Vector2d::Constant(frame_.depth_m);
    const Vector2d around = walls + Vector2d::Constant(kSurroundingsM);
    const Vector2d approach = walls + Vector2d::Constant(kApproachM);
    json& ground = blueprint_["ground"];
    ground["min"] = point_json(frame_.min - around);
    ground["max"] = point_json(frame_.max + around);
    ground["material"] = material;
    blueprint_["inside"] = {{"min", point_json(frame_.min - approach)},
                            {"max", point_json(frame_.max + approach)}};
    blueprint_["name"] = fmt::format("Generated {} {}", spec_.kind, spec_.seed);
    blueprint_["description"] = fmt::format("Made from a seed: {}", to_json(spec_).dump());
    add_people(free_m2);
    add_drone();
    add_surroundings(frame_, kApproachM, spec_.building_density, random_, blueprint_);
    return std::move(blueprint_);
  }

 private:
  void add_people(double free_m2) {
    constexpr double kPerPersonM2 = 14;
    constexpr double kFromWallsM = 1.5;
    const Vector2d inset = Vector2d::Constant(kFromWallsM);
    const int usual =
        std::clamp(static_cast<int>(free_m2 / (kPerPersonM2 * random_.uniform(0.7, 1.6))), 20, 800);
    json people = {{"groups",
                    {{{"doing", "stroll"},
                      {"area", outline_json(frame_.min + inset, frame_.max - inset)},
                      {"count", spec_.people > 0 ? spec_.people : usual}}}}};
    for (const json& exit : blueprint_["exits"]) {
      people["sources"].push_back({{"doing", "cross"},
                                   {"exit", exit["id"]},
                                   {"per_minute", spec_.demand_per_minute},
                                   {"until_s", 600}});
    }
    people["in_groups"] = std::round(100 * random_.uniform(0.3, 0.7)) / 100;
    blueprint_["people"] = people;
  }

  void add_drone() {
    constexpr double kAboveRoofsM = 8;
    double height_m = 22;
    for (const json& building : blueprint_["buildings"]) {
      height_m = std::max(height_m, building["height_m"].get<double>() + kAboveRoofsM);
    }
    blueprint_["drones"].push_back(
        {{"id", "d1"}, {"start", {0, frame_.min.y(), height_m}}, {"yaw_deg", 90}});
  }

  GeneratorSpec spec_;
  Random random_;
  Frame frame_;
  json blueprint_;
};

double drawn_size(const GeneratorSpec& spec, double min_size_m, double max_size_m) {
  Random random(spec.seed, Stream::environment, kPlaceIndex + kPlaceKinds.size());
  const double drawn = random.uniform(min_size_m, max_size_m);
  return spec.size_m > 0 ? spec.size_m : std::round(drawn);
}

double drawn_share(const GeneratorSpec& spec, double min_share, double max_share) {
  Random random(spec.seed, Stream::environment, kPlaceIndex + kPlaceKinds.size() + 1);
  return random.uniform(min_share, max_share);
}

const std::vector<Side> kAllSides = {Side::south, Side::east, Side::north, Side::west};

/// An open square with something in its middle.
json plaza(const GeneratorSpec& spec) {
  const double length_m = drawn_size(spec, 40, 80);
  Site site(spec, {length_m, std::round(length_m * drawn_share(spec, 0.6, 1))}, 11);
  Frame& frame = site.frame();
  Random& random = site.random();
  frame.gates =
      spread_gates(frame, kAllSides, site.gate_count(3, 6), site.gate_width_m(2.5, 6), random);
  build_walls(frame, {0.35 + 0.65 * spec.building_density, 7, random.uniform(10, 24)}, random,
              site.blueprint());
  const bool is_paved = random.uniform() < 0.6;
  Planting planting = site.planting();
  planting.pave(is_paved ? "pavers" : "asphalt", is_paved ? "asphalt" : "concrete", 3);
  planting.add_strips(is_paved ? "asphalt" : "pavers", 1.1, 11);
  if (random.uniform() < 0.7) site.prop("fountain", {0, 0});
  const Vector2d bed(std::max(2.5, 0.07 * frame.size().x()),
                     std::max(2.5, 0.07 * frame.size().y()));
  for (const double x : {-0.27, 0.27}) {
    for (const double y : {-0.27, 0.27}) {
      const Vector2d middle = frame.size().cwiseProduct(Vector2d(x, y));
      if (random.uniform() > 0.3 + 0.6 * spec.clutter) continue;
      site.area(middle - 0.5 * bed, middle + 0.5 * bed, "grass", true);
      site.prop("tree", middle);
    }
  }
  planting.add_corner_lawns(std::clamp(0.14 * frame.size().minCoeff(), 4.0, 8.0));
  for (const double side : {-1.0, 1.0}) {
    const Vector2d row(0.5 * frame.size().x() - 9, side * (0.5 * frame.size().y() - 5.2));
    planting.add_row({-row.x(), row.y()}, row, 5, {"tree", "planter", "bench"},
                     0.3 + 0.6 * spec.clutter);
  }
  const Vector2d inset = Vector2d::Constant(4);
  site.scatter({"bench", "lamp_post", "bin", "tree", "planter"}, frame.min + inset,
               frame.max - inset, 0.014, 5);
  site.scatter({"stall", "kiosk"}, frame.min + inset, frame.max - inset, 0.003, 8);
  return site.finish("grass", 0.8 * frame.size().prod());
}

/// A long, narrow space between houses, with lanes to both sides.
json street(const GeneratorSpec& spec) {
  const double length_m = drawn_size(spec, 70, 140);
  Site site(spec, {length_m, std::round(std::max(11.0, length_m * drawn_share(spec, 0.13, 0.2)))},
            12);
  Frame& frame = site.frame();
  Random& random = site.random();
  const double end_width_m = std::min(frame.size().y() - 4, site.gate_width_m(6, 10));
  frame.gates = {{Side::west, 0.5 * frame.size().y(), end_width_m},
                 {Side::east, 0.5 * frame.size().y(), end_width_m}};
  const int lanes = site.gate_count(3, 6) - 2;
  if (lanes > 0) {
    for (const Gate& lane : spread_gates(frame, {Side::north, Side::south}, lanes,
                                         std::min(site.gate_width_m(2.5, 5), 6.0), random)) {
      frame.gates.push_back(lane);
    }
  }
  build_walls(frame, {0.6 + 0.4 * spec.building_density, 8, random.uniform(11, 22)}, random,
              site.blueprint());
  const double half_m = 0.5 * frame.size().y();
  const bool has_road = random.uniform() < 0.5;
  const Vector2d road(0.5 * frame.size().x() + 60, 0.22 * frame.size().y());
  const bool is_paved = random.uniform() < 0.6;
  Planting planting = site.planting();
  planting.pave(is_paved ? "pavers" : "asphalt", is_paved ? "asphalt" : "concrete", 2.2);
  if (!has_road) planting.add_strips(is_paved ? "concrete" : "pavers", 0.9, 12);
  if (has_road) site.area(-road, road, "asphalt", true);
  const double row_m = half_m - 3;
  for (double x = frame.min.x() + 7; x < frame.max.x() - 6; x += 9) {
    const double side = random.uniform() < 0.5 ? -1 : 1;
    if (random.uniform() > 0.25 + 0.7 * spec.clutter) continue;
    bool clear = true;
    for (const Gate& gate : frame.gates) {
      clear = clear && std::abs(frame.min.x() + gate.middle_m - x) > 0.5 * gate.width_m + 4;
    }
    if (clear) site.prop(random.uniform() < 0.6 ? "tree" : "lamp_post", {x, side * row_m});
  }
  for (const double side : {-1.0, 1.0}) {
    const Vector2d row(0.5 * frame.size().x() - 10, side * row_m);
    planting.add_row({-row.x(), row.y()}, row, 6.5, {"planter", "bench", "planter"},
                     0.15 + 0.5 * spec.clutter);
  }
  const Vector2d inset(8, 3.2);
  site.scatter({"bench", "bin", "bench"}, frame.min + inset, frame.max - inset, 0.01, 5);
  return site.finish("grass", 0.9 * frame.size().prod());
}

/// A hall in some of the quarters between two paths that cross at `hub`.
void add_halls(Site& site, Planting& planting, const Vector2d& hub, const Vector2d& path) {
  constexpr double kAroundHallM = 4;
  const Frame& frame = site.frame();
  Random& random = site.random();
  int number = 0;
  for (const bool east : {false, true}) {
    for (const bool north : {false, true}) {
      if (random.uniform() > 0.2 + 0.8 * site.spec().building_density) continue;
      const Vector2d low(east ? hub.x() + path.x() : frame.min.x(),
                         north ? hub.y() + path.y() : frame.min.y());
      const Vector2d high(east ? frame.max.x() : hub.x() - path.x(),
                          north ? frame.max.y() : hub.y() - path.y());
      const Vector2d middle = 0.5 * (low + high);
      const Vector2d room = 0.5 * (high - low) - Vector2d::Constant(kAroundHallM);
      const Vector2d half(room.x() * random.uniform(0.4, 0.85),
                          room.y() * random.uniform(0.4, 0.85));
      if (half.minCoeff() < 3) continue;
      const Vector2d apron = half + Vector2d::Constant(1.5);
      site.area(middle - apron, middle + apron, "pavers");
      site.blueprint()["buildings"].push_back(house_json(fmt::format("hall{}", ++number),
                                                         middle - half, middle + half,
                                                         random.uniform(6, 16), random));
      const Vector2d beside = half + Vector2d::Constant(0.85);
      for (const double side : {-1.0, 1.0}) {
        const Vector2d row(half.x() - 1, side * beside.y());
        planting.add_row(middle + Vector2d(-row.x(), row.y()), middle + row, 2.5, {"bush"}, 0.6);
      }
    }
  }
}

/// Lawns, paths between the gates and halls that stand by themselves.
json campus(const GeneratorSpec& spec) {
  const double length_m = drawn_size(spec, 70, 130);
  Site site(spec, {length_m, std::round(length_m * drawn_share(spec, 0.6, 0.95))}, 9);
  Frame& frame = site.frame();
  Random& random = site.random();
  frame.gates =
      spread_gates(frame, kAllSides, site.gate_count(3, 6), site.gate_width_m(3, 7), random);
  build_walls(frame, {0.5 * spec.building_density, 6, 12}, random, site.blueprint());
  const Vector2d path = Vector2d::Constant(random.uniform(2.5, 4));
  const Vector2d hub =
      frame.size().cwiseProduct(Vector2d(random.uniform(-0.15, 0.15), random.uniform(-0.15, 0.15)));
  const char* paving = random.uniform() < 0.5 ? "pavers" : "asphalt";
  site.area({frame.min.x() - 20, hub.y() - path.y()}, {frame.max.x() + 20, hub.y() + path.y()},
            paving, true);
  site.area({hub.x() - path.x(), frame.min.y() - 20}, {hub.x() + path.x(), frame.max.y() + 20},
            paving, true);
  const Vector2d court = path + Vector2d::Constant(random.uniform(0, 5));
  site.area(hub - court, hub + court, random.uniform() < 0.5 ? "pavers" : "concrete");
  if (random.uniform() < 0.5) site.prop("fountain", hub);
  Planting planting = site.planting();
  add_halls(site, planting, hub, path);
  for (const double side : {-1.0, 1.0}) {
    const double y = hub.y() + side * (path.y() + 1.8);
    planting.add_row({frame.min.x() + 4, y}, {frame.max.x() - 4, y}, 7,
                     {"tree", "tree", "bench", "tree", "planter"}, 0.35 + 0.5 * spec.clutter);
  }
  const Vector2d inset = Vector2d::Constant(4);
  site.scatter({"tree", "tree", "tree", "bench", "lamp_post"}, frame.min + inset, frame.max - inset,
               0.012, 5);
  return site.finish("grass", 0.6 * frame.size().prod());
}

/// Streets at right angles between blocks of houses.
json block(const GeneratorSpec& spec) {
  const double length_m = drawn_size(spec, 80, 140);
  Site site(spec, {length_m, std::round(length_m * drawn_share(spec, 0.6, 0.9))}, 10);
  Frame& frame = site.frame();
  Random& random = site.random();
  const double street_m = random.uniform(7, 11);
  const int columns = frame.size().x() > 100 ? 3 : 2;
  const int rows = 2;
  frame.gates = spread_gates(frame, kAllSides, site.gate_count(4, 8),
                             std::min(site.gate_width_m(3.5, 6.5), street_m), random);
  build_walls(frame, {0.4 + 0.6 * spec.building_density, 8, random.uniform(12, 26)}, random,
              site.blueprint());
  const Vector2d lot((frame.size().x() - (columns + 1) * street_m) / columns,
                     (frame.size().y() - (rows + 1) * street_m) / rows);
  Planting planting = site.planting();
  planting.pave("asphalt", "pavers", 1.8);
  for (int column = 0; column < columns; ++column) {
    for (int row = 0; row < rows; ++row) {
      const Vector2d low = frame.min + Vector2d(street_m + column * (lot.x() + street_m),
                                                street_m + row * (lot.y() + street_m));
      const Vector2d high = low + lot;
      const std::string id = fmt::format("block{}_{}", column + 1, row + 1);
      constexpr double kPavementM = 1.8;
      site.area(low - Vector2d::Constant(kPavementM), high + Vector2d::Constant(kPavementM),
                "pavers", true);
      if (lot.minCoeff() < 6 || random.uniform() > 0.25 + 0.75 * spec.building_density) {
        site.area(low, high, "grass", true);  // a small park
        site.scatter({"tree", "tree", "bench", "bush"}, low, high, 0.04, 3.5);
        continue;
      }
      const double cut = random.uniform(0.4, 0.6) * lot.x();
      const Vector2d wall_low(low.x() + cut, low.y());
      const Vector2d wall_high(low.x() + cut, high.y());
      site.blueprint()["buildings"].push_back(
          house_json(id + "a", low, wall_high, random.uniform(8, 24), random));
      site.blueprint()["buildings"].push_back(
          house_json(id + "b", wall_low, high, random.uniform(8, 24), random));
    }
  }
  for (int row = 1; row < rows; ++row) {
    const double y = frame.min.y() + row * (lot.y() + street_m) + 0.5 * street_m;
    site.blueprint()["ground"]["markings"].push_back(
        {{"kind", "dashes"},
         {"from", point_json({frame.min.x() + street_m, y})},
         {"to", point_json({frame.max.x() - street_m, y})}});
  }
  site.scatter({"lamp_post", "bin", "tree", "planter"},
               frame.min + Vector2d::Constant(0.5 * street_m),
               frame.max - Vector2d::Constant(0.5 * street_m), 0.004, 6);
  return site.finish("grass", 0.4 * frame.size().prod());
}

}  // namespace

json generate_blueprint(const GeneratorSpec& spec) {
  if (spec.kind == "street") return street(spec);
  if (spec.kind == "campus") return campus(spec);
  if (spec.kind == "block") return block(spec);
  throng::check(spec.kind == "plaza", "a spec has a known kind");
  return plaza(spec);
}

}  // namespace throng::scenarios
