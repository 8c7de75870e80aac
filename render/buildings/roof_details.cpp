#include "render/buildings/roof_details.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "base/compute/random.h"
#include "base/geometry/polygon.h"
#include "base/geometry/rectangle.h"
#include "render/buildings/building_paints.h"
#include "render/props/prop_builder.h"

namespace throng::render {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using world::Facade;
using world::RoofKind;
namespace paints = building_paints;

/// Axes of a slope: along its eaves, upwards in it, and out of it.
struct Slope {
  Vector3d origin;
  Vector3d along;
  Vector3d up;
  Vector3d out;
  double length_m = 0;    ///< along, at its foot
  double height_m = 0;    ///< along `up`
  double top_from_m = 0;  ///< where its upper side begins and ends along
  double top_to_m = 0;

  Vector3d at(double along_m, double up_m, double out_m) const {
    return origin + along_m * along + up_m * up + out_m * out;
  }
  /// Whether a rectangle of the slope lies in it with a margin.
  bool holds(double from_m, double to_m, double low_m, double high_m) const {
    constexpr double kMarginM = 0.45;
    if (low_m < kMarginM || high_m > height_m - kMarginM) return false;
    const double share = high_m / height_m;
    const double left_m = std::max(0.0, share * top_from_m);
    const double right_m = length_m + std::min(0.0, share * (top_to_m - length_m));
    return from_m > left_m + kMarginM && to_m < right_m - kMarginM;
  }
};

std::optional<Slope> slope_at(const RoofSurface& surface) {
  if (surface.part != RoofPart::covering || surface.corners.size() != 4) return std::nullopt;
  const std::vector<Vector3d>& corners = surface.corners;
  Slope slope;
  slope.origin = corners[0];
  slope.length_m = (corners[1] - corners[0]).norm();
  slope.along = (corners[1] - corners[0]) / slope.length_m;
  slope.out = slope.along.cross(corners[3] - corners[0]).normalized();
  slope.up = slope.out.cross(slope.along);
  slope.height_m = (corners[3] - corners[0]).dot(slope.up);
  slope.top_from_m = (corners[3] - corners[0]).dot(slope.along);
  slope.top_to_m = (corners[2] - corners[0]).dot(slope.along);
  if (slope.out.z() > 0.98 || std::abs(slope.along.z()) > 1e-6) return std::nullopt;
  return slope;
}

class RoofDetails {
 public:
  RoofDetails(const BuildingModel& model, std::uint32_t id)
      : model_(model),
        builder_(origin(), id),
        random_(model.number, Stream::environment, 0x0F00F) {}

  PropMesh take() { return builder_.take(); }

  void add_pitched() {
    add_gutters();
    const bool is_lived_in = model_.look.facade != Facade::warehouse &&
                             model_.look.roof != RoofKind::sawtooth &&
                             model_.look.roof != RoofKind::dome;
    const double solar = random_.uniform();
    const double dormers = random_.uniform();
    for (const RoofSurface& surface : model_.roof.surfaces) {
      const std::optional<Slope> slope = slope_at(surface);
      if (!slope || slope->height_m < 1.8) continue;
      const bool is_upper = surface.corners[0].z() > model_.roof.eaves_m + 0.5;
      const bool faces_south = slope->out.y() < -0.2;
      if (is_lived_in && !is_upper && slope->out.z() < 0.83 &&
          (dormers < 0.6 || slope->out.z() < 0.45)) {
        add_dormers(*slope);
      } else if (faces_south && solar < 0.35) {
        add_solar(*slope);
      } else if (is_lived_in) {
        add_skylights(*slope);
      }
    }
    if (is_lived_in) add_chimneys();
  }

  /// Boxes that stand free of each other, the largest first.
  void add_flat() {
    const double area_m2 = geometry::signed_area(model_.building.footprint);
    constexpr double kMinRoofM2 = 60;
    if (area_m2 < kMinRoofM2) return;
    if (!place({1.3, 1.0}, [&](const Stand& stand) { add_stair_head(stand); })) return;
    if (random_.uniform() < 0.3) {
      for (int i = 0; i < std::min(10, static_cast<int>(area_m2 / 25)); ++i) {
        place({1.7, 0.75}, [&](const Stand& stand) { add_tilted_solar(stand); });
      }
    }
    const int units = std::min(8, static_cast<int>(area_m2 / 60));
    for (int i = 0; i < units; ++i) {
      place({0.85, 0.5}, [&](const Stand& stand) { add_cooler(stand); });
    }
    for (int i = 0; i < units; ++i) {
      place({0.55, 0.55}, [&](const Stand& stand) { add_light_dome(stand); });
    }
    for (int i = 0; i < 2 * units; ++i) {
      place({0.16, 0.16}, [&](const Stand& stand) { add_vent(stand); });
    }
    if (random_.uniform() < 0.5) {
      place({0.2, 0.2}, [&](const Stand& stand) { add_mast(stand); });
    }
  }

