#include "jobs/live/flight.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "base/files/hash.h"
#include "base/json/problem_json.h"
#include "jobs/live/replay_job.h"
#include "jobs/pipeline/pipeline.h"
#include "sim/recording/pilot_log.h"

namespace throng::live {

using nlohmann::json;

/// Writes the trace and keeps the newest step.
class Flight::Recorder : public sim::RunObserver {
 public:
  explicit Recorder(const std::filesystem::path& trace_file) : file_(trace_file) {}

  void begin(const world::TraceHeader& header) override {
    header_ = header;
    trace_.emplace(file_, header);
    flown_.header.drone_ids = header.drone_ids;
    flown_.drones.resize(header.drone_ids.size());
    strides_now_.resize(header.agent_count());
  }
  void step(const world::CrowdStep& step) override {
    trace_->add(step);
    before_ = std::exchange(now_, std::make_shared<const world::CrowdStep>(step));
    if (!before_) before_ = now_;
    strides_before_ = strides_now_;
    for (std::size_t i = 0; i < strides_now_.size(); ++i) {
      strides_now_[i] += (now_->position[i] - before_->position[i]).norm();
    }
  }
  void drone(std::size_t drone, const world::DroneSample& sample) override {
    trace_->add_drone(drone, sample);
    flown_.drones[drone].push_back(sample);
  }
  void event(const world::TraceEvent& event) override {
    trace_->add_event(event);
    const auto drone = world::drone_of_event(event.kind);
    if (!drone) return;
    events_.push_back({{"time_s", event.time_s},
                       {"type", world::to_string(event.kind)},
                       {"drone", header_.drone_ids.at(static_cast<std::size_t>(*drone))}});
  }

  const world::TraceHeader& header() const { return header_; }
  std::vector<json> take_events() { return std::exchange(events_, {}); }

  /// All but the drones' status.
  Moment moment(double dt_s) const {
    Moment moment;
    moment.time_s = now_->time_s;
    moment.dt_s = dt_s;
    moment.before = before_;
    moment.now = now_;
    moment.strides_before = strides_before_;
    moment.strides_now = strides_now_;
    moment.flown = flown_;
    return moment;
  }

  /// Forgets all samples but the newest, before a step.
  void forget_flown() {
    for (std::vector<world::DroneSample>& samples : flown_.drones) {
      if (samples.size() > 1) samples.erase(samples.begin(), samples.end() - 1);
    }
  }

  void finish() { trace_->finish(); }

 private:
  std::filesystem::path file_;
  world::TraceHeader header_;
  std::optional<world::TraceWriter> trace_;
  std::shared_ptr<const world::CrowdStep> before_;
  std::shared_ptr<const world::CrowdStep> now_;
  std::vector<float> strides_before_;  ///< meters walked
  std::vector<float> strides_now_;
  world::Trace flown_;
  std::vector<json> events_;
};

Flight::Flight(const jobs::JobSpec& job, const world::Scenario& scenario,
               const std::filesystem::path& folder, double max_s)
    : job_(job),
      trace_file_(folder / kTraceFile),
      spec_(jobs::run_spec(job, 0)),
      recorder_(std::make_unique<Recorder>(trace_file_)) {
  spec_.duration_s = max_s;
  sim::fly_remotely(spec_, scenario);
  run_ = std::make_unique<sim::SteppedRun>(scenario, spec_, *recorder_);
  pilots_ = std::make_unique<sim::RemotePilots>(scenario, *run_, spec_);
}

Flight::~Flight() = default;

const world::TraceHeader& Flight::header() const { return recorder_->header(); }

std::shared_ptr<const Moment> Flight::moment(std::uint32_t sequence) const {
  auto moment = std::make_shared<Moment>(recorder_->moment(dt_s()));
  moment->sequence = sequence;
  for (std::size_t i = 0; i < drones().size(); ++i) {
    const sim::Pilot& pilot = run_->pilot(i);
    moment->drones.push_back({pilot.is_on_mission() && pilots_->log(i).back().beacon,
                              pilot.is_on_mission(), pilot.is_running()});
  }
  return moment;
}

std::shared_ptr<const Moment> Flight::step(const std::vector<sim::RemoteCommand>& commands,
                                           std::uint32_t sequence) {
  recorder_->forget_flown();
  pilots_->advance(commands);
  run_->step();
  return moment(sequence);
}

std::vector<json> Flight::take_events() { return recorder_->take_events(); }

json Flight::finish() {
  const std::vector<Problem> warnings = run_->finish();
  recorder_->finish();
  json logs = json::array();
  for (std::size_t i = 0; i < drones().size(); ++i) {
    logs.push_back({{"id", drones()[i].mission.id}, {"csv", sim::pilot_log_csv(pilots_->log(i))}});
  }
  json texts = json::array();
  for (const Problem& warning : warnings) texts.push_back(warning.text());
  return {{"duration_s", time_s()},
          {"steps", std::lround(time_s() / dt_s())},
          {"trace_sha256", sha256_hex_of_file(trace_file_)},
          {"drones", std::move(logs)},
          {"job", jobs::to_json(replay_job(job_, *pilots_, time_s()))},
          {"warnings", std::move(texts)}};
}

}  // namespace throng::live
