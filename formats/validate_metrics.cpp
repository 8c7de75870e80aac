// metrics.json against metrics/RUN.json, the tables of exits, and itself.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "base/files.h"
#include "base/json_text.h"
#include "formats/run_checks.h"
#include "formats/validate_figures.h"

namespace throng::formats {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr const char* kMetricsFile = "metrics.json";

bool is_number(const json& value, const char* key) {
  return value.contains(key) && value.at(key).is_number();
}

/// One run's figures.
class RunFigures {
 public:
  RunFigures(const DatasetInfo& info, const json& run, Findings& findings)
      : info_(info), run_(run), name_(run.at("run")), findings_(findings) {}

  void check() const {
    check_copy();
    check_escapes();
    for (const json& exit : run_.value("exits", json::array())) check_exit(exit);
    check_run_figures(run_, [this](const std::string& what) { fault(what); });
    check_table();
    check_crossings();
    check_waits();
  }

 private:
  void fault(const std::string& what) const { findings_.add("metrics", kMetricsFile, name_, what); }

  /// metrics/RUN.json has the same figures.
  void check_copy() const {
    const std::string path = "metrics/" + name_ + ".json";
    if (!fs::is_regular_file(info_.root / path)) return;
    json own = parse_json_or_discard(read_file(info_.root / path), kOwnJsonLimits);
    json expected = run_;
    expected.erase("run");
    expected.erase("seed");
    if (own.is_object()) {
      own.erase("run");
      own.erase("seed");
    }
    if (own == expected) return;
    std::string where;
    const json difference = json::diff(expected, own);
    if (!difference.empty()) where = difference.front().value("path", "");
    findings_.add("metrics", path, where, "not what metrics.json says of the run");
  }

  void check_escapes() const {
    const json curve =
        run_.value("escape_curve", json::object()).value("escaped_share", json::array());
    double last = 0;
    for (const json& share : curve) {
      const double value = share.get<double>();
      if (value < last - 1e-9 || value > 1 + 1e-9) {
        fault(fmt::format("escape_curve goes from {} to {}", last, value));
        break;
      }
      last = value;
    }
    const json people = run_.value("by_person", json::object());
    if (is_number(run_, "people") && people.contains("agent") &&
        run_.at("people").get<std::size_t>() > people.at("agent").size()) {
      fault(fmt::format("people {}, but by_person has {}", run_.at("people").dump(),
                        people.at("agent").size()));
    }
    for (const auto& [key, column] : people.items()) {
      if (people.contains("agent") && column.is_array() &&
          column.size() != people.at("agent").size()) {
        fault(fmt::format("by_person.{} has {} entries", key, column.size()));
      }
    }
    double before = 0;
    for (const char* percentile :
         {"t25_s", "t50_s", "t75_s", "t80_s", "t90_s", "t95_s", "t99_s", "t100_s"}) {
      const json times = run_.value("escape_time_percentiles", json::object());
      if (!is_number(times, percentile)) continue;
      const double time = times.at(percentile).get<double>();
      if (time < before)
        fault(fmt::format("{} {} is below an earlier percentile", percentile, time));
      before = time;
    }
  }

  void check_exit(const json& exit) const {
    const std::string id = exit.value("id", "");
    const json states = exit.value("time_in_state", json::object());
    double sum = 0;
    for (const auto& [state, time] : states.items()) sum += time.get<double>();
    // Steps at both ends count whole.
    constexpr double kSlackS = 0.6;
    if (!states.empty() && is_number(run_, "duration_s") &&
        std::abs(sum - run_.at("duration_s").get<double>()) > kSlackS) {
      fault(fmt::format("time_in_state of {} sums to {:.2f} s of {} s", id, sum,
                        run_.at("duration_s").dump()));
    }
    const json gaps = exit.value("gaps", json::object());
    if (gaps.contains("list_s") && is_number(gaps, "count")) {
      const auto list = gaps.at("list_s").get<std::vector<double>>();
      const double longest = list.empty() ? 0 : *std::max_element(list.begin(), list.end());
      if (gaps.at("count") != list.size() ||
          (is_number(gaps, "longest_s") &&
           std::abs(gaps.at("longest_s").get<double>() - longest) > 1e-6)) {
        fault(fmt::format(
            "gaps of {}: {} in the list, the longest {} s, but count {}, longest_s {}", id,
            list.size(), longest, gaps.at("count").dump(), gaps.value("longest_s", json()).dump()));
      }
    }
    for (const char* share : {"mean_clogging_index", "share_of_net_out"}) {
      if (is_number(exit, share) &&
          !(exit.at(share).get<double>() >= -1e-9 && exit.at(share).get<double>() <= 1 + 1e-9)) {
        fault(fmt::format("{} of {} is {}", share, id, exit.at(share).dump()));
      }
    }
  }