 private:
  /// A rectangle on a flat roof.
  struct Stand {
    Vector2d half;
    Vector2d middle;
  };

  static const world::Prop& origin() {
    static const world::Prop kOrigin;
    return kOrigin;
  }

  void quad(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d,
            const Vector3d& paint, Finish finish = Finish::matt) {
    builder_.quad({a, b, c, d}, paint, finish);
  }

  /// A box that is turned as the building is.
  void box(const Stand& stand, double low_m, double high_m, const Vector3d& paint,
           Finish finish = Finish::matt) {
    const auto corners = geometry::turned_rectangle(stand.middle, stand.half, along_);
    const auto at = [&](std::size_t i, double z) {
      return Vector3d(corners.at(i % 4).x(), corners.at(i % 4).y(), z);
    };
    for (std::size_t i = 0; i < 4; ++i) {
      quad(at(i, low_m), at(i + 1, low_m), at(i + 1, high_m), at(i, high_m), paint, finish);
    }
    quad(at(0, high_m), at(1, high_m), at(2, high_m), at(3, high_m), paint, finish);
  }

  /// Calls `add` with a free stand, if there is one this far from the outline (m).
  template <typename Add>
  bool place(const Vector2d& half, const Add& add, double from_edge_m = 0.9) {
    constexpr double kApartM = 0.5;
    constexpr int kTries = 20;
    const std::vector<Vector2d>& footprint = model_.building.footprint;
    const auto [low, high] = geometry::bounding_box(footprint);
    for (int attempt = 0; attempt < kTries; ++attempt) {
      const Stand stand{half,
                        {random_.uniform(low.x(), high.x()), random_.uniform(low.y(), high.y())}};
      if (geometry::signed_distance_to(footprint, stand.middle) > -half.norm() - from_edge_m) {
        continue;
      }
      const bool is_free = std::all_of(taken_.begin(), taken_.end(), [&](const Stand& other) {
        return (other.middle - stand.middle).norm() > half.norm() + other.half.norm() + kApartM;
      });
      if (!is_free) continue;
      taken_.push_back(stand);
      add(stand);
      return true;
    }
    return false;
  }

  double top_m() const { return model_.roof.top_m; }

  void add_stair_head(const Stand& stand) {
    const Vector3d paint = model_.look.wall.matrix().cast<double>();
    box(stand, top_m(), top_m() + 2.3, 0.9 * paint);
    box({stand.half + Vector2d(0.1, 0.1), stand.middle}, top_m() + 2.3, top_m() + 2.42,
        paints::kZinc);
    const Vector2d across(-along_.y(), along_.x());
    const Vector2d door = stand.middle - (stand.half.y() + 0.02) * across;
    box({{0.45, 0.02}, door}, top_m(), top_m() + 2, paints::kDark);
  }

  void add_cooler(const Stand& stand) {
    const double high_m = top_m() + random_.uniform(0.9, 1.3);
    box(stand, top_m() + 0.15, high_m, random_.uniform(0.8, 1.1) * paints::kMachine);
    // Dark louvers on all sides, and a fan on top.
    box({stand.half + Vector2d(0.012, 0.012), stand.middle}, top_m() + 0.35, high_m - 0.25,
        0.35 * paints::kMachine);
    builder_.tube({stand.middle.x(), stand.middle.y(), high_m}, 0.38,
                  {stand.middle.x(), stand.middle.y(), high_m + 0.06}, 0.36, paints::kDark,
                  Finish::matt, 10);
  }

  void add_light_dome(const Stand& stand) {
    box(stand, top_m(), top_m() + 0.25, paints::kZinc);
    box({0.86 * stand.half, stand.middle}, top_m() + 0.25, top_m() + 0.4, {0.42, 0.44, 0.45},
        Finish::lit_glass);
  }

  void add_vent(const Stand& stand) {
    const double high_m = top_m() + random_.uniform(0.4, 0.9);
    builder_.tube({stand.middle.x(), stand.middle.y(), top_m()}, 0.11,
                  {stand.middle.x(), stand.middle.y(), high_m}, 0.11, paints::kZinc, Finish::matt,
                  6);
    builder_.tube({stand.middle.x(), stand.middle.y(), high_m + 0.05}, 0.19,
                  {stand.middle.x(), stand.middle.y(), high_m + 0.13}, 0.06, paints::kZinc,
                  Finish::matt, 6);
  }

  void add_mast(const Stand& stand) {
    const double high_m = top_m() + random_.uniform(1.8, 2.4);
    builder_.tube({stand.middle.x(), stand.middle.y(), top_m()}, 0.03,
                  {stand.middle.x(), stand.middle.y(), high_m}, 0.02, paints::kDark, Finish::matt,
                  4);
    for (const double below_m : {0.1, 0.4, 0.7}) {
      box({{0.5 - 0.3 * below_m, 0.015}, stand.middle}, high_m - below_m, high_m - below_m + 0.03,
          paints::kDark);
    }
  }

