#include "world/scenario.h"
#include "world/scenario_id.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <ostream>

#include "base/error.h"
#include "tests/world/temporary_folder.h"
#include "world/fields/read_scenario.h"

namespace throng::world {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using throng::testing::TemporaryFolder;

json valid_scenario() {
  return json::parse(R"({
    "name": "Yard",
    "crowd": {"scene": "scene.xml", "behavior": "behavior.xml"},
    "ground": {"min": [-20, -20], "max": [20, 20], "material": "asphalt"},
    "inside": {"min": [-10, -10], "max": [10, 10]},
    "exits": [
      {"id": "a", "from": [10, -1], "to": [10, 1], "goals": [[3, 0], [4, 0]]},
      {"id": "b", "from": [-2, -10], "to": [1, -10], "outward": [0, -2], "goals": [[3, 1]]}],
    "buildings": [{"id": "hut", "footprint": [[0, 0], [4, 0], [4, 4], [0, 4]], "height_m": 6}],
    "drones": [{"id": "d1", "start": [-5, 0, 12], "yaw_deg": 90, "moves_goal": [99, 0]}],
    "disaster_agents": [7]
  })");
}

class ScenarioFile : public ::testing::Test {
 protected:
  void SetUp() override {
    folder.write("scene.xml", "<scene/>");
    folder.write("behavior.xml", "<behavior/>");
  }
  Scenario load(const json& document) { return load_text(document.dump(1)); }
  Scenario load_text(const std::string& text) {
    return load_scenario(folder.write("yard.json", text), "yard");
  }
  std::vector<Problem> list_problems(const std::string& text) {
    try {
      load_text(text);
    } catch (const InputError& error) {
      return error.problems();
    }
    return {};
  }

  TemporaryFolder folder;
};

TEST_F(ScenarioFile, APlaceForRecordedPeopleNeedsNeitherCrowdNorGoals) {
  json document = valid_scenario();
  document.erase("crowd");
  for (json& exit : document["exits"]) exit.erase("goals");
  const Scenario s = load(document);
  EXPECT_TRUE(s.scene_file.empty());
  EXPECT_TRUE(s.behavior_file.empty());
  EXPECT_TRUE(s.exits.at(0).goals.empty());
  document["exits"][0]["goals"] = json::array();
  EXPECT_EQ(list_problems(document.dump()).at(0).where, "/exits/0/goals") << "given, but none";
}

TEST_F(ScenarioFile, ReadsDisastersWhoseAgentsAreNotPeople) {
  json document = valid_scenario();
  document["disasters"] = json::parse(R"([{"kind": "gas", "agent": 3, "position": [1, 2],
      "start_s": 10, "radius_m": 2, "growth_mps": 0.5, "max_radius_m": 6}])");
  const Scenario s = load(document);
  ASSERT_EQ(s.disasters.size(), 1U);
  EXPECT_THAT(s.disaster_agents, ElementsAre(7, 3));
  const Disaster& gas = s.disasters.front();
  EXPECT_EQ(gas.kind, DisasterKind::gas);
  EXPECT_EQ(gas.reach_m(9.9), 0);
  EXPECT_EQ(gas.reach_m(10), 2);
  EXPECT_DOUBLE_EQ(gas.reach_m(14), 4);
  EXPECT_EQ(gas.reach_m(100), 6);
  document["disasters"].push_back(document["disasters"][0]);
  EXPECT_EQ(list_problems(document.dump()).front().where, "/disasters/1/agent");
}

TEST_F(ScenarioFile, ReadsEverything) {
  const Scenario s = load(valid_scenario());
  EXPECT_EQ(s.id, "yard");
  EXPECT_EQ(s.name, "Yard");
  EXPECT_EQ(s.scene_file, folder.path() / "scene.xml");
  EXPECT_EQ(s.behavior_file, folder.path() / "behavior.xml");
  EXPECT_EQ(s.ground.max, Eigen::Vector2d(20, 20));
  EXPECT_EQ(s.ground_material, "asphalt");
  EXPECT_TRUE(s.inside.contains({10, -10}));
  EXPECT_FALSE(s.inside.contains({10.1, 0}));
  ASSERT_EQ(s.exits.size(), 2U);
  EXPECT_EQ(s.exits[0].goals, (std::vector<GoalRef>{{3, 0}, {4, 0}}));
  EXPECT_DOUBLE_EQ(s.exits[1].width_m(), 3);
  ASSERT_EQ(s.buildings.size(), 1U);
  EXPECT_EQ(s.buildings[0].footprint.size(), 4U);
  ASSERT_EQ(s.drones.size(), 1U);
  EXPECT_EQ(s.drones[0].position, Eigen::Vector3d(-5, 0, 12));
  EXPECT_DOUBLE_EQ(s.drones[0].yaw_rad, std::numbers::pi / 2);
  EXPECT_EQ(s.drones[0].moves_goal, (GoalRef{99, 0}));
  EXPECT_THAT(s.disaster_agents, ElementsAre(7));
}

