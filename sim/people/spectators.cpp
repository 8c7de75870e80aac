#include "sim/people/spectators.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#include "sim/people/seated_people.h"

namespace throng::sim {

using Eigen::Vector2f;

namespace {

constexpr float kSpectatorRadiusM = 0.24F;
constexpr float kStairsMps = 0.7F;

template <typename T, typename U>
std::vector<T> extended(std::span<const T> first, std::size_t more, const U& value) {
  std::vector<T> all(first.begin(), first.end());
  all.resize(first.size() + more, T(value));
  return all;
}

class CrowdWithSpectators : public CrowdSource {
 public:
  CrowdWithSpectators(std::unique_ptr<CrowdSource> crowd, Spectators people, std::uint64_t seed)
      : crowd_(std::move(crowd)),
        agents_(crowd_->positions().size()),
        leavers_(people.leave.size()),
        waves_(seed, crowd_->dt_s()),
        states_before_(crowd_->header(seed).state_names.size()) {
    people_ = std::move(people.leave);
    people_.insert(people_.end(), people.stay.begin(), people.stay.end());
    now_.resize(people_.size());
    moving_mps_.resize(people_.size(), Vector2f::Zero());
    on_stand_.resize(people_.size(), 1);
    move_people();
  }

  double dt_s() const override { return crowd_->dt_s(); }

  world::TraceHeader header(std::uint64_t seed) const override {
    world::TraceHeader header = crowd_->header(seed);
    if (!header.state_lying.empty()) {
      header.state_lying.resize(header.state_names.size() + world::kStandStates.size(), 0);
    }
    header.state_names.insert(header.state_names.end(), world::kStandStates.begin(),
                              world::kStandStates.end());
    header.role.resize(count(), world::AgentRole::spectator);
    header.radius_m.resize(count(), kSpectatorRadiusM);
    header.pref_speed_mps.resize(count(), kStairsMps);
    header.group.resize(agents_, -1);
    const auto last = std::max_element(header.group.begin(), header.group.end());
    const std::int32_t first_group = last == header.group.end() ? 0 : *last + 1;
    for (std::size_t i = leavers_; i < people_.size(); ++i) {
      header.group.push_back(people_[i].group < 0 ? -1 : first_group + people_[i].group);
    }
    return header;
  }

  world::CrowdStep now() const override {
    world::CrowdStep step = crowd_->now();
    step.position = positions_;
    step.velocity = velocities_;
    step.yaw_rad.resize(count());
    step.desired_speed_mps.resize(count());
    step.state.resize(count());
    step.exit_intent.resize(count(), -1);
    step.flags.resize(count());
    for (std::size_t i = 0; i < people_.size(); ++i) {
      if (on_stand_[i] == 0) continue;
      const std::size_t agent = agent_of(i);
      const Posture posture = now_[i].posture;
      step.yaw_rad[agent] = now_[i].yaw_rad;
      step.desired_speed_mps[agent] = posture == Posture::leaving ? kStairsMps : 0;
      step.state[agent] =
          static_cast<std::uint8_t>(states_before_ + static_cast<std::size_t>(posture));
      step.flags[agent] = world::kPresent;
    }
    return step;
  }

  std::span<const Vector2f> positions() const override { return positions_; }
  std::span<const Vector2f> velocities() const override { return velocities_; }
  std::span<const std::uint8_t> present() const override { return present_; }
  std::span<const std::uint8_t> on_ground() const override { return on_ground_; }
  std::span<const crowd::GoalId> goals() const override { return goals_; }
  std::span<const crowd::Fall> falls() const override { return crowd_->falls(); }
  std::vector<Problem> warnings() const override { return crowd_->warnings(); }
  bool has_intents() const override { return crowd_->has_intents(); }

  void step() override {
    crowd_->step();
    ++steps_;
    move_people();
  }
  void set_present(std::size_t agent, bool present) override {
    if (agent >= agents_) return;
    crowd_->set_present(agent, present);
    present_[agent] = on_ground_[agent] = crowd_->present()[agent];
    velocities_[agent] = crowd_->velocities()[agent];
    if (agent + leavers_ < agents_) return;
    on_stand_[agent + leavers_ - agents_] = present ? 1 : 0;
    if (present) present_[agent] = 1;
  }
  void move_goal(int set, int goal, const Vector2f& center) override {
    crowd_->move_goal(set, goal, center);
  }
  void strike(std::size_t agent, const Vector2f& impulse_ns) override {
    if (agent < agents_) crowd_->strike(agent, impulse_ns);
  }

