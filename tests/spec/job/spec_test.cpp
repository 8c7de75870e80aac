#include "spec/job/spec.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "spec/job/resolved_job.h"

namespace throng::jobs {
namespace {

using nlohmann::json;
using testing::ElementsAre;

class Spec : public testing::Test {
 protected:
  static JobSpec parse(const std::string& text) { return parse_job(text, "test.job.json"); }

  static std::vector<Problem> list_problems(const std::string& text) {
    try {
      parse(text);
    } catch (const InputError& error) {
      return error.problems();
    }
    return {};
  }

  static std::vector<std::string> pointers_of(const std::string& text) {
    std::vector<std::string> pointers;
    for (const Problem& problem : list_problems(text)) {
      EXPECT_EQ(problem.source, "test.job.json");
      EXPECT_FALSE(problem.found.empty());
      EXPECT_FALSE(problem.expected.empty());
      pointers.push_back(problem.where);
    }
    return pointers;
  }
};

// As a program prints them that has one kind of number.
TEST(JobNumbers, IntegersMayBeWrittenWithAFractionOfZero) {
  const JobSpec job = parse_job(
      R"({"scenario": "yard", "runs": 2.0, "seed": 1e3, "crowd": {"agents": 30.0},
          "drones": [{"id": "d1", "camera": {"width": 160.0, "height": 120}}]})",
      "");
  EXPECT_EQ(job.runs, 2);
  EXPECT_EQ(job.seed, 1000U);
  EXPECT_EQ(job.agents, 30);
  EXPECT_EQ(job.drones.at(0).camera.width, 160);
  EXPECT_THROW(parse_job(R"({"scenario": "yard", "runs": 2.5})", ""), InputError);
}

TEST_F(Spec, EverythingButTheScenarioHasADefault) {
  const JobSpec job = parse(R"({"scenario": "yard"})");
  EXPECT_EQ(job.name, "yard");
  EXPECT_EQ(job.seed, 1U);
  EXPECT_EQ(job.runs, 1);
  EXPECT_FALSE(job.agents);
  EXPECT_TRUE(job.drones.empty()) << "the scenario's, once it is resolved";
  EXPECT_EQ(job.frames_per_camera(), 61);
}

TEST_F(Spec, ParsingOpensNoFileAndKnowsNoScenario) {
  const std::string text = R"({"scenario": "nowhere/at_all",
    "crowd": {"agents": 1000000, "model": "unknown", "recorded": {"file": "no.csv"}},
    "drones": [{"id": "a", "guidance": {"policy": "pilot_log", "log": "no.csv"}}]})";
  const JobSpec job = parse_job(text, "/no/such/folder/job.json");
  EXPECT_EQ(job.recorded->file, "/no/such/folder/no.csv");
  EXPECT_EQ(job.recorded->sha256, "");
  EXPECT_EQ(job.drones[0].pilot_log, "/no/such/folder/no.csv");
}

TEST_F(Spec, AJobNamedAfterALongScenarioIsAcceptedAgain) {
  std::string scenario;
  for (int i = 0; i < 150; ++i) scenario += "\u00e9";  // two bytes each
  const std::string written = to_json(parse(json{{"scenario", scenario}}.dump())).dump();
  EXPECT_EQ(parse(written).name, scenario.substr(0, 240));
  EXPECT_EQ(to_json(parse(written)).dump(), written);
}

// The name of a job without one is made of them.
TEST_F(Spec, IdsOfScenariosHaveNoControlCharacters) {
  EXPECT_THAT(pointers_of(R"({"scenario": "yard\u007f"})"), ElementsAre("/scenario"));
  EXPECT_THAT(pointers_of(R"({"scenario": ["yard", "yard\n", {"id": "yard\u0001"}]})"),
              ElementsAre("/scenario/1", "/scenario/2/id"));
}

TEST_F(Spec, AResolvedJobIsReadAsItWasWritten) {
  const json written = to_json(parse(R"({"scenario": "yard", "crowd": {"model": "orca"},
    "drones": [{"id": "d1", "camera": {"pitch_deg": {"uniform": [-80, -40]}}}],
    "randomize": {"crowd.agents": {"choice": [1, 2]}}})"));
  EXPECT_EQ(to_json(read_resolved_job(written.dump(), "job.json").spec()), written);
  EXPECT_THROW(read_resolved_job("{", "job.json"), InputError);
  EXPECT_THROW(read_resolved_job(R"({"scenario": "yard", "runs": "x"})", "job.json"),
               EnvironmentError);
}