  /// No value of exits/RUN.csv is above the greatest of all steps.
  void check_table() const {
    const fs::path file = info_.root / ("exits/" + name_ + ".csv");
    if (!fs::is_regular_file(file) || !run_.contains("exits")) return;
    const CsvTable table = read_csv(file);
    struct Pair {
      const char* column;
      const char* key;
      double rounding;
    };
    const std::size_t exit_column = table.find("exit");
    for (const Pair& pair :
         {Pair{"queue", "max_queue", 0.01}, Pair{"queue_length", "max_queue_length_m", 0.01},
          Pair{"predicted_wait", "max_predicted_wait_s", 0.01},
          Pair{"pressure", "max_pressure_per_s2", 1e-5},
          Pair{"voronoi_density", "max_voronoi_density_per_m2", 1e-4}}) {
      const std::size_t column = table.find(pair.column);
      if (column == table.columns.size() || exit_column == table.columns.size()) continue;
      for (const json& exit : run_.at("exits")) {
        if (!is_number(exit, pair.key)) continue;
        for (std::size_t i = 0; i < table.rows.size(); ++i) {
          if (table.rows[i][exit_column] != exit.value("id", "")) continue;
          const double value = number_of(table.rows[i][column]);
          if (value <= exit.at(pair.key).get<double>() + pair.rounding) continue;
          fault(fmt::format("{} of {} is {}, but exits/{}.csv line {} has {}", pair.key,
                            exit.value("id", ""), exit.at(pair.key).dump(), name_, i + 2, value));
          return;
        }
      }
    }
  }

  /// Crossings in exits/RUN.csv are at the times that gaps and last crossing give. They count when
  /// the person is 0.2 m beyond the line, some time after having crossed it.
  void check_crossings() const {
    const fs::path file = info_.root / ("exits/" + name_ + ".csv");
    if (!fs::is_regular_file(file) || !run_.contains("exits")) return;
    const CsvTable table = read_csv(file);
    const std::size_t exit_column = table.find("exit");
    const std::size_t time_column = table.find("time_s");
    const std::size_t out_column = table.find("crossed_out");
    const std::size_t in_column = table.find("crossed_in");
    if (std::max({exit_column, time_column, out_column, in_column}) >= table.columns.size()) return;
    for (const json& exit : run_.at("exits")) {
      const std::vector<double> times = crossing_times(exit);
      const double in = exit.value("crossings", json::object()).value("in", 1e9);
      const auto crossed_by = [&](double time_s) {
        return static_cast<double>(std::upper_bound(times.begin(), times.end(), time_s) -
                                   times.begin());
      };
      for (std::size_t i = 0; i < table.rows.size(); ++i) {
        if (table.rows[i][exit_column] != exit.value("id", "")) continue;
        const double time_s = number_of(table.rows[i][time_column]);
        const double crossed = number_of(table.rows[i][out_column]);
        if (number_of(table.rows[i][in_column]) > in) {
          fault(fmt::format("crossings.in of {} is {}, but exits/{}.csv line {} has {}",
                            exit.value("id", ""), in, name_, i + 2, table.rows[i][in_column]));
          return;
        }
        constexpr double kStepS = 0.3;   // the table is of the last crowd step before the frame
        constexpr double kDelayS = 4.0;  // slow people stand in the door
        if (crossed <= crossed_by(time_s + 1e-3) &&
            crossed >= crossed_by(time_s - kDelayS - kStepS)) {
          continue;
        }
        fault(
            fmt::format("{} has {} crossings in exits/{}.csv line {}, but {} by its gaps and "
                        "last_crossing_s",
                        exit.value("id", ""), crossed, name_, i + 2, crossed_by(time_s)));
        return;
      }
    }
  }

