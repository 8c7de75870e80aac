// The two linear programs of ORCA: incremental in the plane, and with one more dimension for the
// violation when the first has no solution (de Berg et al. 2008, chapter 4; van den Berg 2011).
#include "crowd/half_planes.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/simd.h"
#include "crowd/obstacles.h"

namespace throng::crowd {

namespace {

constexpr std::size_t kPadding = 8;  // lanes

/// Sines below are those of parallels.
constexpr float kParallel = 1e-5F;

/// What is to be optimised: as near as possible to `target`, or as far as possible along it.
struct Objective {
  Eigen::Vector2f target;
  bool along = false;
};

float violation(const HalfPlane& plane, const Eigen::Vector2f& v) {
  return cross(plane.direction, plane.point - v);
}

struct BestVelocity {
  template <int kWidth>
  using Float = typename Vectors<kWidth>::Float;
  template <int kWidth>
  using Int = typename Vectors<kWidth>::Int;

  template <int kWidth>
  static Eigen::Vector2f run(const HalfPlanes& planes, std::size_t hard,
                             const Eigen::Vector2f& preferred, float max_speed,
                             HalfPlanes& scratch) {
    Eigen::Vector2f v;
    const std::size_t failed = solve_in_disc<kWidth>(planes, max_speed, {preferred, false}, v);
    if (failed < planes.size()) {
      minimise_violation<kWidth>(planes, hard, failed, max_speed, scratch, v);
    }
    return v;
  }

  /// The first plane from `from` on that v violates, or their number.
  template <int kWidth>
  static std::size_t first_violated(const HalfPlanes& planes, std::size_t from,
                                    const Eigen::Vector2f& v) {
    for (std::size_t at = from; at < planes.size(); at += kWidth) {
      const Float<kWidth> wrong =
          load<kWidth>(&planes.direction_x[at]) * (load<kWidth>(&planes.point_y[at]) - v.y()) -
          load<kWidth>(&planes.direction_y[at]) * (load<kWidth>(&planes.point_x[at]) - v.x());
      if (const unsigned found = bits(wrong > 0); found != 0) {
        return std::min(at + static_cast<std::size_t>(std::countr_zero(found)), planes.size());
      }
    }
    return planes.size();
  }

  /// The best point on the boundary of planes[index] within the disc and the planes before it.
  template <int kWidth>
  static bool solve_on_boundary(const HalfPlanes& planes, std::size_t index, float max_speed,
                                const Objective& objective, Eigen::Vector2f& v) {
    const HalfPlane plane = planes[index];
    const float along = plane.point.dot(plane.direction);
    const float discriminant = along * along + max_speed * max_speed - plane.point.squaredNorm();
    if (discriminant < 0) return false;
    const float half_chord = std::sqrt(discriminant);
    Float<kWidth> low = every<kWidth>(-along - half_chord);
    Float<kWidth> high = every<kWidth>(-along + half_chord);
    Int<kWidth> excluded{};
    for (std::size_t at = 0; at < index; at += kWidth) {
      const Float<kWidth> dx = load<kWidth>(&planes.direction_x[at]);
      const Float<kWidth> dy = load<kWidth>(&planes.direction_y[at]);
      const Float<kWidth> slope = plane.direction.x() * dy - plane.direction.y() * dx;
      const Float<kWidth> offset = dx * (plane.point.y() - load<kWidth>(&planes.point_y[at])) -
                                   dy * (plane.point.x() - load<kWidth>(&planes.point_x[at]));
      const Float<kWidth> t = offset / slope;
      const Int<kWidth> before =
          Vectors<kWidth>::kIndex <
          static_cast<std::int32_t>(std::min<std::size_t>(index - at, kWidth));
      const Int<kWidth> rises = slope > kParallel;
      const Int<kWidth> falls = slope < -kParallel;
      high = (before & rises & (t < high)) ? t : high;
      low = (before & falls & (t > low)) ? t : low;
      excluded |= before & ~(rises | falls) & (offset < 0);
    }
    const float lower = highest(low);
    const float upper = lowest(high);
    if (lower > upper || bits(excluded) != 0) return false;
    float t = 0;
    if (objective.along) {
      t = objective.target.dot(plane.direction) > 0 ? upper : lower;
    } else {
      t = std::clamp(plane.direction.dot(objective.target - plane.point), lower, upper);
    }
    v = plane.point + t * plane.direction;
    return true;
  }

