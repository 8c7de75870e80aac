#include "crowd/output/standing.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <string>

namespace throng::crowd {

namespace {

constexpr float kShuffleM = 0.5F;  // swaying, and giving way in a jam
constexpr float kSlowMps = 0.05F;  // no wish to move
constexpr float kAtGoalM = 1;      // as near as others let somebody
constexpr double kRoundingS = 1e-6;

bool wants_to_go(const Simulation& crowd, std::size_t agent) {
  const std::uint8_t state = crowd.states()[agent];
  if (crowd.is_final(state) || !crowd.has_exits(state)) return false;  // who stays for good
  if (crowd.desired_speeds_mps()[agent] <= kSlowMps || crowd.fallen()[agent] != 0) return false;
  return crowd.preferred_velocity(agent).norm() > kSlowMps ||
         crowd.goal_distance_m(agent) > kAtGoalM;
}

std::string states_text(const Simulation& crowd, const std::map<std::uint8_t, int>& counts) {
  std::string text;
  for (const auto& [state, count] : counts) {
    text += fmt::format("{}{} in {}", text.empty() ? "" : ", ", count, crowd.state_names()[state]);
  }
  return text;
}

}  // namespace

void StandingWatch::record(const Simulation& crowd) {
  stays_.resize(crowd.agent_count());
  for (std::size_t i = 0; i < stays_.size(); ++i) {
    Stay& stay = stays_[i];
    if (crowd.present()[i] == 0) {
      stay.known = false;
      continue;
    }
    const Eigen::Vector2f& place = crowd.positions()[i];
    const bool stays =
        stay.known && stay.state == crowd.states()[i] && (place - stay.place).norm() <= kShuffleM;
    if (!stays) stay = {place, crowd.time_s(), crowd.states()[i], true};
  }
}

void StandingWatch::finish(const Simulation& crowd) {
  std::map<std::uint8_t, int> counts;
  double since_s = std::numeric_limits<double>::infinity();
  double until_s = 0;
  int all = 0;
  for (std::size_t i = 0; i < stays_.size(); ++i) {
    const Stay& stay = stays_[i];
    if (!stay.known || crowd.time_s() - stay.since_s < kPatienceS - kRoundingS ||
        !wants_to_go(crowd, i)) {
      continue;
    }
    ++all;
    ++counts[stay.state];
    since_s = std::min(since_s, stay.since_s);
    until_s = std::max(until_s, stay.since_s);
  }
  if (all == 0) return;
  const std::string since = until_s - since_s < 0.05
                                ? fmt::format("since {:.1f} s", since_s)
                                : fmt::format("since {:.1f} to {:.1f} s", since_s, until_s);
  warning_ = Problem{
      "", "",
      fmt::format("{} of {} agents who stand still {} until the end at {:.1f} s although they have "
                  "not arrived ({})",
                  all, stays_.size(), since, crowd.time_s(), states_text(crowd, counts)),
      "a road map, field or velocity component that leads them on to their goals, and room for "
      "them on the way"};
}

}  // namespace throng::crowd
