#include "sim/crowd_trace.h"

#include <span>
#include <vector>

#include "base/version.h"

namespace throng::sim {

namespace {

template <typename T>
std::vector<T> copied(std::span<const T> values) {
  return {values.begin(), values.end()};
}

world::TraceHeader named(world::TraceHeader header, const std::string& name) {
  header.scenario_id = name;
  return header;
}

}  // namespace

world::TraceHeader crowd_header(const crowd::Simulation& crowd, std::uint64_t seed) {
  world::TraceHeader header;
  header.generator = kGenerator;
  header.seed = seed;
  header.dt_s = crowd.dt_s();
  header.state_names = crowd.state_names();
  header.role.assign(crowd.agent_count(), world::AgentRole::person);
  header.radius_m = copied(crowd.radii_m());
  header.pref_speed_mps = copied(crowd.desired_speeds_mps());
  header.group = copied(crowd.social_groups());
  return header;
}

world::CrowdStep crowd_step(const crowd::Simulation& crowd) {
  const std::size_t count = crowd.agent_count();
  world::CrowdStep step;
  step.time_s = crowd.time_s();
  step.position = copied(crowd.positions());
  step.velocity = copied(crowd.velocities());
  step.yaw_rad = copied(crowd.yaws_rad());
  step.desired_speed_mps = copied(crowd.desired_speeds_mps());
  step.state = copied(crowd.states());
  step.exit_intent.assign(count, -1);
  step.flags.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    step.flags[i] = static_cast<std::uint8_t>((crowd.present()[i] != 0 ? world::kPresent : 0) |
                                              (crowd.panicked()[i] != 0 ? world::kPanicked : 0) |
                                              (crowd.fallen()[i] != 0 ? world::kFallen : 0));
  }
  return step;
}

CrowdTrace::CrowdTrace(const std::filesystem::path& path, const std::string& name,
                       const crowd::Simulation& crowd, std::uint64_t seed)
    : trace_(path, named(crowd_header(crowd, seed), name)) {}

void CrowdTrace::record(const crowd::Simulation& crowd) { trace_.add(crowd_step(crowd)); }

void CrowdTrace::finish(const crowd::Simulation&) { trace_.finish(); }

}  // namespace throng::sim
