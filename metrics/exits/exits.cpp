#include "metrics/exits/exits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <tuple>

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

// Measures one exit from the first step to the last.
class ExitObserver {
 public:
  ExitObserver(const Trace& trace, const world::Exit& exit, const ExitLine& line,
               const geometry::Region& inside, const ControlZone& zone,
               const std::vector<std::size_t>& people, const VoronoiCutter& cutter)
      : trace_(trace),
        people_(people),
        cutter_(cutter),
        zone_(zone),
        exit_(exit),
        inside_(inside),
        intent_(find_intent(trace, exit.id)),
        mean_radius_m_(mean_radius_m(trace.header)),
        line_(line),
        capacity_per_s_(capacity_per_s(exit.width_m())),
        state_(exit.width_m()),
        pressure_(zone, trace.header.dt_s),
        wait_(exit.width_m(), mean_radius_m_, trace.header.dt_s),
        counters_(people.size()) {
    if (people.empty()) return;
    const double fills_door = exit.width_m() / (2 * mean_radius_m_);
    // Slack: radii are stored as float, and 2 / (2 * 0.2f) must not round up to 6.
    demand_from_ = static_cast<int>(std::ceil(fills_door - 1e-6)) + 1;
  }

  ExitSeries observe() {
    ExitSeries series{exit_.id, exit_.width_m(), zone_.area_m2(), {}};
    series.samples.reserve(trace_.steps());
    for (std::size_t step = 0; step < trace_.steps(); ++step) {
      const double flow = change_over(series.samples, step, kFlowWindowS);
      series.samples.push_back(observe_step(step, series.passages));
      finish(series.samples.back(), trace_.time_s[step], flow);
      if (series.samples.back().demand && step + 1 < trace_.steps()) add_walks(step, series.edie);
    }
    find_clogs(series, trace_.time_s);
    for (ClogEvent& clog : series.clogs) clog.members = members_of(clog);
    return series;
  }

 private:
  // Net number gone out a window before this step.
  double change_over(const std::vector<ExitSample>& samples, std::size_t step,
                     double window_s) const {
    const auto window = static_cast<std::size_t>(std::lround(window_s / trace_.header.dt_s));
    return step > window ? samples[step - window].net_out() : 0;
  }

  // Quantities measured at the step itself.
  ExitSample observe_step(std::size_t step, std::vector<Passage>& passages) {
    look_around(step, passages);
    ExitSample sample;
    sample.crossed_out = doors_.out;
    sample.crossed_in = doors_.in;
    desired_speed_mps_ = 0;
    for (const NearPerson& person : queuing_) {
      if (!zone_.contains(person.place)) continue;
      ++sample.in_zone;
      sample.approach_speed_mps +=
          person.velocity.dot((zone_.middle() - person.place).normalized());
      desired_speed_mps_ += person.desired_speed_mps;
    }
    if (sample.in_zone > 0) {
      sample.approach_speed_mps /= sample.in_zone;
      desired_speed_mps_ /= sample.in_zone;
    }
    sample.density_per_m2 = sample.in_zone / zone_.area_m2();
    sample.normalized_density = sample.density_per_m2 * close_packing_m2();
    sample.voronoi_density_per_m2 = voronoi_density();
    sample.pressure_per_s2 = pressure_.step(near_);
    queue_ = queue_before(zone_, exit_.outward, queuing_);
    sample.queue = queue_.people;
    sample.queue_length_m = queue_.length_m;
    sample.demand = sample.in_zone >= demand_from_ && !people_.empty();
    return sample;
  }

  // Quantities that depend on earlier steps as well.
  void finish(ExitSample& sample, double time_s, double net_out_4s_ago) {
    sample.flow_per_s = (sample.net_out() - net_out_4s_ago) / kFlowWindowS;
    sample.specific_flow_per_ms = sample.flow_per_s / exit_.width_m();
    sample.since_crossing_s = time_s - last_outward_s_;
    sample.predicted_wait_s = wait_.step(queue_, sample.crossed_out);
    const ExitDemand demand{sample.demand, desired_speed_mps_};
    const bool open = exit_.is_open(time_s);
    sample.state = state_.step(time_s, open, sample, demand);
    if (open) sample.clogging_index = clogging_index(sample, demand, capacity_per_s_);
  }