// The schema states defaults for its readers, the structs for the program: they must agree.
void expect_defaults(const json& schema, const json& value, const std::string& place) {
  const json fields = schema.value("properties", json::object());
  for (const auto& field : fields.items()) {
    const std::string at = place + "/" + field.key();
    const json& rules = field.value();
    EXPECT_TRUE(rules.contains("title")) << at;
    EXPECT_TRUE(rules.contains("description")) << at;
    if (rules["type"] == "object") {
      EXPECT_EQ(rules["additionalProperties"], field.key() == "randomize") << at;
      // An object without a default is not there unless it is given.
      if (!rules.contains("default") && !value.contains(field.key())) continue;
      expect_defaults(rules, value.value(field.key(), json::object()), at);
    } else if (rules.contains("default")) {
      EXPECT_EQ(value.value(field.key(), rules["type"] == "array" ? json::array() : json()),
                rules["default"])
          << at;
    }
    if (field.key() == "drones") expect_defaults(rules["items"], value["drones"][0], at + "/0");
  }
}

TEST_F(Spec, APlaceFromASeedIsReadBackAsItIsWritten) {
  const JobSpec job = parse(
      R"({"scenario": {"generate": {"kind": "street", "seed": 4, "exits": 3, "clutter": 0.25}}})");
  ASSERT_TRUE(job.generate);
  EXPECT_EQ(job.generate->exits, 3);
  EXPECT_EQ(job.scenario.substr(0, 19), "generated/street_4_");
  const json written = to_json(job);
  EXPECT_EQ(written["scenario"]["generate"]["clutter"], 0.25);
  EXPECT_EQ(to_json(parse(written.dump())), written);
}

TEST_F(Spec, ReportsMistakesInGeneratedScenarios) {
  EXPECT_THAT(pointers_of(R"({"scenario": {"generate": {"kind": "moon"}}})"),
              ElementsAre("/scenario/generate/kind"));
  EXPECT_THAT(pointers_of(R"({"scenario": {"make": 1, "generate": {"kind": "street"}}})"),
              ElementsAre("/scenario"));
}

TEST_F(Spec, DefaultsAreThoseOfTheSchema) {
  expect_defaults(job_schema(), to_json(parse(R"({"scenario": "yard", "drones": [{"id": "d1"}]})")),
                  "");
}

