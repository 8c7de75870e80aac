#include "render/props/large_props.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace throng::render {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

const Vector3d kSteel(0.34, 0.35, 0.36);
const Vector3d kDarkSteel(0.07, 0.075, 0.08);
const Vector3d kPlanks(0.24, 0.16, 0.09);
const Vector3d kCanvas(0.72, 0.70, 0.66);
const Vector3d kGlass(0.03, 0.035, 0.04);
const Vector3d kStone(0.42, 0.40, 0.37);

Eigen::AlignedBox2d rectangle(double half_x, double half_y) {
  return {Vector2d(-half_x, -half_y), Vector2d(half_x, half_y)};
}

Vector3d choose_paint(Random& random, const std::array<std::array<double, 3>, 4>& paints) {
  return Vector3d(paints[random.below(static_cast<std::uint32_t>(paints.size()))].data());
}

constexpr std::array<std::array<double, 3>, 4> kBrightCloths = {
    {{0.48, 0.07, 0.06}, {0.07, 0.18, 0.38}, {0.72, 0.70, 0.66}, {0.50, 0.34, 0.05}}};

/// A cloth that is seen from both sides.
void cloth(PropBuilder& builder, const std::array<Vector3d, 4>& corners, const Vector3d& paint) {
  builder.quad(corners, paint, Finish::matt);
  builder.quad({corners[3], corners[2], corners[1], corners[0]}, 0.5 * paint, Finish::matt);
}

}  // namespace

// Crowd barrier: a frame with bars on two feet.
void make_barrier(PropBuilder& builder) {
  constexpr double kHalfM = 1.22;
  constexpr int kBars = 11;
  for (const double z : {0.16, 1.06}) {
    builder.box({-kHalfM, -0.025, z}, {kHalfM, 0.025, z + 0.05}, kSteel);
  }
  for (int i = 0; i <= kBars; ++i) {
    const double x = -kHalfM + 2 * kHalfM * i / kBars;
    const double half = i == 0 || i == kBars ? 0.025 : 0.012;
    builder.box({x - half, -half, 0.16}, {x + half, half, 1.06}, kSteel);
  }
  for (const double x : {-0.9, 0.9}) {
    builder.box({x - 0.03, -0.25, 0}, {x + 0.03, 0.25, 0.04}, kSteel);
    builder.box({x - 0.025, -0.025, 0.04}, {x + 0.025, 0.025, 0.2}, kSteel);
  }
}

// A panel of a wooden fence, posts and boards.
void make_fence(PropBuilder& builder) {
  constexpr int kBoards = 16;
  for (const double x : {-1.46, 1.38}) builder.box({x, -0.05, 0}, {x + 0.08, 0.05, 1.25}, kPlanks);
  for (const double z : {0.3, 0.9}) {
    builder.box({-1.5, -0.02, z}, {1.5, 0.02, z + 0.1}, 0.8 * kPlanks);
  }
  for (int i = 0; i < kBoards; ++i) {
    const double x = -1.48 + 3.0 * i / kBoards;
    const Vector3d paint = builder.random().uniform(0.8, 1.2) * kPlanks;
    builder.box({x, -0.05, 0.08}, {x + 0.14, -0.02, 1.15}, paint);
  }
}

void make_kiosk(PropBuilder& builder) {
  const Vector3d paint = choose_paint(builder.random(), kBrightCloths);
  builder.box({-1.4, -1.1, 0}, {1.4, 1.1, 1.0}, 0.75 * paint);
  builder.block(rectangle(1.38, 1.08), 1.0, rectangle(1.38, 1.08), 2.2, kGlass, Finish::lit_glass);
  for (const double x : {-1.4, 1.32}) {
    for (const double y : {-1.1, 1.02}) builder.box({x, y, 1.0}, {x + 0.08, y + 0.08, 2.2}, kSteel);
  }
  builder.block(rectangle(1.5, 1.25), 2.2, rectangle(1.45, 1.2), 2.5, paint);
  builder.box({-1.3, -1.25, 0.98}, {1.3, -1.08, 1.04}, kPlanks);
}

