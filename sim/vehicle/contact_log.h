// Groups the contacts of simulation steps into collisions with their impulses.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/vehicle/quadcopter.h"
#include "world/trace_event.h"

namespace throng::sim {

/// Coefficient of restitution of all contacts.
inline constexpr double kRestitution = 0.4;

/// Objects that a vehicle can hit.
using Obstacle = world::Partner;

/// A collision of a vehicle. Continued contact, or another contact with the same object within half
/// a second, belongs to the same collision.
struct Impact {
  std::size_t vehicle = 0;
  Obstacle obstacle = Obstacle::ground;
  int index = -1;         ///< index of the building, vehicle or person; -1: the ground
  double speed_mps = 0;   ///< relative speed just before
  double impulse_ns = 0;  ///< sum of the magnitudes in the first 50 ms
  Eigen::Vector3d push_ns =
      Eigen::Vector3d::Zero();  ///< vector sum of the impulses on the obstacle in the first 50 ms
  PerRotor rotor_ns{};          ///< part of impulse_ns at each propeller
  double ago_s = 0;             ///< time since its start
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

/// Collects contacts step by step.
class ContactLog {
 public:
  /// Adds a contact; call it once per step for each pair of bodies in contact.
  void record(const Touch& touch);

  /// Ends a step of `dt_s`.
  void advance(double dt_s);

  /// Collisions whose first 50 ms ended in the last step.
  std::span<const Impact> impacts() const { return impacts_; }
  /// Collisions within their first 50 ms, for the end of a run.
  std::vector<Impact> unfinished() const;

 private:
  struct Contact {
    Impact impact;
    double apart_s = 0;
    bool counted = false;  ///< its impulse is complete and it has been in impacts()
  };

  std::vector<Contact> contacts_;
  std::vector<Impact> impacts_;
};

}  // namespace throng::sim
