#include "jobs/pipeline/checks/resolve.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "annotate/people/coco.h"
#include "base/error.h"
#include "base/files/files.h"
#include "crowd/simulation.h"
#include "crowd/state/model.h"
#include "formats/export/exporter.h"
#include "jobs/pipeline/checks/ground_check.h"
#include "jobs/pipeline/checks/lens_check.h"
#include "jobs/pipeline/checks/models_memory.h"
#include "jobs/pipeline/runs/job_scenario.h"
#include "jobs/pipeline/runs/recording.h"
#include "jobs/pipeline/runs/run_input.h"
#include "render/props/vehicles.h"
#include "sim/people/participants.h"
#include "sim/planning/aimed_start.h"
#include "sim/planning/moved_goals.h"
#include "sim/planning/plan.h"
#include "sim/recording/pilot_log.h"
#include "sim/run.h"
#include "spec/annotate/ground_truth.h"
#include "spec/job/plan.h"
#include "spec/job/scenario_mix.h"
#include "spec/job/schema_problems.h"
#include "spec/job/spec.h"

namespace throng::jobs {

namespace {

// Keeps image and annotation ids, and a manifest in memory, within sane bounds.
constexpr std::int64_t kMaxImages = 2'000'000;

void add(const InputError& error, std::vector<Problem>& problems) {
  problems.insert(problems.end(), error.problems().begin(), error.problems().end());
}

void read_pilot_log(const std::string& pointer, DroneSpec& drone, std::vector<Problem>& problems) {
  const std::filesystem::path file = std::exchange(drone.pilot_log, {});
  try {
    drone.mission.guidance.setpoints = sim::parse_pilot_log(read_file(file), file.string());
  } catch (const EnvironmentError&) {
    problems.push_back({"", pointer, "\"" + file.filename().string() + "\", which cannot be read",
                        "the name of a pilot log, from the job's folder"});
  } catch (const InputError& error) {
    add(error, problems);
  }
}

// Reads the files beside the job into it.
void read_files(JobSpec& job, std::vector<Problem>& problems) {
  for (std::size_t i = 0; i < job.drones.size(); ++i) {
    if (job.drones[i].pilot_log.empty()) continue;
    read_pilot_log(fmt::format("/drones/{}/guidance/log", i), job.drones[i], problems);
  }
  if (job.recorded && !job.recorded->file.empty()) identify_recording(*job.recorded, problems);
}

void check_formats(const OutputSpec& outputs, std::vector<Problem>& problems) {
  try {
    formats::choose_formats(outputs.formats, outputs.annotations, "/outputs/formats");
  } catch (const InputError& error) {
    add(error, problems);
  }
}

// Checks the cameras of every run, as each may have another lens.
void check_cameras(const JobSpec& job, std::vector<Problem>& problems) {
  for (std::size_t i = 0; i < job.drones.size(); ++i) {
    const CameraSpec& camera = job.drones[i].camera;
    const std::string pointer = camera_pointer(i);
    const std::size_t before = problems.size();
    const bool is_alike = camera.sampled.empty() && job.randomize.empty();
    for (const RunPlan& run : plan_runs(job)) {
      const render::Quality quality = job_of_run(job, run.index).quality;
      check_lens(camera_of_run(camera, run.seed, pointer), quality, pointer, problems);
      if (is_alike || problems.size() > before) break;
    }
  }
}

// Gives the job what the scenario knows: its model, and its drones to a job without any.
void take_from_scenario(JobSpec& job, const world::Scenario& scenario,
                        DefaultDrones default_drones) {
  if (job.mix.empty()) job.crowd.model = sim::model_for(scenario, job.crowd);
  if (job.drones.empty() && !job.is_without_drones && default_drones != DefaultDrones::none) {
    for (const world::DroneStart& known : scenario.drones) {
      job.drones.emplace_back().mission.id = known.id;
    }
  }
  for (DroneSpec& drone : job.drones) {
    for (const world::DroneStart& known : scenario.drones) {
      if (known.id != drone.mission.id) continue;
      if (!drone.mission.moves_goal) drone.mission.moves_goal = known.moves_goal;
    }
  }
}

void check_image_count(const JobSpec& job, std::vector<Problem>& problems) {
  if (job.capture.to_s < job.capture.from_s) return;  // reported by parse_job
  const auto cameras = static_cast<std::int64_t>(job.drones.size());
  const std::int64_t images = job.frames_per_camera() * cameras * job.runs;
  if (images <= kMaxImages) return;
  problems.push_back({"", "/capture", fmt::format("{} images over all runs and cameras", images),
                      fmt::format("at most {}", kMaxImages)});
}

// Recorded people do what they did.
void check_recording(const JobSpec& job, std::vector<Problem>& problems) {
  if (job.crowd.physical.on) {
    problems.push_back({"", "/crowd/physical", "true", "false, since the people are recorded"});
  }
  if (job.recorded->sha256.empty()) return;  // there is no such file: reported by read_files()
  try {
    const world::Trace recording = read_recording(*job.recorded);
    if (job.capture.end_s() > recording.duration_s() + world::kTimeSlackS) {
      problems.push_back(
          {"", job.capture.run_to_s ? "/capture/run_to_s" : "/capture/to_s",
           fmt::format("{}", job.capture.end_s()),
           fmt::format("at most {:.6g}, the recording's length", recording.duration_s())});
    }
    sim::choose_roles("", {}, recording.agents(), job.agents, job.seed, problems);
  } catch (const InputError& error) {
    problems.insert(problems.end(), error.problems().begin(), error.problems().end());
  }
}

/// A job of several scenarios that says nothing of drones takes none of theirs.
void check_no_drones_are_meant(const JobSpec& job, const std::vector<world::Scenario>& scenarios,
                               std::vector<Problem>& problems) {
  const bool have_drones = std::any_of(scenarios.begin(), scenarios.end(),
                                       [](const auto& place) { return !place.drones.empty(); });
  if (job.mix.empty() || job.is_without_drones || !have_drones) return;
  problems.push_back({"", "/drones", "nothing",
                      "at least one drone, since a job of several scenarios takes none of theirs; "
                      "\"aim\" places it in each; or [] for figures without images"});
}

/// Makes a job without drones one for figures: leaves out the ground truth that images hold if the
/// job does not say which it wants, and refuses it otherwise.
void make_job_for_figures(JobSpec& job, std::vector<Problem>& problems) {
  job.is_without_drones = true;
  OutputSpec& outputs = job.outputs;
  const auto needs_images = [](const std::string& name) {
    const annotate::GroundTruthKind* kind = annotate::find_kind(name);
    return kind != nullptr && annotate::needs_images(*kind);
  };
  if (outputs.annotations == annotate::default_ground_truth()) {
    std::erase_if(outputs.annotations, needs_images);
  }
  const char* const expected =
      "a drone in /drones, since the scenario has none of its own or the job wants none";
  const auto refuse = [&](const std::string& pointer, const std::string& what) {
    problems.push_back(
        {"", pointer, what + " without drones, whose cameras make images", expected});
  };
  for (std::size_t i = 0; i < outputs.annotations.size(); ++i) {
    if (!needs_images(outputs.annotations[i])) continue;
    refuse(fmt::format("/outputs/annotations/{}", i),
           fmt::format("\"{}\"", outputs.annotations[i]));
  }
  for (std::size_t i = 0; i < outputs.formats.size(); ++i) {
    const formats::Format* format = formats::find_format(outputs.formats[i]);
    if (format == nullptr || !format->needs_images()) continue;
    refuse(fmt::format("/outputs/formats/{}", i), fmt::format("\"{}\"", outputs.formats[i]));
  }
  if (outputs.previews != OutputSpec().previews && outputs.previews > 0) {
    refuse("/outputs/previews", fmt::format("{}", outputs.previews));
  }
  outputs.previews = 0;
}

void check_flight(CheckedScenario& place, const JobSpec& run_job, int run,
                  std::vector<Problem>& problems) {
  const std::uint64_t seed = run_seed(run_job, run);
  std::vector<sim::DroneMission> missions = make_missions(run_job, seed);
  sim::aim_drones(place.scenario(), place.people_to_aim_at(), seed, missions, problems);
  sim::plan_drones(place.scenario(), missions, run_job.capture.end_s(), problems);
}

// Checks that need the simulation: whether the drones can fly and whether there are people enough.
void check_with_simulation(CheckedScenario& place, const JobSpec& job,
                           std::vector<Problem>& problems) {
  const world::Scenario& scenario = place.scenario();
  check_flight(place, job, place.runs().front(), problems);
  const char* field = "/crowd/model";
  try {
    const crowd::ModelEntry& model = crowd::find_model(sim::model_for(scenario, job.crowd));
    field = "/crowd/constants";
    crowd::chosen_constants(model, job.crowd.constants, job.seed);
  } catch (const InputError& error) {
    const Problem& problem = error.problems().front();
    problems.push_back({"", field, problem.found, problem.expected});
    return;
  }
  if (job.recorded) return check_recording(job, problems);
  if (place.is_of_trace()) return;
  const std::vector<sim::DroneMission> missions = make_missions(job, job.seed);
  const bool moves_goals = std::any_of(
      missions.begin(), missions.end(),
      [&](const sim::DroneMission& mission) { return sim::has_own_goal(mission, scenario); });
  if (!job.agents && !moves_goals) return;
  const crowd::Simulation& crowd = place.people();
  if (moves_goals) sim::check_moved_goals(missions, scenario, crowd, problems);
  if (!job.agents) return;
  sim::choose_roles(scenario.id, scenario.disaster_agents, crowd.agent_count(), job.agents,
                    job.seed, problems);
}

/// That the scenario has if the job does not say how many; 0 where they cannot be counted, which
/// the simulation will explain.
int count_people(CheckedScenario& place) {
  if (place.job().agents || place.job().recorded || place.is_of_trace()) return 0;
  try {
    return static_cast<int>(place.people().agent_count());
  } catch (const InputError&) {
    return 0;
  }
}

// Errors of the airframe would only be found again.
bool has_own_airframe(const JobSpec& job) {
  return std::any_of(job.drones.begin(), job.drones.end(),
                     [](const DroneSpec& drone) { return drone.mission.own_airframe.has_value(); });
}

// Checks the fields that may differ between runs in each of them, and the largest of their crowds.
// Problems are reported at the distributions.
void check_runs(CheckedScenario& place, std::vector<Problem>& problems) {
  JobSpec largest = place.job();
  const std::size_t before = problems.size();
  for (const int run : place.runs()) {
    const JobSpec run_job = job_of_run(place.job(), run);
    if (run_job.agents.value_or(0) > largest.agents.value_or(0)) largest.agents = run_job.agents;
    check_flight(place, run_job, run, problems);
    if (problems.size() > before) break;
  }
  if (problems.size() == before) check_with_simulation(place, largest, problems);
  for (std::size_t i = before; i < problems.size(); ++i) {
    for (const RandomField& field : place.job().randomize) {
      if (field.pointer.starts_with(problems[i].where)) {
        problems[i].where = "/randomize/" + field.path;
      }
    }
  }
}

/// `is_sound`: nothing else is wrong with the job.
std::vector<Problem> problems_in(CheckedScenario& place, bool is_sound) {
  std::vector<Problem> problems;
  if (is_sound && !place.job().randomize.empty()) {
    check_runs(place, problems);
  } else if (is_sound || !has_own_airframe(place.job())) {
    check_with_simulation(place, place.job(), problems);
  }
  return problems;
}

/// The job's scenarios, in the order of first_runs().
std::vector<CheckedScenario> split_by_scenario(const JobSpec& job,
                                               std::vector<world::Scenario> scenarios) {
  const std::vector<int> first = first_runs(job);
  std::vector<CheckedScenario> places;
  places.reserve(first.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    places.emplace_back(in_scenario_of_run(job, first[i]), std::move(scenarios[i]),
                        runs_alike(job, first[i]));
  }
  return places;
}

// Checks the job in its scenarios. Of several, each problem says in which.
void check_places(const JobSpec& job, std::vector<CheckedScenario>& places,
                  std::vector<Problem>& problems) {
  const bool is_sound = problems.empty();
  for (CheckedScenario& place : places) {
    for (Problem& problem : problems_in(place, is_sound)) {
      if (!job.mix.empty()) problem.found += fmt::format(" in {}", place.scenario().id);
      problems.push_back(std::move(problem));
    }
  }
}

/// Ids of annotations have room for so many people and vehicles of a run.
void check_ids(const JobSpec& job, const world::Scenario& scenario, std::int64_t people,
               std::vector<Problem>& problems) {
  if (!wants(job, annotate::GroundTruth::coco)) return;
  if (people > annotate::kFirstVehicleNumber) {
    problems.push_back(
        {"", "/crowd/agents", fmt::format("{} people", people),
         fmt::format("at most {} with the annotation coco", annotate::kFirstVehicleNumber)});
  }
  if (!wants(job, annotate::GroundTruth::vehicles)) return;
  const auto vehicles = static_cast<std::int64_t>(render::vehicle_count(scenario));
  if (vehicles > annotate::kMaxVehiclesPerRun) {
    problems.push_back(
        {"", "/outputs/annotations", fmt::format("{} vehicles", vehicles),
         fmt::format("at most {} with the annotation vehicles", annotate::kMaxVehiclesPerRun)});
  }
}

/// A filter by contrast needs the annotation that measures it.
void check_filters(const JobSpec& job, std::vector<Problem>& problems) {
  const double min_contrast = job.outputs.exports.filters.min_contrast;
  if (min_contrast <= 0 || wants(job, annotate::GroundTruth::difficulty)) return;
  problems.push_back({"", "/outputs/filters/min_contrast", fmt::format("{}", min_contrast),
                      "the annotation difficulty, too, which measures contrast"});
}

Resolution resolved(JobSpec job, std::vector<world::Scenario> scenarios, const std::string& source,
                    std::vector<Problem> problems, DefaultDrones default_drones) {
  read_files(job, problems);
  if (job.mix.empty()) take_from_scenario(job, scenarios.front(), default_drones);
  if (job.drones.empty() && default_drones == DefaultDrones::of_scenario) {
    check_no_drones_are_meant(job, scenarios, problems);
    make_job_for_figures(job, problems);
  }
  if (!job.is_without_drones || problems.empty()) check_formats(job.outputs, problems);
  check_image_count(job, problems);
  check_filters(job, problems);
  check_ground_outputs(job.outputs, scenarios, problems);
  if (problems.empty()) check_cameras(job, problems);
  std::vector<CheckedScenario> places = split_by_scenario(job, std::move(scenarios));
  check_places(job, places, problems);
  int people = 0;
  if (problems.empty()) {
    for (CheckedScenario& place : places) {
      const int here = count_people(place);
      check_ids(job, place.scenario(), std::max(here, job.agents.value_or(0)), problems);
      people = std::max(people, here);
    }
  }
  for (Problem& problem : problems) {
    if (problem.source.empty()) problem.source = source;
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return {ResolvedJob(std::move(job), SceneLoad{people}), std::move(places)};
}

}  // namespace

ResolvedJob resolve(JobSpec job, const world::Scenario& scenario, const std::string& source) {
  return resolved(std::move(job), {scenario}, source, {}, DefaultDrones::of_scenario).job;
}

namespace {

Resolution resolve_valid(const nlohmann::json& document, const std::string& source,
                         const std::filesystem::path& scenarios, DefaultDrones default_drones) {
  std::vector<Problem> problems;
  JobSpec job = read_job(document, source, problems);
  std::vector<world::Scenario> places;
  std::vector<Problem> of_places;
  bool is_named = true;
  const std::vector<std::size_t> shares = shares_of_runs(job);
  for (const int run : first_runs(job)) {
    const std::size_t share = shares[static_cast<std::size_t>(run)];
    const std::string pointer = job.mix.empty() ? "/scenario" : fmt::format("/scenario/{}", share);
    const JobSpec one = in_scenario_of_run(job, run);
    is_named = is_named && (!one.scenario.empty() || one.generate);
    if (!is_named) continue;  // a problem of the share, which is known
    try {
      places.push_back(load_job_scenario(one, scenarios, source, pointer));
    } catch (const InputError& error) {
      add(error, of_places);
    }
  }
  if (!is_named || !of_places.empty()) {
    check_formats(job.outputs, problems);
    for (Problem& problem : problems) problem.source = source;
    problems.insert(problems.end(), of_places.begin(), of_places.end());
    throw InputError(std::move(problems));
  }
  Resolution resolution =
      resolved(std::move(job), std::move(places), source, std::move(problems), default_drones);
  SceneLoad load{resolution.job.load().people, 0};
  for (const CheckedScenario& place : resolution.scenarios) {
    load.models_mib = std::max(load.models_mib, models_memory_mib(place.scenario()));
  }
  resolution.job = ResolvedJob(resolution.job.spec(), load);
  return resolution;
}

}  // namespace

Resolution resolve_in_scenarios(const nlohmann::json& document, const std::string& source,
                                const std::filesystem::path& scenarios,
                                DefaultDrones default_drones) {
  const SchemaProblems of_schema(document, source);
  if (of_schema.problems().empty()) {
    return resolve_valid(document, source, scenarios, default_drones);
  }
  std::vector<Problem> problems = of_schema.problems();
  if (const nlohmann::json* rest = of_schema.valid_part()) {
    try {
      static_cast<void>(resolve_valid(*rest, source, scenarios, default_drones));
    } catch (const InputError& error) {
      for (const Problem& problem : error.problems()) {
        if (!of_schema.may_cause(problem)) problems.push_back(problem);
      }
    }
  }
  throw InputError(std::move(problems));
}

ResolvedJob resolve_job(const nlohmann::json& document, const std::string& source,
                        const std::filesystem::path& scenarios, DefaultDrones default_drones) {
  return resolve_in_scenarios(document, source, scenarios, default_drones).job;
}

ResolvedJob resolve_valid_job(const nlohmann::json& document, const std::string& source,
                              const std::filesystem::path& scenarios) {
  return resolve_valid(document, source, scenarios, DefaultDrones::of_scenario).job;
}

}  // namespace throng::jobs
