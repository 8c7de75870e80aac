#include "live/flight/replay_job.h"

#include <fmt/core.h>

#include <string>
#include <vector>

namespace throng::live {

jobs::JobSpec replay_job(const jobs::JobSpec& flown, const sim::RemotePilots& pilots,
                         double duration_s) {
  jobs::JobSpec job = flown;
  job.runs = 1;
  job.name = (flown.name.empty() ? "live flight" : flown.name + ", flown").substr(0, 200);
  for (std::size_t i = 0; i < job.drones.size(); ++i) {
    sim::DroneMission& mission = job.drones[i].mission;
    mission.policy = "pilot_log";
    mission.waypoints.clear();
    mission.guidance = {};
    mission.guidance.setpoints = pilots.log(i);
    job.drones[i].pilot_log.clear();
    // Values sampled for the former policy.
    std::erase_if(job.randomize, [&](const jobs::RandomField& field) {
      return field.path.starts_with(fmt::format("drones.{}.guidance.", i));
    });
  }
  std::erase_if(job.randomize,
                [](const jobs::RandomField& field) { return field.path.starts_with("capture."); });
  job.capture.to_s = duration_s;
  job.capture.run_to_s.reset();
  if (job.capture.from_s >= duration_s) job.capture.from_s = 0;
  return job;
}

}  // namespace throng::live
