#include "render/scenery/water.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/compute/random.h"
#include "base/geometry/polygon.h"
#include "base/geometry/triangulate.h"
#include "render/ground/ground_builder.h"
#include "render/props/prop_cells.h"

namespace throng::render {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kBelowWaterM = 0.5;  // walls and piers reach below the surface
constexpr double kAlgaeM = 0.35;
const Vector3d kAshlar(0.3, 0.275, 0.235);
const Vector3d kAlgaePaint(0.05, 0.062, 0.035);

const world::Prop kWaterProp;

Vector3d at(const Vector2d& point, double z) { return {point.x(), point.y(), z}; }

/// A wall that faces the left of a segment, between two heights.
void add_wall(PropBuilder& builder, const Vector2d& from, const Vector2d& to, double low_m,
              double high_m, const Vector3d& paint) {
  builder.quad({at(to, low_m), at(from, low_m), at(from, high_m), at(to, high_m)}, paint,
               Finish::matt);
}

/// Stones in courses, each with a tone of its own.
void add_courses(PropBuilder& builder, const GroundSegment& piece, double low_m, double high_m,
                 double block_m, Random& random) {
  constexpr double kCourseM = 0.55;
  const double courses = std::max(1.0, std::round((high_m - low_m) / kCourseM));
  const double blocks = std::max(1.0, std::round(piece.length_m() / block_m));
  const Vector2d step = (piece.to - piece.from) / blocks;
  for (double row = 0; row < courses; ++row) {
    const double z0 = low_m + row / courses * (high_m - low_m);
    const double z1 = low_m + (row + 1) / courses * (high_m - low_m);
    const double off = std::fmod(row, 2) < 1 ? 0 : 0.5;
    for (double i = -off; i < blocks; ++i) {
      const Vector2d a = piece.from + std::max(i, 0.0) * step;
      const Vector2d b = piece.from + std::min(i + 1, blocks) * step;
      add_wall(builder, a, b, z0, z1, random.uniform(0.82, 1.14) * kAshlar);
    }
  }
}

void add_ladder(PropBuilder& builder, const GroundSegment& piece, double low_m) {
  const Vector3d steel(0.12, 0.1, 0.085);
  const double x = 0.5 * piece.length_m();
  builder.placing =
      Eigen::Translation3d(at(piece.from, 0)) *
      Eigen::AngleAxisd(std::atan2(piece.along().y(), piece.along().x()), Vector3d::UnitZ());
  builder.is_near = true;
  for (const double side : {-0.22, 0.22}) {
    builder.box({x + side - 0.02, 0.03, low_m}, {x + side + 0.02, 0.08, 0.1}, steel);
  }
  for (double z = low_m + 0.2; z < -0.1; z += 0.3) {
    builder.box({x - 0.22, 0.04, z}, {x + 0.22, 0.07, z + 0.03}, steel);
  }
  builder.is_near = false;
  builder.placing.setIdentity();
}

}  // namespace

PropMesh water_surface(const world::GroundArea& water, std::uint32_t id) {
  PropBuilder builder(kWaterProp, id);
  const Vector3d paint(0.030, 0.048, 0.042);
  for (const auto& [a, b, c] : geometry::triangulate(water.corners)) {
    const Vector3d last = at(water.corners[c], water.level_m);
    builder.quad(
        {at(water.corners[a], water.level_m), at(water.corners[b], water.level_m), last, last},
        {Vector3d::UnitZ(), Vector3d::UnitZ(), Vector3d::UnitZ(), Vector3d::UnitZ()}, paint,
        Finish::water);
  }
  return builder.take();
}

std::vector<PropMesh> quay_walls(const world::Scenario& scenario, const world::GroundArea& water,
                                 std::uint32_t id) {
  constexpr double kCellM = 30;
  constexpr double kNearGroundM = 15;
  constexpr double kCopingM = 0.4;
  PropCells cells(kCellM, id);
  const double line_m = water.level_m + kAlgaeM;
  std::uint64_t number = 0;
  for (std::size_t i = 0; i < water.corners.size(); ++i) {
    const GroundSegment edge = {water.corners[i], water.corners[(i + 1) % water.corners.size()]};
    const double pieces = std::max(1.0, std::ceil(edge.length_m() / kCellM));
    const Vector2d step = (edge.to - edge.from) / pieces;
    for (double k = 0; k < pieces; ++k) {
      const GroundSegment piece = {edge.from + k * step, edge.from + (k + 1) * step};
      const Vector2d middle = 0.5 * (piece.from + piece.to);
      PropBuilder& builder = cells.at(middle);
      Random random(++number, Stream::environment, 0x90A7);
      const bool is_near =
          (scenario.ground.nearest_point(middle, 0) - middle).norm() < kNearGroundM;
      add_wall(builder, piece.from, piece.to, water.level_m - kBelowWaterM, line_m, kAlgaePaint);
      add_courses(builder, piece, line_m, -0.3, is_near ? 1.6 : kCellM, random);
      // The coping lies on the wall and a little over the water.
      const Vector2d over = kCopingM * piece.left();
      add_wall(builder, piece.from + over, piece.to + over, -0.3, -0.03, 1.15 * kAshlar);
      builder.quad({at(piece.from, -0.03), at(piece.to, -0.03), at(piece.to + over, -0.03),
                    at(piece.from + over, -0.03)},
                   1.2 * kAshlar, Finish::matt);
      builder.quad({at(piece.from + over, -0.3), at(piece.to + over, -0.3), at(piece.to, -0.3),
                    at(piece.from, -0.3)},
                   0.8 * kAshlar, Finish::matt);
      if (is_near) add_ladder(builder, piece, water.level_m);
    }
  }
  std::vector<PropMesh> meshes;
  cells.take(meshes);
  return meshes;
}

