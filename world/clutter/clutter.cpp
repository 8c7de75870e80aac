#include "world/clutter/clutter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/compute/random.h"
#include "base/geometry/polygon.h"
#include "base/geometry/rectangle.h"
#include "world/clutter/free_ground.h"
#include "world/scenario.h"

namespace throng::world {

using Eigen::Vector2d;

namespace {

constexpr std::uint64_t kStrewing = std::uint64_t{1} << 43;  // apart from other uses of the stream
constexpr std::size_t kMaxStrewn = 2500;

/// Ground for a kind.
enum class Habitat : std::uint8_t {
  facade,  ///< its back to a wall
  flat,    ///< hanging on a wall
  corner,  ///< its back to a wall, beside a corner of the house
  kerb,    ///< on the pavement, its back to it, beside a road
  road,    ///< parked along the edge of a road
  lawn,
  lot  ///< on wide paved ground
};

struct Rule {
  PropKind kind;
  Habitat habitat;
  double weight = 1;  ///< how often, relative to others of the habitat
  int max_run = 1;    ///< side by side
};

constexpr std::array<Rule, 64> kRules = {{
    {PropKind::bicycle, Habitat::facade, 5, 5},
    {PropKind::cafe_table, Habitat::facade, 4, 5},
    {PropKind::wheelie_bin, Habitat::facade, 3, 3},
    {PropKind::wheelie_bins, Habitat::facade, 1.5},
    {PropKind::flower_pots, Habitat::facade, 4, 3},
    {PropKind::planter, Habitat::facade, 2, 2},
    {PropKind::a_board, Habitat::facade, 3},
    {PropKind::bench, Habitat::facade, 2, 2},
    {PropKind::crates, Habitat::facade, 2, 2},
    {PropKind::market_goods, Habitat::facade, 2, 3},
    {PropKind::flower_stand, Habitat::facade, 1.5, 2},
    {PropKind::clothes_rack, Habitat::facade, 1.5, 3},
    {PropKind::cabinet, Habitat::facade, 2},
    {PropKind::cargo_bike, Habitat::facade, 1},
    {PropKind::moped, Habitat::facade, 1, 2},
    {PropKind::vending_machine, Habitat::facade, 0.7},
    {PropKind::scaffold, Habitat::facade, 0.5, 3},
    {PropKind::cardboard, Habitat::facade, 0.7},
    {PropKind::bin, Habitat::facade, 1},
    {PropKind::wall_box, Habitat::flat},
    {PropKind::recycling_container, Habitat::corner, 2, 3},
    {PropKind::garbage_bags, Habitat::corner, 2},
    {PropKind::pallet, Habitat::corner, 2, 2},
    {PropKind::cardboard, Habitat::corner, 2},
    {PropKind::wheelie_bins, Habitat::corner, 2},
    {PropKind::cabinet, Habitat::corner, 2},
    {PropKind::construction_fence, Habitat::corner, 0.7, 3},
    {PropKind::street_sign, Habitat::kerb, 1.5},
    {PropKind::traffic_sign, Habitat::kerb, 4},
    {PropKind::parking_meter, Habitat::kerb, 2},
    {PropKind::bicycle_rack, Habitat::kerb, 2.5, 2},
    {PropKind::bin, Habitat::kerb, 2},
    {PropKind::bollard, Habitat::kerb, 1.5, 6},
    {PropKind::bench, Habitat::kerb, 1.5},
    {PropKind::bus_stop, Habitat::kerb, 0.8},
    {PropKind::hydrant, Habitat::kerb, 0.8},
    {PropKind::newspaper_box, Habitat::kerb, 1},
    {PropKind::post_box, Habitat::kerb, 0.8},
    {PropKind::advertising_column, Habitat::kerb, 0.8},
    {PropKind::phone_booth, Habitat::kerb, 0.4},
    {PropKind::drinking_fountain, Habitat::kerb, 0.4},
    {PropKind::kick_scooter, Habitat::kerb, 1.5, 4},
    {PropKind::charging_station, Habitat::kerb, 0.6},
    {PropKind::planter, Habitat::kerb, 1.5, 3},
    {PropKind::car, Habitat::road, 12},
    {PropKind::van, Habitat::road, 2},
    {PropKind::delivery_truck, Habitat::road, 0.6},
    {PropKind::moped, Habitat::road, 0.6, 3},
    {PropKind::motorcycle, Habitat::road, 0.6, 2},
    {PropKind::cone, Habitat::road, 0.3, 4},
    {PropKind::bench, Habitat::lawn, 4},
    {PropKind::picnic_table, Habitat::lawn, 2},
    {PropKind::bush, Habitat::lawn, 3},
    {PropKind::swing, Habitat::lawn, 0.6},
    {PropKind::slide, Habitat::lawn, 0.6},
    {PropKind::spring_rider, Habitat::lawn, 0.8},
    {PropKind::sandbox, Habitat::lawn, 0.5},
    {PropKind::statue, Habitat::lawn, 0.5},
    {PropKind::flagpole, Habitat::lawn, 0.5},
    {PropKind::info_board, Habitat::lawn, 0.5},
    {PropKind::food_truck, Habitat::lot, 2},
    {PropKind::beer_table, Habitat::lot, 3},
    {PropKind::portable_toilet, Habitat::lot, 1},
    {PropKind::skip, Habitat::lot, 0.6},
}};

/// Strews over one scenario. Each place where a prop may stand has a number, by which all that is
/// random there is addressed.
class Strewer {
 public:
  Strewer(const Clutter& clutter, Scenario& scenario)
      : clutter_(clutter), scenario_(scenario), ground_(scenario) {}

