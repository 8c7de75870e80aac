// experiments.json and folders of recordings: what is read, and every error by its pointer.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/schemas/json_schema.h"
#include "spec/documents/published_schemas.h"
#include "tests/validation/experiments/recordings.h"
#include "tests/world/temporary_folder.h"
#include "validation/experiments/experiment.h"

namespace throng::validation {
namespace {

using nlohmann::json;
using testing::TemporaryFolder;

json corridor_json() {
  return json::parse(R"({
    "name": "corridor", "file": "walk.txt", "frame_rate_hz": 25, "unit": "cm",
    "free_speed_mps": {"mean": 1.4, "stddev": 0.2},
    "walkable": [[0, 0], [20, 0], [20, 2], [0, 2]],
    "obstacles": [[[4, 0], [5, 0], [5, 1]]],
    "goals": [{"min": [18, 0.2], "max": [19.5, 1.8]}],
    "area": {"min": [8, 0], "max": [12, 2]},
    "line": [[10, 0], [10, 2]],
    "steady_s": [3, 15]})");
}

json loop_json() {
  return json::parse(R"({"name": "loop", "loop": {"length_m": 30, "width_m": 2,
                         "points": [[0.5, 1.3], [2, 0.6]]}})");
}

json single_file_json() {
  return json::parse(R"({"name": "file", "file": "walk.txt", "single_file":
                         {"people": 20, "width_m": 0.8, "from_x_m": -1, "until_x_m": 2}})");
}

class ExperimentsFile : public ::testing::Test {
 protected:
  ExperimentsFile() { folder_.write("walk.txt", recording_text({{0, {1, 1}, {1, 0}, 18}})); }

  std::vector<Experiment> parse(const json& experiment) const {
    return parse_experiments(json{{"experiments", {experiment}}}.dump(), folder_.path());
  }

  /// The experiment with the value at a pointer replaced is refused with a problem there.
  void refuse(const json& sound, const std::string& pointer, const json& value,
              const std::string& expected, const std::string& where = "") const {
    json wrong = sound;
    wrong[json::json_pointer(pointer)] = value;
    refuse_document({{"experiments", {wrong}}},
                    "/experiments/0" + (where.empty() ? pointer : where), expected);
  }

  void refuse_document(const json& document, const std::string& where,
                       const std::string& expected) const {
    try {
      parse_experiments(document.dump(), folder_.path());
      ADD_FAILURE() << "accepted: " << document.dump();
    } catch (const InputError& error) {
      bool found = false;
      for (const Problem& problem : error.problems()) {
        EXPECT_EQ(problem.source, (folder_.path() / "experiments.json").string());
        found =
            found || (problem.where == where && problem.text().find(expected) != std::string::npos);
      }
      EXPECT_TRUE(found) << where << " " << expected << ":\n" << error.what();
    }
  }

  TemporaryFolder folder_;
};

TEST_F(ExperimentsFile, ReadsARecording) {
  const Experiment experiment = parse(corridor_json()).at(0);
  EXPECT_EQ(experiment.name, "corridor");
  EXPECT_EQ(experiment.free_speeds.mean_mps, 1.4);
  EXPECT_EQ(experiment.free_speeds.stddev_mps, 0.2);
  ASSERT_TRUE(experiment.recording);
  const Recording& recording = *experiment.recording;
  EXPECT_EQ(recording.file, folder_.path() / "walk.txt");
  EXPECT_EQ(recording.format.frames_per_s, 25);
  EXPECT_EQ(recording.format.unit_m, 0.01);
  EXPECT_EQ(recording.walkable.size(), 4U);
  ASSERT_EQ(recording.obstacles.size(), 1U);
  EXPECT_EQ(recording.obstacles[0][2], Eigen::Vector2d(5, 1));
  ASSERT_EQ(recording.goals.size(), 1U);
  EXPECT_EQ(recording.goals[0].max(), Eigen::Vector2d(19.5, 1.8));
  EXPECT_EQ(recording.area.min(), Eigen::Vector2d(8, 0));
  EXPECT_EQ(recording.line.to, Eigen::Vector2d(10, 2));
  ASSERT_TRUE(recording.steady);
  EXPECT_EQ(recording.steady->until_s, 15);
}

TEST_F(ExperimentsFile, NamesTheColumnsOfARecording) {
  json experiment = corridor_json();
  experiment["columns"] = "frame,id,x,y";
  const Experiment read = parse(experiment).at(0);
  ASSERT_TRUE(read.recording);
  EXPECT_EQ(read.recording->format.columns.frame, "1");
  EXPECT_EQ(read.recording->format.columns.person, "2");
  refuse(corridor_json(), "/columns", "frame,x,y", "id, x, y and either frame or time");
}

