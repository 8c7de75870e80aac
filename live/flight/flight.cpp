#include "live/flight/flight.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "base/files/hash.h"
#include "base/json/problem_json.h"
#include "jobs/pipeline/runs/run_input.h"
#include "live/flight/replay_job.h"
#include "sim/recording/gimbal_setpoints.h"
#include "sim/recording/pilot_log.h"

namespace throng::live {

using nlohmann::json;

Flight::Flight(const jobs::JobSpec& job, const world::Scenario& scenario,
               const std::filesystem::path& folder, double max_s)
    : job_(job), trace_file_(folder / kTraceFile), recorder_(trace_file_) {
  sim::RunSpec spec = jobs::run_spec(job, 0);
  spec.duration_s = max_s;
  sim::fly_remotely(spec, scenario);
  run_ = std::make_unique<sim::SteppedRun>(scenario, spec, recorder_);
  pilots_ = std::make_unique<sim::RemotePilots>(scenario, *run_, spec);
}

Flight::~Flight() = default;

const world::TraceHeader& Flight::header() const { return recorder_.header(); }

std::shared_ptr<const Moment> Flight::moment(std::uint32_t sequence) const {
  auto moment = std::make_shared<Moment>(recorder_.moment(dt_s()));
  moment->sequence = sequence;
  for (std::size_t i = 0; i < drones().size(); ++i) {
    const sim::Pilot& pilot = run_->pilot(i);
    const std::vector<sim::PilotSample>& log = pilots_->log(i);
    const camera::GimbalAngles own = drones()[i].mission.camera.gimbal_angles();
    moment->drones.push_back({pilot.is_on_mission() && log.back().beacon, pilot.is_on_mission(),
                              pilot.is_running(), sim::gimbal_at(log, own, time_s())});
    moment->setpoints.push_back(sim::setpoints_around(log, time_s() - dt_s(), time_s()));
  }
  return moment;
}

std::shared_ptr<const Moment> Flight::step(const std::vector<sim::RemoteCommand>& commands,
                                           std::uint32_t sequence) {
  recorder_.forget_samples();
  pilots_->advance(commands);
  run_->step();
  return moment(sequence);
}

std::vector<json> Flight::take_events() {
  std::vector<json> events;
  for (const world::TraceEvent& event : recorder_.take_events()) {
    const auto drone = world::drone_of_event(event.kind);
    if (!drone) continue;
    events.push_back({{"time_s", event.time_s},
                      {"type", world::to_string(event.kind)},
                      {"drone", header().drone_ids.at(static_cast<std::size_t>(*drone))}});
  }
  return events;
}

json Flight::finish() {
  const std::vector<Problem> warnings = run_->finish();
  recorder_.finish();
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

std::vector<FlownDrone> flown_drones(const Flight& flight) {
  std::vector<FlownDrone> list;
  list.reserve(flight.drones().size());
  for (const sim::PlannedDrone& drone : flight.drones()) {
    list.push_back({drone.mission.id, !drone.mission.camera.gimbal.is_rigid()});
  }
  return list;
}

std::vector<std::string> drone_ids(const Flight& flight) {
  std::vector<std::string> ids;
  ids.reserve(flight.drones().size());
  for (const sim::PlannedDrone& drone : flight.drones()) ids.push_back(drone.mission.id);
  return ids;
}

}  // namespace throng::live