// A pavilion of 6 m by 6 m, open to all sides.
void make_tent(PropBuilder& builder) {
  const Vector3d paint = choose_paint(builder.random(), kBrightCloths);
  constexpr double kEavesM = 2.3;
  constexpr double kPeakM = 4.2;
  for (const double x : {-2.9, 2.9}) {
    for (const double y : {-2.9, 2.9}) {
      builder.tube({x, y, 0}, 0.05, {x, y, kEavesM}, 0.05, kSteel, Finish::matt, 6);
    }
  }
  const std::array<Vector2d, 4> corners = {Vector2d(-3, -3), Vector2d(3, -3), Vector2d(3, 3),
                                           Vector2d(-3, 3)};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector2d& a = corners[i];
    const Vector2d& b = corners[(i + 1) % corners.size()];
    // Each side as two cloths of different colors, from the eaves to the peak.
    const Vector2d middle = 0.5 * (a + b);
    const Vector3d peak(0, 0, kPeakM);
    const auto eaves = [&](const Vector2d& p) { return Vector3d(p.x(), p.y(), kEavesM); };
    cloth(builder, {eaves(a), eaves(middle), peak, peak}, paint);
    cloth(builder, {eaves(middle), eaves(b), peak, peak}, kCanvas);
    const auto low = [&](const Vector2d& p) { return Vector3d(p.x(), p.y(), kEavesM - 0.35); };
    cloth(builder, {low(a), low(b), eaves(b), eaves(a)}, kCanvas);
  }
  builder.box({-0.2, -0.2, 2.55}, {0.2, 0.2, 2.65}, {0.75, 0.72, 0.6}, Finish::lamp);
  for (const double y : {-2.2, 1.5}) {
    builder.box({-2.2, y, 0.7}, {2.2, y + 0.7, 0.76}, kPlanks);
    for (const double x : {-2.0, 1.9}) {
      builder.box({x, y + 0.1, 0}, {x + 0.1, y + 0.6, 0.7}, kPlanks);
    }
  }
}

// A floor of 16 m by 9 m under a roof on trusses; its front looks along its heading's right (-y).
void make_stage(PropBuilder& builder) {
  constexpr double kFloorM = 1.4;
  constexpr double kRoofM = 7.5;
  builder.box({-8, -4.5, 0}, {8, 4.5, kFloorM}, kDarkSteel);
  builder.box({-7.9, -4.4, kFloorM}, {7.9, 4.4, kFloorM + 0.04}, {0.05, 0.05, 0.052});
  for (const double x : {-7.8, 7.3}) {
    for (const double y : {-4.4, 3.9}) {
      builder.box({x, y, 0}, {x + 0.5, y + 0.5, kRoofM}, kSteel);
    }
  }
  builder.block(rectangle(8, 4.5), kRoofM, rectangle(7.6, 4.1), kRoofM + 0.9, {0.12, 0.12, 0.125});
  builder.box({-7.3, 4.1, kFloorM}, {7.3, 4.3, kRoofM}, {0.04, 0.06, 0.14}, Finish::screen);
  for (int i = 0; i < 12; ++i) {
    const double x = -6.6 + 1.2 * i;
    builder.box({x - 0.18, -4.3, kRoofM - 0.45}, {x + 0.18, -3.95, kRoofM - 0.05},
                {0.75, 0.72, 0.6}, Finish::lamp);
  }
  for (const double x : {-7.6, 6.2}) {
    for (int i = 0; i < 4; ++i) {
      const double z = kFloorM + 0.2 + 0.85 * i;
      builder.box({x, -4.3, z}, {x + 1.4, -3.4, z + 0.8}, kDarkSteel);
    }
  }
  builder.box({-1.1, 0.6, kFloorM}, {1.1, 2.2, kFloorM + 0.5}, {0.2, 0.2, 0.21});
  builder.tube({0, 1.4, kFloorM + 0.5}, 0.6, {0, 1.4, kFloorM + 1.1}, 0.6, {0.45, 0.06, 0.05},
               Finish::glossy, 12);
}

