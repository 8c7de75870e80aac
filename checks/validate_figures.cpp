// The figures of a run against each other: most of metrics.json follows from the rows of by_person
// and from the exits' crossings and gaps. Definitions: docs/metrics.md.
#include "checks/validate_figures.h"
#include "checks/median.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <vector>

namespace throng::checks {

using nlohmann::json;

namespace {

double number_in(const json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? found->get<double>() : std::nan("");
}

std::optional<double> read_cell(const json& columns, const char* key, std::size_t i) {
  const auto column = columns.find(key);
  if (column == columns.end() || i >= column->size() || !column->at(i).is_number()) return {};
  return column->at(i).get<double>();
}

/// Empty where there is no word.
std::string read_word(const json& columns, const char* key, std::size_t i) {
  const auto column = columns.find(key);
  if (column == columns.end() || i >= column->size() || !column->at(i).is_string()) return {};
  return column->at(i).get<std::string>();
}

/// A figure against what it follows from; files that lack one of them are of other versions.
void follows(const Report& fault, const std::string& name, double found, double expected,
             double slack) {
  if (!std::isfinite(found) || !std::isfinite(expected)) return;
  if (std::abs(found - expected) <= slack + 1e-6 * std::abs(expected)) return;
  fault(fmt::format("{} {}, but it follows from other figures as {:.6g}", name, found, expected));
}

constexpr double kFigureSlackS = 1e-3;
constexpr double kCountSlack = 1e-9;

/// Everybody's rows, as escape times see them.
struct Evacuation {
  std::size_t all = 0;
  std::size_t evacuees = 0;
  std::size_t casualties = 0;
  std::size_t never_inside = 0;  ///< people who turned back included
  std::size_t vanished = 0;
  std::vector<double> escapes;    ///< since each one's start, sorted
  std::vector<double> escaped_s;  ///< by the run's clock
  double censored_sum_s = 0;
  bool is_complete = true;  ///< the columns are there
};

Evacuation read_evacuation(const json& run) {
  Evacuation people;
  const json columns = run.value("by_person", json::object());
  const double end_s = number_in(run, "duration_s");
  for (const char* key : {"agent", "start_s", "escaped_s", "hurt_s"}) {
    people.is_complete = people.is_complete && columns.contains(key);
  }
  if (!people.is_complete || !std::isfinite(end_s)) return people;
  people.all = columns.at("agent").size();
  for (std::size_t i = 0; i < people.all; ++i) {
    const std::optional<double> start = read_cell(columns, "start_s", i);
    const std::optional<double> escaped = read_cell(columns, "escaped_s", i);
    const std::string outcome = read_word(columns, "outcome", i);
    if (outcome == "never_inside" || outcome == "turned_back") {
      ++people.never_inside;
      continue;
    }
    if (escaped) people.escaped_s.push_back(*escaped);
    if (!start || (escaped && *escaped < *start)) continue;  // had left before the alarm
    ++people.evacuees;
    if (escaped) people.escapes.push_back(*escaped - *start);
    const std::optional<double> vanished = read_cell(columns, "vanished_s", i);
    if (!escaped && read_cell(columns, "hurt_s", i)) {
      ++people.casualties;
    } else if (!escaped && vanished) {
      ++people.vanished;
    }
    people.censored_sum_s += std::max(0.0, escaped.value_or(vanished.value_or(end_s)) - *start);
  }
  std::sort(people.escapes.begin(), people.escapes.end());
  return people;
}

void check_escape_times(const json& run, const Evacuation& people, const Report& fault) {
  const auto all = static_cast<double>(people.all);
  const auto evacuees = static_cast<double>(people.evacuees);
  follows(fault, "people", number_in(run, "people"), all, kCountSlack);
  const double left_before = all - evacuees - static_cast<double>(people.never_inside);
  follows(fault, "left_before_alarm", number_in(run, "left_before_alarm"), left_before,
          kCountSlack);
  if (number_in(run, "left_before_alarm") != left_before) return;
  follows(fault, "casualties", number_in(run, "casualties"), static_cast<double>(people.casualties),
          kCountSlack);
  follows(
      fault, "not_escaped", number_in(run, "not_escaped"),
      evacuees - static_cast<double>(people.casualties + people.vanished + people.escapes.size()),
      kCountSlack);
  if (people.evacuees > 0) {
    follows(fault, "mean_escape_time_censored_s", number_in(run, "mean_escape_time_censored_s"),
            people.censored_sum_s / evacuees, kFigureSlackS);
  }
  const json times = run.value("escape_time_percentiles", json::object());
  for (const int percent : {25, 50, 75, 80, 90, 95, 99, 100}) {
    const std::string name = fmt::format("t{}_s", percent);
    const std::size_t rank =
        (people.evacuees * static_cast<std::size_t>(percent) + 99) / 100;  // rounded up
    if (!times.contains(name)) continue;
    const bool is_reached = rank > 0 && rank <= people.escapes.size();
    if (is_reached != times.at(name).is_number()) {
      fault(fmt::format("{} {}, but {} of {} evacuees have escaped", name, times.at(name).dump(),
                        people.escapes.size(), people.evacuees));
    } else if (is_reached) {
      follows(fault, name, times.at(name).get<double>(), people.escapes[rank - 1], kFigureSlackS);
    }
  }
}

/// How the run ended for everybody, by the rows.
void check_people_counts(const json& run, const Report& fault) {
  const json columns = run.value("by_person", json::object());
  const json counts = run.value("people_counts", json());
  if (!counts.is_object() || !columns.contains("outcome") || !columns.contains("exit")) return;
  std::map<std::string, double> number_of;
  std::map<std::string, double> left_by;
  for (std::size_t i = 0; i < columns.at("outcome").size(); ++i) {
    const std::string outcome = read_word(columns, "outcome", i);
    const std::string exit = read_word(columns, "exit", i);
    ++number_of[outcome == "left" && exit.empty() ? "left_by_no_exit" : outcome];
    if (outcome == "left" && !exit.empty()) ++left_by[exit];
  }
  for (const auto& [name, outcome] :
       {std::pair{"left_by_no_exit", "left_by_no_exit"}, std::pair{"inside", "inside"},
        std::pair{"casualties", "casualty"}, std::pair{"vanished_inside", "vanished"},
        std::pair{"turned_back", "turned_back"}, std::pair{"never_inside", "never_inside"}}) {
    follows(fault, std::string("people_counts.") + name, number_in(counts, name),
            number_of[outcome], kCountSlack);
  }
  for (const json& exit : counts.value("left_by_exit", json::array())) {
    const std::string id = exit.value("id", "");
    follows(fault, "people_counts.left_by_exit of " + id, number_in(exit, "people"), left_by[id],
            kCountSlack);
  }
}

void check_curve(const json& run, const Evacuation& people, const Report& fault) {
  const json curve =
      run.value("escape_curve", json::object()).value("escaped_share", json::array());
  const double end_s = number_in(run, "duration_s");
  const std::size_t in_place = people.all - people.never_inside;
  for (std::size_t i = 0; i < curve.size() && in_place > 0; ++i) {
    const auto at_s = static_cast<double>(i);
    if (at_s > end_s || !curve[i].is_number()) continue;
    // Steps are not exactly at whole seconds.
    const auto out_by = [&](double time_s) {
      return static_cast<double>(std::count_if(people.escaped_s.begin(), people.escaped_s.end(),
                                               [&](double t) { return t <= time_s; })) /
             static_cast<double>(in_place);
    };
    const double share = curve[i].get<double>();
    if (share >= out_by(at_s - kFigureSlackS) - 1e-9 &&
        share <= out_by(at_s + kFigureSlackS) + 1e-9) {
      continue;
    }
    fault(fmt::format("escape_curve is {} at {} s, but by_person gives {:.4f}", share, i,
                      out_by(at_s)));
    return;
  }
}

void check_ratios(const json& run, const Report& fault) {
  for (const char* name : {"lower_bound", "reference_time"}) {
    const json best = run.value(name, json());
    if (!best.is_object()) continue;
    follows(fault, fmt::format("{}.mean_ratio", name), number_in(best, "mean_ratio"),
            number_in(run, "mean_escape_time_censored_s") / number_in(best, "mean_s"), 1e-6);
    const json times = run.value("escape_time_percentiles", json::object());
    for (const int percent : {25, 50, 75, 80, 90, 95, 99, 100}) {
      const std::string time = fmt::format("t{}_s", percent);
      const std::string ratio = fmt::format("t{}_ratio", percent);
      follows(fault, fmt::format("{}.{}", name, ratio), number_in(best, ratio.c_str()),
              number_in(times, time.c_str()) / number_in(best, time.c_str()), 1e-6);
    }
  }
}

void check_exit_figures(const json& exit, double net_sum, const Report& fault) {
  const std::string id = exit.value("id", "");
  const json crossings = exit.value("crossings", json::object());
  const double out = number_in(crossings, "out");
  const double net = out - number_in(crossings, "in");
  follows(fault, "net_out of " + id, number_in(exit, "net_out"), net, kCountSlack);
  if (net_sum > 0) {
    follows(fault, "share_of_net_out of " + id, number_in(exit, "share_of_net_out"),
            std::max(net, 0.0) / net_sum, 1e-9);
  }
  const json gaps = exit.value("gaps", json::object());
  if (gaps.contains("list_s") && std::isfinite(out)) {
    follows(fault, "crossings.out of " + id, out > 0 ? out - 1 : 0,
            static_cast<double>(gaps.at("list_s").size()), kCountSlack);
  }
  if (number_in(exit, "demand_s") > 0) {
    follows(fault, "mean_clogging_index of " + id, number_in(exit, "mean_clogging_index"),
            number_in(exit, "clogging_index_s") / number_in(exit, "demand_s"), 1e-6);
    follows(fault, "demand_specific_flow_per_ms of " + id,
            number_in(exit, "demand_specific_flow_per_ms"),
            number_in(exit, "demand_flow_per_s") / number_in(exit, "width_m"), 1e-6);
  }
  const json states = exit.value("time_in_state", json::object());
  follows(fault, "congested_s of " + id, number_in(exit, "congested_s"),
          number_in(states, "congested_s") + number_in(states, "clogged_s"), 1e-6);
  follows(fault, "clogged_s of " + id, number_in(exit, "clogged_s"), number_in(states, "clogged_s"),
          1e-6);
}

void check_exit_sums(const json& run, const Report& fault) {
  const json exits = run.value("exits", json::array());
  double net_sum = 0;
  double capacity_sum = 0;
  for (const json& exit : exits) {
    net_sum += std::max(0.0, number_in(exit, "net_out"));
    capacity_sum += number_in(exit, "capacity_per_s");
  }
  double off_balance = 0;
  for (const json& exit : exits) {
    check_exit_figures(exit, net_sum, fault);
    off_balance += std::abs(number_in(exit, "share_of_net_out") -
                            number_in(exit, "capacity_per_s") / capacity_sum);
  }
  const json balance = run.value("exit_balance", json());
  if (balance.is_object() && net_sum > 0 && capacity_sum > 0) {
    follows(fault, "exit_balance.balance", number_in(balance, "balance"), 1 - 0.5 * off_balance,
            1e-6);
  }
}

double median_of_column(const json& columns, const char* key) {
  std::vector<double> values;
  const json column = columns.value(key, json::array());
  for (const json& value : column) {
    if (value.is_number()) values.push_back(value.get<double>());
  }
  return median(std::move(values));
}

void check_journeys(const json& run, const Report& fault) {
  const json columns = run.value("by_person", json::object());
  const json journeys = run.value("journeys", json());
  if (journeys.is_object()) {
    for (const char* key : {"walked_m", "speed_ratio"}) {
      const json summary = journeys.value(key, json());
      if (!summary.is_object()) continue;
      follows(fault, fmt::format("journeys.{}.median", key), number_in(summary, "median"),
              median_of_column(columns, key), 1e-6);
    }
  }
  const json remaining = run.value("remaining", json());
  if (remaining.is_object()) {
    double sum = 0;
    for (const auto& [reason, count] : remaining.items()) {
      if (reason != "people" && count.is_number()) sum += count.get<double>();
    }
    follows(fault, "remaining.people", number_in(remaining, "people"), sum, kCountSlack);
  }
  double flown_m = 0;
  double energy_wh = 0;
  for (const json& drone : run.value("drones", json::array())) {
    flown_m += number_in(drone, "flown_m");
    energy_wh += number_in(drone, "energy_wh");
  }
  const json guidance = run.value("guidance", json::object());
  follows(fault, "guidance.flown_km", number_in(guidance, "flown_km"), flown_m / 1000, 1e-9);
  follows(fault, "guidance.energy_wh", number_in(guidance, "energy_wh"), energy_wh, 1e-9);
}

void check_exposure(const json& run, const Report& fault) {
  const json exposure = run.value("exposure", json::object());
  double before = std::numeric_limits<double>::infinity();
  for (const char* key :
       {"above_2_per_m2_person_s", "above_3.57_per_m2_person_s", "above_4_per_m2_person_s",
        "above_5_per_m2_person_s", "above_5.55_per_m2_person_s", "above_6_per_m2_person_s"}) {
    const double value = number_in(exposure, key);
    if (!std::isfinite(value)) continue;
    if (value > before + kFigureSlackS) {
      fault(fmt::format("exposure.{} {} is above that of a lower density", key, value));
    }
    before = value;
  }
  double inside_s = 0;
  const json levels = exposure.value("level_of_service", json::object());
  for (const auto& [level, value] : levels.items()) {
    if (value.is_number()) inside_s += value.get<double>();
  }
  // Everybody is inside from arrival to escape at the most.
  const json columns = run.value("by_person", json::object());
  const double end_s = number_in(run, "duration_s");
  double present_s = 0;
  for (std::size_t i = 0; columns.contains("arrived_s") && i < columns.at("arrived_s").size();
       ++i) {
    const double arrived_s = read_cell(columns, "arrived_s", i).value_or(end_s);
    present_s += end_s - arrived_s + 0.5;  // each step counts whole
  }
  if (columns.contains("arrived_s") && inside_s > present_s) {
    fault(
        fmt::format("level_of_service sums to {:.0f} person-seconds, but people are there for "
                    "{:.0f} at the most",
                    inside_s, present_s));
  }
}

}  // namespace

void check_run_figures(const json& run, const Report& fault) {
  const Evacuation people = read_evacuation(run);
  if (people.is_complete) {
    check_escape_times(run, people, fault);
    check_curve(run, people, fault);
    check_people_counts(run, fault);
  }
  check_ratios(run, fault);
  check_exit_sums(run, fault);
  check_journeys(run, fault);
  check_exposure(run, fault);
}

std::vector<double> crossing_times(const json& exit) {
  const double last_s = number_in(exit, "last_crossing_s");
  const json list = exit.value("gaps", json::object()).value("list_s", json::array());
  if (!std::isfinite(last_s)) return {};
  std::vector<double> times = {last_s};
  for (auto gap = list.rbegin(); gap != list.rend(); ++gap) {
    times.push_back(times.back() - gap->get<double>());
  }
  std::reverse(times.begin(), times.end());
  return times;
}

}  // namespace throng::checks