namespace {

/// The part of a deck over water, along the deck's longest side.
struct BridgeSpan {
  Vector2d origin = Vector2d::Zero();
  Vector2d along = Vector2d::UnitX();
  double length_m = 0;
  double half_width_m = 0;
};

std::optional<BridgeSpan> find_span(const world::GroundArea& deck, const world::GroundArea& water) {
  Vector2d longest = Vector2d::Zero();
  for (std::size_t i = 0; i < deck.corners.size(); ++i) {
    const Vector2d edge = deck.corners[(i + 1) % deck.corners.size()] - deck.corners[i];
    if (edge.norm() > longest.norm()) longest = edge;
  }
  const Vector2d u = longest.normalized();
  const Vector2d v(-u.y(), u.x());
  Eigen::AlignedBox2d over;
  Eigen::AlignedBox1d across;
  for (const Vector2d& p : deck.corners) across.extend(Eigen::Matrix<double, 1, 1>(p.dot(v)));
  for (const auto& [a, b, c] : geometry::triangulate(water.corners)) {
    std::vector<Vector2d> part = deck.corners;
    const std::array<Vector2d, 3> corners = {water.corners[a], water.corners[b], water.corners[c]};
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const GroundSegment side = {corners.at(i), corners.at((i + 1) % corners.size())};
      part = cut(part, -side.left(), -side.left().dot(side.from));
    }
    for (const Vector2d& p : part) over.extend(Vector2d(p.dot(u), p.dot(v)));
  }
  constexpr double kMinM = 1;
  if (over.isEmpty() || over.sizes().minCoeff() < kMinM) return std::nullopt;
  const double middle = across.center()(0);
  return BridgeSpan{over.min().x() * u + middle * v, u, over.sizes().x(), 0.5 * across.sizes()(0)};
}

constexpr double kBridgeSlabM = 0.35;  // height of the beams along the deck's edges

/// A wall across the plane y of the span's frame, between two curves of heights.
void add_side(PropBuilder& builder, double y, double x0, double x1, const Vector2d& low,
              const Vector2d& high, const Vector3d& paint) {
  std::array<Vector3d, 4> corners = {Vector3d(x0, y, low.x()), Vector3d(x1, y, low.y()),
                                     Vector3d(x1, y, high.y()), Vector3d(x0, y, high.x())};
  if (y > 0) corners = {corners[1], corners[0], corners[3], corners[2]};
  builder.quad(corners, paint, Finish::matt);
}

/// One arch from x0 to x1 with its spandrels: walls on both sides, a ring of stones and the vault.
void add_arch(PropBuilder& builder, double x0, double x1, double half_m, double foot_m,
              double crown_m, Random& random) {
  constexpr int kSteps = 16;
  constexpr double kRingM = 0.45;
  const double half_span = 0.5 * (x1 - x0);
  const double rise = crown_m - foot_m;
  const double radius = 0.5 * (half_span * half_span + rise * rise) / rise;
  const auto height = [&](double x) {
    const double off = x - 0.5 * (x0 + x1);
    return crown_m - radius + std::sqrt(std::max(0.0, radius * radius - off * off));
  };
  for (int i = 0; i < kSteps; ++i) {
    const double a = x0 + (x1 - x0) * i / kSteps;
    const double b = x0 + (x1 - x0) * (i + 1) / kSteps;
    const Vector2d low(height(a), height(b));
    const Vector2d ring = (low.array() + kRingM).min(-kBridgeSlabM);
    const Vector2d top(-kBridgeSlabM, -kBridgeSlabM);
    for (const double y : {-half_m, half_m}) {
      add_side(builder, y, a, b, ring, top, random.uniform(0.9, 1.06) * kAshlar);
      add_side(builder, y * (1 + 0.015 / half_m), a, b, low, ring,
               random.uniform(1.05, 1.3) * kAshlar);
    }
    builder.quad({Vector3d(a, half_m, low.x()), Vector3d(b, half_m, low.y()),
                  Vector3d(b, -half_m, low.y()), Vector3d(a, -half_m, low.x())},
                 0.8 * kAshlar, Finish::matt);
  }
}