  void strew() {
    for (const Building& building : scenario_.buildings) {
      constexpr double kMinHouseM = 2.8;
      if (building.height_m < kMinHouseM || building.facade == Facade::hedge ||
          building.facade == Facade::fence || building.facade == Facade::railing ||
          building.facade == Facade::stand) {
        continue;
      }
      for (std::size_t i = 0; i < building.footprint.size(); ++i) {
        along_wall(building.footprint[i], building.footprint[(i + 1) % building.footprint.size()],
                   building.height_m);
      }
    }
    for (const GroundArea& area : scenario_.areas) {
      for (std::size_t i = 0; i < area.corners.size(); ++i) {
        along_border(area.corners[i], area.corners[(i + 1) % area.corners.size()]);
      }
      if (area.material == "grass" && !is_pitch(area)) over(area.corners, Habitat::lawn, 45);
    }
    const auto& [low, high] = scenario_.ground;
    over({low, {high.x(), low.y()}, high, {low.x(), high.y()}}, Habitat::lot, 1500);
  }

 private:
  /// Whether lines are painted on an area, as on a football pitch.
  bool is_pitch(const GroundArea& area) const {
    return std::any_of(
        scenario_.markings.begin(), scenario_.markings.end(), [&](const Marking& marking) {
          return geometry::signed_distance_to(area.corners, 0.5 * (marking.from + marking.to)) < 0;
        });
  }

  Random next_place() { return {clutter_.seed, Stream::environment, kStrewing + places_++}; }

  /// A rule of the habitat, by weight, among the kinds that are wanted; none if there are none.
  const Rule* choose(Habitat habitat, Random& random) const {
    const auto weight = [&](const Rule& rule) {
      const auto& kinds = clutter_.kinds;
      const bool is_wanted =
          kinds.empty() || std::find(kinds.begin(), kinds.end(), rule.kind) != kinds.end();
      return rule.habitat == habitat && is_wanted ? rule.weight : 0;
    };
    double sum = 0;
    for (const Rule& rule : kRules) sum += weight(rule);
    double left = random.uniform() * sum;
    const Rule* chosen = nullptr;
    for (const Rule& rule : kRules) {
      if (weight(rule) == 0) continue;
      chosen = &rule;
      left -= weight(rule);
      if (left < 0) break;
    }
    return chosen;
  }

  bool add(Prop prop, Random& random) {
    prop.look = random.bits();
    const bool is_full = scenario_.strewn_props >= kMaxStrewn;
    if (is_full || !ground_.is_free(prop)) return false;
    ground_.take(prop);
    scenario_.props.push_back(prop);
    ++scenario_.strewn_props;
    return true;
  }

