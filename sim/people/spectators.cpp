#include "sim/people/spectators.h"

#include <algorithm>
#include <utility>

#include "base/compute/random.h"
#include "base/geometry/angle.h"
#include "sim/people/cheering.h"
#include "world/stand_seats.h"

namespace throng::sim {

using Eigen::Vector2f;

namespace {

constexpr float kRadiusM = 0.24F;
constexpr float kStairsMps = 0.7F;
constexpr std::array kStateNames = {"sitting", "standing", "cheering"};

/// A person on a seat.
struct Spectator {
  std::uint64_t key = 0;              ///< of random numbers
  Vector2f seat = Vector2f::Zero();   ///< m
  Vector2f ahead = Vector2f::Zero();  ///< from there to where the person stands (m)
  float yaw_rad = 0;
  double place = 0;  ///< of the block among all blocks, 0 to 1
};

std::vector<Spectator> take_seats(const world::Scenario& scenario, std::uint64_t seed) {
  std::vector<Spectator> people;
  std::vector<int> blocks;  // of each spectator, counted over all stands
  int first_block = 0;
  for (const world::Stand& stand : scenario.stands) {
    const std::vector<world::Seat> seats = world::seats(stand);
    const double yaw_rad = world::facing_rad(stand);
    const Vector2f facing = Eigen::Vector2d(std::cos(yaw_rad), std::sin(yaw_rad)).cast<float>();
    for (const std::size_t i : world::taken_seats(stand, seats)) {
      Spectator& person = people.emplace_back();
      person.key = derive_seed(seed, Stream::spectators, people.size() + (1ULL << 32U));
      person.seat = seats[i].position.cast<float>();
      person.ahead = static_cast<float>(world::standing_ahead_m(stand)) * facing;
      Random random(person.key, Stream::spectators);
      person.yaw_rad =
          static_cast<float>(geometry::wrapped_rad(yaw_rad + random.uniform(-8, 8) * kDegree));
      blocks.push_back(first_block + seats[i].block);
    }
    first_block += static_cast<int>(world::inner_aisles(stand)) + 1;
  }
  for (std::size_t i = 0; i < people.size(); ++i) {
    people[i].place = static_cast<double>(blocks[i]) / std::max(1, first_block - 1);
  }
  return people;
}

template <typename T, typename U>
std::vector<T> joined(std::span<const T> first, std::size_t more, const U& value) {
  std::vector<T> all(first.begin(), first.end());
  all.resize(first.size() + more, T(value));
  return all;
}

class CrowdWithSpectators : public CrowdSource {
 public:
  CrowdWithSpectators(std::unique_ptr<CrowdSource> crowd, std::vector<Spectator> people,
                      std::uint64_t seed)
      : crowd_(std::move(crowd)),
        people_(std::move(people)),
        waves_(seed, crowd_->dt_s()),
        agents_(crowd_->positions().size()),
        postures_(people_.size()),
        rising_m_(people_.size(), Vector2f::Zero()),
        states_before_(crowd_->header(seed).state_names.size()) {
    move_people();
  }

  double dt_s() const override { return crowd_->dt_s(); }

  world::TraceHeader header(std::uint64_t seed) const override {
    world::TraceHeader header = crowd_->header(seed);
    const std::size_t all = agents_ + people_.size();
    if (!header.state_lying.empty()) {
      header.state_lying.resize(header.state_names.size() + kStateNames.size(), 0);
    }
    header.state_names.insert(header.state_names.end(), kStateNames.begin(), kStateNames.end());
    header.role.resize(all, world::AgentRole::spectator);
    header.radius_m.resize(all, kRadiusM);
    header.pref_speed_mps.resize(all, kStairsMps);
    header.group.resize(all, -1);
    return header;
  }

  world::CrowdStep now() const override {
    world::CrowdStep step = crowd_->now();
    step.position = positions_;
    step.velocity = velocities_;
    for (std::size_t i = 0; i < people_.size(); ++i) {
      step.yaw_rad.push_back(people_[i].yaw_rad);
      step.desired_speed_mps.push_back(0);
      step.state.push_back(
          static_cast<std::uint8_t>(states_before_ + static_cast<std::size_t>(postures_[i])));
      step.exit_intent.push_back(-1);
      step.flags.push_back(world::kPresent);
    }
    return step;
  }

  std::span<const Vector2f> positions() const override { return positions_; }
  std::span<const Vector2f> velocities() const override { return velocities_; }
  std::span<const std::uint8_t> present() const override { return present_; }
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
    join();
  }
  void move_goal(int set, int goal, const Vector2f& center) override {
    crowd_->move_goal(set, goal, center);
  }
  void strike(std::size_t agent, const Vector2f& impulse_ns) override {
    if (agent < agents_) crowd_->strike(agent, impulse_ns);
  }

 private:
  void move_people() {
    const double time_s = static_cast<double>(steps_) * dt_s();
    const auto per_s = static_cast<float>(steps_ > 0 ? 1 / dt_s() : 0);
    rising_mps_.assign(people_.size(), Vector2f::Zero());
    for (std::size_t i = 0; i < people_.size(); ++i) {
      const Spectator& person = people_[i];
      const PostureNow now = waves_.posture_at(time_s, person.key, person.place);
      const Vector2f risen_m = static_cast<float>(now.risen) * person.ahead;
      rising_mps_[i] = per_s * (risen_m - rising_m_[i]);
      rising_m_[i] = risen_m;
      postures_[i] = now.posture;
    }
    join();
  }

  /// The crowd's agents, then the spectators.
  void join() {
    const std::size_t more = people_.size();
    positions_ = joined(crowd_->positions(), more, Vector2f::Zero());
    velocities_ = joined(crowd_->velocities(), more, Vector2f::Zero());
    present_ = joined(crowd_->present(), more, 1);
    goals_ = joined(crowd_->goals(), more, crowd::GoalId());
    for (std::size_t i = 0; i < more; ++i) {
      positions_[agents_ + i] = people_[i].seat + rising_m_[i];
      velocities_[agents_ + i] = rising_mps_[i];
    }
  }

  std::unique_ptr<CrowdSource> crowd_;
  std::vector<Spectator> people_;
  CheeringWaves waves_;
  std::size_t agents_;  ///< of the crowd
  std::vector<Posture> postures_;
  std::vector<Vector2f> rising_m_;  ///< from the seats
  std::vector<Vector2f> rising_mps_;
  std::size_t states_before_;
  long steps_ = 0;
  std::vector<Vector2f> positions_;
  std::vector<Vector2f> velocities_;
  std::vector<std::uint8_t> present_;
  std::vector<crowd::GoalId> goals_;
};

}  // namespace

std::size_t count_spectators(const world::Scenario& scenario) {
  std::size_t count = 0;
  for (const world::Stand& stand : scenario.stands) {
    count += static_cast<std::size_t>(stand.spectators.count);
  }
  return count;
}

std::unique_ptr<CrowdSource> with_spectators(std::unique_ptr<CrowdSource> crowd,
                                             const world::Scenario& scenario, std::uint64_t seed) {
  if (count_spectators(scenario) == 0) return crowd;
  return std::make_unique<CrowdWithSpectators>(std::move(crowd), take_seats(scenario, seed), seed);
}

}  // namespace throng::sim
