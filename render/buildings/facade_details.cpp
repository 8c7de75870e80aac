#include "render/buildings/facade_details.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/compute/random.h"
#include "base/geometry/polygon.h"
#include "render/buildings/building_paints.h"
#include "render/buildings/exit_doors.h"
#include "render/buildings/facade_style.h"
#include "render/props/letter_sprites.h"
#include "render/props/prop_builder.h"

namespace throng::render {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using world::Facade;
namespace paints = building_paints;

/// A trade: the letters of its sign, its colors, and whether it has an awning.
struct Trade {
  std::string_view word;
  std::array<double, 3> board;
  std::array<double, 3> letters;
  double awning_share;
};

constexpr std::array<double, 3> kCream = {0.62, 0.58, 0.48};
constexpr std::array<double, 3> kGold = {0.55, 0.38, 0.10};
constexpr std::array<double, 3> kBlack = {0.02, 0.02, 0.022};
constexpr std::array<double, 3> kWhite = {0.68, 0.68, 0.66};

/// In the order of kShopWords.
constexpr std::array<Trade, kShopWords.size()> kTrades = {{
    {"BAKERY", {0.20, 0.09, 0.03}, kCream, 0.7},
    {"CAFE", {0.05, 0.03, 0.02}, kCream, 0.9},
    {"PHARMACY", {0.02, 0.20, 0.07}, kWhite, 0.2},
    {"BOOKS", {0.03, 0.05, 0.12}, kGold, 0.4},
    {"FLOWERS", {0.04, 0.13, 0.05}, kWhite, 0.8},
    {"SHOES", kBlack, kWhite, 0.2},
    {"OPTICIAN", {0.05, 0.09, 0.20}, kWhite, 0.1},
    {"BICYCLES", {0.42, 0.10, 0.02}, kBlack, 0.3},
    {"BARBER", {0.26, 0.03, 0.03}, kWhite, 0.3},
    {"PIZZA", {0.28, 0.03, 0.02}, kCream, 0.7},
    {"TAVERN", {0.04, 0.05, 0.03}, kGold, 0.6},
    {"FASHION", kWhite, kBlack, 0.2},
    {"TOYS", {0.50, 0.34, 0.03}, {0.25, 0.03, 0.03}, 0.4},
    {"JEWELER", kBlack, kGold, 0.2},
    {"HOTEL", {0.10, 0.02, 0.03}, kGold, 0.5},
    {"BANK", {0.03, 0.07, 0.20}, kWhite, 0.0},
    {"GROCERY", {0.05, 0.20, 0.04}, kCream, 0.9},
    {"PHOTO", {0.38, 0.28, 0.02}, kBlack, 0.1},
    {"TEA HOUSE", {0.05, 0.10, 0.08}, kCream, 0.6},
    {"WINES", {0.13, 0.02, 0.04}, kCream, 0.6},
    {"RECORDS", kBlack, {0.50, 0.10, 0.04}, 0.1},
    {"TAILOR", {0.06, 0.06, 0.08}, kCream, 0.4},
    {"HARDWARE", {0.30, 0.14, 0.02}, kWhite, 0.2},
    {"ICE CREAM", {0.50, 0.30, 0.32}, kWhite, 0.8},
}};

Vector3d color(const std::array<double, 3>& rgb) { return Vector3d(rgb.data()); }

/// Builds the details of one front in its frame: x along it, -y out of it, z up.
class FrontDetails {
 public:
  FrontDetails(const BuildingModel& model, const Front& front, const world::Scenario& scenario,
               std::uint32_t id)
      : model_(model),
        front_(front),
        scenario_(scenario),
        style_(facade_style(model.look.facade)),
        grid_(facade_grid(style_, front.length_m, front.height_m)),
        prop_(frame_prop(front)),
        builder_(prop_, id),
        random_(model.number, Stream::environment, 0xDE7A1 + front.number) {}

  /// Bands, signs and awnings, which also show from afar.
  void add_large() {
    if (front_.length_m < kMinFrontM) return;
    add_bands();
    const bool has_shops = model_.look.has_shops && grid_.stories > 1;
    for (int bay = 0; has_shops && bay < grid_.bays; bay += 2) add_shop(bay);
  }

  void add_small() {
    if (front_.length_m < kMinFrontM) return;
    add_downpipe();
    add_balconies();
    for (int story = 1; story < grid_.stories; ++story) {
      for (int bay = 0; bay < grid_.bays; ++bay) add_at_window(story, bay);
    }
    if (grid_.bays >= 3) add_step();
  }

