// How people of a model move in scenes of everyday life and of standards: through an exit, across
// an open square, against each other, around a corner, past each other, in a queue.
#pragma once

#include <cstddef>
#include <cstdint>

#include "crowd/validation/scene.h"

namespace throng::validation {

struct ExitRun {
  bool all_out = false;   ///< within 400 s
  double flow_per_s = 0;  ///< people over the entire time until the last is out
  double overlap_m = 0;   ///< the deepest of two bodies
};
/// 100 people leave a room of 8 m x 5 m through an exit of 1 m (IMO MSC.1/Circ.1533, test 4;
/// NIST 5.2).
ExitRun leave_room(const Tested& tested, std::uint64_t seed);

struct SquareRun {
  double stuck = 0;      ///< share of people who got less than 1 m far in the last 10 of 120 s
  double speed_mps = 0;  ///< mean of these 10 s
  double acceleration_mps2 = 0;  ///< root mean square of these 10 s
};
/// An open square of 30 m x 30 m in which everybody walks to one random place after the other.
SquareRun cross_square(const Tested& tested, double density, std::uint64_t seed);

/// Two rooms with a corridor of 10 m x 2 m between them: 100 people in state "There" walk through
/// it, so many others in state "Back" against them (NIST 2.8).
Scene two_rooms(std::size_t others);

struct CounterRun {
  double time_s = 0;     ///< until the last is across, at most 600
  std::size_t left = 0;  ///< people who are not across by then
};
/// two_rooms() until everybody is across.
CounterRun pass_corridor(const Tested& tested, std::size_t others, std::uint64_t seed);

struct TwoWayRun {
  double there = 0;  ///< 1/(m s), of those who walk one way; mean from 60 to 180 s
  double back = 0;   ///< 1/(m s), of the others
};
/// A corridor 4 m wide that `each` people per meter and second enter at both ends.
TwoWayRun walk_both_ways(const Tested& tested, double each, std::uint64_t seed);

/// People per meter and second between the 10th and the 80th percentile of those who come out of a
/// corridor that is straight, or turns by 90 degrees; 0 when that takes longer than 600 s.
double corridor_flow(const Tested& tested, bool turns, double width_m, std::uint64_t seed);

struct MeetingRun {
  bool passed = false;           ///< within 60 s, and without touching
  double begins_s = 0;           ///< before they meet: one goes aside (0.03 m/s); 0 if nobody does
  double acceleration_mps2 = 0;  ///< the greatest
};
/// Two people of radius 0.2 m who walk towards each other, `aside_m` apart.
MeetingRun meet(const Tested& tested, double aside_m, std::uint64_t seed);

struct QueueRun {
  std::size_t passed = 0;  ///< people through the door
  double turns = 0;  ///< of the heading by more than 90°, per person and minute; 0 without people
  double stops = 0;  ///< per person and minute
};
/// 150 people before a door of 0.8 m, from 20 to 60 s.
QueueRun stand_in_queue(const Tested& tested, std::uint64_t seed);

}  // namespace throng::validation
