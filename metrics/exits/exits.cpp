#include "metrics/exits/exits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <tuple>
#include <utility>

#include "base/compute/parallel.h"
#include "base/error.h"
#include "base/geometry/point_grid.h"
#include "metrics/basis/control_zone.h"
#include "metrics/basis/crossings.h"
#include "metrics/basis/near_people.h"
#include "metrics/basis/people.h"
#include "metrics/density/pressure.h"
#include "metrics/density/voronoi.h"
#include "metrics/exits/clogs.h"
#include "metrics/exits/exit_state.h"
#include "metrics/exits/queue.h"

namespace throng::metrics {

namespace {

using world::Trace;

constexpr double kFlowWindowS = 4.0;
constexpr double kMemberWidths = 1.5;
constexpr double kCellGridM = 0.8;

std::vector<std::size_t> list_people(const Trace& trace) {
  std::vector<std::size_t> people;
  for (std::size_t agent = 0; agent < trace.agents(); ++agent) {
    if (trace.header.role[agent] == world::AgentRole::person) people.push_back(agent);
  }
  return people;
}

// Index of this exit in Trace::exit_intent, if the trace has it.
std::optional<std::size_t> find_intent(const Trace& trace, const std::string& exit_id) {
  const auto& ids = trace.header.exit_ids;
  const auto found = std::find(ids.begin(), ids.end(), exit_id);
  if (found == ids.end()) return std::nullopt;
  return static_cast<std::size_t>(found - ids.begin());
}

// An exit and the recorded crowd.
struct RecordedExit {
  const Trace& trace;
  const std::vector<std::size_t>& people;  ///< agents
  const world::Exit& exit;
  const ControlZone& zone;
  std::optional<std::size_t> intent;  ///< empty: the trace has no intents for this exit

  // Whether the person intends this exit; `at` is the place in the trace's arrays.
  bool is_intended(std::size_t at) const {
    return !intent || trace.exit_intent[at] == static_cast<int>(*intent);
  }
};

// The crossings of a door by all people, and the passages outward.
class DoorCounter {
 public:
  DoorCounter(const ExitLine& line, const geometry::Region& inside, std::size_t people)
      : line_(line), inside_(inside), counters_(people) {}

  void step(const Trace& trace, std::span<const std::size_t> people, std::size_t step) {
    const double time_s = trace.time_s[step];
    const std::size_t already = passages_.size();
    for (std::size_t i = 0; i < people.size(); ++i) {
      const Eigen::Vector2d place = trace.position[trace.at(step, people[i])].cast<double>();
      const int crossing = trace.present(step, people[i])
                               ? counters_[i].step(line_, place, time_s, !inside_.contains(place))
                               : counters_[i].vanish();
      if (crossing < 0) ++counts_.in;
      if (crossing > 0) {
        ++counts_.out;
        last_outward_s_ = time_s;
        passages_.push_back({counters_[i].crossed_at_s(), people[i]});
      }
    }
    // They are known with a delay, and not all with the same: who crossed first may come second.
    if (passages_.size() > already) {
      std::sort(passages_.begin(), passages_.end(), [](const Passage& one, const Passage& other) {
        return std::tie(one.time_s, one.agent) < std::tie(other.time_s, other.agent);
      });
    }
  }

  const DoorCounts& counts() const { return counts_; }
  double last_outward_s() const { return last_outward_s_; }
  std::vector<Passage> take_passages() { return std::move(passages_); }

