#include "render/buildings/roof_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "base/geometry/angle.h"
#include "base/geometry/polygon.h"
#include "base/geometry/straight_skeleton.h"
#include "base/geometry/triangulate.h"
#include "render/ground/scenery_mesh.h"

namespace throng::render {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::EdgeSpeeds;
using geometry::SweptStrip;
using world::RoofKind;
using Footprint = std::vector<Vector2d>;

/// Heights of a roof by the way of its eaves, in shares of the whole of both.
using Profile = std::vector<std::pair<double, double>>;

Profile roof_profile(RoofKind kind) {
  if (kind == RoofKind::mansard) return {{0, 0}, {0.22, 0.68}, {1, 1}};
  if (kind != RoofKind::dome) return {{0, 0}, {1, 1}};
  Profile quarter_circle;
  constexpr int kSteps = 6;
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = 0.5 * std::numbers::pi * i / kSteps;
    quarter_circle.emplace_back(1 - std::cos(angle), std::sin(angle));
  }
  return quarter_circle;
}

double profile_height(const Profile& profile, double share) {
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const auto& [from, low] = profile[i - 1];
    const auto& [to, high] = profile[i];
    if (share <= to) return low + (high - low) * (share - from) / (to - from);
  }
  return 1;
}

Vector2d edge_direction(const Footprint& footprint, std::size_t edge) {
  return (footprint[(edge + 1) % footprint.size()] - footprint[edge]).normalized();
}

Vector2d outward_of_edge(const Footprint& footprint, std::size_t edge) {
  const Vector2d along = edge_direction(footprint, edge);
  return {along.y(), -along.x()};
}

double edge_m(const Footprint& footprint, std::size_t edge) {
  return (footprint[(edge + 1) % footprint.size()] - footprint[edge]).norm();
}

bool is_convex(const Footprint& footprint) {
  for (std::size_t i = 0; i < footprint.size(); ++i) {
    const std::size_t next = (i + 1) % footprint.size();
    if (geometry::cross(edge_direction(footprint, i), edge_direction(footprint, next)) < -1e-6) {
      return false;
    }
  }
  return true;
}

/// Whether a wall ends a wing: both walls beside it run away from it side by side.
bool ends_wing(const Footprint& footprint, std::size_t edge) {
  const std::size_t size = footprint.size();
  const Vector2d before = edge_direction(footprint, (edge + size - 1) % size);
  const Vector2d along = edge_direction(footprint, edge);
  const Vector2d after = edge_direction(footprint, (edge + 1) % size);
  const double square = std::sin(62 * kDegree);
  return geometry::cross(before, along) > square && geometry::cross(along, after) > square &&
         before.dot(after) < -std::cos(20 * kDegree);
}

std::vector<double> gabled_speeds(const Footprint& footprint, const world::Roof& roof) {
  const std::size_t size = footprint.size();
  std::vector<double> speeds(size, 1);
  for (std::size_t i = 0; i < size; ++i) {
    if (!ends_wing(footprint, i)) continue;
    if (roof.falls_rad) {
      const Vector2d falls(std::cos(*roof.falls_rad), std::sin(*roof.falls_rad));
      if (std::abs(outward_of_edge(footprint, i).dot(falls)) < std::sqrt(0.5)) speeds[i] = 0;
      continue;
    }
    const double beside_m =
        std::min(edge_m(footprint, (i + 1) % size), edge_m(footprint, (i + size - 1) % size));
    const bool is_first_of_square = size == 4 && i % 2 == 1;
    const double length_m = edge_m(footprint, i);
    if (length_m < 0.98 * beside_m || (length_m < 1.02 * beside_m && is_first_of_square)) {
      speeds[i] = 0;
    }
  }
  return speeds;
}

/// All walls stay but the one towards which the roof falls.
std::vector<double> shed_speeds(const Footprint& footprint, const world::Roof& roof) {
  Vector2d falls = main_direction(footprint);
  falls = Vector2d(falls.y(), -falls.x());
  if (roof.falls_rad) falls = {std::cos(*roof.falls_rad), std::sin(*roof.falls_rad)};
  std::vector<double> speeds(footprint.size(), 0);
  std::size_t low = 0;
  for (std::size_t i = 1; i < footprint.size(); ++i) {
    if (outward_of_edge(footprint, i).dot(falls) > outward_of_edge(footprint, low).dot(falls)) {
      low = i;
    }
  }
  speeds[low] = 1;
  return speeds;
}

double last_moment_m(const std::vector<SweptStrip>& strips) {
  double last_m = 0;
  for (const SweptStrip& strip : strips) last_m = std::max(last_m, strip.to_m);
  return last_m;
}

/// Strips from all walls to the middle, for a convex footprint.
std::vector<SweptStrip> swept_to_middle(const Footprint& footprint) {
  Vector2d middle = Vector2d::Zero();
  for (const Vector2d& corner : footprint) {
    middle += corner / static_cast<double>(footprint.size());
  }
  const double way_m = std::abs(geometry::signed_distance_to(footprint, middle));
  std::vector<SweptStrip> strips;
  for (std::size_t i = 0; i < footprint.size(); ++i) {
    const Vector2d& next = footprint[(i + 1) % footprint.size()];
    strips.push_back({i, {footprint[i], next, middle, middle}, 0, way_m});
  }
  return strips;
}

