// Counts of people in zones and across lines of the ground, frame by frame, with their identities:
// what counting individuals in videos is scored against.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "annotate/people/labels.h"
#include "spec/annotate/count_areas.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::annotate {

/// Id of the zone that is all of the ground.
inline constexpr const char* kGroundZone = "ground";

/// Those of a job, before them the zone of all ground and the scenario's doors; inward is into the
/// place.
CountAreas count_areas(const world::Scenario& scenario, const CountAreas& of_job);

/// counts/RUN.csv: a row per frame and area. A zone has the people `inside` at the frame's time,
/// and who `entered` and `left` since the frame before (at the first, all inside entered). A line
/// has who crossed it since the frame before, each time they did, step by step of the trace.
/// People are those of trajectories_at(), by track id of run `run_index`.
std::string counts_csv(const world::Trace& trace, const CountAreas& areas,
                       std::span<const double> times_s, std::int64_t run_index);

/// counts/RUN.json: the areas with their places.
std::string counts_json(const CountAreas& areas);

/// A JSON array of the zones with how many people with a visible pixel stand in them.
std::string visible_in_zones(const FrameLabels& labels, const std::vector<CountZone>& zones);

}  // namespace throng::annotate
