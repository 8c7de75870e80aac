#include "metrics/exits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/error.h"
#include "base/parallel.h"
#include "metrics/control_zone.h"
#include "metrics/crossings.h"
#include "metrics/exit_state.h"

namespace throng::metrics {

namespace {

using world::Trace;

constexpr double kFlowWindowS = 4.0;

std::vector<std::size_t> people_of(const Trace& trace) {
  std::vector<std::size_t> people;
  for (std::size_t agent = 0; agent < trace.agents(); ++agent) {
    if (trace.header.role[agent] == world::AgentRole::person) people.push_back(agent);
  }
  return people;
}

double mean_radius_m(const Trace& trace, const std::vector<std::size_t>& people) {
  double sum = 0;
  for (const std::size_t person : people) sum += trace.header.radius_m[person];
  return people.empty() ? 0.0 : sum / static_cast<double>(people.size());
}

// What the trace calls this exit in Trace::exit_intent, if it knows it.
std::optional<std::size_t> intent_of(const Trace& trace, const std::string& exit_id) {
  const auto& ids = trace.header.exit_ids;
  const auto found = std::find(ids.begin(), ids.end(), exit_id);
  if (found == ids.end()) return std::nullopt;
  return static_cast<std::size_t>(found - ids.begin());
}

// Measures one exit from the first step to the last.
class ExitObserver {
 public:
  ExitObserver(const Trace& trace, const world::Exit& exit, const ControlZone& zone,
               const std::vector<std::size_t>& people)
      : trace_(trace),
        people_(people),
        zone_(zone),
        middle_(exit.middle()),
        intent_(intent_of(trace, exit.id)),
        mean_radius_m_(mean_radius_m(trace, people)),
        line_(exit, mean_radius_m_),
        capacity_per_s_(capacity_per_s(exit.width_m())),
        state_(exit.width_m()),
        counters_(people.size()) {
    if (people.empty()) return;
    const double fills_door = exit.width_m() / (2 * mean_radius_m_);
    // Slack: radii are stored as float, and 2 / (2 * 0.2f) must not round up to 6.
    demand_from_ = static_cast<int>(std::ceil(fills_door - 1e-6)) + 1;
  }

  std::vector<ExitSample> observe() {
    const auto window = static_cast<std::size_t>(std::lround(kFlowWindowS / trace_.header.dt_s));
    std::vector<ExitSample> samples;
    samples.reserve(trace_.steps());
    for (std::size_t step = 0; step < trace_.steps(); ++step) {
      const int crossed_before = step > window ? samples[step - window].crossed : 0;
      samples.push_back(observe_step(step, crossed_before));
    }
    return samples;
  }

 private:
  struct Zone {
    int count = 0;
    double approach_speed_mps = 0;
    double desired_speed_mps = 0;
  };

  ExitSample observe_step(std::size_t step, int crossed_before) {
    const double time_s = trace_.time_s[step];
    count_crossings(step, time_s);
    const Zone zone = look_at_zone(step);
    ExitSample sample;
    sample.in_zone = zone.count;
    sample.density_per_m2 = zone.count / zone_.area_m2();
    sample.normalised_density = sample.density_per_m2 * close_packing_m2();
    sample.approach_speed_mps = zone.approach_speed_mps;
    sample.crossed = crossed_;
    sample.flow_per_s = (crossed_ - crossed_before) / kFlowWindowS;
    sample.since_crossing_s = time_s - last_outward_s_;
    const ExitDemand demand{zone.count >= demand_from_ && !people_.empty(), zone.desired_speed_mps};
    sample.state = state_.step(time_s, sample, demand);
    sample.clogging_index = clogging_index(sample, demand, capacity_per_s_);
    return sample;
  }

  void count_crossings(std::size_t step, double time_s) {
    for (std::size_t i = 0; i < people_.size(); ++i) {
      if (!trace_.present(step, people_[i])) continue;
      const int crossing = counters_[i].step(line_, position(step, people_[i]));
      crossed_ += crossing;
      if (crossing > 0) last_outward_s_ = time_s;
    }
  }

  Zone look_at_zone(std::size_t step) const {
    Zone zone;
    for (const std::size_t person : people_) {
      const std::size_t at = trace_.at(step, person);
      if (!trace_.present(step, person)) continue;
      if (intent_ && trace_.exit_intent[at] != static_cast<int>(*intent_)) continue;
      const Eigen::Vector2d place = position(step, person);
      if (!zone_.contains(place)) continue;
      ++zone.count;
      zone.approach_speed_mps +=
          trace_.velocity[at].cast<double>().dot((middle_ - place).normalized());
      zone.desired_speed_mps += trace_.desired_speed_mps[at];
    }
    if (zone.count > 0) {
      zone.approach_speed_mps /= zone.count;
      zone.desired_speed_mps /= zone.count;
    }
    return zone;
  }

  // Ground per person at close packing: discs of the mean radius in a hexagonal lattice.
  double close_packing_m2() const {
    return 2 * std::numbers::sqrt3 * mean_radius_m_ * mean_radius_m_;
  }

  Eigen::Vector2d position(std::size_t step, std::size_t agent) const {
    return trace_.position[trace_.at(step, agent)].cast<double>();
  }

  const Trace& trace_;
  const std::vector<std::size_t>& people_;
  const ControlZone& zone_;
  Eigen::Vector2d middle_;
  std::optional<std::size_t> intent_;  ///< empty: the trace does not say who wants this exit
  double mean_radius_m_;
  ExitLine line_;
  double capacity_per_s_;
  ExitStateMachine state_;
  std::vector<CrossingCounter> counters_;
  int demand_from_ = 1;
  int crossed_ = 0;
  double last_outward_s_ = 0;
};

// One zone per exit; throws for exits at which nothing can be measured.
std::vector<ControlZone> zones_of(const world::Scenario& scenario) {
  std::vector<ControlZone> zones;
  std::vector<Problem> problems;
  for (std::size_t i = 0; i < scenario.exits.size(); ++i) {
    const world::Exit& exit = scenario.exits[i];
    const std::string where = fmt::format("/exits/{}", i);
    if (!(exit.width_m() > 0)) {
      problems.push_back({scenario.id, where, "a door without width", "two different end points"});
      continue;
    }
    zones.emplace_back(exit, scenario.buildings);
    if (!(zones.back().area_m2() > 0)) {
      problems.push_back({scenario.id, where, "buildings all over the inner side of the door",
                          "free ground to approach it on (does `outward` point outward?)"});
    }
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return zones;
}

}  // namespace

std::string name_of(ExitState state) {
  switch (state) {
    case ExitState::idle:
      return "idle";
    case ExitState::flowing:
      return "flowing";
    case ExitState::congested:
      return "congested";
    case ExitState::clogged:
      return "clogged";
    case ExitState::closed:
      return "closed";
  }
  check(false, "every exit state has a name");
  return {};
}

std::vector<ExitSeries> exit_series(const Trace& trace, const world::Scenario& scenario) {
  const std::vector<ControlZone> zones = zones_of(scenario);
  const std::vector<std::size_t> people = people_of(trace);
  std::vector<ExitSeries> series(scenario.exits.size());
  parallel_ranges(series.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const world::Exit& exit = scenario.exits[i];
      series[i] = {exit.id, exit.width_m(), zones[i].area_m2(),
                   ExitObserver(trace, exit, zones[i], people).observe()};
    }
  });
  return series;
}

}  // namespace throng::metrics