/// The strips of a roof that is not flat; none if the footprint does not allow it.
std::vector<SweptStrip> roof_strips(const Footprint& footprint, RoofKind kind,
                                    const world::Roof& roof) {
  const auto sweep = [&](std::vector<EdgeSpeeds> speeds) {
    return geometry::sweep_inwards(footprint, speeds);
  };
  const std::vector<double> all(footprint.size(), 1);
  std::vector<SweptStrip> strips;
  if (kind == RoofKind::gabled || kind == RoofKind::half_hipped) {
    const std::vector<double> gabled = gabled_speeds(footprint, roof);
    strips = sweep({{0, gabled}});
    constexpr double kHippedFrom = 0.55;  // of the way to the ridge
    if (kind == RoofKind::half_hipped && !strips.empty()) {
      strips = sweep({{0, gabled}, {kHippedFrom * last_moment_m(strips), all}});
    }
  } else if (kind == RoofKind::shed && is_convex(footprint)) {
    strips = sweep({{0, shed_speeds(footprint, roof)}});
  } else if ((kind == RoofKind::pyramid || kind == RoofKind::dome) && is_convex(footprint)) {
    strips = swept_to_middle(footprint);
  }
  return strips.empty() ? sweep({{0, all}}) : strips;
}

/// The part of a strip between two moments within its own.
SweptStrip part_of_strip(const SweptStrip& strip, double from_m, double to_m) {
  const auto at = [&](double moment_m) {
    const double share = (moment_m - strip.from_m) / (strip.to_m - strip.from_m);
    return std::pair(Vector2d(strip.corners[0] + share * (strip.corners[3] - strip.corners[0])),
                     Vector2d(strip.corners[1] + share * (strip.corners[2] - strip.corners[1])));
  };
  const auto [a, b] = at(from_m);
  const auto [d, c] = at(to_m);
  return {strip.edge, {a, b, c, d}, from_m, to_m};
}

class Shaper {
 public:
  Shaper(const Footprint& footprint, RoofShape& shape) : footprint_(footprint), shape_(shape) {}

  void add(RoofPart part, std::size_t wall, const std::vector<Vector3d>& corners) {
    std::vector<Vector3d> kept;
    for (const Vector3d& corner : corners) {
      if (kept.empty() || (corner - kept.back()).norm() > 1e-4) kept.push_back(corner);
    }
    if (kept.size() > 1 && (kept.front() - kept.back()).norm() < 1e-4) kept.pop_back();
    if (kept.size() < 3) return;
    shape_.surfaces.push_back(
        {part, std::move(kept), footprint_[wall], edge_direction(footprint_, wall), wall});
  }

  void add(RoofPart part, const SweptStrip& strip, double low_m, double high_m) {
    const auto at = [&](std::size_t i) {
      return Vector3d(strip.corners.at(i).x(), strip.corners.at(i).y(), i < 2 ? low_m : high_m);
    };
    add(part, strip.edge, {at(0), at(1), at(2), at(3)});
  }

 private:
  const Footprint& footprint_;
  RoofShape& shape_;
};

RoofShape pitched_roof(const world::Building& building, const std::vector<SweptStrip>& strips,
                       const BuildingLook& look) {
  constexpr double kMaxShare = 0.42;  // of the building's height, if its file says nothing
  const double whole_m = last_moment_m(strips);
  const double wanted_m = building.roof.height_m.value_or(
      std::min(std::tan(look.pitch_rad) * whole_m,
               (building.roof.pitch_rad ? 1 : kMaxShare) * building.height_m));
  const double rise_m =
      std::min(wanted_m, std::max(0.4 * building.height_m, building.height_m - kMinStoryM));
  RoofShape shape{building.height_m - rise_m, building.height_m, false, {}, {}};
  Shaper shaper(building.footprint, shape);
  const Profile profile = roof_profile(look.roof);
  for (const SweptStrip& strip : strips) {
    const bool is_gable = std::abs(geometry::signed_area(strip.corners)) < 1e-6;
    const Vector2d outward = outward_of_edge(building.footprint, strip.edge);
    const bool stays =
        is_gable && std::abs((strip.corners[2] - strip.corners[0]).dot(outward)) < 1e-4;
    if (!stays && strip.from_m == 0) shape.eaves.push_back(strip.edge);
    double from_m = strip.from_m;
    for (const auto& [share, height] : profile) {
      const double to_m = std::min(strip.to_m, share * whole_m);
      if (to_m <= from_m + 1e-9) continue;
      shaper.add(stays ? RoofPart::gable : RoofPart::covering, part_of_strip(strip, from_m, to_m),
                 shape.eaves_m + rise_m * profile_height(profile, from_m / whole_m),
                 shape.eaves_m + rise_m * profile_height(profile, to_m / whole_m));
      from_m = to_m;
    }
  }
  return shape;
}

