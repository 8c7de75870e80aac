// Counts of people in zones and across lines of the ground per frame, with their identities: ground
// truth for the counting of individuals in videos.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "annotate/people/labels.h"
#include "spec/annotate/count_areas.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::annotate {

/// Id of the zone that covers all of the ground.
inline constexpr const char* kGroundZone = "ground";

/// The zone kGroundZone, a line for each exit of the scenario, with its inward direction opposite
/// to Exit::outward, and then the zones and lines of the job.
CountAreas count_areas(const world::Scenario& scenario, const CountAreas& of_job);

/// The content of counts/RUN.csv: one row per frame and area, with people as track ids. A zone
/// lists the people `inside` at the frame's time and those who `entered` and `left` since the
/// previous frame; at the first frame, all people inside have entered. A line lists the people who
/// crossed it since the previous frame, once per crossing, from the trace's steps. The people are
/// those of trajectories_at().
std::string counts_csv(const world::Trace& trace, const CountAreas& areas,
                       std::span<const double> times_s, std::int64_t run_index);

/// The content of counts/RUN.json: the areas with their coordinates.
std::string counts_json(const CountAreas& areas);

/// A JSON array with the number of people in each zone who have at least one visible pixel.
std::string visible_in_zones(const FrameLabels& labels, const std::vector<CountZone>& zones);

}  // namespace throng::annotate
