// Groups contacts into collisions, with the impulse of each.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/vehicle/quadcopter.h"
#include "world/trace_event.h"

namespace throng::sim {

/// Objects that a vehicle can hit.
using Obstacle = world::Partner;

/// A vehicle hit something. One per approach: staying in touch, or touching the same object again
/// within half a second, is the same one.
struct Impact {
  std::size_t vehicle = 0;
  Obstacle obstacle = Obstacle::ground;
  int index = -1;         ///< of the building, vehicle or person; -1: the ground
  double speed_mps = 0;   ///< of one relative to the other just before
  double impulse_ns = 0;  ///< given in the first 50 ms
  Eigen::Vector3d push_ns =
      Eigen::Vector3d::Zero();  ///< the same with its direction, on the obstacle
  PerRotor rotor_ns{};          ///< the share of impulse_ns that came in through each propeller
  double ago_s = 0;             ///< how long ago it began
};

/// The contact of one pair of bodies during one step.
struct Touch {
  std::size_t vehicle = 0;
  Obstacle obstacle = Obstacle::ground;
  int index = -1;
  double speed_mps = 0;
  Eigen::Vector3d push_ns = Eigen::Vector3d::Zero();
  double impulse_ns = 0;
  PerRotor rotor_ns{};
};

class ContactLog {
 public:
  /// Call once per step and pair that pushes each other.
  void record(const Touch& touch);

  /// Ends a step of `dt_s`.
  void advance(double dt_s);

  /// Collisions whose impulse became known in the last step.
  std::span<const Impact> impacts() const { return impacts_; }
  /// Those whose impulse is still being counted: for the end of a run.
  std::vector<Impact> unfinished() const;

 private:
  struct Contact {
    Impact impact;
    double apart_s = 0;
    bool counted = false;  ///< its impulse is known and it has been in impacts()
  };

  std::vector<Contact> contacts_;
  std::vector<Impact> impacts_;
};

}  // namespace throng::sim
