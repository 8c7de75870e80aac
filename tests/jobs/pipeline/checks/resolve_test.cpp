// Jobs against their scenario: what it completes and what it refuses.
#include "jobs/pipeline/checks/resolve.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "annotate/people/coco.h"
#include "base/error.h"
#include "base/files/files.h"
#include "jobs/pipeline/runs/run_input.h"
#include "places/scenarios/blueprint/load_scenario.h"
#include "sim/run.h"
#include "tests/jobs/yard.h"

namespace throng::jobs {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Resolve : public testing::Test {
 protected:
  Resolve() { write_yard(folder.path()); }

  JobSpec resolved(const std::string& text) const {
    return resolve_job(parse_job_document(text, "test.job.json"), "test.job.json", folder.path())
        .spec();
  }

  /// A job file in the scenarios' folder.
  JobSpec resolved_file(const json& job) const {
    return resolve_job(job, (folder.path() / "job.json").string(), folder.path()).spec();
  }

  std::vector<Problem> list_problems(const std::string& text) const {
    try {
      resolved(text);
    } catch (const InputError& error) {
      return error.problems();
    }
    return {};
  }

  std::vector<std::string> pointers_of(const std::string& text) const {
    std::vector<std::string> pointers;
    for (const Problem& problem : list_problems(text)) {
      EXPECT_EQ(problem.source, "test.job.json");
      EXPECT_FALSE(problem.found.empty());
      EXPECT_FALSE(problem.expected.empty());
      pointers.push_back(problem.where);
    }
    return pointers;
  }

  TemporaryFolder folder;
};

TEST_F(Resolve, TheScenarioCompletesTheJob) {
  const JobSpec job = resolved(R"({"scenario": "yard"})");
  ASSERT_EQ(job.drones.size(), 1U);
  EXPECT_EQ(job.drones[0].mission.id, "d1");
  EXPECT_EQ(job.drones[0].mission.moves_goal, (world::GoalRef{99, 0}));
  EXPECT_EQ(job.crowd.model,
            sim::model_for(scenarios::find_scenario(folder.path(), "yard"), sim::CrowdSpec()));
  EXPECT_EQ(resolved(R"({"scenario": "yard", "crowd": {"compat": "menge"}})").crowd.model, "orca");
}

TEST_F(Resolve, AResolvedJobResolvesToItself) {
  const json once = to_json(resolved(R"({"scenario": "yard", "crowd": {"agents": 2}})"));
  EXPECT_EQ(to_json(resolved(once.dump())), once);
  EXPECT_EQ(to_json(read_resolved_job(once.dump(), "").spec()), once);
}

TEST_F(Resolve, ARunMayGoOnAfterItsImages) {
  const JobSpec job = resolved(R"({"scenario": "yard", "capture": {"to_s": 3, "run_to_s": 40}})");
  EXPECT_EQ(run_spec(job, 0).duration_s, 40);
  EXPECT_EQ(job.frames_per_camera(), 4);
  EXPECT_EQ(run_spec(resolved(R"({"scenario": "yard", "capture": {"to_s": 3}})"), 0).duration_s, 3);
}

TEST_F(Resolve, EachMistakeIsNamedByItsPointer) {
  const std::pair<const char*, const char*> cases[] = {
      {R"({"scenario": "nowhere"})", "/scenario"},
      {R"({"scenario": "../etc/passwd"})", "/scenario"},
      {R"({"scenario": "yard", "crowd": {"agents": 3}})", "/crowd/agents"},
      {R"({"scenario": "yard", "crowd": {"model": "orka"}})", "/crowd/model"},
      {R"({"scenario": "yard", "crowd": {"model": "orka", "agents": 1}})", "/crowd/model"},
      {R"({"scenario": "yard", "drones": [{"id": "d1"}, {"id": "d1"}]})", "/drones/1/id"},
      {R"({"scenario": "yard", "drones": [{"id": "other"}]})", "/drones/0/start"},
      {R"({"scenario": "yard", "drones": [{"id": "d1", "airframe": "brick"}]})",
       "/drones/0/airframe"},
      {R"({"scenario": "yard", "drones": [{"id": "d1", "start": [1, 2, 0]}]})", "/drones/0/start"},
      {R"({"scenario": "yard", "drones": [{"id": "d1", "guidance": {"policy": "dance"}}]})",
       "/drones/0/guidance/policy"},
      {R"({"scenario": "yard", "drones": [{"id": "d1", "guidance": {"policy": "waypoints"}}]})",
       "/drones/0/guidance/waypoints"},
      {R"({"scenario": "yard", "drones": [{"id": "d1", "guidance": {"waypoints": [[1, 2, 3]]}}]})",
       "/drones/0/guidance/waypoints"},
      {R"({"scenario": "yard", "drones": [{"id": "d1", "guidance":
           {"policy": "waypoints", "waypoints": [[1, 2, 3], [1, 2, -3]]}}]})",
       "/drones/0/guidance/waypoints/1"},
      {R"({"scenario": "yard", "capture": {"to_s": 7200, "rate_hz": 60}, "runs": 100})",
       "/capture"},
      {R"({"scenario": "yard", "outputs": {"formats": ["mot", "docx"]}})", "/outputs/formats/1"},
      {R"({"scenario": "yard", "outputs": {"formats": ["yolo-pose"]}})", "/outputs/formats/0"},
      {R"({"scenario": "yard", "outputs": {"filters": {"min_contrast": 2.3}}})",
       "/outputs/filters/min_contrast"},
  };
  for (const auto& [text, pointer] : cases) {
    EXPECT_THAT(pointers_of(text), ElementsAre(pointer)) << text;
  }
  EXPECT_THAT(list_problems(R"({"scenario": "nowhere"})")[0].expected, HasSubstr("yard"));
}