/// A pier with pointed ends against the stream, and their caps.
void add_pier(PropBuilder& builder, double x, double half_x, double half_y, double level_m,
              double foot_m) {
  const double low = level_m - kBelowWaterM;
  const double cap = foot_m + 0.5;
  const auto ring = [&](double grow, double z) {
    const double hx = half_x + grow;
    const double hy = half_y + grow;
    const double nose = hy + 1.2 * hx;
    return std::array<Vector3d, 6>{Vector3d(x - hx, -hy, z), Vector3d(x, -nose, z),
                                   Vector3d(x + hx, -hy, z), Vector3d(x + hx, hy, z),
                                   Vector3d(x, nose, z),     Vector3d(x - hx, hy, z)};
  };
  const auto wall = [&](double grow, double z0, double z1, const Vector3d& paint) {
    const auto below = ring(grow, z0);
    const auto above = ring(grow, z1);
    for (std::size_t i = 0; i < below.size(); ++i) {
      const std::size_t next = (i + 1) % below.size();
      builder.quad({below.at(i), below.at(next), above.at(next), above.at(i)}, paint, Finish::matt);
    }
    return above;
  };
  const auto lid = [&](const std::array<Vector3d, 6>& r, const Vector3d& paint) {
    builder.quad({r[0], r[1], r[2], r[2]}, paint, Finish::matt);
    builder.quad({r[0], r[2], r[3], r[5]}, paint, Finish::matt);
    builder.quad({r[3], r[4], r[5], r[5]}, paint, Finish::matt);
  };
  wall(0.25, low, level_m + 0.1, kAlgaePaint);
  lid(ring(0.25, level_m + 0.1), kAlgaePaint);
  wall(0, level_m, level_m + kAlgaeM, kAlgaePaint);
  wall(0, level_m + kAlgaeM, cap, kAshlar);
  lid(wall(0.08, cap, cap + 0.18, 1.15 * kAshlar), 1.2 * kAshlar);
}

}  // namespace

PropMesh bridge_below(const world::GroundArea& deck, const world::GroundArea& water,
                      std::uint32_t id) {
  constexpr double kSpanM = 14;
  constexpr double kPierM = 0.8;  // half its thickness
  constexpr double kMinRiseM = 0.9;
  PropBuilder builder(kWaterProp, id);
  const std::optional<BridgeSpan> span = find_span(deck, water);
  if (!span) return builder.take();
  builder.placing =
      Eigen::Translation3d(at(span->origin, 0)) *
      Eigen::AngleAxisd(std::atan2(span->along.y(), span->along.x()), Vector3d::UnitZ());
  const double length = span->length_m;
  const double half = span->half_width_m;
  const double foot = water.level_m + 0.5;
  const double crown = -kBridgeSlabM - 0.3;
  const double count = std::max(1.0, std::round(length / kSpanM));
  Random random(static_cast<std::uint64_t>(10 * length), Stream::environment, 0xB21D6E);
  // Edge beams with a cornice, a little wider than the deck.
  for (const double side : {-1.0, 1.0}) {
    const double y = side * (half + 0.05);
    builder.box({0, std::min(y, y - 0.3 * side), -kBridgeSlabM},
                {length, std::max(y, y - 0.3 * side), -0.012}, 1.15 * kAshlar);
  }
  builder.quad({Vector3d(0, half, -kBridgeSlabM), Vector3d(length, half, -kBridgeSlabM),
                Vector3d(length, -half, -kBridgeSlabM), Vector3d(0, -half, -kBridgeSlabM)},
               0.7 * kAshlar, Finish::matt);
  const double apart = length / count;
  const bool has_arches = crown - foot > kMinRiseM;
  for (double i = 0; i < count; ++i) {
    const double x0 = i * apart + (i > 0 ? kPierM : 0);
    const double x1 = (i + 1) * apart - (i + 1 < count ? kPierM : 0);
    if (has_arches) {
      add_arch(builder, x0, x1, half, foot, crown, random);
    } else {
      builder.box({x0, -half + 0.6, -kBridgeSlabM - 0.5}, {x1, half - 0.6, -kBridgeSlabM + 0.05},
                  0.9 * kAshlar);
    }
    if (i > 0) {
      add_pier(builder, i * apart, kPierM, half, water.level_m,
               has_arches ? foot : -kBridgeSlabM - 0.8);
      builder.box({i * apart - kPierM, -half, foot}, {i * apart + kPierM, half, -kBridgeSlabM},
                  kAshlar);
    }
  }
  return builder.take();
}

}  // namespace throng::render
