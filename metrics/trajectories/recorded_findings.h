// Warnings about recorded people: speeds that no human has, and people in buildings.
#pragma once

#include <vector>

#include "base/error.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::metrics {

struct Recorded;

/// Adds a warning if people move faster than 12 m/s from one of their frames to the next, whatever
/// lies between: with the number of such steps and people, and the id, frames and speed of the
/// fastest. `unit_m`: the unit of the positions.
void note_jumps(const Recorded& recorded, double unit_m, std::vector<Problem>& notes);

/// Warns of people more than 0.2 m inside of buildings: of how many, in how many frames, and in
/// which buildings. Nothing or one problem.
std::vector<Problem> find_people_in_buildings(const world::Trace& recording,
                                              const world::Scenario& scenario);

}  // namespace throng::metrics