TEST_F(Resolve, ProblemsOfTextAndScenarioComeTogether) {
  EXPECT_THAT(pointers_of(R"({"scenario": "yard", "capture": {"from_s": 10, "to_s": 5},
                              "outputs": {"formats": ["docx"]},
                              "drones": [{"id": "other", "camera": {"fy_px": 900}}]})"),
              testing::UnorderedElementsAre("/drones/0/camera/fx_px", "/capture/to_s",
                                            "/outputs/formats/0", "/drones/0/start"));
}

TEST_F(Resolve, ABatteryOfUnknownSizeCannotRunOut) {
  json job =
      json::parse(R"({"scenario": "yard", "drones": [{"id": "d1", "battery": {"charge": 1}}]})");
  job["drones"][0]["airframe"] = sim::to_json(sim::shipped_airframes().front());
  EXPECT_THAT(pointers_of(job.dump().c_str()), ElementsAre());
  job["drones"][0]["airframe"].erase("battery_wh");
  EXPECT_THAT(pointers_of(job.dump().c_str()), ElementsAre("/drones/0/battery/charge"));
}

TEST_F(Resolve, APilotLogBecomesPartOfTheJob) {
  write_file_atomically(folder.path() / "d1.csv",
                        "time_s,x_m,y_m,z_m,yaw_deg,beacon\n0,1,2,3,0,1\n2,1,5,3,90,0\n");
  json job = {
      {"scenario", "yard"},
      {"drones", {{{"id", "d1"}, {"guidance", {{"policy", "pilot_log"}, {"log", "d1.csv"}}}}}}};
  const json guidance = to_json(resolved_file(job))["drones"][0]["guidance"];
  EXPECT_EQ(guidance["setpoints"].size(), 2U);
  EXPECT_FALSE(guidance.contains("log"));

  job["drones"][0]["guidance"]["log"] = "nowhere.csv";
  try {
    resolved_file(job);
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems()[0].where, "/drones/0/guidance/log");
    EXPECT_THAT(error.problems()[0].expected, HasSubstr("pilot log"));
  }
}

TEST_F(Resolve, ALogThatGoesBackInTimeIsRefusedByLine) {
  write_file_atomically(folder.path() / "d1.csv",
                        "time_s,x_m,y_m,z_m,yaw_deg,beacon\n2,1,2,3,0,1\n1,1,5,3,90,0\n");
  try {
    resolved_file(
        {{"scenario", "yard"},
         {"drones", {{{"id", "d1"}, {"guidance", {{"policy", "pilot_log"}, {"log", "d1.csv"}}}}}}});
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems()[0].where, "line 3");
    EXPECT_THAT(error.problems()[0].source, HasSubstr("d1.csv"));
  }
}

TEST_F(Resolve, ADrawnFieldThatFitsInNoRunIsNamedInTheBlock) {
  EXPECT_THAT(pointers_of(R"({"scenario": "yard", "runs": 8,
                              "randomize": {"crowd.agents": {"choice": [1, 900000]}}})"),
              ElementsAre("/randomize/crowd.agents"));
}

TEST_F(Resolve, TheSimulationGetsTheSampledValues) {
  const JobSpec job = resolved(R"({"scenario": "yard", "runs": 6,
    "drones": [{"id": "d1", "start": [0, 0, 20]}],
    "randomize": {"crowd.agents": {"choice": [1, 2]},
                  "drones.0.start.2": {"uniform": [10, 20]}}})");
  for (int run = 0; run < job.runs; ++run) {
    const json drawn = samples_of_run(job, run);
    const sim::RunSpec spec = run_spec(job, run);
    EXPECT_EQ(spec.people, drawn["crowd.agents"].get<int>());
    EXPECT_EQ(spec.drones[0].start->z(), drawn["drones.0.start.2"].get<double>());
  }
}

