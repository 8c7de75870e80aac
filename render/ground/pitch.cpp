#include "render/ground/pitch.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "render/ground/ground_heights.h"

namespace throng::render {

namespace {

using Eigen::Vector2d;

constexpr double kLineM = 0.12;  // also in shaders/ground_decals.glsl

/// Lines in the frame of a pitch: x from its middle towards `to`, y to the left.
class PitchPainter {
 public:
  explicit PitchPainter(const world::Marking& pitch)
      : middle_(0.5 * (pitch.from + pitch.to)), along_((pitch.to - pitch.from).normalized()) {}

  void line(const Vector2d& from, const Vector2d& to) {
    constexpr double kPieceM = 4;
    const double pieces = std::max(1.0, std::ceil((to - from).norm() / kPieceM));
    const Vector2d step = (to - from) / pieces;
    for (double i = 0; i < pieces; ++i) {
      lines.push_back({point(from + i * step), point(from + (i + 1) * step)});
    }
  }

  /// Three sides of a rectangle in front of the goal line at x = side * half_m.
  void box(double side, double half_m, double depth_m, double half_width_m) {
    const double goal = side * half_m;
    const double front = side * (half_m - depth_m);
    line({goal, -half_width_m}, {front, -half_width_m});
    line({front, -half_width_m}, {front, half_width_m});
    line({front, half_width_m}, {goal, half_width_m});
  }

  /// An arc between two angles.
  void arc(const Vector2d& center, double radius_m, double from_rad, double to_rad) {
    constexpr double kSideM = 0.4;
    const double steps = std::max(2.0, std::ceil(radius_m * (to_rad - from_rad) / kSideM));
    for (double i = 0; i < steps; ++i) {
      const double a = from_rad + (to_rad - from_rad) * i / steps;
      const double b = from_rad + (to_rad - from_rad) * (i + 1) / steps;
      line(center + radius_m * Vector2d(std::cos(a), std::sin(a)),
           center + radius_m * Vector2d(std::cos(b), std::sin(b)));
    }
  }

  std::vector<GroundSegment> lines;

 private:
  Vector2d point(const Vector2d& p) const {
    return middle_ + p.x() * along_ + p.y() * Vector2d(-along_.y(), along_.x());
  }

  Vector2d middle_;
  Vector2d along_;
};

}  // namespace

bool is_on_pitch(const world::Marking& pitch, const Vector2d& point) {
  const GroundSegment axis = {pitch.from, pitch.to};
  const Vector2d off = point - 0.5 * (pitch.from + pitch.to);
  return std::abs(off.dot(axis.along())) < 0.5 * axis.length_m() &&
         std::abs(off.dot(axis.left())) < 0.5 * pitch.width_m;
}

std::vector<GroundSegment> pitch_lines(const world::Marking& pitch) {
  constexpr double kCircleM = 9.15;
  constexpr double kSpotM = 11;  // penalty mark from the goal line
  constexpr double kPenaltyM = 16.5;
  constexpr double kPenaltyHalfM = 20.16;
  constexpr double kGoalAreaM = 5.5;
  constexpr double kGoalAreaHalfM = 9.16;
  constexpr double kPi = std::numbers::pi;
  const double half = 0.5 * (pitch.to - pitch.from).norm();
  const double side = 0.5 * pitch.width_m;
  PitchPainter painter(pitch);
  for (const double sign : {-1.0, 1.0}) {
    painter.line({-half, sign * side}, {half, sign * side});
    painter.line({sign * half, -side}, {sign * half, side});
    const double spot = sign * (half - kSpotM);
    painter.line({spot - 0.06, 0}, {spot + 0.06, 0});
    if (kPenaltyHalfM < side && kPenaltyM < half) {
      painter.box(sign, half, kPenaltyM, kPenaltyHalfM);
      painter.box(sign, half, kGoalAreaM, kGoalAreaHalfM);
      const double reach = std::acos((kPenaltyM - kSpotM) / kCircleM);
      const double towards = sign > 0 ? kPi : 0;
      painter.arc({spot, 0}, kCircleM, towards - reach, towards + reach);
    }
    for (const double end : {-1.0, 1.0}) {
      const double into = std::atan2(-end, -sign) - 0.25 * kPi;
      painter.arc({sign * half, end * side}, 1, into, into + 0.5 * kPi);
    }
  }
  painter.line({0, -side}, {0, side});
  painter.line({-0.06, 0}, {0.06, 0});
  if (kCircleM < std::min(half, side)) painter.arc({0, 0}, kCircleM, 0, 2 * kPi);
  return std::move(painter.lines);
}

void add_pitch_lines(const world::Marking& pitch, GroundBuilder& builder) {
  for (const GroundSegment& line : pitch_lines(pitch)) {
    builder.add_strip(line, -0.5 * kLineM, 0.5 * kLineM, ground_height::kPaintM);
  }
}

void add_mown_stripes(const world::Scenario& scenario, GroundBuilder& builder) {
  constexpr double kStripeM = 5.5;
  constexpr double kMarginM = 1.5;
  constexpr float kDark = 0.84F;
  constexpr float kBright = 1.1F;
  for (const world::Marking& pitch : scenario.markings) {
    if (pitch.kind != "pitch") continue;
    const GroundSegment axis = {pitch.from, pitch.to};
    const double side = 0.5 * pitch.width_m + kMarginM;
    const double count = std::max(1.0, std::round(axis.length_m() / kStripeM));
    const Vector2d step = (axis.to - axis.from) / count;
    for (double i = 0; i < count; ++i) {
      builder.set_tone(std::fmod(i, 2) < 1 ? kBright : kDark);
      const Vector2d first = axis.from + (i > 0 ? i : -kMarginM / step.norm()) * step;
      const Vector2d last =
          axis.from + (i + 1 < count ? i + 1 : count + kMarginM / step.norm()) * step;
      builder.add_strip({first, last}, -side, side, ground_height::kMownM);
    }
    builder.set_tone(1);
  }
}

}  // namespace throng::render