  PropMesh take() { return builder_.take(); }

 private:
  static constexpr double kMinFrontM = 2.5;
  static constexpr double kBoardM = 0.36;  ///< height of a shop sign

  static world::Prop frame_prop(const Front& front) {
    world::Prop prop;
    prop.position = front.from;
    prop.yaw_rad = std::atan2(front.along.y(), front.along.x());
    return prop;
  }

  /// A box on the wall that reaches out of it.
  void box(double from_m, double to_m, double low_m, double high_m, double out_m,
           const Vector3d& paint, Finish finish = Finish::matt) {
    builder_.box({from_m, -out_m, low_m}, {to_m, 0, high_m}, paint, finish);
  }

  bool is_near_exit_at(double along_m) const {
    constexpr double kClearM = 2.6;
    return is_near_exit(scenario_, front_.from + along_m * front_.along, kClearM);
  }

  /// Whether something stands where an awning would hang.
  bool is_before_prop(double from_m, double to_m) const {
    constexpr double kRoomM = 2.6;
    const Vector2d a = front_.from + from_m * front_.along;
    const Vector2d b = front_.from + to_m * front_.along;
    return std::any_of(scenario_.props.begin(), scenario_.props.end(),
                       [&](const world::Prop& prop) {
                         return geometry::distance_to_segment(a, b, prop.position) < kRoomM;
                       });
  }

  Vector3d wall_paint() const { return front_.paint.matrix().cast<double>(); }

  void add_bands() {
    const Vector3d trim = style_.brick ? Vector3d(0.42, 0.39, 0.34) : Vector3d(0.54, 0.52, 0.47);
    const double top_m = front_.height_m;
    if (model_.look.facade == Facade::historic) {
      box(0, front_.length_m, top_m - 0.32, top_m - 0.14, 0.18, trim);
      box(0, front_.length_m, top_m - 0.14, top_m, 0.34, trim);
    } else if (style_.surround_m > 0) {
      box(0, front_.length_m, top_m - 0.2, top_m, 0.14, trim);
    }
    if (style_.course_m > 0 && grid_.stories > 1) {
      const double z = grid_.story_m;
      box(0, front_.length_m, z - style_.course_m, z, 0.07, trim);
    }
  }

  void add_downpipe() {
    if (style_.surround_m <= 0) return;
    const double x = 0.14;
    builder_.tube({x, -0.09, 0.1}, 0.05, {x, -0.09, front_.height_m - 0.2}, 0.05, paints::kZinc,
                  Finish::matt, 5);
  }

  double bay_middle_m(int bay) const { return (bay + 0.5) * grid_.bay_m; }

  /// Columns of balconies on every third or fourth bay of every other house, none right above
  /// shops, whose signs they would hide.
  void add_balconies() {
    constexpr double kShare = 0.5;
    if (style_.brick || random_.uniform() > kShare || grid_.stories < 2) return;
    has_balconies_ = true;
    const int every = 3 + static_cast<int>(random_.below(2));
    const int first = 1 + static_cast<int>(random_.below(2));
    const bool is_solid = model_.look.facade == Facade::concrete || random_.uniform() < 0.25;
    const int lowest = model_.look.has_shops ? 2 : 1;
    for (int bay = first; bay < grid_.bays; bay += every) {
      for (int story = lowest; story < grid_.stories; ++story) {
        add_balcony(bay_middle_m(bay), story * grid_.story_m + 0.05, is_solid);
      }
    }
  }

  void add_balcony(double middle_m, double floor_m, bool is_solid) {
    constexpr double kDeepM = 0.75;
    constexpr double kRailM = 1.0;
    const double half_m = std::min(style_.window_half_m + 0.5, 0.48 * grid_.bay_m);
    const double from = middle_m - half_m;
    const double to = middle_m + half_m;
    box(from, to, floor_m - 0.14, floor_m, kDeepM, 0.9 * paints::kStone);
    if (is_solid) {
      const Vector3d paint = 0.4 * wall_paint() + 0.5 * paints::kStone;
      builder_.box({from, -kDeepM, floor_m}, {to, -kDeepM + 0.06, floor_m + kRailM}, paint);
      for (const double x : {from, to - 0.06}) {
        builder_.box({x, -kDeepM + 0.06, floor_m}, {x + 0.06, 0, floor_m + kRailM}, paint);
      }
      return;
    }
    builder_.box({from, -kDeepM, floor_m + kRailM - 0.05}, {to, -kDeepM + 0.05, floor_m + kRailM},
                 paints::kIron);
    const int bars = static_cast<int>((to - from) / 0.16);
    for (int i = 0; i <= bars; ++i) {
      const double x = from + (to - from - 0.025) * i / bars;
      upright_bar({x, -kDeepM}, {x + 0.025, -kDeepM}, floor_m, kRailM);
    }
    for (const double x : {from, to}) {
      for (int i = 0; i < 4; ++i) {
        const double y = -kDeepM + 0.18 * i;
        upright_bar({x, y}, {x, y + 0.025}, floor_m, kRailM);
      }
    }
  }