  /// The predicted wait is the queue over a rate, which is between a third of the door's capacity
  /// and what the crossings of the last 20 s would give (docs/metrics.md).
  void check_waits() const {
    const fs::path file = info_.root / ("exits/" + name_ + ".csv");
    if (!fs::is_regular_file(file) || !run_.contains("exits")) return;
    const CsvTable table = read_csv(file);
    const std::size_t exit_column = table.find("exit");
    const std::size_t time_column = table.find("time_s");
    const std::size_t queue_column = table.find("queue");
    const std::size_t wait_column = table.find("predicted_wait");
    if (std::max({exit_column, time_column, queue_column, wait_column}) >= table.columns.size()) {
      return;
    }
    for (const json& exit : run_.at("exits")) {
      if (!is_number(exit, "width_m")) continue;
      constexpr double kCapacityPerMs = 1.3;
      constexpr double kPriorS = 10;
      constexpr double kWindowS = 20;
      const double capacity = kCapacityPerMs * exit.at("width_m").get<double>();
      const std::vector<double> times = crossing_times(exit);
      for (std::size_t i = 0; i < table.rows.size(); ++i) {
        if (table.rows[i][exit_column] != exit.value("id", "")) continue;
        const double time_s = number_of(table.rows[i][time_column]);
        const double queue = number_of(table.rows[i][queue_column]);
        const double wait_s = number_of(table.rows[i][wait_column]);
        constexpr double kDelayS = 4.5;  // as in check_crossings()
        const auto passed = static_cast<double>(
            std::upper_bound(times.begin(), times.end(), time_s + 1e-3) -
            std::lower_bound(times.begin(), times.end(), time_s - kWindowS - kDelayS));
        const double min_wait_s = queue * kPriorS / (passed + capacity * kPriorS);
        const double max_wait_s = queue * (kWindowS + kPriorS) / (capacity * kPriorS);
        constexpr double kRoundingS = 0.011;
        if (wait_s >= min_wait_s - kRoundingS && wait_s <= max_wait_s + kRoundingS) continue;
        fault(
            fmt::format("exits/{}.csv line {}: predicted_wait {} s for a queue of {}, expected "
                        "{:.2f} to {:.2f} s",
                        name_, i + 2, wait_s, queue, min_wait_s, max_wait_s));
        return;
      }
    }
  }

  const DatasetInfo& info_;
  const json& run_;
  std::string name_;
  Findings& findings_;
};

}  // namespace

void check_metrics(const DatasetInfo& info, const json& manifest, Findings& findings) {
  const fs::path file = info.root / kMetricsFile;
  if (!fs::is_regular_file(file)) return;
  const json metrics = parse_json_or_discard(read_file(file), kOwnJsonLimits);
  if (!metrics.is_object() || !metrics.contains("runs")) {
    findings.add("metrics", kMetricsFile, "", "not the JSON that throng wrote");
    return;
  }
  if (metrics.at("runs").size() != info.runs.size()) {
    findings.add("metrics", kMetricsFile, "",
                 fmt::format("{} runs, but the manifest has {}", metrics.at("runs").size(),
                             info.runs.size()));
    return;
  }
  for (std::size_t i = 0; i < info.runs.size(); ++i) {
    const json& run = metrics.at("runs").at(i);
    const json& listed = manifest.at("runs").at(i);
    if (run.at("run") != info.runs[i] ||
        (listed.contains("seed") && run.value("seed", json()) != listed.at("seed"))) {
      findings.add("metrics", kMetricsFile, info.runs[i], "not the manifest's run and seed");
    }
    RunFigures(info, run, findings).check();
  }
}

}  // namespace throng::formats