 private:
  ExitLine line_;
  const geometry::Region& inside_;
  std::vector<CrossingCounter> counters_;
  DoorCounts counts_;
  double last_outward_s_ = 0;
  std::vector<Passage> passages_;  ///< in order of time
};

// People at a step who matter for an exit.
struct PeopleAtExit {
  std::vector<NearPerson> near;     ///< who may matter for density and pressure in the zone
  std::vector<NearPerson> queuing;  ///< who intends this exit, wherever they are
};

PeopleAtExit people_at_exit(const RecordedExit& at_exit, std::size_t step) {
  const Trace& trace = at_exit.trace;
  // Cells that reach into the zone depend on people two cells' radii beyond them.
  const double near_m = at_exit.zone.radius_m() + 3.1 * kCellRadiusM;
  PeopleAtExit people;
  for (const std::size_t agent : at_exit.people) {
    if (!trace.present(step, agent)) continue;
    const std::size_t at = trace.at(step, agent);
    const Eigen::Vector2d place = trace.position[at].cast<double>();
    const bool comes = at_exit.is_intended(at);
    const bool near = (place - at_exit.zone.middle()).squaredNorm() < near_m * near_m;
    if (!comes && !near) continue;
    const NearPerson person{agent, place, trace.velocity[at].cast<double>(),
                            trace.desired_speed_mps[at], comes};
    if (near) people.near.push_back(person);
    if (comes) people.queuing.push_back(person);
  }
  return people;
}

// The displacement from this step to the next of people who are near and intend this exit.
void add_walks(const RecordedExit& at_exit, std::size_t step, std::span<const NearPerson> near,
               EdieRegion& edie) {
  const Trace& trace = at_exit.trace;
  edie.add_time(at_exit.zone, trace.time_s[step + 1] - trace.time_s[step]);
  for (const NearPerson& person : near) {
    if (!person.comes_here || !trace.present(step + 1, person.agent)) continue;
    const std::size_t next = trace.at(step + 1, person.agent);
    edie.add_walk(at_exit.zone, person.place, trace.position[next].cast<double>());
  }
}

double share_in_zone(const VoronoiCell& cell, const ControlZone& zone,
                     const Eigen::Vector2d& outward) {
  const double radius = zone.radius_m();
  const bool whole = std::all_of(
      cell.rings.front().begin(), cell.rings.front().end(), [&](const Eigen::Vector2d& corner) {
        const Eigen::Vector2d offset = corner - zone.middle();
        return offset.squaredNorm() < radius * radius && offset.dot(outward) <= 0;
      });
  return whole ? 1.0 : area_in(cell, zone.outline()) / cell.area_m2;
}

double voronoi_density_per_m2(std::span<const NearPerson> near, const ControlZone& zone,
                              const Eigen::Vector2d& outward, const VoronoiCutter& cutter) {
  std::vector<Eigen::Vector2d> places;
  places.reserve(near.size());
  for (const NearPerson& person : near) places.push_back(person.place);
  const geometry::PointGrid grid(places, kCellGridM);
  const double reach_m = zone.radius_m() + 1.01 * kCellRadiusM;
  double people = 0;
  VoronoiCell cell;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Eigen::Vector2d offset = places[i] - zone.middle();
    if (offset.norm() > reach_m || offset.dot(outward) > 1.01 * kCellRadiusM) continue;
    cutter.cut(grid, i, cell);
    people += share_in_zone(cell, zone, outward);
  }
  return people / zone.area_m2();
}

std::vector<std::size_t> clog_members(const RecordedExit& at_exit, const ClogEvent& clog) {
  const Trace& trace = at_exit.trace;
  const double near_m = kMemberWidths * at_exit.exit.width_m();
  std::set<std::size_t> members;
  for (std::size_t step = 0; step < trace.steps(); ++step) {
    if (trace.time_s[step] < clog.from_s || trace.time_s[step] > clog.until_s) continue;
    for (const std::size_t agent : at_exit.people) {
      const std::size_t at = trace.at(step, agent);
      if (!trace.present(step, agent) || !at_exit.is_intended(at)) continue;
      const Eigen::Vector2d offset = trace.position[at].cast<double>() - at_exit.zone.middle();
      if (offset.norm() <= near_m && offset.dot(at_exit.exit.outward) < 0) members.insert(agent);
    }
  }
  return {members.begin(), members.end()};
}

// Number of people in the zone from which on they fill the door.
int demand_from(double width_m, double mean_radius_m) {
  if (!(mean_radius_m > 0)) return 1;
  // Slack: radii are stored as float, and 2 / (2 * 0.2f) must not round up to 6.
  return static_cast<int>(std::ceil(width_m / (2 * mean_radius_m) - 1e-6)) + 1;
}

// Measures one exit from the first step to the last.
class ExitObserver {
 public:
  ExitObserver(const RecordedExit& exit, const ExitLine& line, const geometry::Region& inside,
               const VoronoiCutter& cutter)
      : at_exit_(exit),
        cutter_(cutter),
        mean_radius_m_(mean_radius_m(exit.trace.header)),
        demand_from_(demand_from(exit.exit.width_m(), mean_radius_m_)),
        door_(line, inside, exit.people.size()),
        state_(capacity_per_s(exit.exit)),
        pressure_(exit.zone, exit.trace.header.dt_s),
        wait_(exit.exit, mean_radius_m_, exit.trace.header.dt_s) {}

