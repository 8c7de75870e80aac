#include "sim/people/crowd_trace.h"

#include <span>
#include <string>
#include <vector>

#include "base/version.h"
#include "crowd/project/project.h"

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

world::CrowdOrigin crowd_origin(const crowd::LoadOptions& options) {
  return {options.model,
          std::string(crowd::kCompatWords.at(static_cast<std::size_t>(options.compat))),
          options.separation == crowd::BodySeparation::hard,
          std::string(crowd::kConstantsWords.at(static_cast<std::size_t>(options.constants))),
          options.compliance,
          options.physical.on,
          static_cast<double>(options.physical.fall_impulse_ns)};
}

/// Per state: 1 if people in it lie on the ground.
std::vector<std::uint8_t> lying_states(const crowd::Simulation& crowd) {
  std::vector<std::uint8_t> lying;
  for (const std::string& name : crowd.state_names()) {
    const auto state = static_cast<std::uint8_t>(lying.size());
    lying.push_back(crowd.is_lying(state).value_or(world::implies_lying(name)) ? 1 : 0);
  }
  return lying;
}

}  // namespace

world::TraceHeader crowd_header(const crowd::Simulation& crowd, std::uint64_t seed) {
  world::TraceHeader header;
  header.generator = kGenerator;
  header.seed = seed;
  header.dt_s = crowd.dt_s();
  header.crowd = crowd_origin(crowd.options());
  header.state_names = crowd.state_names();
  header.state_lying = lying_states(crowd);
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
  const std::vector<std::uint8_t> lies_in_state = lying_states(crowd);
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_lying = crowd.fallen()[i] != 0 || lies_in_state[step.state[i]] != 0;
    step.flags[i] = static_cast<std::uint8_t>((crowd.present()[i] != 0 ? world::kPresent : 0) |
                                              (crowd.panicked()[i] != 0 ? world::kPanicked : 0) |
                                              (is_lying ? world::kFallen : 0));
  }
  return step;
}

CrowdTrace::CrowdTrace(const std::filesystem::path& path, const std::string& name,
                       const crowd::Simulation& crowd, std::uint64_t seed)
    : trace_(path, named(crowd_header(crowd, seed), name)) {}

void CrowdTrace::record(const crowd::Simulation& crowd) { trace_.add(crowd_step(crowd)); }

void CrowdTrace::finish(const crowd::Simulation&) { trace_.finish(); }

}  // namespace throng::sim
