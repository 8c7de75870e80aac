#include "metrics/exits/exit_totals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "metrics/exits/exit_state.h"

namespace throng::metrics {

using nlohmann::json;

namespace {

// Adds one step that lasts dt_s.
void add(const ExitSample& sample, int net_out_now, double dt_s, ExitTotals& totals,
         int& net_out_in_demand) {
  totals.state_s[static_cast<std::size_t>(sample.state)] += dt_s;
  totals.clogging_index_s += sample.clogging_index * dt_s;
  const bool closed = sample.state == ExitState::closed;
  if (closed ? sample.demand : sample.state != ExitState::idle) {
    totals.demand_s += dt_s;
    net_out_in_demand += net_out_now;
  }
  if (sample.state_offline == ExitState::clogged) totals.clogged_offline_s += dt_s;
  totals.max_queue = std::max(totals.max_queue, sample.queue);
  totals.max_queue_length_m = std::max(totals.max_queue_length_m, sample.queue_length_m);
  totals.max_wait_s = std::max(totals.max_wait_s, sample.predicted_wait_s);
  totals.max_pressure_per_s2 = std::max(totals.max_pressure_per_s2, sample.pressure_per_s2);
  totals.max_voronoi_density_per_m2 =
      std::max(totals.max_voronoi_density_per_m2, sample.voronoi_density_per_m2);
}

// The share of the run's time in which the exit was open.
double open_share(const std::vector<ExitSample>& samples) {
  const auto open = std::count_if(samples.begin(), samples.end(), [](const ExitSample& sample) {
    return sample.state != ExitState::closed;
  });
  return samples.empty() ? 0 : static_cast<double>(open) / static_cast<double>(samples.size());
}

ExitTotals sum_exit(const ExitSeries& series, double dt_s) {
  ExitTotals totals;
  totals.exit_id = series.exit_id;
  totals.width_m = series.width_m;
  if (!series.samples.empty()) {
    totals.crossings = {series.samples.back().crossed_out, series.samples.back().crossed_in};
  }
  int net_out_before = 0;
  int net_out_in_demand = 0;
  for (const ExitSample& sample : series.samples) {
    add(sample, sample.net_out() - net_out_before, dt_s, totals, net_out_in_demand);
    net_out_before = sample.net_out();
  }
  const auto time_in = [&](ExitState state) {
    return totals.state_s[static_cast<std::size_t>(state)];
  };
  totals.capacity_per_s = open_share(series.samples) * series.capacity_per_s;
  totals.capacity_source = series.capacity_source;
  totals.clogged_s = time_in(ExitState::clogged);
  totals.congested_s = time_in(ExitState::congested) + totals.clogged_s;
  if (totals.demand_s > 0) {
    totals.mean_clogging_index = totals.clogging_index_s / totals.demand_s;
    totals.demand_flow_per_s = net_out_in_demand / totals.demand_s;
  }
  std::vector<double> crossings_s;
  for (const Passage& passage : series.passages) crossings_s.push_back(passage.time_s);
  if (!crossings_s.empty()) totals.last_crossing_s = crossings_s.back();
  totals.clog_after_s = clog_after_s(series.capacity_per_s);
  totals.gaps = gap_figures(crossings_s, totals.clog_after_s);
  totals.clogs = series.clogs;
  totals.edie = series.edie;
  return totals;
}

json clog_json(const ClogEvent& clog) {
  return {{"from_s", clog.from_s},
          {"until_s", clog.until_s},
          {"ended", clog.ended},
          {"people_at_onset", clog.people_at_onset},
          {"max_normalised_density", clog.max_normalized_density},
          {"max_pressure_per_s2", clog.max_pressure_per_s2},
          {"members", clog.members}};
}

json edie_json(const EdieRegion& edie) {
  if (edie.duration_s() <= 0) return nullptr;
  return {{"density_per_m2", edie.density_per_m2()},
          {"flow_per_ms", edie.flow_per_ms()},
          {"speed_mps", edie.speed_mps()}};
}

template <typename T>
json value_or_null(const std::optional<T>& value) {
  return value ? json(*value) : json(nullptr);
}

}  // namespace

std::vector<ExitTotals> exit_totals(const std::vector<ExitSeries>& exits, double dt_s) {
  std::vector<ExitTotals> totals;
  double all = 0;
  for (const ExitSeries& exit : exits) {
    totals.push_back(sum_exit(exit, dt_s));
    all += std::max(0, totals.back().net_out());
  }
  for (ExitTotals& exit : totals) {
    if (all > 0) exit.share = std::max(0, exit.net_out()) / all;
  }
  return totals;
}

std::optional<ExitBalance> balance_exits(const std::vector<ExitTotals>& exits) {
  double capacity = 0;
  double people = 0;
  for (const ExitTotals& exit : exits) {
    capacity += exit.capacity_per_s;
    people += std::max(0, exit.net_out());
  }
  if (capacity <= 0 || people <= 0) return std::nullopt;
  double distance = 0;
  double sum = 0;
  double squares = 0;
  int open = 0;
  std::vector<double> last_s;
  for (const ExitTotals& exit : exits) {
    distance += std::abs(exit.share - exit.capacity_per_s / capacity);
    if (exit.last_crossing_s) last_s.push_back(*exit.last_crossing_s);
    if (exit.capacity_per_s <= 0) continue;
    const double load = std::max(0, exit.net_out()) / exit.capacity_per_s;
    sum += load;
    squares += load * load;
    ++open;
  }
  ExitBalance balance;
  balance.balance = 1 - 0.5 * distance;
  if (squares > 0) balance.jain = sum * sum / (open * squares);
  if (!last_s.empty()) {
    const auto [first, last] = std::minmax_element(last_s.begin(), last_s.end());
    balance.last_spread_s = *last - *first;
  }
  return balance;
}

json to_json(const ExitTotals& totals) {
  json states = json::object();
  for (std::size_t i = 0; i < totals.state_s.size(); ++i) {
    states[to_string(static_cast<ExitState>(i)) + "_s"] = totals.state_s[i];
  }
  json clogs = json::array();
  for (const ClogEvent& clog : totals.clogs) clogs.push_back(clog_json(clog));
  json specific = nullptr;
  if (totals.demand_flow_per_s) specific = *totals.demand_flow_per_s / totals.width_m;
  return {{"id", totals.exit_id},
          {"width_m", totals.width_m},
          {"capacity_per_s", totals.capacity_per_s},
          {"capacity_source", totals.capacity_source},
          {"crossings", {{"out", totals.crossings.out}, {"in", totals.crossings.in}}},
          {"net_out", totals.net_out()},
          {"share_of_net_out", totals.share},
          {"mean_clogging_index", totals.mean_clogging_index},
          {"clogging_index_s", totals.clogging_index_s},
          {"demand_s", totals.demand_s},
          {"congested_s", totals.congested_s},
          {"clogged_s", totals.clogged_s},
          {"clogged_offline_s", totals.clogged_offline_s},
          {"time_in_state", std::move(states)},
          {"demand_flow_per_s", value_or_null(totals.demand_flow_per_s)},
          {"demand_specific_flow_per_ms", std::move(specific)},
          {"max_queue", totals.max_queue},
          {"max_queue_length_m", totals.max_queue_length_m},
          {"max_predicted_wait_s", totals.max_wait_s},
          {"max_pressure_per_s2", totals.max_pressure_per_s2},
          {"max_voronoi_density_per_m2", totals.max_voronoi_density_per_m2},
          {"last_crossing_s", value_or_null(totals.last_crossing_s)},
          {"clog_after_s", totals.clog_after_s},
          {"edie", edie_json(totals.edie)},
          {"gaps", to_json(totals.gaps)},
          {"clogs", std::move(clogs)}};
}

json to_json(const std::optional<ExitBalance>& balance) {
  if (!balance) return nullptr;
  return {{"balance", balance->balance},
          {"jain", balance->jain},
          {"last_crossing_spread_s", balance->last_spread_s}};
}

}  // namespace throng::metrics
