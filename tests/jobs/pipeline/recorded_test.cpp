// Jobs that replay recorded people: the block in the job, the copy in its folder, and a run whose
// metrics are those of the file.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files/files.h"
#include "jobs/pipeline/checks/job_check.h"
#include "jobs/pipeline/checks/resolve.h"
#include "jobs/pipeline/pipeline.h"
#include "jobs/pipeline/runs/recording.h"
#include "jobs/queue/dataset/folder.h"
#include "metrics/evacuation.h"
#include "metrics/exits/exits.h"
#include "places/scenarios/blueprint/load_scenario.h"
#include "spec/job/spec.h"
#include "tests/jobs/yard.h"
#include "world/scenario.h"

namespace throng::jobs {
namespace {

using nlohmann::json;

/// Twelve people who walk through the yard's gate, one after another, with a sway; 16 frames a
/// second. The later ones appear later; all vanish behind the gate.
std::string people_of_an_experiment() {
  std::string text = "t;who;east;north\n";
  for (int person = 0; person < 12; ++person) {
    for (int frame = 10 * person; frame < 10 * person + 100; ++frame) {
      const double since_s = (frame - 10 * person) / 16.0;
      const double x = 500 + 120 * since_s;
      const double y = 30 * std::sin(person) * std::exp(-since_s) + 4 * std::sin(6 * since_s);
      text += fmt::format("{};p{};{};{}\n", frame, person, x, y);
    }
  }
  return text;
}

class RecordedJob : public testing::Test {
 protected:
  RecordedJob() {
    write_yard(folder.path());
    write_file_atomically(folder.path() / "data" / "walk.csv", people_of_an_experiment());
  }

  json job() const {
    return json::parse(R"({"scenario": "yard", "capture": {"to_s": 10},
      "crowd": {"recorded": {"file": "data/walk.csv", "frame_rate_hz": 16, "unit": "cm",
        "columns": {"person": "who", "frame": "t", "x": "east", "y": "north"}}}})");
  }

  ResolvedJob resolve(const json& value) const {
    return resolve_job(value, (folder.path() / "job.json").string(), folder.path());
  }

  /// The figures of the job's run.
  json measured() const {
    const ResolvedJob resolved = resolve(job());
    const JobFolder made = JobFolder::create(folder.path() / "out", resolved);
    simulate_run(made, resolved.spec(), folder.path(), 0);
    measure_run(made, resolved.spec(), folder.path(), 0);
    return json::parse(
        read_file(made.output_of({Task::Kind::measure, 0}) / "files/metrics/run000.json"));
  }

  std::string problem_pointer(const json& value) const {
    try {
      resolve(value);
    } catch (const InputError& error) {
      return error.problems().front().where;
    }
    return "nothing is wrong";
  }