  /// Returns the index of the first plane that could not be met, or their number.
  template <int kWidth>
  static std::size_t solve_in_disc(const HalfPlanes& planes, float max_speed,
                                   const Objective& objective, Eigen::Vector2f& v) {
    v = objective.target;
    if (objective.along) {
      v *= max_speed;
    } else if (const float speed_sq = v.squaredNorm(); speed_sq > max_speed * max_speed) {
      v *= max_speed / std::sqrt(speed_sq);
    }
    std::size_t i = first_violated<kWidth>(planes, 0, v);
    while (i < planes.size()) {
      if (!solve_on_boundary<kWidth>(planes, i, max_speed, objective, v)) break;
      i = first_violated<kWidth>(planes, i + 1, v);
    }
    return i;
  }

  /// Writes to `bisectors` the boundaries of where the violations of the first `count` planes are
  /// at most that of `plane`. Planes that point the same way as `plane` are always violated more or
  /// always less; theirs bound nothing, as a direction of 0 does.
  template <int kWidth>
  static void bisect(const HalfPlanes& planes, std::size_t count, const HalfPlane& plane,
                     HalfPlanes& bisectors) {
    for (std::size_t at = 0; at < count; at += kWidth) {
      const Float<kWidth> px = load<kWidth>(&planes.point_x[at]);
      const Float<kWidth> py = load<kWidth>(&planes.point_y[at]);
      const Float<kWidth> dx = load<kWidth>(&planes.direction_x[at]);
      const Float<kWidth> dy = load<kWidth>(&planes.direction_y[at]);
      const Float<kWidth> sine = plane.direction.x() * dy - plane.direction.y() * dx;
      const Float<kWidth> cosine = plane.direction.x() * dx + plane.direction.y() * dy;
      const Int<kWidth> parallel = (sine <= kParallel) & (sine >= -kParallel);
      const Int<kWidth> same = parallel & (cosine > 0);
      const Float<kWidth> t = (dx * (plane.point.y() - py) - dy * (plane.point.x() - px)) / sine;
      const Float<kWidth> x = plane.point.x() + t * plane.direction.x();
      const Float<kWidth> y = plane.point.y() + t * plane.direction.y();
      store(parallel ? 0.5F * (plane.point.x() + px) : x, &bisectors.point_x[at]);
      store(parallel ? 0.5F * (plane.point.y() + py) : y, &bisectors.point_y[at]);
      const Float<kWidth> across_x = dx - plane.direction.x();
      const Float<kWidth> across_y = dy - plane.direction.y();
      const Float<kWidth> length = square_root<kWidth>(across_x * across_x + across_y * across_y);
      store(same ? Float<kWidth>{} : across_x / length, &bisectors.direction_x[at]);
      store(same ? Float<kWidth>{} : across_y / length, &bisectors.direction_y[at]);
    }
  }

  /// Makes the largest violation of the soft planes from `first` on as small as possible.
  template <int kWidth>
  static void minimise_violation(const HalfPlanes& planes, std::size_t hard, std::size_t first,
                                 float max_speed, HalfPlanes& scratch, Eigen::Vector2f& v) {
    float largest = 0;
    for (std::size_t i = first; i < planes.size(); ++i) {
      const HalfPlane plane = planes[i];
      if (violation(plane, v) <= largest) continue;
      scratch.resize(i);
      bisect<kWidth>(planes, i, plane, scratch);
      for (std::size_t j = 0; j < std::min(hard, i); ++j) scratch.set(j, planes[j]);
      const Eigen::Vector2f before = v;
      // Fails through rounding only: the point before it is on the edge of all of them.
      const Objective inwards{{-plane.direction.y(), plane.direction.x()}, true};
      if (solve_in_disc<kWidth>(scratch, max_speed, inwards, v) < scratch.size()) v = before;
      largest = violation(plane, v);
    }
  }
};

}  // namespace

HalfPlanes::HalfPlanes(std::initializer_list<HalfPlane> planes) {
  for (const HalfPlane& plane : planes) push_back(plane);
}

void HalfPlanes::push_back(const HalfPlane& plane) {
  resize(size_ + 1);
  set(size_ - 1, plane);
}

void HalfPlanes::resize(std::size_t count) {
  if (count + kPadding > point_x.size()) reserve(2 * count);
  size_ = count;
}

void HalfPlanes::reserve(std::size_t count) {
  for (std::vector<float>* values : {&point_x, &point_y, &direction_x, &direction_y}) {
    values->resize(std::max(values->size(), count + kPadding));
  }
}

Eigen::Vector2f best_velocity(const HalfPlanes& planes, std::size_t hard,
                              const Eigen::Vector2f& preferred, float max_speed,
                              HalfPlanes& scratch, InstructionSet set) {
  return Versions<BestVelocity,
                  Eigen::Vector2f(const HalfPlanes&, std::size_t, const Eigen::Vector2f&, float,
                                  HalfPlanes&)>::pick(set)(planes, hard, preferred, max_speed,
                                                           scratch);
}

}  // namespace throng::crowd