TEST_F(Spec, ReadsEveryField) {
  const JobSpec job = parse(R"({
    "name": "n", "scenario": "yard", "seed": 9007199254740991, "runs": 5,
    "crowd": {"agents": 2, "model": "orca", "compat": "huang2016", "separation": "hard",
              "constants": "posterior"},
    "drones": [{"id": "a", "airframe": "f450", "battery": {"charge": 0.75}, "start": [1, 2, 3], "moves_goal": [4, 5],
                "guidance": {"policy": "waypoints", "waypoints": [[1, 2, 3], [4, 5, 6]],
                             "speed_mps": 2},
                "camera": {"width": 640, "height": 480, "hfov_deg": 60, "pitch_deg": -90,
                           "yaw_deg": 10,
                           "gimbal": {"model": "second_order", "natural_rad_s": 30, "damping": 0.9,
                                      "jitter_deg": {"uniform": [0.01, 0.02]}, "bias_deg": 0.2,
                                      "reading_deg": 0.05}}}],
    "capture": {"rate_hz": 2, "from_s": 1, "to_s": 3}, "quality": "high",
    "environment": {"time_of_day": "07:45",
                    "wind": {"speed_mps": {"uniform": [3, 6]}, "direction_deg": 90,
                             "profile": {"choice": ["power", "uniform"]}, "roughness_m": 1,
                             "exponent": 0.3, "gusts": "ou", "intensity": 2, "gust_mps": 1,
                             "gust_time_s": 2}},
    "outputs": {"image": {"format": "jpeg", "quality": 80}, "annotations": ["density", "coco"],
                "density": {"sigma_px": 6}, "previews": 0, "formats": ["mot", "yolo-detect"],
                "splits": {"train": 0.5, "val": 0.25, "test": 0.25, "val_runs": [3]},
                "filters": {"min_visibility": 0.2, "min_height_px": 9},
                "classes": {"by": "sex", "names": ["female=woman"]}}})");
  EXPECT_EQ(job.seed, 9007199254740991U);
  EXPECT_EQ(job.agents, 2);
  EXPECT_EQ(job.crowd.model, "orca");
  EXPECT_EQ(job.crowd.compat, crowd::Compat::huang2016);
  EXPECT_EQ(job.crowd.separation, crowd::BodySeparation::hard);
  EXPECT_EQ(job.crowd.constants, crowd::ConstantsChoice::posterior);
  EXPECT_EQ(job.drones[0].mission.start, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(job.drones[0].mission.waypoints[1], Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(job.drones[0].mission.moves_goal, (world::GoalRef{4, 5}));
  EXPECT_EQ(job.drones[0].camera.pitch_deg, -90);
  const camera::GimbalSpec gimbal =
      camera_of_run(job.drones[0].camera, 5, camera_pointer(0)).gimbal;
  EXPECT_EQ(gimbal.model, camera::GimbalModel::second_order);
  EXPECT_EQ(gimbal.natural_rad_s, 30);
  EXPECT_NEAR(gimbal.bias_rad, 0.2 * EIGEN_PI / 180, 1e-12);
  EXPECT_GE(gimbal.jitter_rad, 0.01 * EIGEN_PI / 180);
  EXPECT_LE(gimbal.jitter_rad, 0.02 * EIGEN_PI / 180);
  EXPECT_DOUBLE_EQ(environment_of_run(job.environment, 1).time_of_day_h, 7.75);
  EXPECT_EQ(job.drones[0].mission.battery_charge, 0.75);
  const sim::WindSpec wind = environment_of_run(job.environment, 1).wind;
  EXPECT_GE(wind.speed_mps, 3);
  EXPECT_LE(wind.speed_mps, 6);
  EXPECT_NE(wind.speed_mps, environment_of_run(job.environment, 2).wind.speed_mps);
  EXPECT_NEAR(wind.mean_at(10).x(), 0, 1e-9);
  EXPECT_NEAR(wind.mean_at(10).y(), wind.speed_mps, 1e-9);
  EXPECT_EQ(wind.gusts, sim::GustModel::ou);
  EXPECT_EQ(wind.gust_time_s, 2);
  EXPECT_EQ(job.frames_per_camera(), 5);
  EXPECT_EQ(job.quality, render::Quality::high);
  EXPECT_THAT(job.outputs.annotations, ElementsAre("density", "coco"));
  EXPECT_THAT(job.outputs.formats, ElementsAre("mot", "yolo-detect"));
  EXPECT_EQ(job.outputs.exports.splits.share[1], 0.25);
  EXPECT_EQ(job.outputs.exports.splits.runs.at("run003"), formats::Split::val);
  EXPECT_EQ(job.outputs.exports.filters.min_visibility, 0.2);
  EXPECT_EQ(job.outputs.exports.filters.min_height_px, 9);
  EXPECT_EQ(job.outputs.exports.classes.names.at("female"), "woman");
  EXPECT_EQ(job.outputs.density_sigma_px, 6);
  EXPECT_EQ(to_json(parse(to_json(job).dump())), to_json(job));
}

TEST_F(Spec, EachMistakeIsNamedByItsPointer) {
  const std::pair<const char*, const char*> cases[] = {
      {R"({})", "/scenario"},
      {R"([])", ""},
      {R"({"scenario": 3})", "/scenario"},
      {R"({"scenario": "yard", "seed": -1})", "/seed"},
      {R"({"scenario": "yard", "seed": 1.5})", "/seed"},
      {R"({"scenario": "yard", "runs": 0})", "/runs"},
      {R"({"scenario": "yard", "runs": "3"})", "/runs"},
      {R"({"scenario": "yard", "crowd": {"agents": 0}})", "/crowd/agents"},
      {R"({"scenario": "yard", "crowd": 260})", "/crowd"},
      {R"({"scenario": "yard", "crowd": {"model": 3}})", "/crowd/model"},
      {R"({"scenario": "yard", "crowd": {"compat": "meng"}})", "/crowd/compat"},
      {R"({"scenario": "yard", "crowd": {"separation": true}})", "/crowd/separation"},
      {R"({"scenario": "yard", "drones": {}})", "/drones"},
      {R"({"scenario": "yard", "drones": [{}]})", "/drones/0/id"},
      {R"({"scenario": "yard", "drones": [{"id": "../x"}]})", "/drones/0/id"},
      {R"({"scenario": "yard", "drones": [{"id": "d1\n"}]})", "/drones/0/id"},
      {R"({"scenario": "yard", "drones": [{"id": "d1", "start": [1, 2]}]})", "/drones/0/start"},
      {R"({"scenario": "yard", "drones": [{"id": "d1", "start": [1, 2, "3"]}]})",
       "/drones/0/start/2"},
      {R"({"scenario": "yard", "drones": [{"id": "d1", "camera": {"hfov_deg": 180}}]})",
       "/drones/0/camera/hfov_deg"},
      {R"({"scenario": "yard", "drones": [{"id": "d1", "camera": {"width": 100000}}]})",
       "/drones/0/camera/width"},
      {R"({"scenario": "yard", "capture": {"rate_hz": 0}})", "/capture/rate_hz"},
      {R"({"scenario": "yard", "capture": {"from_s": 10, "to_s": 5}})", "/capture/to_s"},
      {R"({"scenario": "yard", "capture": {"to_s": 9, "run_to_s": 8}})", "/capture/run_to_s"},
      {R"({"scenario": "yard", "environment": {"time_of_day": "25:00"}})",
       "/environment/time_of_day"},
      {R"({"scenario": "yard", "environment": {"weather": "snow"}})", "/environment/weather"},
      {R"({"scenario": "yard", "environment": {"weather": {"choice": ["fog", "snow"]}}})",
       "/environment/weather/choice/1"},
      {R"({"scenario": "yard", "environment": {"weather": {"uniform": ["fog", "rain"]}}})",
       "/environment/weather"},
      {R"({"scenario": "yard", "environment": {"latitude_deg": 91}})", "/environment/latitude_deg"},
      {R"({"scenario": "yard", "environment": {"latitude_deg": {"uniform": [5, 4]}}})",
       "/environment/latitude_deg/uniform/1"},
      {R"({"scenario": "yard", "environment": {"latitude_deg": {"gaussian": [5, 4]}}})",
       "/environment/latitude_deg"},
      {R"({"scenario": "yard", "environment": {"day_of_year": 1.5}})", "/environment/day_of_year"},
      {R"({"scenario": "yard", "environment": {"day_of_year": {"choice": []}}})",
       "/environment/day_of_year/choice"},
      {R"({"scenario": "yard", "environment": {"wind": 3}})", "/environment/wind"},
      {R"({"scenario": "yard", "environment": {"wind": {"speed_mps": -1}}})",
       "/environment/wind/speed_mps"},
      {R"({"scenario": "yard", "environment": {"wind": {"gusts": "hurricane"}}})",
       "/environment/wind/gusts"},
      {R"({"scenario": "yard", "environment": {"wind": {"profile": {"uniform": ["log", "power"]}}}})",
       "/environment/wind/profile"},
      {R"({"scenario": "yard", "drones": [{"id": "d1", "airframe": 3}]})", "/drones/0/airframe"},
      {R"({"scenario": "yard", "drones": [{"id": "d1", "battery": {"charge": 1.5}}]})",
       "/drones/0/battery/charge"},
      {R"({"scenario": "yard", "randomise": {}})", "/randomise"},
      {R"({"scenario": "yard", "outputs": {"split": {}}})", "/outputs/split"},
      {R"({"scenario": "yard", "outputs": {"annotations": ["coco", "yolo"]}})",
       "/outputs/annotations/1"},
      {R"({"scenario": "yard", "outputs": {"publish": "https://data/set"}})", "/outputs/publish"},
      {R"({"scenario": "yard", "outputs": {"publish": "s3://me:secret@data"}})",
       "/outputs/publish"},
      {R"({"scenario": "yard", "outputs": {"annotations": ["coco", "coco"]}})",
       "/outputs/annotations"},
      {R"({"scenario": "yard", "outputs": {"splits": {"val_runs": [1]}}})",
       "/outputs/splits/val_runs/0"},
      {R"({"scenario": "yard", "outputs": {"splits": {"train": 0}}})", "/outputs/splits"},
      {R"({"scenario": "yard", "outputs": {"splits": {"train": 0.9, "test": 0.2}}})",
       "/outputs/splits"},
      {R"({"scenario": "yard", "outputs": {"splits": {"val": 0.6, "test": 0.6}}})",
       "/outputs/splits"},
      {R"({"scenario": "yard", "outputs": {"filters": {"min_visibility": 2}}})",
       "/outputs/filters/min_visibility"},
      {R"({"scenario": "yard", "outputs": {"classes": {"names": ["male=man"]}}})",
       "/outputs/classes/names/0"},
      {R"({"scenario": "yard", "a/b~c": 1})", "/a~1b~0c"},
  };
  for (const auto& [text, pointer] : cases) {
    EXPECT_THAT(pointers_of(text), ElementsAre(pointer)) << text;
  }
}

TEST_F(Spec, AUsersOwnAirframeIsReadAndChecked) {
  json job = json::parse(R"({"scenario": "yard", "drones": [{"id": "d1"}]})");
  json& airframe = job["drones"][0]["airframe"];
  airframe = sim::to_json(sim::shipped_airframes().front());
  airframe["mass_kg"] = 0.02;
  const JobSpec parsed = parse(job.dump());
  ASSERT_TRUE(parsed.drones[0].mission.own_airframe.has_value());
  EXPECT_EQ(parsed.drones[0].mission.own_airframe->mass_kg, 0.02);
  EXPECT_EQ(to_json(parse(to_json(parsed).dump())), to_json(parsed));

  airframe["mass_kg"] = 90;
  EXPECT_THAT(pointers_of(job.dump().c_str()), ElementsAre("/drones/0/airframe"));
  EXPECT_THAT(list_problems(job.dump().c_str())[0].text(),
              testing::HasSubstr("to hover and steer"));
  airframe["mass_kg"] = "heavy";
  airframe.erase("arm_m");
  EXPECT_THAT(pointers_of(job.dump().c_str()),
              testing::IsSupersetOf({"/drones/0/airframe/mass_kg", "/drones/0/airframe/arm_m"}));
}

TEST_F(Spec, AllProblemsOfTheSchemaComeAtOnce) {
  EXPECT_THAT(pointers_of(R"({"seed": "x", "sead": 1, "capture": {"to_s": -1, "rate": 2}})"),
              testing::UnorderedElementsAre("/scenario", "/seed", "/sead", "/capture/to_s",
                                            "/capture/rate"));
}

TEST_F(Spec, NamesTheExpectedValue) {
  EXPECT_EQ(list_problems(R"({"scenario": "yard", "crowd": {"agents": -3}})")[0].text(),
            "test.job.json: /crowd/agents: found -3, expected an integer from 1 to 1000000");
  EXPECT_EQ(list_problems(R"({"scenario": "yard", "captur": {}})")[0].text(),
            "test.job.json: /captur: unknown field \"captur\"; did you mean \"capture\"?");
}

TEST_F(Spec, UmbrellasAreUpInTheRain) {
  const JobSpec job = parse(R"({"scenario": "yard", "appearance": {"umbrellas": 0.4}})");
  EXPECT_EQ(styling_in(job, render::Weather::rain).umbrellas, 0.4);
  EXPECT_EQ(styling_in(job, render::Weather::clear).umbrellas, 0);
  EXPECT_EQ(styling_in(job, render::Weather::overcast).umbrellas, 0);
  EXPECT_GT(styling_in(parse(R"({"scenario": "yard"})"), render::Weather::rain).umbrellas, 0);
}

TEST_F(Spec, ImagesHaveTheLeadersOfTheRun) {
  const JobSpec job = parse(R"({"scenario": "yard", "crowd": {"leading": 0.1}})");
  EXPECT_EQ(job.crowd.leading, 0.1);
  EXPECT_EQ(styling_in(job, render::Weather::clear).leading, 0.1);
}

TEST_F(Spec, SyntaxErrorsNameLineAndColumn) {
  EXPECT_EQ(pointers_of("{\n  \"scenario\": yard}"), std::vector<std::string>{"line 2, column 15"});
  EXPECT_EQ(list_problems("").size(), 1U);
  EXPECT_EQ(list_problems(R"({"scenario": "yard", "scenario": "yard"})").size(), 1U);
}

TEST_F(Spec, HostileTextsAreRefusedAndNothingElse) {
  const std::string long_text(1 << 20, 'a');
  const std::string deep = std::string(100'000, '[');
  for (const std::string& text :
       {std::string("\xff\xfe{}"), std::string(1 << 20, ' '), deep,
        deep + std::string(100'000, ']'), fmt::format(R"({{"scenario": "{}"}})", long_text),
        fmt::format(R"({{"scenario": "yard", "{}": 1}})", long_text),
        fmt::format(R"({{"scenario": "yard", "drones": [{{"id": "{}"}}]}})", long_text),
        fmt::format(R"({{"scenario": "yard", "environment": {{"time_of_day": "{}"}}}})", long_text),
        fmt::format(R"({{"scenario": "yard", "drones": {}1{}}})", deep, std::string(100'000, ']')),
        std::string(R"({"scenario": "yard", "capture": {"to_s": 1e999}})"),
        std::string(R"({"scenario": "yard", "seed": 18446744073709551616})"),
        std::string("{\"scenario\": \"y\xc3\x28\"}"),
        std::string("{\"scenario\": \"ya\0rd\"}", 21)}) {
    EXPECT_THROW(parse(text), InputError) << text.substr(0, 60);
  }
}

}  // namespace
}  // namespace throng::jobs
