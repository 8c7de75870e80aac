#include "live/engine/stepped_job.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/compute/parallel.h"
#include "base/error.h"
#include "jobs/pipeline/checks/resolve.h"
#include "jobs/pipeline/runs/job_scenario.h"
#include "jobs/pipeline/runs/run_input.h"
#include "live/engine/newest_step.h"
#include "live/flight/onboard_camera.h"
#include "live/flight/replay_job.h"
#include "sim/recording/gimbal_setpoints.h"
#include "skinning/population.h"
#include "spec/job/scenario_mix.h"
#include "spec/job/spec.h"
#include "world/scenario.h"

namespace throng::engine {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

jobs::JobSpec read_job(std::string_view text, const std::string& source,
                       const RunChoices& choices) {
  json job = jobs::parse_job_document(text, source);
  if (choices.seed && job.is_object()) job["seed"] = *choices.seed;
  return jobs::resolve_job(job, source, world::scenarios_folder()).spec();
}

}  // namespace

struct SteppedJob::State {
  State(std::string_view text, const std::string& source, const RunChoices& given)
      : choices(given),
        job(read_job(text, source, given)),
        scenario(jobs::load_job_scenario(jobs::in_scenario_of_run(job, 0),
                                         world::scenarios_folder(), source)),
        spec(jobs::run_spec(job, 0)),
        newest(given.trace_file) {
    if (choices.is_remote) sim::fly_remotely(spec, scenario);
    run = std::make_unique<sim::SteppedRun>(scenario, spec, newest);
    if (choices.is_remote) pilots = std::make_unique<sim::RemotePilots>(scenario, *run, spec);
    constexpr double kRounding = 1e-9;  // as sim::simulate() counts steps
    steps = static_cast<long>(std::ceil(spec.duration_s / run->dt_s() - kRounding));
  }

  /// Made when it is first used.
  live::OnboardCamera& own_camera() {
    if (!camera) {
      population = skinning::load_population(skinning::population_folder());
      camera.emplace(job, scenario, *population, newest.header(), run->drones(),
                     live::ImageSize{choices.image_width, choices.image_height});
    }
    return *camera;
  }

  RunChoices choices;
  jobs::JobSpec job;
  world::Scenario scenario;
  sim::RunSpec spec;
  NewestStep newest;
  std::unique_ptr<sim::SteppedRun> run;
  std::unique_ptr<sim::RemotePilots> pilots;
  long steps = 0;  ///< of the job's duration
  long done = 0;
  bool is_finished = false;
  std::optional<skinning::Population> population;
  std::optional<live::OnboardCamera> camera;
};

SteppedJob::SteppedJob(std::string_view job, const std::string& source, const RunChoices& choices)
    : threads_(std::make_unique<ThreadLimit>(choices.threads)),
      state_(threads_->run([&] { return std::make_unique<State>(job, source, choices); })) {}

SteppedJob::~SteppedJob() = default;

const world::TraceHeader& SteppedJob::header() const { return state_->newest.header(); }
double SteppedJob::dt_s() const { return state_->run->dt_s(); }
double SteppedJob::time_s() const { return state_->run->time_s(); }
double SteppedJob::duration_s() const { return state_->spec.duration_s; }
bool SteppedJob::is_over() const { return state_->done >= state_->steps; }
const world::Rectangle& SteppedJob::area() const { return state_->scenario.inside.bounds; }
const world::CrowdStep& SteppedJob::people() const { return state_->newest.people(); }
const DroneRows& SteppedJob::drones() const { return state_->newest.drones(); }
std::vector<world::TraceEvent> SteppedJob::take_events() { return state_->newest.take_events(); }

void SteppedJob::step(const std::vector<sim::RemoteCommand>& commands) {
  State& state = *state_;
  const std::size_t expected = state.choices.is_remote ? state.run->drones().size() : 0;
  if (state.is_finished || commands.size() != expected) {
    throw InputError({"", "step",
                      state.is_finished ? "a run that is finished"
                                        : std::to_string(commands.size()) + " commands",
                      state.is_finished ? "a new run" : std::to_string(expected) + " commands"});
  }
  state.newest.forget_samples();
  if (state.pilots) state.pilots->advance(commands);
  threads_->run([&] { state.run->step(); });
  ++state.done;
}

const std::vector<std::uint8_t>& SteppedJob::image(std::size_t drone) {
  State& state = *state_;
  if (drone >= state.run->drones().size()) {
    throw InputError({"", "image", "drone " + std::to_string(drone),
                      "one of " + std::to_string(state.run->drones().size())});
  }
  live::Moment moment = state.newest.moment(dt_s());
  for (std::size_t i = 0; i < state.run->drones().size(); ++i) {
    const std::vector<sim::PilotSample>& setpoints =
        state.pilots ? state.pilots->log(i) : state.spec.drones[i].guidance.setpoints;
    moment.setpoints.push_back(sim::setpoints_around(setpoints, time_s() - dt_s(), time_s()));
  }
  return *threads_->run([&] { return &state.own_camera().draw(moment, drone, time_s()); });
}

std::vector<std::string> SteppedJob::finish() {
  State& state = *state_;
  std::vector<std::string> warnings;
  if (std::exchange(state.is_finished, true)) return warnings;
  for (const Problem& warning : state.run->finish()) warnings.push_back(warning.text());
  state.newest.finish();
  return warnings;
}

std::string SteppedJob::flown_job() const {
  check(state_->pilots != nullptr, "only flights by commands are repeated by logs");
  return jobs::to_json(live::replay_job(state_->job, *state_->pilots, time_s())).dump();
}

}  // namespace throng::engine