TEST_F(ScenarioFile, InsideMayBeAPolygon) {
  json document = valid_scenario();
  document["inside"] = {{"corners", {{-10, -10}, {-10, 10}, {0, 10}, {0, 2}, {10, 2}, {10, -10}}}};
  document["exits"][0] = {{"id", "inner"}, {"from", {0, 4}}, {"to", {0, 6}}, {"goals", {{3, 0}}}};
  const Scenario s = load(document);
  EXPECT_EQ(s.inside.bounds.max, Eigen::Vector2d(10, 10));
  EXPECT_TRUE(s.inside.contains({-5, 5}));
  EXPECT_FALSE(s.inside.contains({5, 5}));
  EXPECT_EQ(s.exits[0].outward, Eigen::Vector2d(1, 0)) << "out of the polygon";
  json both = document;
  both["inside"]["min"] = {-10, -10};
  EXPECT_EQ(list_problems(both.dump()).front().where, "/inside/min");
  json bow_tie = document;
  bow_tie["inside"]["corners"] = {{0, 0}, {4, 4}, {4, 0}, {0, 4}};
  EXPECT_EQ(list_problems(bow_tie.dump()).front().where, "/inside/corners");
}

TEST_F(ScenarioFile, ADoorMayCloseAtATime) {
  json document = valid_scenario();
  document["exits"][0]["closes_at_s"] = 12.5;
  const Scenario s = load(document);
  EXPECT_TRUE(s.exits[0].is_open(12.4));
  EXPECT_FALSE(s.exits[0].is_open(12.5));
  EXPECT_FALSE(s.exits[0].is_open(125 * 0.1)) << "the step's time, however it was summed up";
  EXPECT_TRUE(s.exits[1].is_open(1e9));
  document["exits"][0]["open"] = false;
  EXPECT_EQ(list_problems(document.dump()).front().where, "/exits/0/closes_at_s");
}

TEST_F(ScenarioFile, DoorsMayHaveACapacity) {
  json document = valid_scenario();
  document["exits"][0]["capacity"] = {{"code", "sfpe"}};
  document["doors"] = {{{"id", "gates"},
                        {"from", {0, 0}},
                        {"to", {0, 3}},
                        {"capacity", {{"device", "ticket_gate"}, {"devices", 4}}}}};
  const Scenario s = load(document);
  ASSERT_TRUE(s.exits[0].capacity);
  EXPECT_EQ(s.exits[0].capacity->text(), "sfpe");
  EXPECT_FALSE(s.exits[1].capacity);
  ASSERT_EQ(s.doors.size(), 1U);
  EXPECT_NEAR(s.doors[0].capacity.per_s_at(3), 100.0 / 60, 1e-12);
}

TEST_F(ScenarioFile, ACapacityIsGivenInOneWay) {
  const auto problem_of = [this](const json& capacity) {
    json document = valid_scenario();
    document["exits"][0]["capacity"] = capacity;
    const std::vector<Problem> problems = list_problems(document.dump());
    EXPECT_EQ(problems.size(), 1U) << capacity;
    return problems.empty() ? Problem{} : problems.front();
  };
  EXPECT_EQ(problem_of(json::object()).where, "/exits/0/capacity");
  EXPECT_EQ(problem_of({{"per_s", 1}, {"code", "imo"}}).found, "\"per_s\" and \"code\"");
  EXPECT_EQ(problem_of({{"code", "imo"}, {"devices", 2}}).where, "/exits/0/capacity/devices");
  EXPECT_THAT(problem_of({{"code", "sfp"}}).expected, HasSubstr("sfpe"));
  EXPECT_EQ(problem_of({{"per_s", 0}}).where, "/exits/0/capacity/per_s");
  json narrow = valid_scenario();
  narrow["doors"] = {
      {{"id", "d"}, {"from", {0, 0}}, {"to", {0, 0.3}}, {"capacity", {{"code", "sfpe"}}}}};
  EXPECT_EQ(list_problems(narrow.dump()).front().where, "/doors/0/capacity/code");
}

