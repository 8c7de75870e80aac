#include "render/animator.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <string>

#include "base/compute/random.h"
#include "base/geometry/angle.h"

namespace throng::render {

namespace {

using skinning::Gaze;
using skinning::Moment;

/// When somebody looks at drones: now and then, if at all.
struct Curiosity {
  bool looks;
  double every_s;
  double for_s;
  double offset_s;

  explicit Curiosity(Random random)
      : looks(random.uniform() < 0.6),
        every_s(random.uniform(10, 22)),
        for_s(random.uniform(3, 6)),
        offset_s(random.uniform(0, 22)) {}
  bool at(double time_s) const { return looks && std::fmod(time_s + offset_s, every_s) < for_s; }
};

/// Direction of a drone that is near and high enough to be looked at.
Gaze gaze_at(const Eigen::Vector3d& drone, const Eigen::Vector2f& from, float yaw_rad) {
  constexpr double kFarM = 45;
  constexpr double kEyesM = 1.6;
  constexpr double kMinElevationRad = 15 * kDegree;
  constexpr double kAhead = 35 * kDegree;
  constexpr double kBehind = 120 * kDegree;
  const Eigen::Vector2d to = drone.head<2>() - from.cast<double>();
  const double away = to.norm();
  if (away > kFarM || std::atan2(drone.z() - kEyesM, away) < kMinElevationRad) return Gaze::none;
  const double bearing =
      geometry::turn_rad(static_cast<double>(yaw_rad), std::atan2(to.y(), to.x()));
  if (std::abs(bearing) < kAhead) return Gaze::ahead;
  if (std::abs(bearing) > kBehind) return Gaze::none;
  return bearing > 0 ? Gaze::left : Gaze::right;
}

/// One agent of a trace as its motion sees it.
class Watcher {
 public:
  explicit Watcher(const world::Trace& trace)
      : trace_(trace), drones_(trace.steps()), has_company_(trace.agents(), 0) {
    find_company();
    for (const std::string& name : trace.header.state_names) {
      watches_.push_back(name == world::kWatchState ? 1 : 0);
    }
    for (std::size_t step = 0; step < trace.steps(); ++step) {
      for (std::size_t drone = 0; drone < trace.drones.size(); ++drone) {
        if (trace.drones[drone].empty()) continue;
        drones_[step].push_back(trace.drone_at(drone, trace.time_s[step]).position);
      }
    }
  }

  Moment moment(std::size_t agent, std::size_t step, const Curiosity& curiosity) const {
    const std::size_t at = trace_.at(step, agent);
    Moment moment;
    moment.position = trace_.position[at];
    moment.yaw_rad = trace_.yaw_rad[at];
    moment.down = (trace_.flags[at] & world::kFallen) != 0;
    moment.panicked = (trace_.flags[at] & world::kPanicked) != 0;
    moment.setting = setting(agent, at, moment.panicked);
    if (!curiosity.at(trace_.time_s[step])) return moment;
    for (const Eigen::Vector3d& drone : drones_[step]) {
      moment.gaze = gaze_at(drone, moment.position, moment.yaw_rad);
      if (moment.gaze != Gaze::none) break;
    }
    return moment;
  }

 private:
  void find_company() {
    const std::vector<std::int32_t>& group = trace_.header.group;
    std::map<std::int32_t, int> size;
    for (const std::int32_t of_agent : group) ++size[of_agent];
    for (std::size_t agent = 0; agent < group.size(); ++agent) {
      has_company_[agent] = group[agent] >= 0 && size[group[agent]] > 1 ? 1 : 0;
    }
  }

  skinning::Setting setting(std::size_t agent, std::size_t at, bool panicked) const {
    if (panicked) return skinning::Setting::fear;
    // Traces of earlier versions may have no states.
    const std::size_t state = at < trace_.state.size() ? trace_.state[at] : watches_.size();
    if (state < watches_.size() && watches_[state] != 0) return skinning::Setting::audience;
    return has_company_[agent] != 0 ? skinning::Setting::company : skinning::Setting::alone;
  }

