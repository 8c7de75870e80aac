// The crowd as drones meet it.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/vehicle/flight_world.h"

namespace throng::sim {

/// Everybody at one instant. Two arrays of one size; empty: nobody.
struct PeopleView {
  std::span<const Eigen::Vector2f> position;  ///< m
  std::span<const std::uint8_t> present;      ///< 1: is a person and there
};

/// A circle on the ground.
struct Area {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  double radius_m = 0;
};

/// Positions of all people at the beginning and the end of an interval. Reads the crowd only in the
/// requested areas.
class PeopleInMotion {
 public:
  /// Begins the next interval, which ends with everybody as in `end`, which must stay valid until
  /// it has ended.
  void begin(const PeopleView& end, double interval_s);

  /// Keeps the end of the interval as the beginning of the next.
  void finish();

  /// Adds to `list` those who start the interval within the area and take part in all of it, in
  /// the order of their numbers.
  void collect(const Area& area, std::vector<NearPerson>& list) const;

 private:
  PeopleView end_;
  double interval_s_ = 0;
  std::vector<Eigen::Vector2f> start_;
  std::vector<std::uint8_t> was_present_;
};

}  // namespace throng::sim
