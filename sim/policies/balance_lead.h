// The lead of the guidance policy "balance": a drone flies ahead of its followers through an exit.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/policies/lead_route.h"
#include "sim/policies/smooth_setpoint.h"
#include "sim/sensors/world_view.h"

namespace throng::sim {

/// People who follow a drone.
struct Followers {
  double count = 0;
  double near = 0;                                 ///< right behind the drone
  Eigen::Vector2d lost = Eigen::Vector2d::Zero();  ///< the nearest of the others
};

/// A flight along a route, and back for followers who got lost.
class BalanceLead {
 public:
  BalanceLead(int drone, double speed_mps) : drone_(drone), speed_mps_(speed_mps) {}

  /// Counts the followers of the drone, which is at `place`.
  void see(const WorldView& view, const Eigen::Vector2d& place);
  const Followers& followers() const { return followers_; }

  /// Begins a lead along a route.
  void begin(const LeadRoute& route, SmoothSetpoint& setpoint);

  /// Continues the lead at a time. Returns whether it is over.
  bool advance(double time_s, const LeadRoute& route, SmoothSetpoint& setpoint);

 private:
  void start_leg(std::size_t point, SmoothSetpoint& setpoint);

  int drone_;
  double speed_mps_;
  Followers followers_;
  std::vector<Eigen::Vector2d> path_;
  std::size_t point_ = 0;  ///< of the path, to which the drone flies
  double arrived_s_ = -1;  ///< there; negative: not yet
  int rescues_ = 0;        ///< of lost followers, in this lead
};

}  // namespace throng::sim