TEST_F(ScenarioFile, ExitsThatCountTheSamePeopleAreRefused) {
  json document = valid_scenario();
  document["exits"].push_back({{"id", "c"}, {"from", {10.5, 0}}, {"to", {10.5, 3}}});
  const std::vector<Problem> problems = list_problems(document.dump());
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].where, "/exits/2");
  EXPECT_THAT(problems[0].found, HasSubstr("exit \"c\", which lies 0.5 m behind exit \"a\""));
  document["exits"][2]["from"] = {10, 1};
  document["exits"][2]["to"] = {10, 3};
  EXPECT_EQ(load(document).exits.size(), 3U) << "doors side by side";
}

TEST_F(ScenarioFile, NamesOfVersion01AreReadWithAWarning) {
  json document = valid_scenario();
  document["exits"][0]["shuts_s"] = 12.5;
  document["disasters"] = json::parse(R"([{"kind": "gas", "agent": 3, "position": [1, 2],
      "radius_m": 2, "growth_mps": 0.5, "most_m": 6}])");
  ::testing::internal::CaptureStderr();
  const Scenario s = load(document);
  const std::string warnings = ::testing::internal::GetCapturedStderr();
  EXPECT_THAT(warnings, HasSubstr("/exits/0/shuts_s is deprecated, use \"closes_at_s\""));
  EXPECT_THAT(warnings, HasSubstr("/disasters/0/most_m is deprecated, use \"max_radius_m\""));
  EXPECT_TRUE(s.exits[0].is_open(12.4));
  EXPECT_FALSE(s.exits[0].is_open(12.5));
  EXPECT_EQ(s.disasters.at(0).reach_m(100), 6);
  document["exits"][0]["closes_at_s"] = 20;
  const Problem both = list_problems(document.dump()).front();
  EXPECT_EQ(both.where, "/exits/0/shuts_s");
  EXPECT_EQ(both.expected, "only \"closes_at_s\"");
  document["exits"][0].erase("closes_at_s");
  document["exits"][0]["shuts"] = 1;
  EXPECT_THAT(list_problems(document.dump()).front().expected, Not(HasSubstr("shuts_s")));
}

TEST_F(ScenarioFile, OutwardIsAUnitNormalAsGivenOrAwayFromTheMiddle) {
  const Scenario s = load(valid_scenario());
  EXPECT_EQ(s.exits[0].outward, Eigen::Vector2d(1, 0));
  EXPECT_EQ(s.exits[1].outward, Eigen::Vector2d(0, -1));
}

TEST_F(ScenarioFile, OptionalPartsMayBeAbsent) {
  json document = valid_scenario();
  for (const char* key : {"buildings", "drones", "disaster_agents"}) document.erase(key);
  const Scenario s = load(document);
  EXPECT_TRUE(s.buildings.empty() && s.drones.empty());
}

TEST_F(ScenarioFile, AnExtendingFileHoldsOnlyDifferences) {
  folder.write("base.json", valid_scenario().dump());
  const auto load_extending = [&](const json& changes) {
    json document = changes;
    document["extends"] = "base.json";
    return load(document);
  };
  json exits = valid_scenario()["exits"];
  exits[1]["open"] = false;
  const Scenario s =
      load_extending({{"name", "Other"}, {"ground", {{"material", "grass"}}}, {"exits", exits}});
  EXPECT_EQ(s.name, "Other");
  EXPECT_EQ(s.ground_material, "grass");
  EXPECT_EQ(s.ground.max, Eigen::Vector2d(20, 20));
  EXPECT_TRUE(s.exits[0].open);
  EXPECT_FALSE(s.exits[1].open);
  EXPECT_EQ(s.buildings.size(), 1U);

  json chain = valid_scenario();
  chain["extends"] = "other.json";
  folder.write("base.json", chain.dump());
  EXPECT_THROW(load_extending({{"name", "Other"}}), InputError);
  for (const char* name : {"nowhere.json", "", "."}) {
    const auto problems = list_problems(json{{"extends", name}}.dump());
    ASSERT_FALSE(problems.empty()) << name;
    EXPECT_EQ(problems[0].where, "/extends");
  }
}

// One change that makes the valid scenario wrong, and where that must be reported.
struct BadCase {
  std::string name;
  std::string pointer;
  json value;
  std::string reported_at;
  std::string expected;
};
std::ostream& operator<<(std::ostream& out, const BadCase& bad) { return out << bad.name; }

