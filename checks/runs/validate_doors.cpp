// Events at exits against the exits' table, crossings of their lines, and figures: when a door
// closes, and by which door people escape.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "checks/door_checks.h"
#include "formats/files/csv_table.h"

namespace throng::checks {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

/// Tables and figures are of steps of the crowd.
constexpr double kDoorStepS = 0.51;

struct DoorState {
  double time_s = 0;
  bool is_closed = false;
};
using DoorStates = std::map<std::string, std::vector<DoorState>>;  ///< by exit

/// Reads exits/RUN.csv; empty without that table.
DoorStates read_states(const fs::path& root, const std::string& run) {
  DoorStates states;
  const fs::path file = root / annotate::ground_truth_file(annotate::GroundTruth::exits, run);
  if (!fs::is_regular_file(file)) return states;
  const formats::CsvTable table = formats::read_csv(file);
  const std::size_t time = table.find("time_s");
  const std::size_t exit = table.find("exit");
  const std::size_t state = table.find("state");
  if (std::max({time, exit, state}) >= table.columns.size()) return states;
  for (const std::vector<std::string>& row : table.rows) {
    states[row[exit]].push_back({formats::parse_number(row[time]), row[state] == "closed"});
  }
  return states;
}

using Closures = std::map<std::string, std::pair<double, std::size_t>>;  ///< time and event

/// The event and the table's rows of an exit; closures are for good.
void check_rows(const std::string& exit, const std::vector<DoorState>& rows,
                const Closures& closures, const formats::EventReport& report) {
  const auto closure = closures.find(exit);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (closure == closures.end()) {
      if (i == 0 || !rows[i].is_closed || rows[i - 1].is_closed) continue;
      return report(formats::kNoEvent,
                    fmt::format("no exit_closes of {}, which is closed at {} s by its "
                                "table and was open at {} s",
                                exit, rows[i].time_s, rows[i - 1].time_s));
    }
    const double since_s = rows[i].time_s - closure->second.first;
    if (std::abs(since_s) <= kDoorStepS || (since_s > 0) == rows[i].is_closed) continue;
    return report(closure->second.second,
                  fmt::format("{} closes, but it is {} at {} s by its table", exit,
                              rows[i].is_closed ? "closed" : "open", rows[i].time_s));
  }
}

/// The event and the time for which an exit was closed by its figures.
void check_time_in_state(const json& figures, const json& exit, const Closures& closures,
                         const formats::EventReport& report) {
  const std::string id = exit.value("id", "");
  const json states = exit.value("time_in_state", json::object());
  if (!states.contains("closed_s") || !figures.contains("duration_s")) return;
  double all_s = 0;
  for (const auto& entry : states.items()) all_s += entry.value().get<double>();
  const double closed_s = states.at("closed_s").get<double>();
  const bool closes = closed_s > kDoorStepS && closed_s < all_s - kDoorStepS;
  const auto closure = closures.find(id);
  if (closure == closures.end()) {
    if (!closes) return;
    return report(formats::kNoEvent,
                  fmt::format("no exit_closes of {}, which is closed for {:.1f} of {:.1f} "
                              "s by metrics",
                              id, closed_s, all_s));
  }
  const double expected_s = figures.at("duration_s").get<double>() - closure->second.first;
  if (std::abs(closed_s - expected_s) <= kDoorStepS) return;
  report(closure->second.second,
         fmt::format("{} closes, but it is closed for {:.1f} s by metrics, not {:.1f} s", id,
                     closed_s, expected_s));
}

/// Lines that each track crosses outward, in order of time.
using Crossings = std::map<std::int64_t, std::vector<std::string>>;