  /// A thin bar that is seen from both sides.
  void upright_bar(const Vector2d& a, const Vector2d& b, double low_m, double tall_m) {
    const std::array<Vector3d, 4> corners = {
        Vector3d(a.x(), a.y(), low_m), Vector3d(b.x(), b.y(), low_m),
        Vector3d(b.x(), b.y(), low_m + tall_m), Vector3d(a.x(), a.y(), low_m + tall_m)};
    builder_.quad(corners, paints::kIron, Finish::matt);
    builder_.quad({corners[1], corners[0], corners[3], corners[2]}, paints::kIron, Finish::matt);
  }

  void add_at_window(int story, int bay) {
    const double draw = random_.uniform();
    const double x = bay_middle_m(bay);
    const double sill_m = (story + style_.sill_share) * grid_.story_m;
    const double half_m = std::min(style_.window_half_m, 0.45 * grid_.bay_m);
    if (!style_.slabs && !style_.brick && !has_balconies_ && draw < 0.07) {
      builder_.box({x - half_m, -0.26, sill_m - 0.04}, {x + half_m, -0.02, sill_m + 0.14},
                   {0.24, 0.10, 0.06});
      const bool is_red = random_.uniform() < 0.5;
      builder_.box({x - half_m + 0.03, -0.24, sill_m + 0.14},
                   {x + half_m - 0.03, -0.05, sill_m + 0.3},
                   is_red ? Vector3d(0.26, 0.05, 0.05) : Vector3d(0.06, 0.14, 0.03));
    } else if (draw > 0.95 && model_.look.facade != Facade::historic) {
      builder_.box({x + half_m + 0.1, -0.32, sill_m}, {x + half_m + 0.8, -0.04, sill_m + 0.55},
                   paints::kMachine);
    } else if (draw > 0.9 && model_.look.facade != Facade::modern) {
      const Vector3d at(x + half_m + 0.35, -0.3, sill_m + 0.2);
      builder_.tube({at.x(), 0, at.z()}, 0.02, at, 0.02, paints::kIron, Finish::matt, 3);
      builder_.tube(at, 0.3, at + Vector3d(-0.02, -0.06, 0.03), 0.3, {0.50, 0.50, 0.49},
                    Finish::matt, 8);
    }
  }

  /// A shop behind two bays.
  void add_shop(int first_bay) {
    const Trade& trade = kTrades.at(random_.below(static_cast<std::uint32_t>(kTrades.size())));
    const double draw = random_.uniform();
    const double awning = random_.uniform();
    const int bays = std::min(2, grid_.bays - first_bay);
    const double from = first_bay * grid_.bay_m + 0.15;
    const double to = (first_bay + bays) * grid_.bay_m - 0.15;
    constexpr double kVacantShare = 0.14;
    if (to - from < 1.8 || draw < kVacantShare) return;
    if (is_near_exit_at(from) || is_near_exit_at(to) || is_near_exit_at(0.5 * (from + to))) return;
    // Below the course above the ground floor.
    const double board_m = std::min(grid_.story_m - 0.62, 3.2);
    box(from, to, board_m, board_m + kBoardM, 0.06, color(trade.board));
    add_letters(trade, 0.5 * (from + to), board_m, to - from);
    if (awning < trade.awning_share && !is_before_prop(from, to)) {
      add_awning(from, to, board_m - 0.02, trade);
    } else if (awning > 0.75) {
      add_blade_sign(to - 0.3, board_m + 0.6, trade);
    }
  }

