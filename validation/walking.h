// Movement of people in scenes of everyday life and of standards: through an exit, across an open
// square, against each other, around a corner, past each other, in a queue.
#pragma once

#include <cstddef>
#include <cstdint>

#include "validation/scene.h"

namespace throng::validation {

struct ExitRun {
  bool all_out = false;   ///< within 400 s
  double flow_per_s = 0;  ///< number of people over the time until the last is out
  double overlap_m = 0;   ///< max overlap of two bodies
};
/// Simulates 100 people who leave a room of 8 m x 5 m through an exit of 1 m (IMO MSC.1/Circ.1533,
/// test 4; NIST 5.2).
ExitRun leave_room(const Tested& tested, std::uint64_t seed);

struct SquareRun {
  double stuck = 0;              ///< share of people who move less than 1 m in the last 10 of 120 s
  double speed_mps = 0;          ///< mean of these 10 s
  double acceleration_mps2 = 0;  ///< root mean square of these 10 s
};
/// Returns the scene of an open square of 30 m x 30 m in which people (1/m^2) walk to random
/// points, one after the other.
TestScene square_scene(double density);
/// Simulates an open square of 30 m x 30 m in which people walk to random points, one after the
/// other.
SquareRun cross_square(const Tested& tested, double density, std::uint64_t seed);

/// Returns the scene of two rooms with a corridor of 10 m x 2 m between them: 100 people in state
/// "There" walk through it, and `others` in state "Back" walk against them (NIST 2.8).
TestScene two_rooms(std::size_t others);

struct CounterRun {
  double time_s = 0;     ///< until the last person is across, at most 600 s
  std::size_t left = 0;  ///< people who are not across by then
};
/// Simulates two_rooms() until everybody is across.
CounterRun pass_corridor(const Tested& tested, std::size_t others, std::uint64_t seed);

struct TwoWayRun {
  double there = 0;  ///< flow (1/(m s)) of those who walk in one direction; mean from 60 to 600 s
  double back = 0;   ///< flow (1/(m s)) of the others
  double stuck = 0;  ///< share of people who get less than 1 m far from 590 to 600 s
};
/// Simulates a corridor 4 m wide that `each` people per meter and second enter at both ends.
TwoWayRun walk_both_ways(const Tested& tested, double each, std::uint64_t seed);

/// A turn of a corridor by 90 degrees, by what its inner side is made of.
enum class Turn {
  none,   ///< the corridor is straight
  block,  ///< one solid box
  thin    ///< two walls, 0.2 m thick, that touch
};
struct Passage {
  double width_m = 4;
  Turn turn = Turn::none;
  /// Whether people stand at 3 per m^2 up to the turn; otherwise at 2 per m^2, the first of them
  /// 10 m before it.
  bool queued = false;
};
/// Flow (1/(m s)) between the 10th and the 80th percentile of the people who leave a corridor; 0 if
/// that takes longer than 600 s.
double corridor_flow(const Tested& tested, const Passage& passage, std::uint64_t seed);

struct MeetingRun {
  bool passed = false;  ///< within 60 s, and without touching
  double begins_s = 0;  ///< start of evasion (lateral speed 0.03 m/s) before they meet; 0: none
  double acceleration_mps2 = 0;  ///< max acceleration
};
/// Simulates two people of radius 0.2 m who walk towards each other, `aside_m` apart laterally.
MeetingRun meet(const Tested& tested, double aside_m, std::uint64_t seed);

struct QueueRun {
  std::size_t passed = 0;  ///< people through the door
  double turns = 0;        ///< turns by more than 90°, per person and minute; 0 without people
  double stops = 0;        ///< per person and minute
};
/// Simulates 150 people before a door of 0.8 m, from 20 to 60 s.
QueueRun stand_in_queue(const Tested& tested, std::uint64_t seed);

}  // namespace throng::validation