/// Reads counts/RUN.csv; empty without that file.
Crossings read_crossings(const fs::path& root, const std::string& run) {
  Crossings crossings;
  const fs::path file = root / annotate::ground_truth_file(annotate::GroundTruth::counts, run);
  if (!fs::is_regular_file(file)) return crossings;
  const formats::CsvTable table = formats::read_csv(file);
  const std::size_t kind = table.find("kind");
  const std::size_t id = table.find("id");
  const std::size_t left = table.find("left");
  if (std::max({kind, id, left}) >= table.columns.size()) return crossings;
  for (const std::vector<std::string>& row : table.rows) {
    if (row[kind] != "line") continue;
    std::istringstream tracks(row[left]);
    for (std::int64_t track = 0; tracks >> track;) {
      crossings[track].push_back(row[id]);
    }
  }
  return crossings;
}

std::set<std::string> exit_ids(const json& figures) {
  std::set<std::string> exits;
  for (const json& exit : figures.value("exits", json::array())) exits.insert(exit.value("id", ""));
  return exits;
}

/// Another exit whose line somebody crossed outward, who never crossed that of `exit`; "" if there
/// is none. Lines that the job adds are no exits.
std::string crossed_instead(const Crossings& crossings, const std::set<std::string>& exits,
                            std::int64_t track, const std::string& exit) {
  const auto own = crossings.find(track);
  std::string other;
  if (own == crossings.end()) return other;
  for (const std::string& line : own->second) {
    if (line == exit) return "";
    if (exits.contains(line)) other = line;
  }
  return other;
}

}  // namespace

void check_closures(const fs::path& root, const std::string& run,
                    const std::vector<formats::RunEvent>& events, const json& figures,
                    const formats::EventReport& report) {
  Closures closures;
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (events[i].type != "exit_closes") continue;
    closures.try_emplace(events[i].record.at("exit").get<std::string>(), events[i].time_s, i);
  }
  const DoorStates states = read_states(root, run);
  for (const auto& [exit, closure] : closures) {
    if (states.empty() || states.contains(exit)) continue;
    report(closure.second, fmt::format("closes {}, which is no exit of the run", exit));
  }
  for (const auto& [exit, rows] : states) check_rows(exit, rows, closures, report);
  for (const json& exit : figures.value("exits", json::array())) {
    check_time_in_state(figures, exit, closures, report);
  }
}

void check_escape_exits(const fs::path& root, const std::string& run,
                        const std::vector<formats::RunEvent>& events, const json& figures,
                        std::int64_t first_track, const formats::EventReport& report) {
  constexpr double kSlackS = 1e-3;
  std::map<std::int64_t, std::pair<double, std::string>> escapes;  // by track, of metrics
  const json people = figures.value("by_person", json::object());
  const json agents = people.value("agent", json::array());
  const json times = people.value("escaped_s", json::array());
  const json exits = people.value("exit", json::array());
  for (std::size_t i = 0; i < std::min({agents.size(), times.size(), exits.size()}); ++i) {
    if (!times[i].is_number() || !exits[i].is_string()) continue;
    escapes[first_track + agents[i].get<std::int64_t>()] = {times[i].get<double>(),
                                                            exits[i].get<std::string>()};
  }
  const auto crossings = read_crossings(root, run);
  const std::set<std::string> all_exits = exit_ids(figures);
  for (std::size_t i = 0; i < events.size(); ++i) {
    const json& record = events[i].record;
    if (events[i].type != "escapes" || !record.contains("exit")) continue;
    const auto exit = record.at("exit").get<std::string>();
    const auto track = record.at("track_id").get<std::int64_t>();
    const auto known = escapes.find(track);
    if (known != escapes.end() && std::abs(known->second.first - events[i].time_s) <= kSlackS &&
        known->second.second != exit) {
      return report(i, fmt::format("escapes by {}, by metrics by {}", exit, known->second.second));
    }
    const std::string other = crossed_instead(crossings, all_exits, track, exit);
    if (!other.empty()) {
      return report(
          i, fmt::format("escapes by {}, but counts has the track cross {} only", exit, other));
    }
  }
}

}  // namespace throng::checks
