// The two linear programs of ORCA: incremental in the plane, and with one more dimension for the
// violation when the first has no solution (de Berg et al. 2008, chapter 4; van den Berg 2011).
#include <algorithm>
#include <cmath>

#include "crowd/orca_lines.h"

namespace throng::crowd {

namespace {

/// How far v is on the wrong side; negative when it is allowed.
float violation(const HalfPlane& plane, const Eigen::Vector2f& v) {
  return cross(plane.direction, plane.point - v);
}

/// What is to be optimised: as near as possible to `target`, or as far as possible along it.
struct Objective {
  Eigen::Vector2f target;
  bool along = false;
};

/// The best point on the boundary of planes[index] within the disc and the planes before it.
bool solve_on_boundary(const std::vector<HalfPlane>& planes, std::size_t index, float max_speed,
                       const Objective& objective, Eigen::Vector2f& v) {
  const HalfPlane& plane = planes[index];
  const float along = plane.point.dot(plane.direction);
  const float discriminant = along * along + max_speed * max_speed - plane.point.squaredNorm();
  if (discriminant < 0) return false;
  const float half_chord = std::sqrt(discriminant);
  float low = -along - half_chord;
  float high = -along + half_chord;
  for (std::size_t i = 0; i < index; ++i) {
    const float slope = cross(plane.direction, planes[i].direction);
    const float offset = cross(planes[i].direction, plane.point - planes[i].point);
    if (std::abs(slope) <= kOrcaEpsilon) {
      if (offset < 0) return false;
      continue;
    }
    const float t = offset / slope;
    if (slope >= 0) {
      high = std::min(high, t);
    } else {
      low = std::max(low, t);
    }
    if (low > high) return false;
  }
  float t = 0;
  if (objective.along) {
    t = objective.target.dot(plane.direction) > 0 ? high : low;
  } else {
    t = std::clamp(plane.direction.dot(objective.target - plane.point), low, high);
  }
  v = plane.point + t * plane.direction;
  return true;
}

/// Returns the index of the first plane that could not be met, or their number.
std::size_t solve_in_disc(const std::vector<HalfPlane>& planes, float max_speed,
                          const Objective& objective, Eigen::Vector2f& v) {
  v = objective.target;
  if (objective.along) {
    v *= max_speed;
  } else if (const float speed_sq = v.squaredNorm(); speed_sq > max_speed * max_speed) {
    v *= max_speed / std::sqrt(speed_sq);
  }
  for (std::size_t i = 0; i < planes.size(); ++i) {
    if (violation(planes[i], v) <= 0) continue;
    const Eigen::Vector2f before = v;
    if (!solve_on_boundary(planes, i, max_speed, objective, v)) {
      v = before;
      return i;
    }
  }
  return planes.size();
}

/// The boundary of where the violation of `other` is at most that of `plane`. False when the two
/// point the same way, so that one of them is always violated more.
bool bisect(const HalfPlane& plane, const HalfPlane& other, HalfPlane& bisector) {
  const float sine = cross(plane.direction, other.direction);
  if (std::abs(sine) <= kOrcaEpsilon) {
    if (plane.direction.dot(other.direction) > 0) return false;
    bisector.point = 0.5F * (plane.point + other.point);
  } else {
    const float t = cross(other.direction, plane.point - other.point) / sine;
    bisector.point = plane.point + t * plane.direction;
  }
  bisector.direction = (other.direction - plane.direction).normalized();
  return true;
}

/// Makes the largest violation of the soft planes from `first` on as small as possible.
void minimise_violation(const std::vector<HalfPlane>& planes, std::size_t hard, std::size_t first,
                        float max_speed, std::vector<HalfPlane>& scratch, Eigen::Vector2f& v) {
  float largest = 0;
  for (std::size_t i = first; i < planes.size(); ++i) {
    if (violation(planes[i], v) <= largest) continue;
    scratch.assign(planes.begin(), planes.begin() + static_cast<std::ptrdiff_t>(hard));
    for (std::size_t j = hard; j < i; ++j) {
      HalfPlane bisector;
      if (bisect(planes[i], planes[j], bisector)) scratch.push_back(bisector);
    }
    const Eigen::Vector2f before = v;
    // Fails through rounding only: the point before it is on the edge of all of them.
    const Objective inwards{left_of(planes[i].direction), true};
    if (solve_in_disc(scratch, max_speed, inwards, v) < scratch.size()) v = before;
    largest = violation(planes[i], v);
  }
}

}  // namespace

Eigen::Vector2f best_velocity(const std::vector<HalfPlane>& planes, std::size_t hard,
                              const Eigen::Vector2f& preferred, float max_speed,
                              std::vector<HalfPlane>& scratch) {
  Eigen::Vector2f v;
  const std::size_t failed = solve_in_disc(planes, max_speed, {preferred, false}, v);
  if (failed < planes.size()) {
    minimise_violation(planes, hard, failed, max_speed, scratch, v);
  }
  return v;
}

}  // namespace throng::crowd
