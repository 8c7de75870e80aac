// The two linear programs of ORCA: incremental in the plane, and, if that has no solution, with the
// violation as third dimension (de Berg et al. 2008, chapter 4; van den Berg et al. 2011). For one
// agent (Float is float) or for several, one per lane (Float4, Float8): both sides of a branch are
// computed while any lane needs them, and a mask selects the results. The result for an agent does
// not depend on the others.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/compute/simd.h"

namespace throng::crowd {

/// Result of a comparison per lane.
template <typename Float>
using Mask = decltype((Float{} < Float{}) & (Float{} < Float{}));

inline bool any(int mask) { return mask != 0; }
using throng::any;

inline float root(float v) { return std::sqrt(v); }
inline Float4 root(Float4 v) { return square_root<4>(v); }
inline Float8 root(Float8 v) { return square_root<8>(v); }

inline void read(const float* from, float& to) { to = *from; }
inline void read(const float* from, Float4& to) { to = load<4>(from); }
inline void read(const float* from, Float8& to) { to = load<8>(from); }

inline void write(float value, float* to) { *to = value; }
inline void write(Float4 value, float* to) { store(value, to); }
inline void write(Float8 value, float* to) { store(value, to); }

/// A half-plane per lane; a direction of 0 permits all velocities.
template <typename Float>
struct PlaneLanes {
  Float point_x;
  Float point_y;
  Float direction_x;
  Float direction_y;

  /// Distance of a velocity from the boundary; positive if it is not permitted.
  Float violation(const Float& x, const Float& y) const {
    return direction_x * (point_y - y) - direction_y * (point_x - x);
  }
};

/// A view of a list of half-planes per lane. Number is float or const float.
template <typename Number>
struct PlaneRowsOf {
  Number* point_x = nullptr;
  Number* point_y = nullptr;
  Number* direction_x = nullptr;
  Number* direction_y = nullptr;
  std::size_t stride = 0;  ///< distance of successive half-planes

  operator PlaneRowsOf<const float>() const {
    return {point_x, point_y, direction_x, direction_y, stride};
  }

  template <typename Float>
  PlaneLanes<Float> at(std::size_t i) const {
    PlaneLanes<Float> plane;
    read(point_x + i * stride, plane.point_x);
    read(point_y + i * stride, plane.point_y);
    read(direction_x + i * stride, plane.direction_x);
    read(direction_y + i * stride, plane.direction_y);
    return plane;
  }
  template <typename Float>
  void set(std::size_t i, const PlaneLanes<Float>& plane) const {
    write(plane.point_x, point_x + i * stride);
    write(plane.point_y, point_y + i * stride);
    write(plane.direction_x, direction_x + i * stride);
    write(plane.direction_y, direction_y + i * stride);
  }
};

using PlaneRows = PlaneRowsOf<const float>;
using WritablePlaneRows = PlaneRowsOf<float>;

template <typename Float>
class PlaneSolver {
 public:
  struct Velocity {
    Float x;
    Float y;
  };

  /// Solves best_velocity() per lane. `hard`: number of a lane's first planes that must be kept.
  /// `scratch` has memory for `count` planes.
  static Velocity solve(const PlaneRows& planes, std::size_t count, const Float& hard,
                        const Velocity& preferred, const Float& max_speed,
                        const WritablePlaneRows& scratch) {
    const Float speed_sq = preferred.x * preferred.x + preferred.y * preferred.y;
    const Float shorter = max_speed / root(speed_sq);
    const auto fast = speed_sq > max_speed * max_speed;
    Velocity v{fast ? preferred.x * shorter : preferred.x,
               fast ? preferred.y * shorter : preferred.y};
    const Failures failures =
        solve_in_disc<false>(planes, count, max_speed, preferred, Float{} == 0, v);
    if (any(failures.lanes)) {
      minimize_violation(planes, count, hard, failures, max_speed, scratch, v);
    }
    return v;
  }

 private:
  static constexpr float kParallel = 1e-5F;  // sines below this value are those of parallel lines

  struct Failures {
    Mask<Float> lanes;
    Float at;  // index of the plane without a solution
    std::size_t first = 0;
  };

  /// Finds the optimal velocity in the disc of max_speed and all planes: the nearest to `target`,
  /// or, with kAlong, the farthest in its direction. `v` is the optimum in the disc at first.
  template <bool kAlong>
  static Failures solve_in_disc(const PlaneRows& planes, std::size_t count, const Float& max_speed,
                                const Velocity& target, Mask<Float> active, Velocity& v) {
    Failures failures{Mask<Float>{}, Float{}, count};
    for (std::size_t i = 0; i < count; ++i) {
      const auto plane = planes.at<Float>(i);
      const Mask<Float> wrong = active & (plane.violation(v.x, v.y) > 0);
      if (!any(wrong)) continue;
      Float low;
      Float high;
      const Mask<Float> possible = chord(planes, i, plane, max_speed, low, high);
      const Float t = best_on_chord<kAlong>(plane, target, low, high);
      const Mask<Float> solved = wrong & possible;
      v.x = solved ? plane.point_x + t * plane.direction_x : v.x;
      v.y = solved ? plane.point_y + t * plane.direction_y : v.y;
      const Mask<Float> failed = wrong & (possible == 0);
      if (!any(failed)) continue;
      failures.lanes = failures.lanes | failed;
      failures.at = failed ? Float{} + static_cast<float>(i) : failures.at;
      failures.first = std::min(failures.first, i);
      active = active & (failed == 0);
      if (!any(active)) break;
    }
    return failures;
  }

