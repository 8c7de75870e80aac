// Selection of the people near drones.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/vehicle/flight_world.h"

namespace throng::sim {

/// All agents at one time; both arrays have one element per agent, or none.
struct PeopleView {
  std::span<const Eigen::Vector2f> position;  ///< m
  std::span<const std::uint8_t> present;      ///< 1: a person who is present
};

/// A circle on the ground.
struct Disc {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  double radius_m = 0;
};

/// The positions of all people at the start and the end of an interval, by area.
class MovingPeople {
 public:
  /// Starts the next interval, at whose end the state is `end`. The arrays of `end` must remain
  /// valid until finish().
  void begin(const PeopleView& end, double interval_s);

  /// Ends the interval; its end becomes the start of the next one.
  void finish();

  /// Appends to `list`, in the order of agents, the people who start the interval within the area
  /// and are present during all of it.
  void collect(const Disc& area, std::vector<NearPerson>& list) const;

 private:
  PeopleView end_;
  double interval_s_ = 0;
  std::vector<Eigen::Vector2f> start_;
  std::vector<std::uint8_t> was_present_;
};

}  // namespace throng::sim