  const world::Trace& trace_;
  std::vector<std::vector<Eigen::Vector3d>> drones_;  ///< [step]
  std::vector<char> has_company_;                     ///< by agent
  std::vector<char> watches_;                         ///< by state
};

}  // namespace

Animator::Animator(const world::Trace& trace, const skinning::Population& population,
                   const skinning::Styling& styling, std::span<const world::Stand> stands,
                   std::span<const world::Sitter> sitters)
    : trace_(&trace),
      stays_(trace.agents()),
      on_stands_(trace, stands, sitters),
      poses_on_stands_(population) {
  const Watcher watcher(trace);
  std::vector<Moment> moments;
  for (std::size_t agent = 0; agent < trace.agents(); ++agent) {
    appearance_.push_back(skinning::sample_appearance(population, trace.header.seed,
                                                      static_cast<std::uint32_t>(agent), styling,
                                                      find_spot(trace.header, agent)));
    if (!world::is_visible_person(trace.header.role[agent])) continue;
    const std::uint64_t key = derive_seed(trace.header.seed, Stream::motion, agent);
    const Curiosity curiosity(Random(key, Stream::motion, 1));
    const auto is_walker = [&](std::size_t step) {
      return trace.present(step, agent) && !on_stands_.has_posture(agent, step);
    };
    for (std::size_t step = 0; step < trace.steps(); ++step) {
      if (!is_walker(step)) continue;
      const std::size_t first = step;
      moments.clear();
      for (; step < trace.steps() && is_walker(step); ++step) {
        moments.push_back(watcher.moment(agent, step, curiosity));
      }
      stays_[agent].push_back({first, skinning::MotionPlan(population, appearance_.back(),
                                                           derive_seed(key, Stream::motion, first),
                                                           moments, trace.header.dt_s)});
    }
  }
}

const Animator::Stay& Animator::stay_at(std::size_t agent, std::size_t step) const {
  const std::vector<Stay>& stays = stays_[agent];
  return *(std::upper_bound(stays.begin(), stays.end(), step,
                            [](std::size_t at, const Stay& s) { return at < s.first_step; }) -
           1);
}

skinning::Actions Animator::actions_at(std::size_t agent, std::size_t step) const {
  if (!world::is_visible_person(trace_->header.role[agent])) return {};
  if (const auto posture = on_stands_.posture_at(agent, step, trace_->time_s[step])) {
    return skinning::SpectatorPoses::actions(*posture, appearance_[agent].phase_offset);
  }
  const Stay& stay = stay_at(agent, step);
  return stay.plan.actions_at(static_cast<double>(step - stay.first_step));
}

void Animator::pose(std::size_t agent, const world::BetweenSteps& at, double time_s,
                    PersonInstance& person) const {
  if (const auto posture = on_stands_.posture_at(agent, at.before, time_s)) {
    person.pose = poses_on_stands_.at(*posture, person.appearance.phase_offset, time_s);
    person.actions = skinning::SpectatorPoses::actions(*posture, person.appearance.phase_offset);
    return;
  }
  const Stay& stay = stay_at(agent, at.before);
  const float share = trace_->present(at.after, agent) ? at.share : 0;
  const double step = static_cast<double>(at.before - stay.first_step) + static_cast<double>(share);
  person.pose = stay.plan.at(step);
  person.actions = stay.plan.actions_at(step);
}

Scene Animator::scene_at(double time_s, std::int64_t frame_index) const {
  const world::Trace& trace = *trace_;
  Scene scene;
  scene.index = frame_index;
  scene.time_s = time_s;
  if (trace.steps() == 0) return scene;
  const world::BetweenSteps at = trace.steps_around(time_s);
  for (std::size_t agent = 0; agent < trace.agents(); ++agent) {
    if (!trace.present(at.before, agent)) continue;
    if (!world::is_visible_person(trace.header.role[agent])) {
      scene.dangers.push_back(trace.position[trace.at(at.before, agent)]);
      continue;
    }
    PersonInstance person;
    person.agent = static_cast<std::uint32_t>(agent);
    person.appearance = appearance_[agent];
    person.position.head<2>() = trace.position_at(at, agent);
    person.velocity = trace.velocity_at(at, agent);
    person.yaw_rad = trace.yaw_at(at, agent);
    person.position.z() = on_stands_.floors().height_m(person.position.head<2>());
    pose(agent, at, time_s, person);
    scene.people.push_back(person);
  }
  return scene;
}

}  // namespace throng::render
