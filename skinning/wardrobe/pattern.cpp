#include "skinning/wardrobe/pattern.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "base/geometry/smoothstep.h"

namespace throng::skinning {

namespace {

// Measures of the unmorphed body (m).
constexpr double kTrunkHalfWidth = 0.19;
constexpr double kFrontFrom = 0.02;

// A point as tailors see it: `side` is the distance from the middle line.
struct OnBody {
  double side;
  double up;
  bool left;
  bool in_front;
  bool on_arm;
  double along_arm;   // from the shoulder
  double across_arm;  // above its middle line
  double ahead;
};

OnBody find_on_body(const Eigen::Vector3f& point) {
  constexpr double kArmSide = 0.636;  // direction of the upper arm
  constexpr double kArmDown = 0.772;
  constexpr double kShoulderSide = 0.168;
  constexpr double kShoulderUp = 0.525;
  OnBody on{};
  on.side = std::abs(point.y());
  on.up = point.z();
  on.ahead = point.x();
  on.left = point.y() > 0;
  const double out = on.side - kShoulderSide;
  const double down = kShoulderUp - on.up;
  on.along_arm = kArmSide * out + kArmDown * down;
  on.across_arm = kArmDown * out - kArmSide * down;
  on.on_arm = on.up > 0.05 && on.across_arm > -0.085 && on.side > kTrunkHalfWidth;
  on.in_front = !on.on_arm && on.ahead > kFrontFrom;
  return on;
}

// 1 where a wave of this period is high, with soft edges.
double wave(double at, double period, double high_share) {
  constexpr double kEdge = 0.06;  // of a period
  const double phase = at / period - std::floor(at / period);
  const double inside = 0.5 * high_share - std::abs(phase - 0.5);
  return std::clamp(0.5 + inside / kEdge, 0.0, 1.0);
}

// 1 within a band around zero, with soft edges.
double band(double distance, double half_width) {
  constexpr double kEdgeM = 0.002;
  return std::clamp(0.5 + (half_width - std::abs(distance)) / kEdgeM, 0.0, 1.0);
}

double lattice(int x, int y, int z) {
  auto h = static_cast<std::uint32_t>(x) * 0x8DA6B343U ^
           static_cast<std::uint32_t>(y) * 0xD8163841U ^
           static_cast<std::uint32_t>(z) * 0xCB1AB31FU;
  h = (h ^ h >> 15U) * 0x2C1B3C6DU;
  h = (h ^ h >> 12U) * 0x297A2D39U;
  return (h ^ h >> 15U) / 4294967296.0;
}

}  // namespace

double soft_noise(const Eigen::Vector3d& at) {
  const Eigen::Vector3d floor = at.array().floor();
  Eigen::Vector3d share = at - floor;
  for (double& s : share) s = geometry::smoothstep(0.0, 1.0, s);
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1;
    std::array<int, 3> cell{};
    for (int axis = 0; axis < 3; ++axis) {
      const int up = corner >> axis & 1;
      cell[axis] = static_cast<int>(floor[axis]) + up;
      weight *= up == 1 ? share[axis] : 1 - share[axis];
    }
    sum += weight * lattice(cell[0], cell[1], cell[2]);
  }
  return sum;
}

double strand_light(const Eigen::Vector3f& point) {
  constexpr double kCrownAhead = 0.03;  // of the unmorphed body (m)
  constexpr double kCrownUp = 0.85;
  const Eigen::Vector3d at = point.cast<double>();
  const double turn = std::atan2(at.y(), at.x() - kCrownAhead);
  const double down = kCrownUp - at.z();
  // Locks of 9 degrees and strands of 2, which wander as they run down.
  const double locks = soft_noise({turn * 6.4 + 0.8 * soft_noise(at / 0.03), down * 9, 0});
  const double strands = soft_noise({turn * 28 + soft_noise(at / 0.02), down * 14, 5});
  const double ring = std::exp(-std::pow((down - 0.055 + 0.02 * locks) / 0.022, 2));
  return 0.86 + 0.16 * locks + 0.16 * (strands - 0.5) + 0.26 * ring * (0.4 + strands);
}