  template <bool kAlong>
  static Float best_on_chord(const PlaneLanes<Float>& plane, const Velocity& target,
                             const Float& low, const Float& high) {
    if constexpr (kAlong) {
      return target.x * plane.direction_x + target.y * plane.direction_y > 0 ? high : low;
    } else {
      const Float t = plane.direction_x * (target.x - plane.point_x) +
                      plane.direction_y * (target.y - plane.point_y);
      return t < low ? low : (t > high ? high : t);
    }
  }

  /// Computes the part of a plane's boundary inside the disc and the previous planes; false if it
  /// is empty.
  static Mask<Float> chord(const PlaneRows& planes, std::size_t index,
                           const PlaneLanes<Float>& plane, const Float& max_speed, Float& low,
                           Float& high) {
    const Float along = plane.point_x * plane.direction_x + plane.point_y * plane.direction_y;
    const Float discriminant = along * along + max_speed * max_speed -
                               (plane.point_x * plane.point_x + plane.point_y * plane.point_y);
    Mask<Float> possible = discriminant >= 0;
    const Float half = root(discriminant);
    low = -along - half;
    high = -along + half;
    for (std::size_t i = 0; i < index; ++i) {
      const auto other = planes.at<Float>(i);
      const Float slope =
          plane.direction_x * other.direction_y - plane.direction_y * other.direction_x;
      const Float offset = other.direction_x * (plane.point_y - other.point_y) -
                           other.direction_y * (plane.point_x - other.point_x);
      const Float t = offset / slope;
      high = ((slope > kParallel) & (t < high)) ? t : high;
      low = ((slope < -kParallel) & (t > low)) ? t : low;
      const Mask<Float> excluded = (slope <= kParallel) & (slope >= -kParallel) & (offset < 0);
      possible = possible & (excluded == 0);
    }
    return possible & (low <= high);
  }

  /// Returns the boundary of the region in which `other` is violated at most as much as `plane`.
  /// There is no bound if both have the same direction, because the order of the violations is then
  /// constant, or if `other` permits all velocities.
  static PlaneLanes<Float> bisect(const PlaneLanes<Float>& plane, const PlaneLanes<Float>& other) {
    const Float sine =
        plane.direction_x * other.direction_y - plane.direction_y * other.direction_x;
    const Float cosine =
        plane.direction_x * other.direction_x + plane.direction_y * other.direction_y;
    const auto parallel = (sine <= kParallel) & (sine >= -kParallel);
    const auto nothing = (other.direction_x == 0) & (other.direction_y == 0);
    const auto same = (parallel & (cosine > 0)) | nothing;
    const Float t = (other.direction_x * (plane.point_y - other.point_y) -
                     other.direction_y * (plane.point_x - other.point_x)) /
                    sine;
    const Float x = other.direction_x - plane.direction_x;
    const Float y = other.direction_y - plane.direction_y;
    const Float length = root(x * x + y * y);
    return {
        parallel ? 0.5F * (plane.point_x + other.point_x) : plane.point_x + t * plane.direction_x,
        parallel ? 0.5F * (plane.point_y + other.point_y) : plane.point_y + t * plane.direction_y,
        same ? Float{} : x / length, same ? Float{} : y / length};
  }

  /// Returns the constraint of planes[index] while the violation of planes[of] is minimized: the
  /// plane itself if it is hard, else its bisector if it precedes `of`.
  static PlaneLanes<Float> bound(const PlaneRows& planes, std::size_t index, const Float& hard,
                                 std::size_t of) {
    const auto plane = planes.at<Float>(index);
    const auto soft = index < of ? bisect(planes.at<Float>(of), plane) : PlaneLanes<Float>{};
    const auto kept = hard > static_cast<float>(index);
    return {kept ? plane.point_x : soft.point_x, kept ? plane.point_y : soft.point_y,
            kept ? plane.direction_x : soft.direction_x,
            kept ? plane.direction_y : soft.direction_y};
  }

  /// Minimizes the max violation of the soft planes in lanes without a solution.
  static void minimize_violation(const PlaneRows& planes, std::size_t count, const Float& hard,
                                 const Failures& failures, const Float& max_speed,
                                 const WritablePlaneRows& scratch, Velocity& v) {
    Float largest{};
    for (std::size_t i = failures.first; i < count; ++i) {
      const auto plane = planes.at<Float>(i);
      const Mask<Float> wrong = failures.lanes & (failures.at <= static_cast<float>(i)) &
                                (plane.violation(v.x, v.y) > largest);
      if (!any(wrong)) continue;
      std::size_t bounds = 0;
      for (; bounds < i || any(hard > static_cast<float>(bounds)); ++bounds) {
        scratch.set<Float>(bounds, bound(planes, bounds, hard, i));
      }
      const Velocity inwards{-plane.direction_y, plane.direction_x};
      Velocity better{max_speed * inwards.x, max_speed * inwards.y};
      const Failures failed =
          solve_in_disc<true>(scratch, bounds, max_speed, inwards, wrong, better);
      // Fails only by rounding: the previous point is on the boundary of all planes.
      const Mask<Float> moved = wrong & (failed.lanes == 0);
      v.x = moved ? better.x : v.x;
      v.y = moved ? better.y : v.y;
      largest = wrong ? plane.violation(v.x, v.y) : largest;
    }
  }
};

}  // namespace throng::crowd