  /// A panel that leans to the south on a frame.
  void add_tilted_solar(const Stand& stand) {
    constexpr double kLowM = 0.15;
    constexpr double kHighM = 0.55;
    const Vector2d south =
        along_.x() > 0 ? Vector2d(along_.y(), -along_.x()) : Vector2d(-along_.y(), along_.x());
    const Vector2d right = Vector2d(-south.y(), south.x());
    const auto at = [&](double x, double y, double z) {
      const Vector2d p = stand.middle + x * stand.half.x() * right + y * stand.half.y() * south;
      return Vector3d(p.x(), p.y(), top_m() + z);
    };
    quad(at(-1, 1, kLowM), at(1, 1, kLowM), at(1, -1, kHighM), at(-1, -1, kHighM), paints::kSolar,
         Finish::glossy);
    quad(at(1, -1, 0), at(-1, -1, 0), at(-1, -1, kHighM), at(1, -1, kHighM), paints::kZinc);
    for (const double side : {-1.0, 1.0}) {
      quad(at(side, side, 0), at(side, -side, 0), at(side, -side, side > 0 ? kHighM : kLowM),
           at(side, side, side > 0 ? kLowM : kHighM), 0.6 * paints::kZinc);
    }
  }

  void add_gutters() {
    constexpr double kGutterM = 0.13;
    const std::vector<Vector2d>& footprint = model_.building.footprint;
    const double z = model_.roof.eaves_m;
    for (const std::size_t wall : model_.roof.eaves) {
      const Vector2d& from = footprint[wall];
      const Vector2d& to = footprint[(wall + 1) % footprint.size()];
      const Vector2d along = (to - from).normalized();
      const Vector2d out = kGutterM * Vector2d(along.y(), -along.x());
      const auto at = [&](const Vector2d& p, double up) { return Vector3d(p.x(), p.y(), z + up); };
      quad(at(from, -kGutterM), at(to, -kGutterM), at(to + out, -0.02), at(from + out, -0.02),
           paints::kZinc);
      quad(at(from + out, -0.02), at(to + out, -0.02), at(to, 0.02), at(from, 0.02),
           0.5 * paints::kZinc);
    }
  }

  /// Dormers with gables of their own in a row above the eaves.
  void add_dormers(const Slope& slope) {
    constexpr double kHalfM = 0.7;
    constexpr double kTallM = 1.05;
    constexpr double kGableM = 0.55;
    constexpr double kApartM = 3.6;
    const double rise = slope.up.z();
    const double steepness = rise / slope.out.z();  // height gained per meter inwards
    const double low_m = std::min(0.9, 0.2 * slope.height_m);
    const double top_m = low_m + (kTallM + kGableM) / rise;
    const Vector3d inward(-slope.along.y(), slope.along.x(), 0);
    const Vector3d front = 0.9 * paints::kStone;
    const Vector3d roof = model_.look.roof_paint.matrix().cast<double>();
    const int count = static_cast<int>(slope.length_m / kApartM);
    for (int i = 0; i < count; ++i) {
      const double middle_m = slope.length_m * (i + 0.5) / count;
      if (!slope.holds(middle_m - kHalfM, middle_m + kHalfM, low_m, top_m)) continue;
      const auto at = [&](double x, double up_m, double in_m) -> Vector3d {
        return slope.at(middle_m + x, low_m, 0) + up_m * Vector3d::UnitZ() + in_m * inward;
      };
      const double cheek_m = kTallM / steepness;  // where the walls end in the slope
      const double ridge_m = (kTallM + kGableM) / steepness;
      quad(at(-kHalfM, 0, 0), at(kHalfM, 0, 0), at(kHalfM, kTallM, 0), at(-kHalfM, kTallM, 0),
           front);
      quad(at(-kHalfM, kTallM, 0), at(kHalfM, kTallM, 0), at(0, kTallM + kGableM, 0),
           at(0, kTallM + kGableM, 0), front);
      quad(at(-0.6 * kHalfM, 0.15, -0.02), at(0.6 * kHalfM, 0.15, -0.02),
           at(0.6 * kHalfM, kTallM - 0.05, -0.02), at(-0.6 * kHalfM, kTallM - 0.05, -0.02),
           paints::kPane, Finish::lit_glass);
      for (const double side : {-1.0, 1.0}) {
        const double x = side * kHalfM;
        const std::array<Vector3d, 3> cheek = {at(x, 0, 0), at(x, kTallM, cheek_m),
                                               at(x, kTallM, 0)};
        const std::size_t second = side > 0 ? 1 : 2;
        quad(cheek[0], cheek[second], cheek[3 - second], cheek[3 - second], 0.8 * front);
        const double over_m = side * (kHalfM + 0.12);
        const double eaves_m = kTallM - 0.12 * kGableM / kHalfM;
        const std::array<Vector3d, 4> cloth = {
            at(over_m, eaves_m, -0.15), at(over_m, eaves_m, cheek_m),
            at(0, kTallM + kGableM, ridge_m), at(0, kTallM + kGableM, -0.15)};
        if (side > 0) {
          quad(cloth[0], cloth[1], cloth[2], cloth[3], roof);
        } else {
          quad(cloth[3], cloth[2], cloth[1], cloth[0], roof);
        }
      }
    }
  }