namespace {

double front_line(const OnBody& on, double side, double half_width) {
  return on.in_front ? band(on.side - side, half_width) : 0;
}

// The zip of a jacket, its flaps and two slanted pockets.
double zipped(const OnBody& on) {
  double light = 1 - 0.12 * front_line(on, 0, 0.02) - 0.3 * front_line(on, 0, 0.0045);
  const bool by_pocket = on.up > 0.03 && on.up < 0.16;
  if (by_pocket) light -= 0.3 * front_line(on, 0.075 + 0.35 * (0.16 - on.up), 0.004);
  return light;
}

// Seams where the sleeves are set in, across the shoulders and along the sides.
double sewn(const OnBody& on) {
  const double armhole = on.up > 0.33 ? band(on.side - kTrunkHalfWidth, 0.003) : 0;
  const double shoulders = on.on_arm ? 0 : band(on.up - 0.44, 0.003);
  const double flank = on.on_arm || on.side < 0.1 ? 0 : band(on.ahead - kFrontFrom, 0.003);
  return 1 - 0.25 * std::max({armhole, shoulders, flank});
}

// Down is held by seams across.
double quilted(const OnBody& on) {
  constexpr double kTubeM = 0.065;
  const double at = (on.on_arm ? on.along_arm : on.up) / kTubeM;
  return 0.72 + 0.36 * std::pow(std::abs(std::sin(std::numbers::pi * at)), 0.45);
}

double hooded_sweater(const OnBody& on) {
  double light = sewn(on);
  if (!on.in_front) return light;
  const double half_width = 0.12 - 0.3 * std::max(0.0, on.up - 0.1);
  const bool beside_pocket = on.up > 0.03 && on.up < 0.21;
  if (beside_pocket) light -= 0.28 * band(on.side - half_width, 0.004);
  if (on.side < half_width) light -= 0.28 * band(on.up - 0.21, 0.004);
  const bool by_cord = on.up > 0.34 && on.up < 0.46;
  if (by_cord) light += 0.22 * band(on.side - 0.035, 0.005);
  return light;
}

// Lapels, an edge and a row of buttons.
double buttoned(const OnBody& on) {
  constexpr double kLapelsEnd = 0.3;
  constexpr double kButtonsM = 0.085;
  double light = sewn(on);
  if (!on.in_front) return light;
  if (on.up > kLapelsEnd) {
    const double inner = 0.42 * (on.up - kLapelsEnd);
    const double outer = std::min(inner + 0.045, 0.9 * (on.up - kLapelsEnd));
    if (on.side < inner) return 0.68;
    return light - 0.25 * band(on.side - outer, 0.004);
  }
  light -= 0.25 * band(on.side - (on.left ? 0.035 : -1), 0.003);
  const double over = on.up / kButtonsM - std::floor(on.up / kButtonsM) - 0.5;
  const double radius = std::hypot(over * kButtonsM, on.side);
  return light - 0.35 * std::clamp((0.011 - radius) / 0.003, 0.0, 1.0);
}

PatternPaint visible_vest(const OnBody& on) {
  PatternPaint paint;
  if (on.on_arm) {
    paint.accent = 1;
    return paint;
  }
  const double around = std::max(band(on.up - 0.12, 0.026), band(on.up - 0.24, 0.026));
  const double over = on.up > 0.24 ? band(on.side - 0.11, 0.024) : 0;
  paint.glint = std::max(around, over);
  paint.light = zipped(on);
  return paint;
}

// Blocks in two rows, as short words are from afar.
double printed_words(const OnBody& on) {
  if (!on.in_front || on.side > 0.085 || on.up < 0.3 || on.up > 0.39) return 0;
  const double across = on.left ? on.side : -on.side;
  const int row = on.up > 0.345 ? 1 : 0;
  const int letter = static_cast<int>(std::floor(across / 0.021));
  const double in_letter = across / 0.021 - letter;
  const double in_row = (on.up - 0.3 - 0.045 * row) / 0.045;
  if (in_letter > 0.78 || in_row < 0.15 || in_row > 0.85) return 0;
  const bool bar = lattice(letter, row, static_cast<int>(in_row * 4)) > 0.4;
  return bar || in_letter < 0.25 ? 1 : 0;
}

// Along the outer side of legs and arms.
double side_stripes(const OnBody& on) {
  if (on.on_arm) return on.across_arm > 0 ? band(on.ahead - 0.015, 0.014) : 0;
  const bool outside = on.up < 0.1 && on.side > 0.11 + 0.115 * (0.05 - on.up);
  return outside ? band(on.ahead - 0.02 - 0.03 * std::max(0.0, -on.up), 0.014) : 0;
}

double dotted(const Eigen::Vector3f& point) {
  constexpr double kPeriodM = 0.035;
  const double a = (point.y() + point.z()) / kPeriodM;
  const double b = (point.y() - point.z()) / kPeriodM;
  return std::clamp((0.24 - std::hypot(a - std::round(a), b - std::round(b))) / 0.06, 0.0, 1.0);
}

double camouflaged(const Eigen::Vector3f& point) {
  const Eigen::Vector3d at = point.cast<double>();
  const double large = soft_noise(at / 0.075);
  const double small = soft_noise(at / 0.05 + Eigen::Vector3d(7.3, 1.9, 4.1));
  return large > 0.58 ? 0.66 : small > 0.56 ? 0.82 : 1.12;
}

}  // namespace

