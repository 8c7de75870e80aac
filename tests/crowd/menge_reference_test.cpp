// Against series recorded with Menge itself, where they are at hand (they are not in the
// repository): its example projects, run with seed 1234 on one thread.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "base/files/resources.h"
#include "crowd/project/project.h"
#include "tests/crowd/crowd_files.h"

namespace throng::crowd {
namespace {

const std::filesystem::path kExamples = source_folder() / "../shared/data/menge_examples";

/// How long a run can be expected to follow Menge's. Rounding differs, and dense crowds multiply a
/// difference by ten every few seconds: what two of our own runs that start 1 micrometer apart do
/// not have in common is not asked for.
struct Agreement {
  std::string name;     ///< of the series
  std::string project;  ///< without .xml
  std::string model = "orca";
  double places_until_s = 5;     ///< within 0.05 m
  double states_until_s = 1000;  ///< share of the agents in each state, within 0.05
  double end_share = 0.05;       ///< of the time at which all are final; 0: it has no end
  double run_until_s = 1000;
  /// States of the file's first `prob` target in the order in which Menge went through them,
  /// which was that of their addresses in memory. All other orders lead elsewhere in a second.
  std::vector<std::string> target_order = {};
};

std::ostream& operator<<(std::ostream& out, const Agreement& agreement) {
  return out << agreement.name;
}

/// A file of comma-separated values with a line of names.
struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;

  std::size_t column(const std::string& name) const {
    return static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) -
                                    columns.begin());
  }
  double number(const std::vector<std::string>& row, const std::string& name) const {
    return std::stod(row[column(name)]);
  }
};

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
  return fields;
}

Table read_table(const std::filesystem::path& file) {
  std::ifstream in(file);
  Table table;
  std::string line;
  std::getline(in, line);
  table.columns = split(line);
  while (std::getline(in, line)) table.rows.push_back(split(line));
  return table;
}

std::string read_text(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// A behavior file whose first `prob` target has its states in this order.
std::string with_target_order(std::string text, const std::vector<std::string>& order) {
  // XML comments may hold a target, too.
  for (std::size_t at = text.find("<!--"); at != std::string::npos; at = text.find("<!--")) {
    text.erase(at, text.find("-->", at) + 3 - at);
  }
  const std::string open = "<Target type=\"prob\">";
  const std::size_t begin = text.find(open) + open.size();
  const std::size_t end = text.find("</Target>", begin);
  const std::string target = text.substr(begin, end - begin);
  std::string reordered;
  for (const std::string& name : order) {
    const std::size_t at = target.find("<State name=\"" + name + "\"");
    reordered += target.substr(at, target.find("/>", at) + 2 - at);
  }
  return text.replace(begin, end - begin, reordered);
}

class MengeReference : public testing::TestWithParam<Agreement> {
 protected:
  void SetUp() override {
    const Agreement& agreement = GetParam();
    const auto series_file = kExamples / "reference" / ("core_" + agreement.name + ".csv");
    if (!std::filesystem::exists(series_file)) GTEST_SKIP() << "no reference series here";
    series = read_table(series_file);
    const Table place_table =
        read_table(kExamples / "reference" / ("core_" + agreement.name + "_pos.csv"));
    for (const auto& row : place_table.rows) {
      places[place_table.number(row, "time")].push_back(
          {static_cast<float>(place_table.number(row, "x")),
           static_cast<float>(place_table.number(row, "y"))});
    }
    Project project = load_project(kExamples / (agreement.project + ".xml"));
    project.options.seed = 1234;
    project.options.model = agreement.model;
    project.options.compat = Compat::menge;
    if (!agreement.target_order.empty()) {
      // In a copy of the folder, for the maps and meshes beside it.
      std::filesystem::copy(project.behavior_file.parent_path(), copied.path(),
                            std::filesystem::copy_options::recursive);
      project.behavior_file =
          copied.write("reordered.xml",
                       with_target_order(read_text(project.behavior_file), agreement.target_order));
    }
    if (agreement.model != "orca") project.options.time_step_s = 0.1;
    const bool by_forces = agreement.model != "orca" && agreement.model != "pedvo";
    if (by_forces) project.options.sub_steps = 9;  // as recorded
    crowd =
        std::make_unique<Simulation>(project.scene_file, project.behavior_file, project.options);
  }

  void advance_to(double time_s) {
    while (!crowd->all_final() && crowd->time_s() < time_s - 0.5 * crowd->dt_s()) crowd->step();
  }

  double share_in(const std::string& state) const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < crowd->agent_count(); ++i) {
      if (test::state_name(*crowd, i) == state) ++count;
    }
    return static_cast<double>(count) / static_cast<double>(crowd->agent_count());
  }

  void expect_states(const std::vector<std::string>& row) const {
    const auto count = static_cast<double>(crowd->agent_count());
    for (const std::string& state : crowd->state_names()) {
      EXPECT_NEAR(share_in(state), series.number(row, "n_" + state) / count, 0.05)
          << state << " at " << row[0] << " s";
    }
  }

  void expect_places(double time_s) const {
    const auto found = places.find(time_s);
    if (found == places.end()) return;
    ASSERT_EQ(crowd->agent_count(), found->second.size());
    const float tolerance = time_s == 0 ? 1e-4F : 0.05F;
    for (std::size_t i = 0; i < crowd->agent_count(); ++i) {
      EXPECT_LT((crowd->positions()[i] - found->second[i]).norm(), tolerance)
          << "agent " << i << " at " << time_s << " s";
    }
  }

  /// The middle of the crowd and how far it spreads, which the series have for every second.
  void expect_spread(const std::vector<std::string>& row) const {
    const auto count = static_cast<float>(crowd->agent_count());
    Eigen::Array2f sum = Eigen::Array2f::Zero();
    for (const Eigen::Vector2f& place : crowd->positions()) sum += place.array();
    const Eigen::Array2f mean = sum / count;
    Eigen::Array2f squares = Eigen::Array2f::Zero();
    for (const Eigen::Vector2f& place : crowd->positions()) {
      squares += (place.array() - mean).square();
    }
    const Eigen::Array2f spread = (squares / count).sqrt();
    for (int axis = 0; axis < 2; ++axis) {
      const std::string suffix = axis == 0 ? "_x" : "_y";
      EXPECT_NEAR(mean[axis], series.number(row, "mean" + suffix), 0.01) << row[0] << " s";
      EXPECT_NEAR(spread[axis], series.number(row, "std" + suffix), 0.01) << row[0] << " s";
    }
  }

  test::TemporaryFolder copied;
  Table series;
  std::map<double, std::vector<Eigen::Vector2f>> places;
  std::unique_ptr<Simulation> crowd;
};

