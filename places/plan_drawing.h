// What a plan's marks are made with: the paper, its scale and the colors of its legend.
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>

#include "places/plan.h"

namespace throng::places {

namespace inks {
inline constexpr Ink kInk{{40, 40, 40}};
inline constexpr Ink kBuilding{{176, 164, 150}};
inline constexpr Ink kObstacle{{150, 60, 60}};
inline constexpr Ink kProp{{110, 140, 90}};
inline constexpr Ink kOpenExit{{20, 140, 60}};
inline constexpr Ink kShutExit{{200, 40, 40}};
inline constexpr Ink kGoal{{60, 110, 200}};
inline constexpr Ink kPerson{{70, 70, 70}, 0.6};
inline constexpr Ink kSource{{220, 130, 20}};
inline constexpr Ink kFlow{{20, 140, 60}, 0.45};
inline constexpr Ink kDrone{{140, 40, 160}};
inline constexpr Ink kDanger{{230, 60, 20}};
}  // namespace inks

/// A sheet on which meters become pixels, +y upwards.
class Sheet {
 public:
  /// The area is drawn `size_px` wide or high, whichever is longer, with room for a legend below.
  Sheet(const world::Rectangle& area, int size_px);

  double px_per_m() const { return px_per_m_; }
  Eigen::Vector2d at(const Eigen::Vector2d& place) const;

  void polygon(std::span<const Eigen::Vector2d> corners, const Ink& fill, const Ink& stroke,
               double width_px = 1);
  void line(std::span<const Eigen::Vector2d> places, const Ink& stroke, double width_px,
            bool arrow = false);
  void dot(const Eigen::Vector2d& place, double radius_px, const Ink& fill);
  void ring(const Eigen::Vector2d& place, double radius_m, const Ink& stroke);
  void words(const Eigen::Vector2d& place, const Eigen::Vector2d& offset_px,
             const std::string& text, const Ink& ink);
  /// Name, scale and north, and what the colors mean.
  void finish(const std::string& title);

  Drawing take() { return std::move(drawing_); }

 private:
  void add_legend(double top_px);

  world::Rectangle area_;
  double px_per_m_;
  int plan_height_px_;
  Drawing drawing_;
};

}  // namespace throng::places
