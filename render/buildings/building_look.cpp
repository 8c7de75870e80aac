#include "render/buildings/building_look.h"

#include <algorithm>
#include <array>
#include <limits>

#include "base/compute/random.h"
#include "base/geometry/angle.h"
#include "base/geometry/polygon.h"
#include "render/ground/scenery_mesh.h"

namespace throng::render {

namespace {

using world::Covering;
using world::Facade;
using world::RoofKind;

/// Uses of the random numbers of a building.
enum class Choice : std::uint64_t { facade = 0xFACADE, roof, covering, roof_paint, shops, front };

double pick(std::uint32_t number, Choice choice, std::uint32_t more = 0) {
  return Random(number, Stream::environment,
                static_cast<std::uint64_t>(choice) + (std::uint64_t{more} << 32U))
      .uniform();
}

template <typename Value>
struct StyleShare {
  Value value;
  double share;  ///< shares of a list add up to 1
};

template <typename Value, std::size_t count>
Value choose(const std::array<StyleShare<Value>, count>& shares, double pick) {
  for (const auto& [value, share] : shares) {
    if (pick < share) return value;
    pick -= share;
  }
  return shares.back().value;
}

constexpr std::array<StyleShare<Facade>, 5> kHouses = {{{Facade::historic, 0.34},
                                                        {Facade::brick, 0.24},
                                                        {Facade::plaster, 0.24},
                                                        {Facade::modern, 0.12},
                                                        {Facade::concrete, 0.06}}};
constexpr std::array<StyleShare<Facade>, 3> kTowers = {
    {{Facade::concrete, 0.4}, {Facade::modern, 0.3}, {Facade::glass, 0.3}}};
constexpr std::array<StyleShare<Facade>, 3> kHalls = {
    {{Facade::warehouse, 0.5}, {Facade::modern, 0.3}, {Facade::concrete, 0.2}}};

Facade choose_facade(const world::Building& building, std::uint32_t number) {
  constexpr double kTowerM = 22;
  constexpr double kHallDeepM = 22;
  const double pick_one = pick(number, Choice::facade);
  if (building.height_m < kMinStoryM) return pick_one < 0.4 ? Facade::brick : Facade::plaster;
  if (building.height_m > kTowerM) return choose(kTowers, pick_one);
  const Eigen::Vector2d along = main_direction(building.footprint);
  if (extent_m(building.footprint, {-along.y(), along.x()}) > kHallDeepM) {
    return choose(kHalls, pick_one);
  }
  const Facade facade = choose(kHouses, pick_one);
  if (number == 0 || facade != choose(kHouses, pick(number - 1, Choice::facade))) {
    return facade;
  }
  return choose(kHouses, pick(number, Choice::facade, 1));
}

constexpr std::array<StyleShare<RoofKind>, 4> kHistoricRoofs = {{{RoofKind::gabled, 0.36},
                                                                 {RoofKind::mansard, 0.34},
                                                                 {RoofKind::hipped, 0.22},
                                                                 {RoofKind::flat, 0.08}}};
constexpr std::array<StyleShare<RoofKind>, 4> kPlainRoofs = {{{RoofKind::gabled, 0.48},
                                                              {RoofKind::hipped, 0.22},
                                                              {RoofKind::half_hipped, 0.14},
                                                              {RoofKind::flat, 0.16}}};
constexpr std::array<StyleShare<RoofKind>, 3> kHallRoofs = {
    {{RoofKind::sawtooth, 0.4}, {RoofKind::gabled, 0.25}, {RoofKind::flat, 0.35}}};

RoofKind choose_roof(const world::Building& building, Facade facade, std::uint32_t number) {
  constexpr double kLowM = 4.5;
  constexpr double kDeepM = 19;
  constexpr std::size_t kMaxCorners = 14;
  const Eigen::Vector2d along = main_direction(building.footprint);
  const double deep_m = extent_m(building.footprint, {-along.y(), along.x()});
  const double pick_one = pick(number, Choice::roof);
  if (building.height_m < kLowM || building.footprint.size() > kMaxCorners) return RoofKind::flat;
  switch (facade) {
    case Facade::warehouse:
      return choose(kHallRoofs, pick_one);
    case Facade::historic:
      return deep_m > kDeepM ? RoofKind::flat : choose(kHistoricRoofs, pick_one);
    case Facade::plaster:
    case Facade::brick:
      return deep_m > kDeepM ? RoofKind::flat : choose(kPlainRoofs, pick_one);
    default:
      return RoofKind::flat;
  }
}

double usual_pitch_rad(RoofKind kind) {
  switch (kind) {
    case RoofKind::shed:
      return 12 * kDegree;
    case RoofKind::sawtooth:
      return 28 * kDegree;
    case RoofKind::hipped:
      return 34 * kDegree;
    case RoofKind::mansard:
      return 45 * kDegree;
    case RoofKind::dome:
    case RoofKind::pyramid:
      return 45 * kDegree;
    default:
      return 39 * kDegree;
  }
}

constexpr std::array<StyleShare<Covering>, 3> kFlatCoverings = {
    {{Covering::gravel, 0.5}, {Covering::felt, 0.36}, {Covering::grass, 0.14}}};
constexpr std::array<StyleShare<Covering>, 3> kSteepCoverings = {
    {{Covering::tiles, 0.66}, {Covering::slate, 0.24}, {Covering::metal, 0.10}}};
constexpr std::array<StyleShare<Covering>, 3> kMansardCoverings = {
    {{Covering::slate, 0.5}, {Covering::tiles, 0.3}, {Covering::metal, 0.2}}};

Covering choose_covering(RoofKind kind, double pick_one) {
  switch (kind) {
    case RoofKind::flat:
      return choose(kFlatCoverings, pick_one);
    case RoofKind::shed:
    case RoofKind::sawtooth:
    case RoofKind::dome:
      return Covering::metal;
    case RoofKind::mansard:
      return choose(kMansardCoverings, pick_one);
    default:
      return choose(kSteepCoverings, pick_one);
  }
}

using Paints = std::span<const std::array<float, 3>>;

constexpr std::array<std::array<float, 3>, 5> kTiles = {{{0.270F, 0.105F, 0.060F},
                                                         {0.215F, 0.098F, 0.066F},
                                                         {0.150F, 0.085F, 0.064F},
                                                         {0.325F, 0.150F, 0.085F},
                                                         {0.110F, 0.088F, 0.080F}}};
constexpr std::array<std::array<float, 3>, 3> kSlates = {
    {{0.085F, 0.090F, 0.100F}, {0.115F, 0.115F, 0.118F}, {0.072F, 0.074F, 0.084F}}};
constexpr std::array<std::array<float, 3>, 4> kMetals = {{{0.265F, 0.275F, 0.285F},
                                                          {0.130F, 0.132F, 0.138F},
                                                          {0.200F, 0.330F, 0.275F},
                                                          {0.215F, 0.215F, 0.205F}}};
constexpr std::array<std::array<float, 3>, 3> kGravels = {
    {{0.330F, 0.305F, 0.272F}, {0.260F, 0.250F, 0.238F}, {0.300F, 0.292F, 0.285F}}};
constexpr std::array<std::array<float, 3>, 3> kFelts = {
    {{0.105F, 0.105F, 0.108F}, {0.175F, 0.172F, 0.165F}, {0.390F, 0.390F, 0.385F}}};
constexpr std::array<std::array<float, 3>, 2> kSedums = {
    {{0.110F, 0.135F, 0.052F}, {0.165F, 0.150F, 0.070F}}};

Paints covering_paints(Covering covering) {
  switch (covering) {
    case Covering::tiles:
      return kTiles;
    case Covering::slate:
      return kSlates;
    case Covering::metal:
      return kMetals;
    case Covering::grass:
      return kSedums;
    case Covering::felt:
      return kFelts;
    default:
      return kGravels;
  }
}

constexpr std::array<std::array<float, 3>, 9> kRenders = {{{0.56F, 0.50F, 0.40F},
                                                           {0.60F, 0.57F, 0.51F},
                                                           {0.52F, 0.40F, 0.29F},
                                                           {0.45F, 0.45F, 0.43F},
                                                           {0.58F, 0.47F, 0.36F},
                                                           {0.50F, 0.42F, 0.22F},
                                                           {0.46F, 0.30F, 0.24F},
                                                           {0.34F, 0.40F, 0.40F},
                                                           {0.42F, 0.45F, 0.36F}}};
constexpr std::array<std::array<float, 3>, 4> kBricks = {{{0.300F, 0.155F, 0.100F},
                                                          {0.245F, 0.140F, 0.105F},
                                                          {0.380F, 0.285F, 0.185F},
                                                          {0.225F, 0.115F, 0.080F}}};
constexpr std::array<std::array<float, 3>, 4> kModerns = {
    {{0.66F, 0.65F, 0.62F}, {0.50F, 0.50F, 0.49F}, {0.60F, 0.55F, 0.47F}, {0.24F, 0.24F, 0.25F}}};
constexpr std::array<std::array<float, 3>, 4> kConcretes = {
    {{0.40F, 0.39F, 0.37F}, {0.47F, 0.45F, 0.41F}, {0.35F, 0.35F, 0.34F}, {0.50F, 0.46F, 0.38F}}};

Paints facade_paints(Facade facade) {
  switch (facade) {
    case Facade::brick:
    case Facade::warehouse:
      return kBricks;
    case Facade::modern:
      return kModerns;
    case Facade::concrete:
      return kConcretes;
    default:
      return kRenders;
  }
}

Paint paint_at(Paints paints, std::size_t index) {
  return Paint(paints[index % paints.size()].data());
}

std::size_t index_at(Paints paints, double pick_one) {
  return static_cast<std::size_t>(pick_one * static_cast<double>(paints.size()));
}

}  // namespace

Eigen::Vector2d main_direction(std::span<const Eigen::Vector2d> footprint) {
  Eigen::Vector2d longest = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < footprint.size(); ++i) {
    const Eigen::Vector2d edge = footprint[(i + 1) % footprint.size()] - footprint[i];
    if (edge.norm() > longest.norm()) longest = edge;
  }
  return longest.normalized();
}

