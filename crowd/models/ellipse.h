// Ellipses as shapes of bodies: distances at which they touch each other and walls.
#pragma once

#include <Eigen/Core>

namespace throng::crowd {

/// An ellipse: its half axes (m) and the unit vector along the first one.
struct Ellipse {
  float along = 0;
  float across = 0;
  Eigen::Vector2f direction;
};

/// Distance (m) of the centers of two ellipses that touch when one is moved towards the other in
/// this direction, a unit vector (Perram and Wertheim 1985).
float contact_distance(const Ellipse& a, const Ellipse& b, const Eigen::Vector2f& direction);

/// Distance (m) of the center from a straight wall perpendicular to the direction when both touch.
float contact_distance(const Ellipse& ellipse, const Eigen::Vector2f& direction);

}  // namespace throng::crowd