  void add_letters(const Trade& trade, double middle_m, double board_m, double room_m) {
    const double wide_m = std::min(0.9 * room_m, 0.29 * kLetterAspect);
    const double tall_m = wide_m / kLetterAspect;
    const double low_m = board_m + 0.5 * (kBoardM - tall_m);
    builder_.word({Vector3d(middle_m - 0.5 * wide_m, -0.075, low_m),
                   Vector3d(middle_m + 0.5 * wide_m, -0.075, low_m),
                   Vector3d(middle_m + 0.5 * wide_m, -0.075, low_m + tall_m),
                   Vector3d(middle_m - 0.5 * wide_m, -0.075, low_m + tall_m)},
                  -Vector3d::UnitY(), color(trade.letters),
                  static_cast<std::size_t>(&trade - kTrades.data()));
  }

  void add_awning(double from, double to, double top_m, const Trade& trade) {
    constexpr double kDeepM = 1.15;
    constexpr double kFallM = 0.26;
    constexpr double kHemM = 0.11;
    const Vector3d paint = 0.5 * color(trade.board) + 0.5 * Vector3d(0.30, 0.28, 0.25);
    const bool is_striped = random_.uniform() < 0.5;
    const int stripes = is_striped ? std::max(2, static_cast<int>((to - from) / 0.35)) : 1;
    const double low_m = top_m - kFallM;
    for (int i = 0; i < stripes; ++i) {
      const double a = from + (to - from) * i / stripes;
      const double b = from + (to - from) * (i + 1) / stripes;
      const Vector3d stripe = i % 2 == 0 ? paint : Vector3d(0.58, 0.56, 0.52);
      const std::array<Vector3d, 4> cloth = {Vector3d(a, -kDeepM, low_m),
                                             Vector3d(b, -kDeepM, low_m), Vector3d(b, 0, top_m),
                                             Vector3d(a, 0, top_m)};
      const std::array<Vector3d, 4> hem = {Vector3d(a, -kDeepM, low_m - kHemM),
                                           Vector3d(b, -kDeepM, low_m - kHemM), cloth[1], cloth[0]};
      for (const auto& part : {cloth, hem}) {
        builder_.quad(part, stripe, Finish::matt);
        builder_.quad({part[3], part[2], part[1], part[0]}, 0.6 * stripe, Finish::matt);
      }
    }
  }

  void add_blade_sign(double x, double low_m, const Trade& trade) {
    builder_.box({x, -0.95, low_m}, {x + 0.07, -0.2, low_m + 0.6}, color(trade.board),
                 Finish::matt);
    builder_.box({x + 0.02, -0.2, low_m + 0.28}, {x + 0.05, 0, low_m + 0.32}, paints::kIron);
  }

  /// Before the door in the middle bay, which shaders/wall.frag.glsl draws.
  void add_step() {
    const double x = bay_middle_m(grid_.bays / 2);
    if (is_near_exit_at(x)) return;
    box(x - 0.85, x + 0.85, 0, 0.12, 0.24, 0.8 * paints::kStone);
  }

  const BuildingModel& model_;
  const Front& front_;
  const world::Scenario& scenario_;
  const FacadeStyle& style_;
  FacadeGrid grid_;
  world::Prop prop_;
  PropBuilder builder_;
  Random random_;
  bool has_balconies_ = false;
};

void append(const PropMesh& part, PropMesh& whole) {
  const auto first = static_cast<std::uint32_t>(whole.vertices.size());
  whole.vertices.insert(whole.vertices.end(), part.vertices.begin(), part.vertices.end());
  for (const std::uint32_t index : part.indices) whole.indices.push_back(first + index);
}

}  // namespace

PropMesh facade_details(const BuildingModel& model, const world::Scenario& scenario,
                        std::uint32_t id, std::uint32_t top_id) {
  PropMesh mesh;
  if (!has_stories(model.building) || model.look.facade == Facade::glass) return mesh;
  const auto add = [&](auto part) {
    for (const Front& front : model.fronts) {
      FrontDetails details(model, front, scenario, id);
      (details.*part)();
      append(details.take(), mesh);
    }
  };
  add(&FrontDetails::add_large);
  mesh.far_indices = mesh.indices.size();
  add(&FrontDetails::add_small);
  for (PropVertex& vertex : mesh.vertices) {
    constexpr float kUp = 0.5F;
    constexpr float kAboveStepsM = 1.6F;
    if (vertex.normal[2] > kUp && vertex.position[2] > kAboveStepsM) vertex.id = top_id;
  }
  return mesh;
}

}  // namespace throng::render