bool has_pattern(Cloth cloth) {
  return cloth != Cloth::plain && cloth != Cloth::print && cloth != Cloth::own;
}

PatternPaint paint_at(Cloth cloth, const Eigen::Vector3f& point) {
  const OnBody on = find_on_body(point);
  switch (cloth) {
    case Cloth::stripes:
      return {1 - 0.4 * wave(point.z(), 0.055, 0.42)};
    case Cloth::band:
      return {1 - 0.5 * (on.side < 0.2 ? band(on.up - 0.39, 0.05) : 0)};
    case Cloth::checks:
      return {(1 - 0.27 * wave(point.z(), 0.07, 0.5)) * (1 - 0.27 * wave(point.y(), 0.07, 0.5))};
    case Cloth::zip:
      return {zipped(on) * sewn(on)};
    case Cloth::quilt:
      return {zipped(on) * quilted(on)};
    case Cloth::hoodie:
      return {hooded_sweater(on)};
    case Cloth::buttons:
      return {buttoned(on)};
    case Cloth::halves:
      return {sewn(on), on.on_arm == on.left ? 0.0 : 1.0};
    case Cloth::sleeves:
      return {sewn(on), on.side + 0.3 * (on.up - 0.5) > kTrunkHalfWidth - 0.02 ? 1.0 : 0.0};
    case Cloth::yoke:
      return {zipped(on), on.up > 0.4 || on.along_arm > 0.22 ? 1.0 : 0.0};
    case Cloth::vest:
      return visible_vest(on);
    case Cloth::words:
      return {1, printed_words(on)};
    case Cloth::dots:
      return {1, dotted(point)};
    case Cloth::camouflage:
      return {camouflaged(point) * sewn(on)};
    case Cloth::pinstripes:
      return {0.9 + 0.24 * wave(point.y(), 0.024, 0.14)};
    case Cloth::side_stripes:
      return {1, side_stripes(on)};
    case Cloth::plain:
    case Cloth::print:
    case Cloth::own:
      break;
  }
  return {};
}

}  // namespace throng::skinning