 private:
  std::size_t count() const { return agents_ - leavers_ + people_.size(); }
  /// People who leave are the crowd's last agents, and the others follow.
  std::size_t agent_of(std::size_t person) const { return agents_ - leavers_ + person; }

  void move_people() {
    const double time_s = static_cast<double>(steps_) * dt_s();
    const auto per_s = static_cast<float>(steps_ > 0 ? 1 / dt_s() : 0);
    const auto arrived = crowd_->present();
    for (std::size_t i = 0; i < people_.size(); ++i) {
      if (i < leavers_ && arrived[agent_of(i)] != 0) on_stand_[i] = 0;
      if (on_stand_[i] == 0) continue;
      const SpectatorNow now = spectator_at(people_[i], waves_, time_s);
      moving_mps_[i] = per_s * (now.position - now_[i].position);
      now_[i] = now;
    }
    join();
  }

  /// The crowd's agents with those who are still on the stands, then those who stay there.
  void join() {
    const std::size_t more = people_.size() - leavers_;
    positions_ = extended(crowd_->positions(), more, Vector2f::Zero());
    velocities_ = extended(crowd_->velocities(), more, Vector2f::Zero());
    on_ground_ = extended(crowd_->present(), more, 0);
    present_ = on_ground_;
    goals_ = extended(crowd_->goals(), more, crowd::GoalId());
    for (std::size_t i = 0; i < people_.size(); ++i) {
      if (on_stand_[i] == 0) continue;
      const std::size_t agent = agent_of(i);
      positions_[agent] = now_[i].position;
      velocities_[agent] = moving_mps_[i];
      present_[agent] = 1;
      goals_[agent] = {};
    }
  }

  std::unique_ptr<CrowdSource> crowd_;
  std::size_t agents_;             ///< of the crowd
  std::size_t leavers_;            ///< of these, people of the stands
  std::vector<Spectator> people_;  ///< those who leave first
  CheeringWaves waves_;
  std::size_t states_before_;
  std::vector<SpectatorNow> now_;
  std::vector<Vector2f> moving_mps_;
  std::vector<std::uint8_t> on_stand_;  ///< 1 until the crowd has them
  long steps_ = 0;
  std::vector<Vector2f> positions_;
  std::vector<Vector2f> velocities_;
  std::vector<std::uint8_t> present_;
  std::vector<std::uint8_t> on_ground_;
  std::vector<crowd::GoalId> goals_;
};

/// Whether the crowd's last agents are people who have not arrived yet.
bool has_leavers(const CrowdSource& crowd, std::size_t count) {
  const auto present = crowd.present();
  return count <= present.size() &&
         std::all_of(present.end() - static_cast<std::ptrdiff_t>(count), present.end(),
                     [](std::uint8_t is_present) { return is_present == 0; });
}

}  // namespace

std::unique_ptr<CrowdSource> with_spectators(std::unique_ptr<CrowdSource> crowd,
                                             const world::Scenario& scenario, std::uint64_t seed,
                                             std::vector<Problem>& problems) {
  const bool is_recorded = !crowd->has_intents();
  Spectators people = take_seats(scenario, seed, is_recorded);
  if (people.stay.empty() && people.leave.empty()) return crowd;
  constexpr std::size_t kMaxStates = std::numeric_limits<std::uint8_t>::max();
  if (const std::size_t states = crowd->header(seed).state_names.size();
      states + world::kStandStates.size() > kMaxStates) {
    problems.push_back({scenario.id, "/crowd/behavior", fmt::format("{} states", states),
                        fmt::format("at most {} where there are spectators",
                                    kMaxStates - world::kStandStates.size())});
    return crowd;
  }
  if (!has_leavers(*crowd, people.leave.size())) {
    problems.push_back({scenario.id, "/stands", "spectators who leave",
                        fmt::format("a crowd whose last {} agents arrive at the feet of aisles, as "
                                    "a blueprint's do",
                                    people.leave.size())});
    return crowd;
  }
  return std::make_unique<CrowdWithSpectators>(std::move(crowd), std::move(people), seed);
}

}  // namespace throng::sim