  ExitSeries observe() {
    const Trace& trace = at_exit_.trace;
    ExitSeries series{.exit_id = at_exit_.exit.id,
                      .width_m = at_exit_.exit.width_m(),
                      .capacity_per_s = capacity_per_s(at_exit_.exit),
                      .capacity_source = capacity_source(at_exit_.exit),
                      .zone_area_m2 = at_exit_.zone.area_m2()};
    series.samples.reserve(trace.steps());
    const auto window = static_cast<std::size_t>(std::lround(kFlowWindowS / trace.header.dt_s));
    for (std::size_t step = 0; step < trace.steps(); ++step) {
      door_.step(trace, at_exit_.people, step);
      const PeopleAtExit people = people_at_exit(at_exit_, step);
      const int out_before = step > window ? series.samples[step - window].net_out() : 0;
      const ExitSample sample = measure(trace.time_s[step], people, out_before);
      series.samples.push_back(sample);
      if (sample.demand && step + 1 < trace.steps()) {
        add_walks(at_exit_, step, people.near, series.edie);
      }
    }
    series.passages = door_.take_passages();
    find_clogs(series, trace.time_s);
    for (ClogEvent& clog : series.clogs) clog.members = clog_members(at_exit_, clog);
    return series;
  }

 private:
  // `net_out_before`: net number gone out a window before this step.
  ExitSample measure(double time_s, const PeopleAtExit& people, int net_out_before) {
    const world::Exit& exit = at_exit_.exit;
    const ControlZone& zone = at_exit_.zone;
    ExitSample sample;
    sample.crossed_out = door_.counts().out;
    sample.crossed_in = door_.counts().in;
    double desired_speed_mps = 0;  // mean over the zone
    for (const NearPerson& person : people.queuing) {
      if (!zone.contains(person.place)) continue;
      ++sample.in_zone;
      sample.approach_speed_mps += person.velocity.dot((zone.middle() - person.place).normalized());
      desired_speed_mps += person.desired_speed_mps;
    }
    if (sample.in_zone > 0) {
      sample.approach_speed_mps /= sample.in_zone;
      desired_speed_mps /= sample.in_zone;
    }
    sample.density_per_m2 = sample.in_zone / zone.area_m2();
    // Ground per person at close packing: discs of the mean radius in a hexagonal lattice.
    sample.normalized_density =
        sample.density_per_m2 * (2 * std::numbers::sqrt3 * mean_radius_m_ * mean_radius_m_);
    sample.voronoi_density_per_m2 =
        voronoi_density_per_m2(people.near, zone, exit.outward, cutter_);
    sample.pressure_per_s2 = pressure_.step(people.near);
    const Queue queue = queue_before(zone, exit.outward, people.queuing);
    sample.queue = queue.people;
    sample.queue_length_m = queue.length_m;
    sample.predicted_wait_s = wait_.step(queue, sample.crossed_out);
    sample.flow_per_s = (sample.net_out() - net_out_before) / kFlowWindowS;
    sample.specific_flow_per_ms = sample.flow_per_s / exit.width_m();
    sample.since_crossing_s = time_s - door_.last_outward_s();
    sample.demand = sample.in_zone >= demand_from_;
    const ExitDemand demand{sample.demand, desired_speed_mps};
    const bool open = exit.is_open(time_s);
    sample.state = state_.step(time_s, open, sample, demand);
    if (open) {
      sample.clogging_index = clogging_index(sample, demand, capacity_per_s(exit));
    }
    return sample;
  }

  RecordedExit at_exit_;
  const VoronoiCutter& cutter_;
  double mean_radius_m_;
  int demand_from_;
  DoorCounter door_;
  ExitStateMachine state_;
  PressureMeter pressure_;
  WaitPredictor wait_;
};

// One zone per exit; throws for exits at which nothing can be measured.
std::vector<ControlZone> control_zones(const world::Scenario& scenario) {
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

std::string to_string(ExitState state) {
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
  const std::vector<ControlZone> zones = control_zones(scenario);
  const std::vector<ExitLine> lines = exit_lines(scenario.exits, mean_radius_m(trace.header));
  const std::vector<std::size_t> people = list_people(trace);
  const VoronoiCutter cutter(scenario.buildings);
  std::vector<ExitSeries> series(scenario.exits.size());
  parallel_ranges(series.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const world::Exit& exit = scenario.exits[i];
      const RecordedExit recorded{trace, people, exit, zones[i], find_intent(trace, exit.id)};
      series[i] = ExitObserver(recorded, lines[i], scenario.inside, cutter).observe();
    }
  });
  return series;
}

}  // namespace throng::metrics
