// The sheet of a floor plan: its scale, colors and legend.
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>

#include "base/graphics/drawing/drawing.h"
#include "world/scenario.h"

namespace throng::scenarios {

using drawing::Color;

namespace colors {
inline constexpr Color kInk{{40, 40, 40}};
inline constexpr Color kBuilding{{176, 164, 150}};
inline constexpr Color kObstacle{{150, 60, 60}};
inline constexpr Color kProp{{110, 140, 90}};
inline constexpr Color kOpenExit{{20, 140, 60}};
inline constexpr Color kClosedExit{{200, 40, 40}};
inline constexpr Color kGoal{{60, 110, 200}};
inline constexpr Color kPerson{{70, 70, 70}, 0.6};
inline constexpr Color kSource{{220, 130, 20}};
inline constexpr Color kFlow{{20, 140, 60}, 0.45};
inline constexpr Color kDrone{{140, 40, 160}};
inline constexpr Color kDanger{{230, 60, 20}};
}  // namespace colors

/// A drawing in meters with +y upward, which is scaled to pixels.
class Sheet {
 public:
  /// The longer side of `area` has `size_px`; there is room for a legend below.
  Sheet(const world::Rectangle& area, int size_px);

  double px_per_m() const { return px_per_m_; }
  Eigen::Vector2d at(const Eigen::Vector2d& point) const;

  void polygon(std::span<const Eigen::Vector2d> corners, const Color& fill, const Color& stroke,
               double width_px = 1);
  void line(std::span<const Eigen::Vector2d> points, const Color& stroke, double width_px,
            bool arrow = false);
  void dot(const Eigen::Vector2d& point, double radius_px, const Color& fill);
  void ring(const Eigen::Vector2d& point, double radius_m, const Color& stroke);
  void label(const Eigen::Vector2d& point, const Eigen::Vector2d& offset_px,
             const std::string& text, const Color& color);
  /// Adds title, scale, north and legend.
  void finish(const std::string& title);

  drawing::Drawing take() { return std::move(drawing_); }

 private:
  void add_legend(double top_px);

  world::Rectangle area_;
  double px_per_m_;
  int plan_height_px_;
  drawing::Drawing drawing_;
};

}  // namespace throng::scenarios