class BadScenario : public ScenarioFile, public ::testing::WithParamInterface<BadCase> {};

TEST_P(BadScenario, IsReportedWhereItStands) {
  json document = valid_scenario();
  document[json::json_pointer(GetParam().pointer)] = GetParam().value;
  const auto problems = list_problems(document.dump());
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].source, (folder.path() / "yard.json").string());
  EXPECT_EQ(problems[0].where, GetParam().reported_at);
  EXPECT_THAT(problems[0].expected, HasSubstr(GetParam().expected));
  EXPECT_FALSE(problems[0].found.empty());
}

INSTANTIATE_TEST_SUITE_P(
    All, BadScenario,
    ::testing::Values(
        BadCase{"unknown_field", "/colour", "red", "/colour", "one of: name"},
        BadCase{"unknown_nested_field", "/exits/0/a~1b", 1, "/exits/0/a~1b", "one of: id"},
        BadCase{"wrong_type", "/name", 5, "/name", "text"},
        BadCase{"not_an_object", "/crowd", 5, "/crowd", "an object"},
        BadCase{"not_an_array", "/exits", 5, "/exits", "a list of at least one exit"},
        BadCase{"missing_file", "/crowd/scene", "nowhere.xml", "/crowd/scene", "file"},
        BadCase{"folder_as_file", "/crowd/scene", ".", "/crowd/scene", "file"},
        BadCase{"material", "/ground/material", "lava", "/ground/material",
                "\"pavers\", \"asphalt\""},
        BadCase{"empty_ground", "/ground/max", {-30, 5}, "/ground/max", "right of"},
        BadCase{"short_vector", "/exits/0/from", json::array({1}), "/exits/0/from", "[x, y]"},
        BadCase{"text_coordinate", "/exits/0/from/1", "1", "/exits/0/from/1", "a number"},
        BadCase{"far_away", "/exits/0/from/1", 1e9, "/exits/0/from/1", "a number"},
        BadCase{"zero_width_exit", "/exits/0/to", {10, -1}, "/exits/0/to", "at least 0.1 m"},
        BadCase{"slanted_outward", "/exits/1/outward", {1, 1}, "/exits/1/outward", "right angles"},
        BadCase{"zero_outward", "/exits/1/outward", {0, 0}, "/exits/1/outward", "right angles"},
        BadCase{"word_as_open", "/exits/0/open", "no", "/exits/0/open", "true or false"},
        BadCase{"closes_in_the_past", "/exits/0/closes_at_s", -1, "/exits/0/closes_at_s",
                "a number"},
        BadCase{"no_goals", "/exits/0/goals", json::array(), "/exits/0/goals", "at least 1"},
        BadCase{"fractional_goal", "/exits/0/goals/0/1", 0.5, "/exits/0/goals/0/1", "an integer"},
        BadCase{"huge_goal", "/exits/0/goals/0/1", 18446744073709551615U, "/exits/0/goals/0/1",
                "an integer"},
        BadCase{"goal_of_two_exits", "/exits/1/goals/0", {3, 0}, "/exits/1/goals/0", "this exit"},
        BadCase{"same_exit_twice", "/exits/1/id", "a", "/exits/1/id", "nothing else"},
        BadCase{"empty_id", "/exits/1/id", "", "/exits/1/id", "a name"},
        BadCase{"two_corners",
                "/buildings/0/footprint",
                {{0, 0}, {1, 1}},
                "/buildings/0/footprint",
                "at least 3"},
        BadCase{"clockwise",
                "/buildings/0/footprint",
                {{0, 0}, {0, 4}, {4, 4}, {4, 0}},
                "/buildings/0/footprint",
                "counter-clockwise"},
        BadCase{"bow_tie",
                "/buildings/0/footprint",
                {{0, 0}, {4, 4}, {4, 0}, {0, 4}},
                "/buildings/0/footprint",
                "do not cross"},
        BadCase{"flat",
                "/buildings/0/footprint",
                {{0, 0}, {4, 0}, {2, 0}},
                "/buildings/0/footprint",
                "do not cross"},
        BadCase{"no_height", "/buildings/0/height_m", 0, "/buildings/0/height_m", "a number"},
        BadCase{"drone_in_ground", "/drones/0/start/2", 0, "/drones/0/start", "above the ground"},
        BadCase{"drone_in_building",
                "/drones/0/start",
                {1, 1, 5},
                "/drones/0/start",
                "outside every building"},
        BadCase{"negative_agent", "/disaster_agents/0", -1, "/disaster_agents/0", "an integer"},
        BadCase{"same_agent_twice", "/disaster_agents", {7, 7}, "/disaster_agents/1", "once"}),
    [](const auto& test) { return test.param.name; });