  /// Adds up to `rule.max_run` props side by side from a point on a line; `out` is where they stand
  /// from it, at this distance. Returns the length that they take.
  double add_run(const Rule& rule, const Vector2d& from, const Vector2d& along, const Vector2d& out,
                 double off_m, double yaw_rad, Random& random) {
    const Vector2d half = prop_type(rule.kind).half_size;
    const bool is_across =
        std::abs(along.dot(Vector2d(std::cos(yaw_rad), std::sin(yaw_rad)))) < 0.5;
    const double half_length = is_across ? half.y() : half.x();
    const double half_depth = is_across ? half.x() : half.y();
    const int count = 1 + static_cast<int>(random.below(static_cast<std::uint32_t>(rule.max_run)));
    const double apart_m = 2 * half_length + random.uniform(0.15, 0.5);
    for (int i = 0; i < count; ++i) {
      const double jitter = rule.habitat == Habitat::flat ? 0 : random.uniform(0, 0.06);
      add({.kind = rule.kind,
           .position =
               from + (half_length + i * apart_m) * along + (off_m + half_depth + jitter) * out,
           .yaw_rad = yaw_rad + (jitter - 0.03)},
          random);
    }
    return count * apart_m;
  }

  /// A wall from one corner to the next; its house, which is higher than all before it, is on the
  /// left.
  void along_wall(const Vector2d& from, const Vector2d& to, double height_m) {
    constexpr double kMinWallM = 3;
    constexpr double kOffWallM = 0.12;
    constexpr double kFlatM = 0.01;
    constexpr double kStepM = 3;
    const double length = (to - from).norm();
    if (length < kMinWallM) return;
    const Vector2d along = (to - from) / length;
    const Vector2d out(along.y(), -along.x());
    const double yaw_rad = std::atan2(along.y(), along.x());
    Random beside = next_place();
    const Rule* const of_corner = choose(Habitat::corner, beside);
    double at_m = 0.3;
    if (of_corner != nullptr && beside.uniform() < 0.4 * clutter_.density) {
      at_m += add_run(*of_corner, from + at_m * along, along, out, kOffWallM, yaw_rad, beside);
    }
    while (at_m < length - 1) {
      Random random = next_place();
      for (const Habitat habitat : {Habitat::facade, Habitat::flat}) {
        const bool is_flat = habitat == Habitat::flat;
        const Rule* const rule = choose(habitat, random);
        if (rule == nullptr || random.uniform() > (is_flat ? 0.25 : 0.5) * clutter_.density ||
            prop_type(rule->kind).height_m > height_m) {
          continue;
        }
        at_m += add_run(*rule, from + at_m * along, along, out, is_flat ? kFlatM : kOffWallM,
                        yaw_rad, random);
      }
      at_m += random.uniform(0.4, 1.6) * kStepM;
    }
  }

  /// An edge of an area of the ground: beside a road, if it is one's.
  void along_border(const Vector2d& from, const Vector2d& to) {
    constexpr double kMinEdgeM = 6;
    const double length = (to - from).norm();
    if (length < kMinEdgeM) return;
    const Vector2d along = (to - from) / length;
    const Vector2d left(-along.y(), along.x());
    line_road({from, along, left, length});
    line_road({to, -along, -left, length});
  }

  /// A border whose road would be on the left.
  struct Border {
    Vector2d from;
    Vector2d along;
    Vector2d to_road;
    double length = 0;
  };

  /// How far asphalt reaches from a point of the border (m), at most 12.
  double road_width(const Border& border, const Vector2d& at) const {
    double width_m = 0.5;
    while (width_m < 12 && ground_.material_at(at + width_m * border.to_road) == "asphalt") {
      width_m += 1;
    }
    return width_m - 0.5;
  }

  void line_road(const Border& border) {
    constexpr double kMinRoadM = 5;
    double kerb_m = next_place().uniform(0, 4);
    double road_m = next_place().uniform(2, 8);
    for (double at_m = 0; at_m < border.length; at_m += 1) {
      const Vector2d at = border.from + at_m * border.along;
      const std::string_view beside = ground_.material_at(at - 0.8 * border.to_road);
      const double width_m = road_width(border, at);
      if (width_m < 2 || beside == "asphalt" || beside.empty()) continue;
      const bool is_pavement = beside == "pavers" || beside == "concrete";
      if (at_m >= kerb_m && is_pavement) kerb_m = at_m + beside_road(border, at);
      if (at_m >= road_m && width_m >= kMinRoadM) road_m = at_m + park(border, at);
    }
  }

