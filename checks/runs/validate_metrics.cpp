// metrics.json against metrics/RUN.json, the tables of exits, and itself.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "base/files/files.h"
#include "base/json/json_text.h"
#include "checks/run_checks.h"
#include "checks/validate_figures.h"

namespace throng::checks {

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
  RunFigures(const formats::DatasetInfo& info, const json& run, Findings& findings)
      : info_(info), run_(run), name_(run.at("run")), findings_(findings) {}

  void check() const {
    check_copy();
    check_escapes();
    for (const json& exit : run_.value("exits", json::array())) check_exit(exit);
    const Report report = [this](const std::string& what) { fault(what); };
    check_run_figures(run_, report);
    check_against_exit_table(info_.root, run_, report);
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

  const formats::DatasetInfo& info_;
  const json& run_;
  std::string name_;
  Findings& findings_;
};

}  // namespace

void check_metrics(const formats::DatasetInfo& info, const json& manifest, Findings& findings) {
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

}  // namespace throng::checks