  void add_skylights(const Slope& slope) {
    const int count = static_cast<int>(slope.length_m / 3.5);
    for (int i = 0; i < count; ++i) {
      if (random_.uniform() < 0.55) continue;
      const double at_m = slope.length_m * (i + 0.5) / count;
      const double low_m = random_.uniform(0.3, 0.5) * slope.height_m;
      add_pane(slope, {at_m - 0.4, at_m + 0.4}, {low_m, low_m + 1.1}, paints::kPane,
               Finish::lit_glass);
    }
  }

  /// A pane a little above a slope, in a frame.
  void add_pane(const Slope& slope, const Vector2d& along_m, const Vector2d& up_m,
                const Vector3d& paint, Finish finish) {
    if (!slope.holds(along_m.x(), along_m.y(), up_m.x(), up_m.y())) return;
    const auto rectangle = [&](double grow_m, double out_m, const Vector3d& color, Finish look) {
      quad(slope.at(along_m.x() - grow_m, up_m.x() - grow_m, out_m),
           slope.at(along_m.y() + grow_m, up_m.x() - grow_m, out_m),
           slope.at(along_m.y() + grow_m, up_m.y() + grow_m, out_m),
           slope.at(along_m.x() - grow_m, up_m.y() + grow_m, out_m), color, look);
    };
    rectangle(0.07, 0.05, 0.5 * paints::kZinc, Finish::matt);
    rectangle(0, 0.07, paint, finish);
  }

  void add_solar(const Slope& slope) {
    constexpr double kWideM = 1.05;
    constexpr double kTallM = 1.7;
    const int rows = static_cast<int>((slope.height_m - 1.2) / kTallM);
    const int columns = static_cast<int>((slope.length_m - 1.5) / kWideM);
    const int begin = static_cast<int>(random_.below(3));
    const int end = columns - static_cast<int>(random_.below(4));
    for (int row = 0; row < rows; ++row) {
      for (int column = begin; column < end; ++column) {
        const double x = 0.75 + kWideM * column;
        const double up = 0.7 + kTallM * row;
        add_pane(slope, {x + 0.04, x + kWideM - 0.04}, {up, up + kTallM - 0.08}, paints::kSolar,
                 Finish::glossy);
      }
    }
  }

  /// Chimneys beside the ridge, one for some 12 m of the building.
  void add_chimneys() {
    constexpr double kHalfM = 0.32;
    const double length_m = extent_m(model_.building.footprint, along_);
    const double deep_m = extent_m(model_.building.footprint, Vector2d(-along_.y(), along_.x()));
    const int count = std::clamp(static_cast<int>(length_m / 12) + 1, 1, 6);
    for (int i = 0; i < count; ++i) {
      place(
          {kHalfM, kHalfM},
          [&](const Stand& stand) {
            const double high_m = model_.building.height_m + random_.uniform(0.3, 0.9);
            const Vector3d paint = random_.uniform() < 0.6 ? paints::kBrick : paints::kStone;
            box(stand, model_.roof.eaves_m, high_m, paint);
            box({stand.half + Vector2d(0.06, 0.06), stand.middle}, high_m, high_m + 0.1,
                0.8 * paints::kStone);
            for (const double x : {-0.14, 0.14}) {
              const Vector2d at = stand.middle + x * along_;
              builder_.tube({at.x(), at.y(), high_m + 0.1}, 0.09, {at.x(), at.y(), high_m + 0.35},
                            0.07, {0.25, 0.11, 0.07}, Finish::matt, 6);
            }
          },
          0.28 * deep_m - kHalfM);
    }
  }

  const BuildingModel& model_;
  PropBuilder builder_;
  Random random_;
  Vector2d along_ = main_direction(model_.building.footprint);
  std::vector<Stand> taken_;
};

}  // namespace

PropMesh roof_details(const BuildingModel& model, std::uint32_t id) {
  if (!has_stories(model.building)) return {};
  RoofDetails details(model, id);
  if (model.roof.is_flat) {
    details.add_flat();
  } else {
    details.add_pitched();
  }
  return details.take();
}

}  // namespace throng::render
