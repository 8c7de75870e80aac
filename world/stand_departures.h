// How spectators leave a stand: along their row to an aisle and down to its foot, one after the
// other. Depends on the stand alone, so that the crowd can expect them.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "world/stand_seats.h"

namespace throng::world {

/// Time between two people at the foot of an aisle.
inline constexpr double kFootHeadwayS = 0.9;

/// The departure of one spectator.
struct Departure {
  std::size_t spectator = 0;  ///< index into taken_seats()
  std::size_t aisle = 0;      ///< index into aisles()
  double rises_s = 0;         ///< gets up
  double at_foot_s = 0;       ///< has come to the foot of the aisle
};

/// A place on the way.
struct OnTheWay {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< m
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  ///< m/s, along the ground
};

/// The foot of an aisle, on the ground kFrontStepsM before the front edge.
Eigen::Vector2d aisle_foot(const Stand& stand, const Aisle& aisle);

/// The departures of a stand's spectators, by aisle and then by time; empty if they stay. From
/// leave_at_s on, after 1 to 8 s, they walk at 0.6 m/s in rows and 0.7 m/s in aisles, those in
/// front first; each gets up so late that nobody waits at the foot.
std::vector<Departure> departures(const Stand& stand);

/// Time that it takes to get up.
inline constexpr double kGetUpS = 0.8;

/// The way of one spectator: up from the seat, along the row and down the aisle.
class WayDown {
 public:
  WayDown(const Stand& stand, const Seat& seat, const Aisle& aisle);

  /// From getting up to the foot.
  double duration_s() const;
  /// The place at a time after getting up, clamped to the way.
  OnTheWay at(double time_s) const;

 private:
  /// A straight part of the way.
  struct Leg {
    Eigen::Vector2d from;
    Eigen::Vector2d to;
    double lasts_s;
  };
  std::vector<Leg> legs_;
};

}  // namespace throng::world