  /// Returns after how many meters the next may stand.
  double beside_road(const Border& border, const Vector2d& at) {
    constexpr double kOffRoadM = 0.35;
    Random random = next_place();
    const Rule* const rule = choose(Habitat::kerb, random);
    const double step_m = random.uniform(3, 9);
    if (rule == nullptr || random.uniform() >= clutter_.density) return step_m;
    const Vector2d back = -border.to_road;
    const double yaw_rad = std::atan2(back.y(), back.x()) - 0.5 * std::numbers::pi;
    const bool faces_drivers =
        rule->kind == PropKind::traffic_sign || rule->kind == PropKind::kick_scooter;
    return step_m + add_run(*rule, at, border.along, back, kOffRoadM,
                            faces_drivers ? yaw_rad + 0.5 * std::numbers::pi : yaw_rad, random);
  }

  double park(const Border& border, const Vector2d& at) {
    constexpr double kOffKerbM = 0.25;
    constexpr double kFreeM = 6;
    Random random = next_place();
    const Rule* const rule = choose(Habitat::road, random);
    if (rule == nullptr || random.uniform() >= clutter_.density) return kFreeM;
    const bool is_wide = prop_type(rule->kind).half_size.y() > 0.5;
    // Traffic on the right has the kerb on the right, but for some cars; two wheels stand across.
    const double turn_rad = is_wide ? (random.uniform() < 0.12 ? std::numbers::pi : 0)
                                    : random.uniform(0.4, 0.5) * std::numbers::pi;
    const double yaw_rad = std::atan2(border.along.y(), border.along.x()) + turn_rad;
    const double taken_m =
        add_run(*rule, at, border.along, border.to_road, kOffKerbM, yaw_rad, random);
    return taken_m + random.uniform(0.5, 1.4);
  }

  /// Darts on an area: one prop for so many square meters.
  void over(const std::vector<Vector2d>& area, Habitat habitat, double m2_each) {
    constexpr int kMaxProps = 60;
    const double wanted = clutter_.density * std::abs(geometry::signed_area(area)) / m2_each;
    const int count = std::min(kMaxProps, static_cast<int>(wanted));
    const auto [low, high] = geometry::bounding_box(area);
    const Vector2d edge = area[1] - area[0];
    for (int i = 0; i < 4 * count; ++i) {
      Random random = next_place();
      const Rule* const rule = choose(habitat, random);
      if (rule == nullptr) return;
      Prop prop;
      prop.kind = rule->kind;
      prop.position = {random.uniform(low.x(), high.x()), random.uniform(low.y(), high.y())};
      prop.yaw_rad = std::atan2(edge.y(), edge.x()) + random.below(4) * 0.5 * std::numbers::pi;
      if (random.uniform() < 0.25 && lies_on(prop, habitat)) add(prop, random);
    }
  }

  /// Whether all ground around a prop is of the habitat.
  bool lies_on(const Prop& prop, Habitat habitat) const {
    constexpr double kLotM = 3;
    const double reach_m =
        prop_type(prop.kind).half_size.norm() + (habitat == Habitat::lot ? kLotM : 0.2);
    for (int i = 0; i < 8; ++i) {
      const double angle = 0.25 * std::numbers::pi * i;
      const std::string_view material =
          ground_.material_at(prop.position + reach_m * Vector2d(std::cos(angle), std::sin(angle)));
      const bool is_grass = material == "grass";
      const bool is_paved = material == "pavers" || material == "concrete";
      if (habitat == Habitat::lawn ? !is_grass : !is_paved) return false;
    }
    return true;
  }

  const Clutter& clutter_;
  Scenario& scenario_;
  FreeGround ground_;
  std::uint64_t places_ = 0;
};

}  // namespace

void strew(const Clutter& clutter, Scenario& scenario) { Strewer(clutter, scenario).strew(); }

bool is_strewn(PropKind kind) {
  return std::any_of(kRules.begin(), kRules.end(),
                     [&](const Rule& rule) { return rule.kind == kind; });
}

}  // namespace throng::world
