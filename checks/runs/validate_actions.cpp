// Actions of people in images against the run's table, their state, groups and places.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "annotate/people/actions.h"
#include "base/error.h"
#include "base/files/files.h"
#include "checks/run_checks.h"
#include "formats/files/csv_table.h"
#include "skinning/animate/action.h"
#include "spec/annotate/table_columns.h"

namespace throng::checks {

using annotate::GroundTruth;
using nlohmann::json;

namespace {

/// Somebody does one of these at a time.
constexpr std::array kMotions = {"stand", "walk",   "run", "turn",  "fall",
                                 "lie",   "get_up", "sit", "squat", "cower"};

/// An action that goes with a motion.
bool is_other_action(const std::string& name) {
  return name == "carry" || std::find(skinning::kActionNames.begin(), skinning::kActionNames.end(),
                                      name) != skinning::kActionNames.end();
}

/// The version of labels since which people who sit, squat or cower have states of their own.
constexpr int kPosturesSince = 4;

/// The table has steps of the crowd, and a pose between two of them may be of the next motion.
constexpr double kActionStepS = 0.25;

bool is_motion_action(const std::string& name) {
  return std::find(kMotions.begin(), kMotions.end(), name) != kMotions.end();
}

}  // namespace

void ActionsCheck::add(const formats::DatasetInfo& info, const formats::Image& image,
                       Findings& findings) {
  if (!knows_postures_) knows_postures_ = label_version(info) >= kPosturesSince;
  std::map<std::int64_t, const formats::Person*> by_track;
  for (const formats::Person& person : image.people) by_track[person.track_id] = &person;
  for (const formats::Person& person : image.people) {
    const auto found = person.record.find("actions");
    if (info.has(GroundTruth::actions) != (found != person.record.end())) {
      findings.add("schema", person, "actions are missing, or not of this job");
    }
    groups_.try_emplace(person.track_id, person.track->value("group", json()));
    if (found == person.record.end()) continue;
    check_names(person, *found, findings);
    check_together(person, by_track, findings);
    seen_[image.run].push_back(
        {person.id, person.track_id, image.time_s, found->get<std::set<std::string>>()});
  }
}

void ActionsCheck::check_names(const formats::Person& person, const json& names,
                               Findings& findings) const {
  const auto fault = [&](const std::string& what) { findings.add("actions", person, what); };
  int motions = 0;
  for (const json& name : names) {
    const bool is_motion = is_motion_action(name.get<std::string>());
    if (!is_motion && !is_other_action(name.get<std::string>())) {
      fault(fmt::format("{} is no action", name.dump()));
    }
    motions += is_motion ? 1 : 0;
  }
  if (motions != 1) {
    fault(fmt::format("{} of {} are motions of the body, expected 1", motions, names.dump()));
  }
  const auto does = [&](const char* name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  const bool is_unlike_posture = does("sit") != (person.state == "sitting") ||
                                 (does("squat") || does("cower")) != (person.state == "squatting");
  // A library of a user's own may have no motion of falling.
  const bool is_unlike = (does("fall") != (person.state == "falling")) ||
                         (does("get_up") != (person.state == "getting_up")) ||
                         (does("lie") && person.state != "lying") ||
                         (*knows_postures_ && is_unlike_posture);
  if (is_unlike) {
    fault(fmt::format("actions {}, but the state is {}", names.dump(), person.state));
  }
  const auto attributes = person.track->find("attributes");
  if (attributes != person.track->end() &&
      does("carry") != (attributes->value("carries", "nothing") != "nothing")) {
    fault(fmt::format("actions {}, but carries is {}", names.dump(),
                      attributes->value("carries", "nothing")));
  }
  constexpr double kStandingMps = 1.2;
  for (const char* motion : {"stand", "sit", "squat", "cower"}) {
    if (!does(motion) || person.velocity.norm() <= kStandingMps) continue;
    fault(fmt::format("action {} at {:.2f} m/s", motion, person.velocity.norm()));
  }
}

void ActionsCheck::check_together(const formats::Person& person,
                                  const std::map<std::int64_t, const formats::Person*>& by_track,
                                  Findings& findings) {
  constexpr double kSlackM = 0.5;  // places are those of the step before
  const json& group = person.track->at("group");
  const auto others = person.record.at("together_with").get<std::set<std::int64_t>>();
  for (const auto& [track, other] : by_track) {
    if (track == person.track_id) continue;
    const bool is_group = !group.is_null() && other->track->at("group") == group;
    const double distance_m = (other->position - person.position).norm();
    const bool is_listed = others.contains(track);
    const bool is_wrong = is_listed ? !is_group || distance_m > annotate::kTogetherM + kSlackM
                                    : is_group && distance_m < annotate::kTogetherM - kSlackM;
    if (!is_wrong) continue;
    findings.add(
        "actions", person,
        fmt::format("together_with {} {}, who is {} and {:.2f} m away", is_listed ? "has" : "lacks",
                    track, is_group ? "of the group" : "not of the group", distance_m));
    return;
  }
}

void ActionsCheck::finish(const formats::DatasetInfo& info, Findings& findings) {
  for (const std::string& run : info.runs) {
    const std::string file = ground_truth_file(GroundTruth::actions, run);
    try {
      const formats::CsvTable table = formats::read_csv(info.root / file);
      check_table(table, file, seen_[run], findings);
      check_groups(table, file, findings);
    } catch (const InputError& error) {
      findings.add("actions", file, "", error.problems().front().found);
    } catch (const std::exception& error) {
      findings.add("actions", file, "", error.what());
    }
  }
}

/// People who are together are of one group.
void ActionsCheck::check_groups(const formats::CsvTable& table, const std::string& file,
                                Findings& findings) const {
  constexpr std::size_t kOther = 2;
  for (const std::vector<std::string>& row : table.rows) {
    if (row.size() <= kOther || row[1] != "together") continue;
    const auto own = groups_.find(std::stoll(row[0]));
    const auto other = groups_.find(std::stoll(row[kOther]));
    if (own == groups_.end() || other == groups_.end()) continue;
    if (!own->second.is_null() && own->second == other->second) continue;
    return findings.add("actions", file, fmt::format("track {}", row[0]),
                        fmt::format("together with track {}, but their groups are {} and {}",
                                    row[kOther], own->second.dump(), other->second.dump()));
  }
}

void ActionsCheck::check_table(const formats::CsvTable& table, const std::string& file,
                               const std::vector<Seen>& seen, Findings& findings) {
  if (fmt::format("{}", fmt::join(table.columns, ",")) != annotate::kActionColumns) {
    return findings.add("actions", file, "line 1", "other columns");
  }
  struct Stretch {
    std::string action;
    double from_s = 0;
    double to_s = 0;
  };
  std::map<std::int64_t, std::vector<Stretch>> stretches;
  for (const std::vector<std::string>& row : table.rows) {
    const Stretch stretch{row[1], formats::parse_number(row[3]), formats::parse_number(row[4])};
    if (!(stretch.from_s <= stretch.to_s)) {
      return findings.add("actions", file, row[0], "ends before it begins");
    }
    if (row[1] != "together") stretches[std::stoll(row[0])].push_back(stretch);
  }
  for (const Seen& person : seen) {
    const std::vector<Stretch>& own = stretches[person.track_id];
    const auto is_in = [&](const Stretch& stretch, double slack_s) {
      return stretch.from_s - slack_s <= person.time_s && person.time_s <= stretch.to_s + slack_s;
    };
    const auto fault = [&](const std::string& action, const char* what) {
      findings.add("actions", file, fmt::format("annotation {}", person.id),
                   fmt::format("{} at {} s {}", action, person.time_s, what));
    };
    for (const std::string& action : person.actions) {
      const bool is_known = std::any_of(own.begin(), own.end(), [&](const Stretch& stretch) {
        return stretch.action == action && is_in(stretch, kActionStepS);
      });
      if (!is_known) return fault(action, "is in the image's record only");
    }
    for (const Stretch& stretch : own) {
      if (is_in(stretch, -kActionStepS) && !person.actions.contains(stretch.action)) {
        return fault(stretch.action, "is in the table only");
      }
    }
  }
}

}  // namespace throng::checks
