#include "sim/policies/queue_model.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace throng::sim {

namespace {

constexpr double kNeverS = 600;               // to wait for a closed door
constexpr double kPriorPerMeterSecond = 1.1;  // discs of 0.4 m through clean doors
constexpr double kPressM = 4;                 // from the door: who is nearer presses on it
constexpr int kPressPeople = 4;
constexpr double kExpected = 0.8;   // of those who have not noticed yet
constexpr double kSurePrior = 100;  // looks: at first everybody is taken to choose the nearest exit
constexpr double kMemory = 0.99;    // per look
constexpr double kOnTheWayM = 6;    // farther from the door it was a choice
constexpr double kLearning = 0.02;  // per look, of the rate
constexpr double kMinSpeedPart = 0.5;
constexpr double kMaxSpeedPart = 1.5;

double prior_per_s(const world::Exit& exit) {
  return exit.capacity ? exit.capacity->per_s_at(exit.width_m())
                       : kPriorPerMeterSecond * exit.width_m();
}

}  // namespace

QueueModel::QueueModel(const world::Scenario& scenario)
    : scenario_(scenario),
      people_(scenario.exits.size()),
      habits_(scenario.exits.size(), std::vector<double>(scenario.exits.size())) {
  for (const world::Exit& exit : scenario.exits) {
    capacity_per_s_.push_back(prior_per_s(exit));
  }
}

void QueueModel::update(const WorldView& view, int self) {
  time_s_ = view.time_s;
  std::fill(people_.begin(), people_.end(), 0);
  std::vector<int> pressing(people_.size());
  learn_habits(view);
  for (const PersonSeen& person : view.people) {
    if (person.guide >= 0) continue;
    if (person.exit < 0) {
      expect(person);
      continue;
    }
    const std::size_t e = index(ends_up_at(person));
    people_[e] += 1;
    if ((person.position - scenario_.exits[e].middle()).norm() < kPressM) ++pressing[e];
  }
  for (std::size_t d = 0; d < view.drones.size(); ++d) {
    const LeadPlan& plan = view.drones[d].plan;
    if (static_cast<int>(d) == self || plan.to < 0) continue;
    people_[index(plan.to)] += plan.people;
    if (!plan.leads && plan.from >= 0) {
      double& left = people_[index(plan.from)];
      left = std::max(0.0, left - plan.people);
    }
  }
  for (std::size_t e = 0; e < people_.size(); ++e) {
    if (pressing[e] < kPressPeople) continue;
    const double prior = prior_per_s(scenario_.exits[e]);
    const double learned =
        capacity_per_s_[e] + kLearning * (view.exit_flow_per_s[e] - capacity_per_s_[e]);
    capacity_per_s_[e] = std::clamp(learned, kMinSpeedPart * prior, kMaxSpeedPart * prior);
  }
}

// People who are informed later choose like earlier people at the same place.
void QueueModel::learn_habits(const WorldView& view) {
  for (std::vector<double>& chosen : habits_) {
    for (double& looks : chosen) looks *= kMemory;
  }
  for (const PersonSeen& person : view.people) {
    if (person.guide >= 0 || person.exit < 0) continue;
    const std::size_t e = index(ends_up_at(person));
    if ((person.position - scenario_.exits[e].middle()).norm() < kOnTheWayM) continue;
    habits_[nearest_exit(person.position)][e] += 1;
  }
}

void QueueModel::expect(const PersonSeen& unaware) {
  const std::size_t nearest = nearest_exit(unaware.position);
  const std::vector<double>& chosen = habits_[nearest];
  const double all = std::accumulate(chosen.begin(), chosen.end(), kSurePrior);
  people_[nearest] += kExpected * kSurePrior / all;
  for (std::size_t e = 0; e < people_.size(); ++e) people_[e] += kExpected * chosen[e] / all;
}

std::size_t QueueModel::nearest_exit(const Eigen::Vector2d& place) const {
  const auto nearer = [&](const world::Exit& a, const world::Exit& b) {
    if (a.is_open(time_s_) != b.is_open(time_s_)) return a.is_open(time_s_);
    return (a.middle() - place).squaredNorm() < (b.middle() - place).squaredNorm();
  };
  return static_cast<std::size_t>(
      std::min_element(scenario_.exits.begin(), scenario_.exits.end(), nearer) -
      scenario_.exits.begin());
}

int QueueModel::ends_up_at(const PersonSeen& person) const {
  if (is_open(person.exit)) return person.exit;
  return static_cast<int>(nearest_exit(scenario_.exits[index(person.exit)].middle()));
}

double QueueModel::wait_s(int exit) const {
  return is_open(exit) ? people_[index(exit)] / capacity_per_s_[index(exit)] : kNeverS;
}

// Leaving a queue shortens it for the people behind, joining one lengthens it for those who come
// after: m people led save m (wait_from - wait_to) - m²/2 (1/C_from + 1/C_to).
double QueueModel::saving_s(int from, int to, double arrive_s, double people) const {
  const double difference_s = wait_s(from) - std::max(wait_s(to), arrive_s);
  const double shorter_s = is_open(from) ? 1 / capacity_per_s_[index(from)] : 0;
  const double longer_s = 1 / capacity_per_s_[index(to)];
  return people * difference_s - 0.5 * people * people * (shorter_s + longer_s);
}

double QueueModel::saving_of_idle_s(double idle_s, int to, double arrive_s, double people) const {
  const double difference_s = idle_s - std::max(wait_s(to), arrive_s);
  return people * difference_s - 0.5 * people * people / capacity_per_s_[index(to)];
}

}  // namespace throng::sim
