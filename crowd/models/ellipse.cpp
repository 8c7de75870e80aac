#include "crowd/models/ellipse.h"

#include <cmath>

namespace throng::crowd {

namespace {

/// A symmetric matrix.
struct Shape {
  float xx;
  float xy;
  float yy;
};

Shape ellipse_shape(const Ellipse& ellipse) {
  const float a = ellipse.along * ellipse.along;
  const float b = ellipse.across * ellipse.across;
  const Eigen::Vector2f& u = ellipse.direction;
  return {a * u.x() * u.x() + b * u.y() * u.y(), (a - b) * u.x() * u.y(),
          a * u.y() * u.y() + b * u.x() * u.x()};
}

/// u^T adj(shape) u
float adjugate_form(const Shape& shape, const Eigen::Vector2f& u) {
  return shape.yy * u.x() * u.x() - 2 * shape.xy * u.x() * u.y() + shape.xx * u.y() * u.y();
}

float determinant(const Shape& shape) { return shape.xx * shape.yy - shape.xy * shape.xy; }

}  // namespace

// With shapes A and B (the inverses of the quadratic forms), the ellipses touch at a distance of
// 1 / sqrt(max f), f(t) = t (1 - t) u^T ((1 - t) A + t B)^-1 u over t in [0, 1]. f is concave
// there; in the plane it is a cubic p over a quadratic q, so that its maximum is the root of
// p' q - p q'.
float contact_distance(const Ellipse& a, const Ellipse& b, const Eigen::Vector2f& direction) {
  const Shape first = ellipse_shape(a);
  const Shape second = ellipse_shape(b);
  const Shape change{second.xx - first.xx, second.xy - first.xy, second.yy - first.yy};
  const float form = adjugate_form(first, direction);
  const float form_slope = adjugate_form(change, direction);
  const float q0 = determinant(first);
  const float q2 = determinant(change);
  const float q1 = first.xx * change.yy + first.yy * change.xx - 2 * first.xy * change.xy;

  // Newton's steps, in the bracket that each one narrows.
  constexpr int kMaxSteps = 20;
  constexpr float kExact = 1e-4F;  // f is flat at its maximum
  float low = 0;
  float high = 1;
  float t = 0.5F;
  for (int i = 0; i < kMaxSteps; ++i) {
    const float line = form + form_slope * t;
    const float p = t * (1 - t) * line;
    const float p1 = (1 - 2 * t) * line + t * (1 - t) * form_slope;
    const float p2 = -2 * line + 2 * (1 - 2 * t) * form_slope;
    const float q = q0 + t * (q1 + t * q2);
    const float q_slope = q1 + 2 * t * q2;
    const float g = p1 * q - p * q_slope;
    const float g_slope = p2 * q - 2 * p * q2;
    (g > 0 ? low : high) = t;
    float next = t - g / g_slope;
    if (!(next > low && next < high)) next = 0.5F * (low + high);
    const bool done = std::abs(next - t) < kExact;
    t = next;
    if (done) break;
  }
  const float f = t * (1 - t) * (form + form_slope * t) / (q0 + t * (q1 + t * q2));
  return 1 / std::sqrt(f);
}

float contact_distance(const Ellipse& ellipse, const Eigen::Vector2f& direction) {
  const float cosine = ellipse.direction.dot(direction);
  const float sine_sq = 1 - cosine * cosine;
  return std::sqrt(ellipse.along * ellipse.along * cosine * cosine +
                   ellipse.across * ellipse.across * sine_sq);
}

}  // namespace throng::crowd
