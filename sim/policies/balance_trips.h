// Trips of the guidance policy "balance": from where people wait longest to the exit by which they
// are out soonest.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "sim/policies/lead_route.h"
#include "sim/policies/policy.h"
#include "sim/policies/queue_model.h"

namespace throng::sim {

/// A place to begin a lead at, and the benefit of the lead.
struct BalanceTrip {
  Eigen::Vector2d pick = Eigen::Vector2d::Zero();
  int from = -1;  ///< the exit for which most of the people head; -1: none
  int to = -1;    ///< the exit to lead to
  double people = 0;
  double saving_s = 0;  ///< people times seconds, less for longer trips
};

/// The leads that a drone may fly.
struct LeadOptions {
  std::vector<int> exits;
  std::vector<LeadRoute> routes;  ///< through every exit of the scenario
  double speed_mps = 0;
  int max_people = 0;

  explicit LeadOptions(const PolicyContext& context);

  const LeadRoute& route(int exit) const { return routes[static_cast<std::size_t>(exit)]; }
};

/// A drone's choice among trips.
class BalanceTrips {
 public:
  explicit BalanceTrips(const PolicyContext& context);

  /// Looks at the queues.
  void update(const WorldView& view) { queues_.update(view, drone_); }

  /// The best trip from `place`, if one is worth it and the alarm has begun.
  std::optional<BalanceTrip> best(const WorldView& view, const Eigen::Vector2d& place) const;
  /// The best trip from `place` with people near a point, if there is one.
  std::optional<BalanceTrip> best_near(const WorldView& view, const Eigen::Vector2d& place,
                                       const Eigen::Vector2d& near) const;
  /// The place at which a drone that comes from `place` informs most people soonest; nothing if
  /// none is worth it, drones cannot inform or there is no alarm yet.
  std::optional<Eigen::Vector2d> place_to_inform(const WorldView& view,
                                                 const Eigen::Vector2d& place) const;
  /// Leaves people near `place`, who did not come with the drone, alone for a while.
  void abandon(const Eigen::Vector2d& place, double time_s);

  bool is_open(int exit) const { return queues_.is_open(exit); }
  /// The open exit by which followers who are at `place` are out soonest; -1 if there is none.
  int soonest_exit(const Eigen::Vector2d& place) const;
  const LeadOptions& leads() const { return leads_; }

 private:
  struct Abandoned {
    Eigen::Vector2d place;
    double until_s;
  };

  /// Replaces `best` by a better trip from `place` that begins at `pick`.
  void consider(const WorldView& view, const Eigen::Vector2d& place, const Eigen::Vector2d& pick,
                BalanceTrip& best) const;

  const world::Scenario& scenario_;
  int drone_;
  LeadOptions leads_;
  QueueModel queues_;
  std::vector<Abandoned> abandoned_;
};

/// Number of people near a place who have not noticed the alarm.
int unaware_near(const WorldView& view, const Eigen::Vector2d& place);

}  // namespace throng::sim