/// Slopes one behind the other, each ending in a wall of glass, over a footprint of four corners.
RoofShape sawtooth_roof(const world::Building& building, const BuildingLook& look) {
  constexpr double kToothM = 6;
  const Footprint& footprint = building.footprint;
  const Vector2d along = main_direction(footprint);
  double first = std::numeric_limits<double>::infinity();
  for (const Vector2d& corner : footprint) first = std::min(first, corner.dot(along));
  const double length_m = extent_m(footprint, along);
  const int teeth = std::max(1, static_cast<int>(std::lround(length_m / kToothM)));
  const double tooth_m = length_m / teeth;
  const double rise_m =
      std::min(building.roof.height_m.value_or(std::min(std::tan(look.pitch_rad) * tooth_m, 3.0)),
               0.6 * building.height_m);
  RoofShape shape{building.height_m - rise_m, building.height_m, false, {}, {}};
  Shaper shaper(footprint, shape);
  for (int i = 0; i < teeth; ++i) {
    const double low = first + i * tooth_m;
    const double high = low + tooth_m;
    const Footprint above =
        geometry::clipped(footprint, [&](const Vector2d& p) { return low - p.dot(along); });
    const Footprint part =
        geometry::clipped(above, [&](const Vector2d& p) { return p.dot(along) - high; });
    const auto raised = [&](const Vector2d& p) {
      const double share = std::clamp((p.dot(along) - low) / tooth_m, 0.0, 1.0);
      return Vector3d(p.x(), p.y(), shape.eaves_m + rise_m * share);
    };
    std::vector<Vector3d> slope;
    for (const Vector2d& p : part) slope.push_back(raised(p));
    shaper.add(RoofPart::covering, 0, slope);
    for (std::size_t k = 0; k < part.size(); ++k) {
      const Vector3d a = raised(part[k]);
      const Vector3d b = raised(part[(k + 1) % part.size()]);
      const bool is_front = (part[k].dot(along) > high - 1e-6) &&
                            (part[(k + 1) % part.size()].dot(along) > high - 1e-6);
      shaper.add(is_front ? RoofPart::glazing : RoofPart::gable, 0,
                 {{a.x(), a.y(), shape.eaves_m}, {b.x(), b.y(), shape.eaves_m}, b, a});
    }
  }
  return shape;
}

RoofShape flat_roof(const world::Building& building, bool has_parapet) {
  constexpr double kParapetM = 0.45;
  constexpr double kThickM = 0.28;
  const double top_m = building.height_m;
  RoofShape shape{top_m, top_m, true, {}, {}};
  Shaper shaper(building.footprint, shape);
  std::vector<SweptStrip> strips;
  if (has_parapet) {
    strips = geometry::sweep_inwards(
        building.footprint,
        std::vector<EdgeSpeeds>{{0, std::vector<double>(building.footprint.size(), 1)}});
  }
  if (strips.empty() || last_moment_m(strips) < 3 * kThickM) {
    for (const auto& triangle : geometry::triangulate(building.footprint)) {
      const auto at = [&](std::uint32_t i) {
        return Vector3d(building.footprint[i].x(), building.footprint[i].y(), top_m);
      };
      shaper.add(RoofPart::covering, 0, {at(triangle[0]), at(triangle[1]), at(triangle[2])});
    }
    return shape;
  }
  shape.top_m = top_m - kParapetM;
  for (const SweptStrip& strip : strips) {
    const double edge_m = std::clamp(kThickM, strip.from_m, strip.to_m);
    if (strip.from_m < edge_m) {
      shaper.add(RoofPart::coping, part_of_strip(strip, strip.from_m, edge_m), top_m, top_m);
    }
    if (strip.to_m <= edge_m) continue;
    const SweptStrip inner = part_of_strip(strip, edge_m, strip.to_m);
    shaper.add(RoofPart::covering, inner, shape.top_m, shape.top_m);
    if (strip.from_m < edge_m) {
      const Vector2d& a = inner.corners[0];
      const Vector2d& b = inner.corners[1];
      shaper.add(RoofPart::coping, strip.edge,
                 {{b.x(), b.y(), shape.top_m},
                  {a.x(), a.y(), shape.top_m},
                  {a.x(), a.y(), top_m},
                  {b.x(), b.y(), top_m}});
    }
  }
  return shape;
}

}  // namespace

RoofShape roof_shape(const world::Building& building, const BuildingLook& look) {
  constexpr double kMinParapetM = 5;  // of height
  const bool has_parapet = has_stories(building) && building.height_m >= kMinParapetM;
  if (look.roof == RoofKind::flat) return flat_roof(building, has_parapet);
  if (look.roof == RoofKind::sawtooth && building.footprint.size() == 4 &&
      is_convex(building.footprint)) {
    return sawtooth_roof(building, look);
  }
  const std::vector<SweptStrip> strips = roof_strips(building.footprint, look.roof, building.roof);
  return strips.empty() ? flat_roof(building, has_parapet) : pitched_roof(building, strips, look);
}

}  // namespace throng::render