TEST_F(ExperimentsFile, ReadsLoopsAndSingleFiles) {
  const Experiment loop = parse(loop_json()).at(0);
  ASSERT_TRUE(loop.loop);
  EXPECT_FALSE(loop.recording || loop.single_file);
  EXPECT_EQ(loop.loop->recorded.at(1).density, 2);
  EXPECT_EQ(loop.free_speeds.mean_mps, 1.34) << "Weidmann's";
  const Experiment single = parse(single_file_json()).at(0);
  ASSERT_TRUE(single.single_file);
  EXPECT_EQ(single.single_file->people, 20U);
  EXPECT_EQ(single.single_file->from_x_m, -1);
}

TEST_F(ExperimentsFile, NamesWrongFieldsOfARecording) {
  const json sound = corridor_json();
  refuse(sound, "/name", "a b", "a name of letters");
  refuse(sound, "/name", std::string(101, 'a'), "at most 100 characters");
  refuse(sound, "/file", "wlak.txt", "did you mean walk.txt?");
  refuse(sound, "/file", 3, "text");
  refuse(sound, "/frame_rate_hz", 0, "0.01 to 10000");
  refuse(sound, "/unit", "inch", "\"cm\"");
  refuse(sound, "/unit", 1, "\"cm\"");
  refuse(sound, "/free_speed_mps", 1.3, "an object");
  refuse(sound, "/free_speed_mps/mean", 0, "0.3 to 2.5");
  refuse(sound, "/free_speed_mps/stddev", -1, "0 to 2");
  refuse(sound, "/free_speed_mps/median", 1, "did you mean \"mean\"?");
  refuse(sound, "/walkable", json::parse("[[0, 0], [20, 0]]"), "3 to 1000");
  refuse(sound, "/walkable", json::parse("[[0, 0], [20, 2], [20, 0], [0, 2]]"), "do not cross");
  refuse(sound, "/walkable/1", json::parse("[0, 0]"), "have a length", "/walkable");
  refuse(sound, "/walkable/1/0", 501, "-500 to 500");
  refuse(sound, "/walkable/1/0", "a", "-500 to 500");
  refuse(sound, "/walkable", json(std::vector<json>(1001, json{0, 0})), "3 to 1000");
  refuse(sound, "/obstacles/0", json::parse("[[4, 0], [5, 0]]"), "3 to 1000");
  refuse(sound, "/obstacles", "none", "an array");
  refuse(sound, "/goals", json::array(), "1 to 20");
  refuse(sound, "/goals", json(std::vector<json>(21, sound["goals"][0])), "1 to 20");
  refuse(sound, "/goals/0/max", json::parse("[17, 1.8]"), "above those of min");
  refuse(sound, "/goals/0/mix", 1, "did you mean");
  refuse(sound, "/goals/0", json::parse(R"({"min": [30, 0], "max": [31, 1]})"), "touches");
  refuse(sound, "/area", json::parse(R"({"min": [8, 3], "max": [12, 4]})"), "touches");
  refuse(sound, "/area/min", 3, "[x, y]");
  refuse(sound, "/line", json::parse("[[10, 3], [12, 5]]"), "touches");
  refuse(sound, "/line", json::parse("[[10, 0], [10, 0]]"), "0.1 m or more");
  refuse(sound, "/line", json::parse("[[10, 0]]"), "[[x, y], [x, y]]");
  refuse(sound, "/steady_s", json::parse("[15, 3]"), "after the first", "/steady_s/1");
  refuse(sound, "/steady_s", 15, "[from, until]");
  refuse(sound, "/steady_s/0", -1, "0 to 7200");
  refuse(sound, "/walkabel", 1, "did you mean \"walkable\"?");
  refuse(sound, "/lop", json::object(), "did you mean \"loop\"?");
  for (const char* field : {"name", "file", "walkable", "goals", "area", "line"}) {
    json wrong = sound;
    wrong.erase(field);
    refuse_document({{"experiments", {wrong}}}, std::string("/experiments/0/") + field,
                    "found nothing");
  }
}

TEST_F(ExperimentsFile, NamesWrongFieldsOfLoops) {
  const json loop = loop_json();
  refuse(loop, "/loop/length_m", 0, "1 to 1000");
  refuse(loop, "/loop/length_m", 12, "2 π times the width");
  refuse(loop, "/loop/width_m", 30, "0.5 to 20");
  refuse(loop, "/loop/points", json::array(), "1 to 100");
  refuse(loop, "/loop/points/0", 3, "[density, speed]");
  refuse(loop, "/loop/points/0/0", 11, "0 to 10");
  refuse(loop, "/loop/points/0/0", 0.01, "1 to 10000 people");
  refuse(loop, "/loop/points/0/1", -1, "0 to 10");
  refuse(loop, "/loop/radius_m", 3, "unknown field");
  refuse(loop, "/walkable", json::array(), "unknown field");
  const json single = single_file_json();
  refuse(single, "/single_file/people", 0, "1 to 10000");
  refuse(single, "/single_file/people", 2.5, "1 to 10000");
  refuse(single, "/single_file/until_x_m", -1, "above from_x_m");
  refuse(single, "/single_file/from_x", 1, "did you mean");
  refuse(single, "/file", "other.txt", "a file in");
}