  // Counts who crosses, and gathers who is near and who comes here.
  void look_around(std::size_t step, std::vector<Passage>& passages) {
    const double time_s = trace_.time_s[step];
    // Cells that reach into the zone depend on people two cells' radii beyond them.
    const double near_m = zone_.radius_m() + 3.1 * kCellRadiusM;
    near_.clear();
    queuing_.clear();
    const std::size_t already = passages.size();
    for (std::size_t i = 0; i < people_.size(); ++i) {
      const bool present = trace_.present(step, people_[i]);
      const std::size_t at = trace_.at(step, people_[i]);
      const Eigen::Vector2d place = trace_.position[at].cast<double>();
      const int crossing = present
                               ? counters_[i].step(line_, place, time_s, !inside_.contains(place))
                               : counters_[i].vanish();
      if (crossing < 0) ++doors_.in;
      if (crossing > 0) {
        ++doors_.out;
        last_outward_s_ = time_s;
        passages.push_back({counters_[i].crossed_at_s(), people_[i]});
      }
      if (!present) continue;
      const bool comes = !intent_ || trace_.exit_intent[at] == static_cast<int>(*intent_);
      const bool near = (place - zone_.middle()).squaredNorm() < near_m * near_m;
      if (!comes && !near) continue;
      const NearPerson person{people_[i], place, trace_.velocity[at].cast<double>(),
                              trace_.desired_speed_mps[at], comes};
      if (near) near_.push_back(person);
      if (comes) queuing_.push_back(person);
    }
    // They are known with a delay, and not all with the same: who crossed first may come second.
    if (passages.size() > already) {
      std::sort(passages.begin(), passages.end(), [](const Passage& one, const Passage& other) {
        return std::tie(one.time_s, one.agent) < std::tie(other.time_s, other.agent);
      });
    }
  }

  // The displacement from this step to the next of people who are near and intend this exit.
  void add_walks(std::size_t step, EdieRegion& edie) const {
    edie.add_time(zone_, trace_.time_s[step + 1] - trace_.time_s[step]);
    for (const NearPerson& person : near_) {
      if (!person.comes_here || !trace_.present(step + 1, person.agent)) continue;
      const std::size_t next = trace_.at(step + 1, person.agent);
      edie.add_walk(zone_, person.place, trace_.position[next].cast<double>());
    }
  }

  double voronoi_density() const {
    std::vector<Eigen::Vector2d> places;
    for (const NearPerson& person : near_) places.push_back(person.place);
    const geometry::PointGrid grid(places, kCellGridM);
    const double reach_m = zone_.radius_m() + 1.01 * kCellRadiusM;
    double people = 0;
    VoronoiCell cell;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Eigen::Vector2d offset = places[i] - zone_.middle();
      if (offset.norm() > reach_m || offset.dot(exit_.outward) > 1.01 * kCellRadiusM) continue;
      cutter_.cut(grid, i, cell);
      people += share_in_zone(cell);
    }
    return people / zone_.area_m2();
  }

  double share_in_zone(const VoronoiCell& cell) const {
    const double radius = zone_.radius_m();
    const bool whole = std::all_of(
        cell.rings.front().begin(), cell.rings.front().end(), [&](const Eigen::Vector2d& corner) {
          const Eigen::Vector2d offset = corner - zone_.middle();
          return offset.squaredNorm() < radius * radius && offset.dot(exit_.outward) <= 0;
        });
    return whole ? 1.0 : area_in(cell, zone_.outline()) / cell.area_m2;
  }

  std::vector<std::size_t> members_of(const ClogEvent& clog) const {
    const double near_m = kMemberWidths * exit_.width_m();
    std::set<std::size_t> members;
    for (std::size_t step = 0; step < trace_.steps(); ++step) {
      if (trace_.time_s[step] < clog.from_s || trace_.time_s[step] > clog.until_s) continue;
      for (const std::size_t agent : people_) {
        const std::size_t at = trace_.at(step, agent);
        if (!trace_.present(step, agent)) continue;
        if (intent_ && trace_.exit_intent[at] != static_cast<int>(*intent_)) continue;
        const Eigen::Vector2d offset = trace_.position[at].cast<double>() - zone_.middle();
        if (offset.norm() <= near_m && offset.dot(exit_.outward) < 0) members.insert(agent);
      }
    }
    return {members.begin(), members.end()};
  }

  // Ground per person at close packing: discs of the mean radius in a hexagonal lattice.
  double close_packing_m2() const {
    return 2 * std::numbers::sqrt3 * mean_radius_m_ * mean_radius_m_;
  }

  const Trace& trace_;
  const std::vector<std::size_t>& people_;
  const VoronoiCutter& cutter_;
  const ControlZone& zone_;
  const world::Exit& exit_;
  const geometry::Region& inside_;
  std::optional<std::size_t> intent_;  ///< empty: the trace has no intents for this exit
  double mean_radius_m_;
  ExitLine line_;
  double capacity_per_s_;
  ExitStateMachine state_;
  PressureMeter pressure_;
  Queue queue_;  ///< at the step that is measured
  WaitPredictor wait_;
  std::vector<CrossingCounter> counters_;
  std::vector<NearPerson> near_;     ///< people who may matter for density and pressure in the zone
  std::vector<NearPerson> queuing_;  ///< who intends this exit, wherever they are
  double desired_speed_mps_ = 0;     ///< mean over the zone
  int demand_from_ = 1;
  DoorCounts doors_;
  double last_outward_s_ = 0;
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
      series[i] = ExitObserver(trace, scenario.exits[i], lines[i], scenario.inside, zones[i],
                               people, cutter)
                      .observe();
    }
  });
  return series;
}

}  // namespace throng::metrics
