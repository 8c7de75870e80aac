// Whether any run beats its lower bound (metrics/bounds/run_bound.h): over all shipped scenarios,
// seeds, numbers of people and lengths.
//
//   build/release/scripts/studies/bound_check [RUNS [FIRST_SEED]]
//
// Run i is of the i-th scenario of the list, round and round. Printed are per scenario how many of
// its percentiles T50, T75, T90, T95 and of its means were below the bound (with people who know at
// once, and as they noticed), the least ratios, how often a door passed more than its measured
// capacity, and the same for the reference time.
#include <fmt/core.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "metrics/bounds/run_bound.h"
#include "places/scenarios/blueprint/load_scenario.h"
#include "sim/run.h"

namespace {

using namespace throng;

constexpr int kPercents[] = {50, 75, 90, 95};
constexpr double kRounding = 1e-6;

class Observer : public sim::RunObserver {
 public:
  Observer(const world::Scenario& scenario, world::Alarm alarm)
      : scenario_(scenario), alarm_(std::move(alarm)) {}
  void begin(const world::TraceHeader& header) override {
    max_radius_m_ = metrics::max_radius_m(header);
    tracker_ = std::make_unique<metrics::PeopleTracker>(header, scenario_, alarm_);
  }
  void step(const world::CrowdStep& step) override {
    tracker_->step({step.time_s, step.position, step.velocity, step.desired_speed_mps, step.state,
                    step.exit_intent, step.flags});
  }
  const metrics::PeopleTracker& tracker() const { return *tracker_; }
  double max_radius_m() const { return max_radius_m_; }

 private:
  const world::Scenario& scenario_;
  world::Alarm alarm_;
  double max_radius_m_ = 0;
  std::unique_ptr<metrics::PeopleTracker> tracker_;
};

struct Tally {
  int figures = 0;
  int below = 0;
  double min_ratio = std::numeric_limits<double>::infinity();

  void add(double run_s, double best_s) {
    ++figures;
    if (run_s < best_s - kRounding) ++below;
    if (best_s > 0) min_ratio = std::min(min_ratio, run_s / best_s);
  }
  void add(const metrics::EscapeTimes& run, const metrics::BestTimes& best) {
    for (const int percent : kPercents) {
      const auto time_s = run.percentile_s(percent);
      if (time_s) add(*time_s, best.percentile_s(percent).value());
    }
    if (run.evacuees() > 0) add(run.mean_censored_s(), best.mean_s);
  }
};

struct Row {
  int runs = 0;
  int raised_doors = 0;
  Tally as_noticed, at_once, reference;
};

void check_run(const world::Scenario& scenario, int number, std::uint64_t seed, Row& row) {
  const int variant = number % 3;
  sim::RunSpec spec;
  spec.seed = seed;
  spec.duration_s = variant == 0 ? 40 : 60;
  spec.people = 40 * (variant + 1);
  if (scenario.id.find("huang2016") != std::string::npos &&
      scenario.id.find("navigated") == std::string::npos) {
    spec.crowd.compat = crowd::Compat::huang2016;
  }
  const world::Alarm alarm = world::find_alarm(scenario);
  Observer observer(scenario, alarm);
  sim::simulate(scenario, spec, observer);
  const auto people = observer.tracker().records();
  const double end_s = observer.tracker().time_s();
  const metrics::EscapeTimes times = metrics::escape_times(people, end_s);
  ++row.runs;
  const auto bound = [&](metrics::Knowledge knowledge) {
    return metrics::lower_bound(
        scenario, people, alarm, end_s,
        {sim::model_for(scenario, spec.crowd), observer.max_radius_m(), knowledge});
  };
  const auto as_noticed = bound(metrics::Knowledge::as_noticed);
  if (!as_noticed) return;
  row.as_noticed.add(times, *as_noticed);
  row.at_once.add(times, *bound(metrics::Knowledge::at_once));
  row.raised_doors += as_noticed->raised_doors;
  metrics::ReferenceSpec reference;
  for (const world::Exit& exit : scenario.exits) {
    reference.capacity_per_s.push_back(1.3 * exit.width_m());
  }
  const auto best = metrics::reference_time(scenario, people, alarm, end_s,
                                            metrics::Knowledge::at_once, reference);
  if (best) row.reference.add(times, *best);
}

}  // namespace

int main(int argc, char** argv) {
  const tbb::global_control one_core(tbb::global_control::max_allowed_parallelism, 1);
  const int runs = argc > 1 ? std::atoi(argv[1]) : 280;
  const int first_seed = argc > 2 ? std::atoi(argv[2]) : 1;
  const auto folder = world::scenarios_folder();
  const std::vector<std::string> ids = world::list_scenarios(folder);
  std::vector<world::Scenario> scenarios;
  for (const std::string& id : ids) scenarios.push_back(scenarios::find_scenario(folder, id));
  std::vector<Row> rows(ids.size());
  const auto print = [&] {
    int done = 0;
    int below = 0;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const Row& row = rows[i];
      done += row.runs;
      below += row.as_noticed.below + row.at_once.below;
      fmt::print(
          "{:<50} {:>4} runs, {:>5} figures: noticed {} below, least {:.3f}; at once {} "
          "below, least {:.3f}; doors raised {}; reference {} below, least {:.3f}\n",
          ids[i], row.runs, row.as_noticed.figures, row.as_noticed.below, row.as_noticed.min_ratio,
          row.at_once.below, row.at_once.min_ratio, row.raised_doors, row.reference.below,
          row.reference.min_ratio);
    }
    fmt::print("{} runs, {} figures below the bound\n\n", done, below);
    std::fflush(stdout);
  };
  for (int i = 0; i < runs; ++i) {
    const std::size_t which = static_cast<std::size_t>(i) % ids.size();
    const int round = i / static_cast<int>(ids.size());
    check_run(scenarios[which], round, static_cast<std::uint64_t>(first_seed + round), rows[which]);
    if ((i + 1) % static_cast<int>(5 * ids.size()) == 0) print();
  }
  print();
}
