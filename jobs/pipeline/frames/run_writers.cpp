#include "jobs/pipeline/frames/run_writers.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "annotate/events.h"
#include "annotate/exits_csv.h"
#include "annotate/people/actions.h"
#include "annotate/people/coco.h"
#include "annotate/rasters/field_levels.h"
#include "annotate/rasters/ground_field.h"
#include "annotate/rasters/trajectories.h"
#include "annotate/rasters/zone_counts.h"
#include "base/error.h"
#include "jobs/pipeline/frames/flight_record.h"
#include "render/animator.h"
#include "skinning/population.h"
#include "spec/job/environment.h"
#include "spec/job/plan.h"

namespace throng::jobs {

using annotate::GroundTruth;

namespace {

void write_exits_table(RunOutput& output) {
  std::vector<annotate::FrameTime> frames;
  for (std::int64_t frame = 0; frame < output.job.frames_per_camera(); ++frame) {
    frames.push_back({frame, output.job.frame_time_s(frame)});
  }
  output.publication.add(ground_truth_file(GroundTruth::exits, run_name(output.run)),
                         annotate::exits_csv(output.exits, output.trace.time_s, frames));
}

// Density and velocity on the ground at the time of every frame.
void write_fields(RunOutput& output) {
  nlohmann::json people = nlohmann::json::array();
  const annotate::GroundGrid ground(output.scenario);
  const std::string run = run_name(output.run);
  std::vector<annotate::FieldLevel> levels;
  for (const double cell_m : output.job.outputs.field_cells_m) {
    levels.push_back(annotate::field_level(ground, cell_m));
  }
  for (std::int64_t frame = 0; frame < output.job.frames_per_camera(); ++frame) {
    const auto field = annotate::ground_field(output.trace, ground, output.job.frame_time_s(frame));
    output.publication.add(ground_truth_file(GroundTruth::fields, run, "", frame),
                           annotate::npy_bytes(ground, field));
    for (const annotate::FieldLevel& level : levels) {
      output.publication.add(
          fmt::format("fields/{}/{}/{:06}.npy", run, annotate::level_folder(level.cell_m), frame),
          annotate::npy_bytes(level, annotate::field_on(level, ground, field)));
    }
    people.push_back(field.people);
  }
  nlohmann::json grid = {{"origin_m", {ground.origin().x(), ground.origin().y()}},
                         {"cell_m", ground.cell_m()},
                         {"kernel_m", annotate::kFieldKernelM},
                         {"columns", ground.columns()},
                         {"rows", ground.rows()},
                         {"people", people}};
  for (const annotate::FieldLevel& level : levels) {
    grid["levels"].push_back({{"cell_m", level.cell_m},
                              {"columns", level.columns},
                              {"rows", level.rows},
                              {"folder", annotate::level_folder(level.cell_m)}});
  }
  output.publication.add("fields/" + run + ".json", grid.dump(kJsonIndent) + "\n");
}

std::vector<double> frame_times_s(const JobSpec& job) {
  std::vector<double> times_s;
  for (std::int64_t frame = 0; frame < job.frames_per_camera(); ++frame) {
    times_s.push_back(job.frame_time_s(frame));
  }
  return times_s;
}

void write_counts_table(RunOutput& output) {
  const annotate::CountAreas areas =
      annotate::count_areas(output.scenario, output.job.outputs.counts);
  const std::string run = run_name(output.run);
  output.publication.add(
      ground_truth_file(GroundTruth::counts, run),
      annotate::counts_csv(output.trace, areas, frame_times_s(output.job), output.run));
  output.publication.add("counts/" + run + ".json", annotate::counts_json(areas));
}

void write_actions_table(RunOutput& output) {
  const JobSpec job = job_of_run(output.job, output.run);
  const std::uint64_t seed = run_seed(job, output.run);
  const RunEnvironment environment = environment_of_run(job.environment, seed);
  const skinning::Styling styling = styling_in(job, environment.light.weather);
  const skinning::Population population = skinning::load_population(skinning::population_folder());
  const render::Animator animator(output.trace, population, styling, output.scenario.stands,
                                  output.scenario.sitters);
  const annotate::ActionFacts facts(output.trace, population, styling);
  output.publication.add(
      ground_truth_file(GroundTruth::actions, run_name(output.run)),
      annotate::actions_csv(output.trace, animator, facts, output.job.capture.from_s,
                            output.job.capture.to_s, output.run));
}

void write_trajectories(RunOutput& output) {
  const std::vector<double> times_s = frame_times_s(output.job);
  const annotate::Trajectories found = annotate::trajectories_at(output.trace, times_s);
  nlohmann::json tracks = nlohmann::json::array();
  for (const std::uint32_t agent : found.agents) {
    tracks.push_back(annotate::track_id(output.run, agent));
  }
  const std::string run = run_name(output.run);
  output.publication.add(ground_truth_file(GroundTruth::trajectories, run),
                         annotate::npy_bytes(found));
  const nlohmann::json description = {{"times_s", times_s},
                                      {"track_ids", std::move(tracks)},
                                      {"states", output.trace.header.state_names}};
  output.publication.add("trajectories/" + run + ".json", description.dump() + "\n");
}

void write_events(RunOutput& output) {
  output.publication.add(
      ground_truth_file(GroundTruth::events, run_name(output.run)),
      annotate::events_jsonl(output.trace, output.scenario, output.run, frame_times_s(output.job)));
}

void write_sensors(RunOutput& output) {
  const std::uint64_t seed = run_seed(output.job, output.run);
  for (std::size_t i = 0; i < output.job.drones.size(); ++i) {
    const std::string& id = output.job.drones[i].mission.id;
    const auto& ids = output.trace.header.drone_ids;
    const auto drone =
        static_cast<std::size_t>(std::find(ids.begin(), ids.end(), id) - ids.begin());
    check(drone < ids.size(), "a trace holds the drones of its job");
    const std::vector<world::DroneSample>& truth = output.trace.drones[drone];
    output.publication.add(ground_truth_file(GroundTruth::sensors, run_name(output.run), id),
                           sensors_csv(truth, record_sensors(output.job, seed, truth, i)));
  }
}

constexpr std::array kRunWriters = {
    RunWriter{GroundTruth::actions, write_actions_table},
    RunWriter{GroundTruth::exits, write_exits_table},
    RunWriter{GroundTruth::fields, write_fields},
    RunWriter{GroundTruth::counts, write_counts_table},
    RunWriter{GroundTruth::trajectories, write_trajectories},
    RunWriter{GroundTruth::events, write_events},
    RunWriter{GroundTruth::sensors, write_sensors},
};

}  // namespace

std::span<const RunWriter> run_writers() { return kRunWriters; }

}  // namespace throng::jobs