TEST_F(ExperimentsFile, NamesWrongDocuments) {
  refuse_document(json::array(), "", "an object");
  refuse_document(json::object(), "/experiments", "found nothing");
  refuse_document({{"experiments", json::array()}}, "/experiments", "1 to 1000");
  refuse_document({{"experiments", {3}}}, "/experiments/0", "an object");
  refuse_document({{"experiments", {loop_json()}}, {"experimnts", 1}}, "/experimnts",
                  "did you mean \"experiments\"?");
  refuse_document({{"experiments", {loop_json(), loop_json()}}}, "/experiments/1/name",
                  "no other experiment");
  EXPECT_THROW(parse_experiments("{", folder_.path()), InputError);
  EXPECT_THROW(parse_experiments("", folder_.path()), InputError);
}

TEST_F(ExperimentsFile, HasASchemaForEditors) {
  const schemas::JsonSchema schema(json::parse(jobs::published_schema("experiments")));
  const auto problems = [&](const json& experiment) {
    return schema.problems({{"experiments", {experiment}}}, "").size();
  };
  for (json sound : {corridor_json(), loop_json(), single_file_json()}) {
    EXPECT_EQ(problems(sound), 0U) << sound;
    sound.erase("free_speed_mps");
    EXPECT_EQ(problems(sound), 0U) << sound;
    sound["free_speed_mps"] = {{"mean", 1}};
    EXPECT_EQ(problems(sound), 1U) << "no stddev";
  }
  json without_goals = corridor_json();
  without_goals.erase("goals");
  EXPECT_GT(problems(without_goals), 0U);
  EXPECT_GT(problems({{"name", "a"}}), 0U) << "of no kind";
}

TEST_F(ExperimentsFile, LetsGoalsAndLinesTouchTheGround) {
  json experiment = corridor_json();
  experiment["goals"][0] = json::parse(R"({"min": [20, 0], "max": [22, 2]})");
  experiment["line"] = json::parse("[[10, -1], [10, 3]]");
  experiment["area"] = json::parse(R"({"min": [-1, -1], "max": [21, 3]})");
  EXPECT_EQ(parse(experiment).size(), 1U);
}

std::vector<std::string> found_names(const TemporaryFolder& folder) {
  std::vector<std::string> names;
  for (const Experiment& experiment : find_experiments(folder.path())) {
    names.push_back(experiment.name);
  }
  return names;
}

void expect_folder_refused(const std::filesystem::path& folder, const std::string& words) {
  try {
    find_experiments(folder);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr(words));
    EXPECT_THAT(error.what(), ::testing::HasSubstr(folder.string()));
  }
}

TEST(Folder, KnowsNamesInCapitals) {
  const TemporaryFolder folder;
  folder.write("traj_UNI_CORR_500_01.TXT.GZ", "");
  folder.write("SINGLE_FILE_N20_CAM2.csv", "");
  EXPECT_EQ(found_names(folder),
            (std::vector<std::string>{"SINGLE_FILE_N20_CAM2", "traj_UNI_CORR_500_01"}));
}

TEST(Folder, HasDescribedAndKnownExperiments) {
  const TemporaryFolder folder;
  folder.write("bi_corr_400_b.txt", "");
  folder.write("notes.txt", "");
  EXPECT_EQ(found_names(folder), (std::vector<std::string>{"bi_corr_400_b"}));
  EXPECT_EQ(unread_files(folder.path(), find_experiments(folder.path())),
            std::vector<std::string>{"notes.txt"});
  folder.write("uo-180-180-070.txt.gz", "");
  EXPECT_EQ(found_names(folder),
            (std::vector<std::string>{"bi_corr_400_b", "uo-180-180-070", "uo-diagram"}));
  json mine = corridor_json();
  mine["file"] = "bi_corr_400_b.txt";
  folder.write("experiments.json", json{{"experiments", {mine, loop_json()}}}.dump());
  EXPECT_EQ(found_names(folder),
            (std::vector<std::string>{"corridor", "loop", "uo-180-180-070", "uo-diagram"}))
      << "a file that is described is not taken again";
}

TEST(Folder, IsRefusedWithoutExperiments) {
  const TemporaryFolder folder;
  expect_folder_refused(folder.path(), "no experiment");
  expect_folder_refused(folder.path() / "missing", "no folder");
  expect_folder_refused(folder.write("file", ""), "a file");
  folder.write("experiments.json", "{}");
  expect_folder_refused(folder.path(), "/experiments: found nothing");
}

TEST(Folder, HasOneExperimentOfEachName) {
  const TemporaryFolder folder;
  folder.write("bi_corr_400_b.txt", "");
  folder.write("bi_corr_400_b.txt.gz", "");
  expect_folder_refused(folder.path(), "two experiments \"bi_corr_400_b\"");
}

}  // namespace
}  // namespace throng::validation