TEST_F(ScenarioFile, AllProblemsAreReportedAtOnce) {
  json document = valid_scenario();
  document.erase("name");
  document["exits"][0]["to"] = document["exits"][0]["from"];
  document["buildings"][0]["height_m"] = "tall";
  EXPECT_EQ(list_problems(document.dump()).size(), 3U);
}

TEST_F(ScenarioFile, MalformedJsonIsReportedByLineAndColumn) {
  const auto problems = list_problems("{\n  \"name\": \"x\",\n  oops\n}");
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].where, "line 3, column 3");
  for (const std::string text : {"", "[", "\xff\xfe", "{\"name\": 1e999}", "\"\\ud800\"", "null"}) {
    EXPECT_EQ(list_problems(text).empty(), false) << text;
  }
}

TEST_F(ScenarioFile, AKeyMayNotStandTwice) {
  const auto problems = list_problems(R"({"name": "a", "name": "b"})");
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_THAT(problems[0].found, HasSubstr("\"name\" twice"));
}

TEST_F(ScenarioFile, CutShortAnywhereIsAnInputError) {
  const std::string text = valid_scenario().dump();
  for (std::size_t length = 0; length < text.size(); length += 7) {
    EXPECT_THROW(load_text(text.substr(0, length)), InputError) << length;
  }
}

TEST_F(ScenarioFile, AMissingScenarioFileIsNotTheUsersJson) {
  EXPECT_THROW(load_scenario(folder.path() / "nowhere.json", "x"), EnvironmentError);
}

TEST_F(ScenarioFile, ScenariosAreFoundById) {
  folder.write("town/scene.xml", "");
  folder.write("town/behavior.xml", "");
  folder.write("town/yard_2.json", valid_scenario().dump());
  folder.write("town/demo.job.json", "{}");
  folder.write("alone.json", "{}");
  EXPECT_THAT(list_scenarios(folder.path()), ElementsAre("alone", "town/yard_2"));
  EXPECT_EQ(scenario_file(folder.path(), "town/yard_2"), folder.path() / "town/yard_2.json");
  EXPECT_EQ(id_from_file("town/yard_2.json"), "yard_2");
}

std::string suggested(const std::filesystem::path& folder, const std::string& name) {
  try {
    scenario_file(folder, name);
  } catch (const InputError& error) {
    return error.problems()[0].expected;
  }
  return "found";
}

TEST_F(ScenarioFile, BlueprintsAreFoundByIdUnlessAScenarioWasMadeOfThem) {
  folder.write("town/hall.blueprint.json", R"({"ground": {}, "people": {}})");
  EXPECT_THAT(list_scenarios(folder.path()), ElementsAre("town/hall"));
  EXPECT_EQ(scenario_file(folder.path(), "town/hall"), folder.path() / "town/hall.blueprint.json");
  EXPECT_EQ(id_from_file("town/hall.blueprint.json"), "hall");
  EXPECT_TRUE(has_scenario(folder.path(), "town/hall"));
  EXPECT_FALSE(has_scenario(folder.path(), "town/nothing"));
  EXPECT_FALSE(has_scenario(folder.path(), "../town/hall"));
  folder.write("town/hall.json", valid_scenario().dump());
  EXPECT_THAT(list_scenarios(folder.path()), ElementsAre("town/hall"));
  EXPECT_EQ(scenario_file(folder.path(), "town/hall"), folder.path() / "town/hall.json");
}

TEST_F(ScenarioFile, BlueprintsWithTheFormerEndingAreFound) {
  folder.write("town/hall.place.json", R"({"ground": {}, "people": {}})");
  EXPECT_THAT(list_scenarios(folder.path()), ElementsAre("town/hall"));
  EXPECT_EQ(scenario_file(folder.path(), "town/hall"), folder.path() / "town/hall.place.json");
  EXPECT_EQ(suggested(folder.path(), "hall.place.json"), "\"town/hall\"");
}