TEST_P(MengeReference, Agrees) {
  const Agreement& agreement = GetParam();
  EXPECT_EQ(crowd->state_names().size(),
            std::count_if(series.columns.begin(), series.columns.end(),
                          [](const auto& name) { return name.starts_with("n_"); }));
  std::map<double, const std::vector<std::string>*> moments;
  for (const auto& row : series.rows) moments[series.number(row, "time")] = &row;
  for (const auto& [time_s, them] : places) moments.try_emplace(time_s, nullptr);
  for (const auto& [time_s, row] : moments) {
    if (time_s > agreement.run_until_s) break;
    advance_to(time_s);
    if (crowd->all_final()) break;
    if (time_s <= agreement.places_until_s) expect_places(time_s);
    if (row != nullptr && time_s <= agreement.places_until_s) expect_spread(*row);
    if (row != nullptr && time_s <= agreement.states_until_s) expect_states(*row);
  }
  if (agreement.end_share == 0) return;
  const double end_s = series.number(series.rows.back(), "time");
  advance_to(2 * end_s);
  EXPECT_NEAR(crowd->time_s(), end_s, agreement.end_share * end_s);
}

constexpr double kEndless = 0;
constexpr double kChaotic = 0.4;  // as far apart as our own runs that start 1 micrometer apart

std::vector<Agreement> agreements() {
  const std::string events = "events/state_population_event/";
  return {
      {"boolean", "boolean", "orca", 40},
      {"circle", "circle", "orca", 4, 12, kChaotic},
      {"cross", "cross", "orca", 130, 130, kEndless},
      {"4square", "4square", "orca", 10, 20, kChaotic},
      {"profileSelect", "profileSelect", "orca", 25},
      {"obstacleSwitch", "obstacleSwitch", "orca", 60.5, 60, kEndless, 61},
      {"persistGoal", "persistGoal", "orca", 55, 55, kEndless, 60},
      {"randomGoal", "randomGoal", "orca", 6, 8, kEndless, 10},
      {"pedModelSwap", "pedModelSwap", "orca", 12.1, 20, kEndless, 20},
      {"events_change_state_effect_change_state", "events/change_state_effect/change_state", "orca",
       24.5},
      {"events_state_population_event_do_decrease", events + "do_decrease", "orca", 11.5, 1000,
       kChaotic},
      {"events_state_population_event_do_increase", events + "do_increase", "orca", 11.5, 1000,
       kChaotic},
      {"events_state_population_event_drop_to", events + "drop_to", "orca", 25.5},
      {"events_state_population_event_rise_to", events + "rise_to", "orca", 25.5},
      {"globalNavSwap-vectorfield", "globalNavSwap-vectorfield", "orca", 25},
      {"globalNavSwap-roadmap", "globalNavSwap-roadmap", "orca", 25},
      {"globalNavSwap-navmesh", "globalNavSwap-navmesh", "orca", 6, 20},
      {"path_goal", "path_goal", "orca", 10},
      {"bottleneck", "bottleneck", "orca", 40},
      {"sharedGoal", "sharedGoal", "orca", 35, 45, kEndless, 50, {"BoxMed", "BoxSmall", "BoxBig"}},
      {"office",
       "office",
       "orca",
       11,
       60,
       kEndless,
       60,
       {"GoOutside", "GoToCubicle", "GoToBathroom", "GoToFax", "GoToKitchen"}},
      {"bottleneck__pedvo", "bottleneck", "pedvo", 40},
      {"bottleneck__helbing", "bottleneck", "helbing", 40},
      {"cross__helbing", "cross", "helbing", 15},
      {"cross__johannson", "cross", "johannson", 125, 125, kEndless},
      {"cross__pedvo", "cross", "pedvo", 130, 130, kEndless},
      {"4square__pedvo", "4square", "pedvo", 12.1, 20, kEndless, 20},
      {"pedModelSwap__pedvo", "pedModelSwap", "pedvo", 12.1, 20, kEndless, 20},
  };
}

INSTANTIATE_TEST_SUITE_P(Core, MengeReference, testing::ValuesIn(agreements()),
                         [](const auto& tested) {
                           std::string name = tested.param.name;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace throng::crowd