TEST_F(Resolve, AJobForFiguresNeedsNoDrone) {
  const JobSpec job = resolved(R"({"scenario": "yard", "drones": []})");
  EXPECT_TRUE(job.drones.empty()) << "not the scenario's either";
  EXPECT_THAT(job.outputs.annotations, ElementsAre("exits"));
  EXPECT_TRUE(plan_shards(job, 0).empty());
  EXPECT_EQ(to_json(resolved(to_json(job).dump())), to_json(job));
  EXPECT_THAT(pointers_of(R"({"scenario": "yard", "drones": [],
                              "outputs": {"annotations": ["events", "semantic", "coco"],
                                          "formats": ["mot"], "previews": 1}})"),
              ElementsAre("/outputs/annotations/1", "/outputs/annotations/2", "/outputs/formats/0",
                          "/outputs/previews"));
  EXPECT_THAT(pointers_of(R"({"scenario": ["yard", "yard"], "runs": 4, "drones": []})"),
              ElementsAre());
}

TEST_F(Resolve, FormatsOfTrajectoriesNeedNoDrone) {
  const JobSpec job = resolved(R"({"scenario": "yard", "drones": [],
                                   "outputs": {"annotations": ["trajectories"],
                                               "formats": ["jupedsim", "eth-ucy", "trajnet"]}})");
  EXPECT_EQ(job.outputs.formats.size(), 3U);
  EXPECT_THAT(pointers_of(R"({"scenario": "yard", "drones": [],
                              "outputs": {"annotations": ["exits"], "formats": ["jupedsim"]}})"),
              ElementsAre("/outputs/formats/0"));
}

TEST_F(Resolve, AJobOfSeveralScenariosIsCheckedInEach) {
  const std::string drones = R"("drones": [{"id": "view", "aim": {"height_m": 15}}])";
  const JobSpec job = resolved(R"({"scenario": ["yard", {"generate": {"kind": "plaza", "seed": 3}}],
                                   "runs": 4, )" +
                               drones + "}");
  EXPECT_EQ(job.mix.size(), 2U);
  EXPECT_EQ(to_json(resolved(to_json(job).dump())), to_json(job));
  EXPECT_THAT(pointers_of(R"({"scenario": ["yard", "yrad"], "runs": 4, )" + drones + "}"),
              ElementsAre("/scenario/1"));
  EXPECT_THAT(pointers_of(R"({"scenario": ["yard", "yard"], "runs": 4})"), ElementsAre("/drones"))
      << "the scenarios' own drones are not taken";
  const auto crowded = list_problems(
      R"({"scenario": [{"generate": {"kind": "plaza", "seed": 3}}, {"id": "yard", "agents": 3}],
          "runs": 4, )" +
      drones + "}");
  ASSERT_EQ(crowded.size(), 1U);
  EXPECT_EQ(crowded[0].where, "/crowd/agents");
  EXPECT_THAT(crowded[0].found, HasSubstr(" in yard"));
}

TEST_F(Resolve, AnAimThatIsNeverFreeIsRefused) {
  write_file_atomically(
      folder.path() / "shaft.json",
      R"({"extends": "yard.json", "name": "Shaft", "drones": [{"id": "d1", "start": [0, 0, 80]}],
      "buildings": [{"id": "block", "footprint": [[-90, -90], [90, -90], [90, 90], [-90, 90]],
                     "height_m": 60}]})");
  EXPECT_THAT(
      pointers_of(R"({"scenario": "shaft", "drones": [{"id": "view", "aim": {"height_m": 20}}]})"),
      ElementsAre("/drones/0/aim"));
}

TEST_F(Resolve, AnAimWithAHeightForEachRunIsFlown) {
  const JobSpec job = resolved(R"({"scenario": "yard", "runs": 5,
    "drones": [{"id": "view", "aim": {}, "camera": {"pitch_deg": {"uniform": [-80, -20]}}}],
    "randomize": {"drones.0.aim.height_m": {"uniform": [8, 40]}}})");
  for (int run = 0; run < job.runs; ++run) {
    const sim::RunSpec spec = run_spec(job, run);
    ASSERT_TRUE(spec.drones[0].aim);
    EXPECT_EQ(spec.drones[0].aim->height_m,
              samples_of_run(job, run)["drones.0.aim.height_m"].get<double>());
  }
}

TEST_F(Resolve, MoreVehiclesThanIdsAreRefused) {
  json parking = json::parse(read_file(folder.path() / "yard.json"));
  parking["props"] = json::array();
  for (int i = 0; i < annotate::kMaxVehiclesPerRun + 1; ++i) {
    parking["props"].push_back({{"kind", "car"}, {"position", {40 + i, 40}}});
  }
  write_file_atomically(folder.path() / "parking.json", parking.dump());
  EXPECT_THAT(pointers_of(R"({"scenario": "parking"})"), IsEmpty());
  EXPECT_THAT(
      pointers_of(R"({"scenario": "parking", "outputs": {"annotations": ["coco", "vehicles"]}})"),
      ElementsAre("/outputs/annotations"));
}

}  // namespace
}  // namespace throng::jobs