TEST_F(ScenarioFile, NamesThatAreNoIdsAreNamed) {
  const std::string text = R"({"ground": {}, "people": {}})";
  EXPECT_THAT(suggested(folder.path(), "hall"), HasSubstr("a folder with files of scenarios"));
  folder.write("noA.blueprint.json", text);
  EXPECT_THAT(suggested(folder.path(), "hall"), HasSubstr("noA.blueprint.json is left out"));
  EXPECT_THAT(suggested(folder.path(), "noA"), HasSubstr("such as \"noa\""));
  EXPECT_THAT(suggested(folder.path(), "noA.blueprint.json"), HasSubstr("such as \"noa\""));
  folder.write("My Floor/Büro-2.json", text);
  folder.write("v1.2.blueprint.json", text);
  folder.write("bad\xff\n.json", text);
  folder.write("sound.json", text);
  folder.write("Day.job.json", R"({"scenario": "sound", "crowd": {"agents": 3}})");
  folder.write("day.json", R"({"scenario": "sound", "crowd": {"agents": 3}})");
  std::vector<std::string> found;
  for (const Problem& problem : list_unnamed_scenarios(folder.path())) {
    found.push_back(problem.text());
  }
  EXPECT_THAT(found, ElementsAre(HasSubstr("My Floor/Büro-2.json: found the name \"My Floor/B"),
                                 HasSubstr("\\n\""), HasSubstr("noA.blueprint.json"),
                                 HasSubstr("such as \"v1_2\"")));
  EXPECT_THAT(found[0], HasSubstr("such as \"my_floor/b_ro_2\""));
  EXPECT_THAT(list_scenarios(folder.path()), ElementsAre("sound")) << "nor jobs with a crowd";
}

TEST_F(ScenarioFile, OtherFilesInTheFolderAreNoScenarios) {
  folder.write("yard.json", valid_scenario().dump());
  folder.write("job.json", R"({"scenario": "yard", "capture": {"to_s": 5}})");
  folder.write("mine.json", R"({"cases": {}, "policies": {}})");
  folder.write("list.json", "[1, 2]");
  folder.write("broken.json", "{\"ground\": ");  // its reader says what is wrong
  EXPECT_THAT(list_scenarios(folder.path()), ElementsAre("broken", "yard"));
}

TEST_F(ScenarioFile, PathsFoldersAndLastPartsFindTheirIds) {
  for (const char* id : {"park/day", "park/night", "town/day"}) {
    folder.write(std::string(id) + ".json", R"({"ground": {}})");
  }
  for (const char* name : {"scenarios/park/day.json", "./park/day", "/a/b/park/day.blueprint.json",
                           "park/day.json", "park/dya"}) {
    EXPECT_EQ(suggested(folder.path(), name), "\"park/day\"") << name;
  }
  EXPECT_EQ(suggested(folder.path(), "night"), "\"park/night\"");
  EXPECT_EQ(suggested(folder.path(), "day"), "one of: park/day, town/day");
  EXPECT_EQ(suggested(folder.path(), "park/"), "one of: park/day, park/night");
  EXPECT_THAT(suggested(folder.path(), "elsewhere"), HasSubstr("THRONG_SCENARIOS"));
}

TEST_F(ScenarioFile, FaultsAreOfTheFileThatHoldsThem) {
  json base = valid_scenario();
  base["exits"][0]["from"] = 5;
  folder.write("base.json", base.dump());
  const std::vector<Problem> problems = list_problems(R"({"extends": "base.json", "name": 7})");
  std::map<std::string, std::string> sources;
  for (const Problem& problem : problems) sources[problem.where] = problem.source;
  EXPECT_EQ(sources["/name"], (folder.path() / "yard.json").string());
  EXPECT_EQ(sources["/exits/0/from"], (folder.path() / "base.json").string());
}

TEST_F(ScenarioFile, AScenarioHasAnExit) {
  json scenario = valid_scenario();
  scenario["exits"] = json::array();
  const std::vector<Problem> problems = list_problems(scenario.dump());
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].where, "/exits");
  EXPECT_EQ(problems[0].found, "[]");
  EXPECT_EQ(problems[0].expected, "a list of at least one exit");
}

TEST_F(ScenarioFile, IdsNameNothingOutsideTheFolder) {
  folder.write("outside.json", valid_scenario().dump());
  folder.write("inner/yard.json", "{}");
  for (const std::string id : {"../outside", "/etc/passwd", "inner//yard", "inner/yard/", "/", "",
                               "Inner/yard", "inner/yard.json", "nowhere", "inner/../outside"}) {
    try {
      scenario_file(folder.path() / "inner", id);
      ADD_FAILURE() << id;
    } catch (const InputError& error) {
      EXPECT_THAT(error.problems()[0].expected, HasSubstr("yard")) << id;
    }
  }
}

}  // namespace
}  // namespace throng::world