// A carriage of 20 m with windows and doors on both sides.
void make_train(PropBuilder& builder) {
  const Vector3d paint = choose_paint(
      builder.random(),
      {{{0.55, 0.56, 0.57}, {0.50, 0.05, 0.05}, {0.08, 0.16, 0.32}, {0.62, 0.62, 0.60}}});
  builder.block(rectangle(9.6, 1.2), 0.3, rectangle(9.6, 1.2), 0.9, kDarkSteel);
  builder.block(rectangle(9.95, 1.42), 0.9, rectangle(9.95, 1.42), 1.75, paint, Finish::glossy);
  builder.block(rectangle(9.93, 1.40), 1.75, rectangle(9.93, 1.38), 2.75, kGlass,
                Finish::lit_glass);
  builder.block(rectangle(9.95, 1.42), 2.75, rectangle(9.95, 1.40), 3.2, paint, Finish::glossy);
  builder.block(rectangle(9.9, 1.38), 3.2, rectangle(9.7, 0.9), 3.75, {0.30, 0.31, 0.32});
  for (int i = 0; i < 8; ++i) {
    const double x = -9.6 + 2.6 * i;
    const double half = i % 3 == 1 ? 0.75 : 0.2;
    for (const double side : {-1.0, 1.0}) {
      const double y = side * 1.43;
      builder.box({x - half, std::min(y, y - 0.03 * side), 0.95},
                  {x + half, std::max(y, y - 0.03 * side), 2.8},
                  i % 3 == 1 ? Vector3d(0.62, 0.55, 0.12) : paint, Finish::glossy);
    }
  }
  for (const double x : {-5.0, 0.0, 5.0}) {
    builder.box({x - 1.2, -0.5, 3.75}, {x + 1.2, 0.5, 4.0}, kSteel);
  }
}

// A round basin with a column in its middle.
void make_fountain(PropBuilder& builder) {
  constexpr int kSides = 20;
  constexpr double kOuterM = 2.5;
  constexpr double kInnerM = 2.15;
  constexpr double kRimM = 0.55;
  const auto at = [](int i, double radius, double z) {
    const double angle = 2 * std::numbers::pi * i / kSides;
    return Vector3d(radius * std::cos(angle), radius * std::sin(angle), z);
  };
  for (int i = 0; i < kSides; ++i) {
    builder.quad({at(i, kOuterM, 0), at(i + 1, kOuterM, 0), at(i + 1, kOuterM, kRimM),
                  at(i, kOuterM, kRimM)},
                 kStone, Finish::matt);
    builder.quad({at(i, kOuterM, kRimM), at(i + 1, kOuterM, kRimM), at(i + 1, kInnerM, kRimM),
                  at(i, kInnerM, kRimM)},
                 1.1 * kStone, Finish::matt);
    builder.quad({at(i + 1, kInnerM, 0.3), at(i, kInnerM, 0.3), at(i, kInnerM, kRimM),
                  at(i + 1, kInnerM, kRimM)},
                 0.8 * kStone, Finish::matt);
  }
  builder.tube({0, 0, 0.2}, kInnerM, {0, 0, 0.42}, kInnerM, {0.05, 0.085, 0.085}, Finish::water,
               kSides);
  builder.tube({0, 0, 0.42}, 0.35, {0, 0, 1.5}, 0.22, kStone, Finish::matt, 10);
  builder.tube({0, 0, 1.5}, 0.3, {0, 0, 1.7}, 0.95, kStone, Finish::matt, 14);
  builder.tube({0, 0, 1.72}, 0.9, {0, 0, 1.74}, 0.85, {0.05, 0.085, 0.085}, Finish::water, 14);
  builder.tube({0, 0, 1.7}, 0.12, {0, 0, 2.3}, 0.05, kStone);
}

}  // namespace throng::render
