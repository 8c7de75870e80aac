// Ellipses that stand for bodies: how near they come to each other and to walls.
#pragma once

#include <Eigen/Core>

namespace throng::crowd {

/// An ellipse by half its axes, m, and the unit vector along the first of them.
struct Ellipse {
  float along = 0;
  float across = 0;
  Eigen::Vector2f direction;
};

/// How far apart the centers of two ellipses are when one is moved towards the other in this
/// direction (a unit vector) until they touch, m (Perram and Wertheim 1985).
float contact_distance(const Ellipse& a, const Ellipse& b, const Eigen::Vector2f& direction);

/// The same for an ellipse and a straight wall across the direction.
float contact_distance(const Ellipse& ellipse, const Eigen::Vector2f& direction);

}  // namespace throng::crowd
