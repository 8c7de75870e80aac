#include "render/animator.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace throng::render {

namespace {

/// Two neighbouring crowd steps and how far between them.
struct Between {
  std::size_t before;
  std::size_t after;
  float share;
};

Between find(const std::vector<double>& times, double time_s) {
  const auto next = std::upper_bound(times.begin(), times.end(), time_s);
  if (next == times.begin()) return {0, 0, 0};
  const auto before = static_cast<std::size_t>(next - times.begin()) - 1;
  if (next == times.end()) return {before, before, 0};
  return {before, before + 1,
          static_cast<float>((time_s - times[before]) / (*next - times[before]))};
}

/// From a to b along the shorter arc.
float turned(float a, float b, float share) {
  constexpr float kTurn = 2 * std::numbers::pi_v<float>;
  return a + share * std::remainder(b - a, kTurn);
}

}  // namespace

Animator::Animator(const world::Trace& trace, const skinning::Population& population)
    : trace_(&trace), population_(&population), phase_(trace.agents() * trace.steps(), 0.0) {
  std::vector<float> speed_mps(trace.steps());
  for (std::size_t agent = 0; agent < trace.agents(); ++agent) {
    appearance_.push_back(
        skinning::appearance_of(population, trace.header.seed, static_cast<std::uint32_t>(agent)));
    for (std::size_t step = 0; step < trace.steps(); ++step) {
      speed_mps[step] = trace.velocity[trace.at(step, agent)].norm();
    }
    const skinning::Appearance& appearance = appearance_.back();
    skinning::integrate_phase(speed_mps, trace.header.dt_s,
                              population.characters[appearance.character].stature_m, appearance,
                              std::span(phase_).subspan(agent * trace.steps(), trace.steps()));
  }
}

Scene Animator::scene_at(double time_s, std::int64_t frame_index) const {
  const world::Trace& trace = *trace_;
  Scene scene;
  scene.index = frame_index;
  scene.time_s = time_s;
  if (trace.steps() == 0) return scene;
  const Between at = find(trace.time_s, time_s);
  for (std::size_t agent = 0; agent < trace.agents(); ++agent) {
    if (trace.header.role[agent] != world::AgentRole::person) continue;
    if (!trace.present(at.before, agent)) continue;
    const std::size_t a = trace.at(at.before, agent);
    const std::size_t b = trace.at(at.after, agent);
    const double* phase = &phase_[agent * trace.steps()];
    PersonInstance person;
    person.agent = static_cast<std::uint32_t>(agent);
    person.appearance = appearance_[agent];
    person.position.head<2>() =
        trace.position[a] + at.share * (trace.position[b] - trace.position[a]);
    person.velocity = trace.velocity[a] + at.share * (trace.velocity[b] - trace.velocity[a]);
    person.yaw_rad = turned(trace.yaw_rad[a], trace.yaw_rad[b], at.share);
    const double strides = phase[at.before] + at.share * (phase[at.after] - phase[at.before]);
    // People who stand must not breathe in step: each lives a little ahead of the clock.
    constexpr double kSpread_s = 20;
    person.pose =
        skinning::pose_at(*population_, strides, person.velocity.norm(),
                          time_s + kSpread_s * static_cast<double>(person.appearance.phase_offset));
    scene.people.push_back(person);
  }
  return scene;
}

}  // namespace throng::render