double extent_m(std::span<const Eigen::Vector2d> footprint, const Eigen::Vector2d& direction) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Eigen::Vector2d& corner : footprint) {
    low = std::min(low, corner.dot(direction));
    high = std::max(high, corner.dot(direction));
  }
  return high - low;
}

bool has_stories(const world::Building& building) {
  for (const Facade without : {Facade::hedge, Facade::screen, Facade::blank}) {
    if (building.facade == without) return false;
  }
  return building.height_m >= kMinStoryM || building.facade == Facade::glass;
}

Paint front_paint(Facade facade, std::uint32_t number, std::uint32_t front) {
  const Paints paints = facade_paints(facade);
  std::size_t index = index_at(paints, pick(number, Choice::front));
  // Each front takes one of the colors after that of its neighbor.
  for (std::uint32_t i = 1; i <= front; ++i) {
    index += 1 + static_cast<std::size_t>(pick(number, Choice::front, i) *
                                          static_cast<double>(paints.size() - 1));
  }
  return paint_at(paints, index);
}

BuildingLook building_look(const world::Building& building, std::uint32_t number) {
  constexpr double kShopShare = 0.6;
  constexpr double kMinShopM = 5.5;  // lower ones are houses
  BuildingLook look;
  look.facade =
      building.facade == Facade::by_id ? choose_facade(building, number) : building.facade;
  look.wall = building.paint.value_or(front_paint(look.facade, number, 0));
  const bool may_have_roof = has_stories(building);
  look.roof = !may_have_roof                          ? RoofKind::flat
              : building.roof.kind == RoofKind::by_id ? choose_roof(building, look.facade, number)
                                                      : building.roof.kind;
  look.pitch_rad = building.roof.pitch_rad.value_or(usual_pitch_rad(look.roof));
  look.covering = building.roof.covering == Covering::by_id
                      ? choose_covering(look.roof, pick(number, Choice::covering))
                      : building.roof.covering;
  const Paints paints = covering_paints(look.covering);
  look.roof_paint = building.roof.paint.value_or(
      paint_at(paints, index_at(paints, pick(number, Choice::roof_paint))));
  const bool suits = look.facade == Facade::plaster || look.facade == Facade::brick ||
                     look.facade == Facade::historic || look.facade == Facade::modern;
  look.has_shops =
      suits && building.height_m > kMinShopM && pick(number, Choice::shops) < kShopShare;
  return look;
}

}  // namespace throng::render