  TemporaryFolder folder;
};

TEST_F(RecordedJob, ItsFolderHoldsTheRecordingAndReadsTheSameJob) {
  const ResolvedJob asked = resolve(job());
  const JobFolder made = JobFolder::create(folder.path() / "out", asked);
  EXPECT_TRUE(std::filesystem::exists(made.path() / "recorded" / "walk.csv"));
  const ResolvedJob kept = made.read_job();
  EXPECT_EQ(to_json(kept.spec()), to_json(asked.spec()));
  EXPECT_EQ(to_json(kept.spec())["crowd"]["recorded"]["sha256"].get<std::string>().size(), 64U);
  JobFolder::create(folder.path() / "out", kept);  // taken up again
}

TEST_F(RecordedJob, TheMetricsOfItsRunAreThoseOfTheFile) {
  json asked = job();
  asked["capture"]["to_s"] = 209.0 / 16;
  asked["runs"] = 2;
  asked["randomize"]["props.density"]["uniform"] = {0, 1};
  const ResolvedJob resolved = resolve(asked);
  const JobSpec& spec = resolved.spec();
  const JobFolder made = JobFolder::create(folder.path() / "out", resolved);
  simulate_run(made, spec, folder.path(), 1);
  const world::Trace run = world::read_trace(made.output_of({Task::Kind::simulate, 1}));
  EXPECT_EQ(run.header.drone_ids.size(), 1U);
  const world::Trace file = read_recording(*spec.recorded);
  const world::Scenario yard = scenarios::find_scenario(folder.path(), "yard");
  const auto figures = [&](const world::Trace& trace) {
    return metrics::to_json(metrics::run_metrics(trace, yard, metrics::exit_series(trace, yard)));
  };
  const json of_run = figures(run);
  const json of_file = figures(file);
  EXPECT_EQ(of_file["exits"][0]["crossings"]["out"], 12);
  for (const char* part : {"exits", "escape_curve", "escape_time_percentiles", "exposure",
                           "journeys", "not_escaped", "people", "duration_s"}) {
    EXPECT_EQ(of_run[part], of_file[part]) << part;
  }
}

TEST_F(RecordedJob, TakesAsManyOfThemAsItAsksFor) {
  json asked = job();
  asked["crowd"]["agents"] = 5;
  const ResolvedJob resolved = resolve(asked);
  const JobSpec& spec = resolved.spec();
  const JobFolder made = JobFolder::create(folder.path() / "out", resolved);
  simulate_run(made, spec, folder.path(), 0);
  const world::Trace run = world::read_trace(made.output_of({Task::Kind::simulate, 0}));
  EXPECT_EQ(std::count(run.header.role.begin(), run.header.role.end(), world::AgentRole::person),
            5);
}

TEST_F(RecordedJob, ItsCheckCountsPeopleAndNotTheirPositions) {
  const CheckedJob checked = check_job(job(), (folder.path() / "job.json").string(), folder.path());
  EXPECT_EQ(checked.people, 12);
  // By 2 s four of them have come, one each 10 frames.
  json shorter = job();
  shorter["capture"]["to_s"] = 2;
  const CheckedJob early = check_job(shorter, (folder.path() / "job.json").string(), folder.path());
  EXPECT_EQ(early.people, 4);
  EXPECT_LT(early.cost.disk_bytes, checked.cost.disk_bytes);
}

TEST_F(RecordedJob, PeopleInBuildingsAndInhumanSpeedsAreInItsCheckItsRunAndItsMetrics) {
  json yard = json::parse(read_file(folder.path() / "yard.json"));
  yard["buildings"] = {
      {{"id", "shed"}, {"height_m", 3}, {"footprint", {{6, -3}, {9, -3}, {9, 3}, {6, 3}}}}};
  write_file_atomically(folder.path() / "yard.json", yard.dump());
  // p0 is used again elsewhere.
  write_file_atomically(folder.path() / "data" / "walk.csv",
                        people_of_an_experiment() + "200;p0;-900;0\n201;p0;900;0\n");
  const auto mentions = [](const std::vector<std::string>& texts, const std::string& what) {
    return std::count_if(texts.begin(), texts.end(), [&](const std::string& text) {
      return text.find("/crowd/recorded/file: found") != std::string::npos &&
             text.find(what) != std::string::npos;
    });
  };
  std::vector<std::string> of_check;
  for (const Problem& warning :
       check_job(job(), (folder.path() / "job.json").string(), folder.path()).warnings) {
    of_check.push_back(warning.text());
  }
  const json figures = measured();
  for (const std::vector<std::string>& texts :
       {of_check, figures["warnings"].get<std::vector<std::string>>()}) {
    EXPECT_EQ(mentions(texts, "12 of 12 recorded people inside of buildings"), 1);
    EXPECT_EQ(mentions(texts, "\"shed\" (12)"), 1);
    EXPECT_EQ(mentions(texts, "person p0 from frame 200 to 201"), 1);
  }
}

TEST_F(RecordedJob, FindingsAboutItsScenarioAreInItsCheckAndInItsMetrics) {
  const auto has_finding = [](const std::vector<std::string>& texts) {
    return std::any_of(texts.begin(), texts.end(), [](const std::string& text) {
      return text.find("/scenario: found error in yard, /exits/0/goals/0: [0, 0]") !=
             std::string::npos;
    });
  };
  std::vector<std::string> texts;
  for (const Problem& warning :
       check_job(json::parse(R"({"scenario": "yard"})"), "", folder.path()).warnings) {
    texts.push_back(warning.text());
  }
  EXPECT_TRUE(has_finding(texts));
  const json figures = measured();
  EXPECT_TRUE(has_finding(figures["warnings"])) << figures["warnings"];
}

TEST_F(RecordedJob, ReportsMistakes) {
  const auto with = [&](const char* pointer, const json& value) {
    json asked = job();
    asked[json::json_pointer(pointer)] = value;
    return asked;
  };
  EXPECT_EQ(problem_pointer(job()), "nothing is wrong");
  EXPECT_EQ(problem_pointer(with("/crowd/recorded/file", "none.csv")), "/crowd/recorded/file");
  EXPECT_EQ(problem_pointer(with("/crowd/recorded/sha256", std::string(64, '0'))),
            "/crowd/recorded/sha256");
  EXPECT_EQ(problem_pointer(with("/crowd/recorded/columns/time", "t")),
            "/crowd/recorded/columns/frame");
  EXPECT_EQ(problem_pointer(with("/crowd/recorded/unit", "yards")), "/crowd/recorded/unit");
  EXPECT_EQ(problem_pointer(with("/crowd/recorded/columns/x", "west")), "line 1");
  EXPECT_EQ(problem_pointer(with("/crowd/agents", 13)), "/crowd/agents");
  EXPECT_EQ(problem_pointer(with("/crowd/physical", true)), "/crowd/physical");
  EXPECT_EQ(problem_pointer(with("/capture/to_s", 60)), "/capture/to_s");
  EXPECT_EQ(problem_pointer(with("/capture/run_to_s", 60)), "/capture/run_to_s");
  EXPECT_THROW(resolve_job(job(), "", folder.path()), InputError);  // a request
}

}  // namespace
}  // namespace throng::jobs
