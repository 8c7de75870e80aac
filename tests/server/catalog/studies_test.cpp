// Studies over HTTP: queued like jobs, simulated run by run.
#include <gmock/gmock.h>

#include <atomic>
#include <cstdlib>
#include <memory>

#include "spec/study/study_files.h"
#include "tests/server/api_fixture.h"
#include "tests/server/bundles.h"

namespace throng::server {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr const char* kRoute = "/v1/studies";

json small_study(int runs = 2) {
  return {{"name", "small"},
          {"runs", runs},
          {"baseline", "none"},
          {"cases",
           {{{
                 "id",
                 "yard",
             },
             {"scenario", "yard"},
             {"alarm_s", 0},
             {"duration_s", 4}}}},
          {"policies",
           {{{"id", "none"}, {"title", "no drone"}},
            {{"id", "d"}, {"drones", {{{"id", "d1"}, {"start", {0, 0, 20}}}}}}}}};
}

class StudyApi : public ApiTest {
 protected:
  StudyApi() { ::setenv("THRONG_SCENARIOS", service.folders().scenarios().c_str(), 1); }
  ~StudyApi() override {
    ::unsetenv("THRONG_SCENARIOS");
    ::unsetenv("THRONG_FAULTS");
  }

  httplib::Result post(const json& study, const httplib::Headers& headers = {}) const {
    return client().Post(kRoute, headers, study.dump(), "application/json");
  }
  httplib::Result act(const std::string& path) const {
    return client().Post(path, "", "application/json");
  }
  std::string submitted(const json& study) const {
    const httplib::Result answer = post(study);
    EXPECT_EQ(answer->status, 201) << answer->body;
    return answer->get_header_value("Location");
  }
  json ended(const std::string& self) const {
    EXPECT_TRUE(wait_until([&] {
      const std::string state = get_json(self)["state"];
      return state != "queued" && state != "running";
    }));
    return get_json(self);
  }
  bool has_run(const std::string& self, const std::string& run) const {
    return wait_until([&] { return get(self + "/files/" + run)->status == 200; });
  }
  static std::string id_of(const std::string& self) { return fs::path(self).filename(); }
};

TEST_F(StudyApi, HasTheResultOfTheProgram) {
  SKIP_WITHOUT_PROGRAM();
  const std::string self = submitted(small_study());
  const json done = ended(self);
  ASSERT_EQ(done["state"], "succeeded") << done.dump();
  EXPECT_EQ(done["name"], "small");
  EXPECT_EQ(done["study"], small_study());
  EXPECT_EQ(done["plan"]["simulations"], 4);
  EXPECT_EQ(done["plan"]["people"], 2);
  EXPECT_EQ(done["plan"]["policies"][0]["title"], "no drone");
  EXPECT_EQ(done["progress"]["stage"], "finished");
  EXPECT_EQ(done["progress"]["runs_done"], 4);
  EXPECT_EQ(done["progress"]["cells"], (json{{2, 2}}));
  EXPECT_EQ(done["summary"]["rows"].size(), 2U);
  // The oracle: the same document through the command line.
  jobs::TemporaryFolder folder;
  write_file_atomically(folder.path() / "study.json", small_study().dump());
  const std::string command =
      fmt::format("{} study {} -o {} > {} 2>&1", kProgram, (folder.path() / "study.json").string(),
                  (folder.path() / "out").string(), (folder.path() / "log").string());
  ASSERT_EQ(std::system(command.c_str()), 0) << read_file(folder.path() / "log");
  for (const char* name :
       {"summary.json", "summary.csv", "summary.md", "values.json", "runs/yard/d/001.json"}) {
    const httplib::Result file = get(self + "/files/" + name);
    ASSERT_EQ(file->status, 200) << name << file->body;
    EXPECT_EQ(file->body, read_file(folder.path() / "out" / name)) << name;
  }
  const httplib::Result report = get(done["links"]["report"]);
  EXPECT_THAT(report->body, HasSubstr("People out"));
  EXPECT_THAT(report->get_header_value("Content-Security-Policy"), HasSubstr("allow-scripts"));
  for (const char* wrong :
       {"/files/plan.json", "/files/runs/yard/d/002.json/..", "/files/runs/yard/x/000.json",
        "/files/../store.sqlite", "/files/runs/yard/d/0.json"}) {
    EXPECT_EQ(get(self + wrong)->status, 404) << wrong;
  }
  // It is listed among its own, and not among datasets; removing it takes its files along.
  EXPECT_EQ(get_json(kRoute)["studies"].size(), 1U);
  EXPECT_EQ(get_json("/v1/jobs")["jobs"].size(), 0U);
  EXPECT_EQ(get("/v1/jobs/" + id_of(self))->status, 404);
  EXPECT_EQ(client().Delete(self)->status, 204);
  EXPECT_EQ(get(self)->status, 404);
  EXPECT_FALSE(fs::exists(service.folders().study_folder(id_of(self))));
}

TEST_F(StudyApi, MistakesComeBackAtOnceWithTheirPointers) {
  SKIP_WITHOUT_PROGRAM();
  const auto pointers = [&](const json& study) {
    const httplib::Result answer = post(study);
    EXPECT_EQ(answer->status, 400) << answer->body;
    std::vector<std::string> found;
    const json errors = json::parse(answer->body).value("errors", json::array());
    for (const json& error : errors) found.push_back(error["pointer"]);
    return found;
  };
  json wrong = small_study();
  wrong["cases"][0]["scenario"] = "yrad";
  EXPECT_THAT(pointers(wrong), ::testing::ElementsAre("/cases/0/scenario"));
  wrong = small_study();
  wrong["policies"][1]["drones"][0]["start"] = "high";
  EXPECT_THAT(pointers(wrong), ::testing::Contains("/policies/1/drones/0/start"));
  // Named once, however many cases a policy has, and policies a case.
  wrong = small_study();
  wrong["cases"].push_back(wrong["cases"][0]);
  wrong["cases"][1]["id"] = "again";
  wrong["cases"][1]["crowd"] = {{"agents", 0}};
  wrong["policies"][1]["drones"][0]["guidance"] = {{"policy", "balance"}, {"speed_mps", 99}};
  EXPECT_THAT(pointers(wrong),
              ::testing::UnorderedElementsAre("/cases/1/crowd/agents",
                                              "/policies/1/drones/0/guidance/speed_mps"));
  wrong = small_study();
  wrong["colour"] = 1;
  wrong["baseline"] = "noone";
  EXPECT_THAT(pointers(wrong), ::testing::IsSupersetOf({"/colour", "/baseline"}));
  wrong = small_study(1000);
  for (int i = 1; i < 11; ++i) {
    wrong["cases"].push_back(wrong["cases"][0]);
    wrong["cases"].back()["id"] = fmt::format("c{}", i);
  }
  EXPECT_THAT(pointers(wrong), ::testing::ElementsAre("/runs")) << "22 000 simulations";
  const auto posted = [&](const std::string& body, const char* type) {
    return client().Post(kRoute, body, type)->status;
  };
  EXPECT_EQ(posted("[", "application/json"), 400);
  EXPECT_EQ(posted("[]", "application/json"), 400);
  EXPECT_EQ(posted(std::string(100, '[') + std::string(100, ']'), "application/json"), 400);
  EXPECT_EQ(posted(small_study().dump(), "text/plain"), 415);
  EXPECT_EQ(posted(std::string(2 << 20, ' '), "application/json"), 413);
  const httplib::Result dry =
      client().Post("/v1/studies?dry_run", small_study().dump(), "application/json");
  EXPECT_EQ(dry->status, 200) << dry->body;
  EXPECT_EQ(json::parse(dry->body)["simulations"], 4);
  EXPECT_EQ(get_json(kRoute)["studies"].size(), 0U);
}

TEST_F(StudyApi, ShowsProgressAndIsCancelledAndGoesOn) {
  SKIP_WITHOUT_PROGRAM();
  ::setenv("THRONG_FAULTS", "slow:simulation/000003:600", 1);
  const std::string self = submitted(small_study());
  ASSERT_TRUE(has_run(self, "runs/yard/none/001.json"));
  EXPECT_TRUE(wait_until([&] { return get_json(self)["progress"]["runs_done"] == 3; }));
  const json running = get_json(self);
  EXPECT_EQ(running["state"], "running");
  EXPECT_EQ(running["progress"]["cells"], (json{{2, 1}}));
  EXPECT_EQ(running.at("summary").at("rows").at(0).at("runs"), 1) << "one whole pair";
  EXPECT_EQ(get_json(self + "/files/values.json")["cases"][0]["runs"], (json{0}));
  EXPECT_EQ(get(self + "/files/summary.json")->status, 409);
  EXPECT_EQ(get(self + "/report")->status, 409);
  // A stream that begins only now: the events so far, then the progress.
  const auto types = streamed(self + "/events", [](const auto& some) { return some.size() >= 3; });
  EXPECT_EQ(types, (std::vector<std::string>{"submitted", "started", "progress"}));
  const httplib::Result cancelled = act(self + "/cancel");
  EXPECT_EQ(cancelled->status, 200) << cancelled->body;
  EXPECT_EQ(json::parse(cancelled->body)["state"], "cancelled");
  EXPECT_EQ(act(self + "/cancel")->status, 409);
  ::unsetenv("THRONG_FAULTS");
  const fs::path first = service.folders().study_folder(id_of(self)) / "runs/yard/none/000.json";
  const auto written = fs::last_write_time(first);
  EXPECT_EQ(act(self + "/retry")->status, 200);
  EXPECT_EQ(ended(self)["state"], "succeeded");
  EXPECT_EQ(fs::last_write_time(first), written) << "finished runs are kept";
}

TEST_F(StudyApi, AStreamTellsItsProgressAndEndsWithIt) {
  SKIP_WITHOUT_PROGRAM();
  // Its first run ends only when progress was seen.
  const auto is_seen = std::make_shared<std::atomic<bool>>(false);
  executor.other = [is_seen, work = executor.other](
                       const jobs::JobFolder& folder, const jobs::Task& task,
                       const jobs::Executor::OnProgress& on_progress, const std::stop_token& stop) {
    jobs::TaskResult result = work(folder, task, on_progress, stop);
    EXPECT_TRUE(wait_until([&] { return *is_seen || stop.stop_requested(); }));
    return result;
  };
  const std::string self = submitted(small_study());
  std::string text;
  client().Get(self + "/events", {{"Accept", "text/event-stream"}},
               [&](const char* block, std::size_t count) {
                 text.append(block, count);
                 if (text.find("event: progress\ndata: {") != std::string::npos) *is_seen = true;
                 return true;
               });
  EXPECT_TRUE(*is_seen);
  EXPECT_EQ(
      get(self + "/events", {{"Accept", "text/event-stream"}})->get_header_value("Content-Type"),
      "text/event-stream");
  EXPECT_THAT(text, HasSubstr("event: submitted\ndata: {"));
  EXPECT_THAT(text, HasSubstr("\"runs_total\":4"));
  EXPECT_THAT(text, HasSubstr("event: succeeded\n"));
  const json events = get_json(self + "/events")["events"];
  EXPECT_EQ(events.front()["type"], "submitted");
  EXPECT_EQ(events.back()["type"], "succeeded");
  // A study's events are not those of a job of its id.
  EXPECT_EQ(get("/v1/jobs/" + id_of(self) + "/events")->status, 404);
}

TEST_F(StudyApi, PriorityLabelsAndKeepAreChanged) {
  SKIP_WITHOUT_PROGRAM();
  ::setenv("THRONG_FAULTS", "slow:*:600", 1);
  const auto with = [](const std::string& key) {
    return httplib::Headers{{"Authorization", "Bearer " + key}};
  };
  const httplib::Headers mine = with(keys.create("me", Scope::submit));
  const httplib::Headers other = with(keys.create("other", Scope::submit));
  const std::string self = post(small_study(), mine)->get_header_value("Location");
  const auto change = [&](const httplib::Headers& headers, const std::string& body) {
    return client().Patch(self, headers, body, "application/json");
  };
  const httplib::Result done = change(mine, R"({"priority": -3, "labels": ["a"], "keep": true})");
  ASSERT_EQ(done->status, 200) << done->body;
  const json study = json::parse(done->body);
  EXPECT_EQ(study["priority"], -3);
  EXPECT_EQ(study["labels"], json{"a"});
  EXPECT_EQ(study["keep"], true);
  expect_problem(change(other, R"({"keep": false})"), 404);
  expect_problem(change(mine, R"({"labels": [""]})"), 400);
  EXPECT_THAT(change(mine, R"({"title": "b"})")->body, HasSubstr("priority, labels, keep"));
  expect_problem(client().Patch(self, mine, "{}", "text/plain"), 415);
  // Another owner sees what is labeled as shared, its events too, and changes nothing.
  ASSERT_EQ(change(mine, R"({"labels": ["shared"]})")->status, 200);
  EXPECT_EQ(get(self + "/events", other)->status, 200);
  expect_problem(change(other, R"({"keep": false})"), 403);
  EXPECT_EQ(client().Delete(self, mine)->status, 204);
}

TEST_F(StudyApi, ARunThatFailsIsTriedAgainAndThenNamed) {
  SKIP_WITHOUT_PROGRAM();
  ::setenv("THRONG_FAULTS", "die:simulation/000001:1", 1);
  EXPECT_EQ(ended(submitted(small_study()))["state"], "succeeded");
  ::setenv("THRONG_FAULTS", "die:simulation/000001", 1);
  const json failed = ended(submitted(small_study()));
  EXPECT_EQ(failed["state"], "failed");
  EXPECT_THAT(failed["error"]["message"].get<std::string>(),
              HasSubstr("run 0 of case \"yard\" and policy \"d\""));
}

TEST_F(StudyApi, IsItsOwnersAndCountsForTheirQuota) {
  SKIP_WITHOUT_PROGRAM();
  ::setenv("THRONG_FAULTS", "slow:*:600", 1);
  const auto with = [](const std::string& key) {
    return httplib::Headers{{"Authorization", "Bearer " + key}};
  };
  const httplib::Headers mine = with(keys.create("me", Scope::submit, 1));
  const httplib::Headers other = with(keys.create("other", Scope::submit));
  const httplib::Headers reader = with(keys.create("reader", Scope::read));
  const httplib::Headers admin = with(keys.create("admin", Scope::admin));
  const httplib::Result first = post(small_study(), mine);
  ASSERT_EQ(first->status, 201);
  const std::string self = first->get_header_value("Location");
  expect_problem(post(small_study(), mine), 429);
  expect_problem(post(small_study(), reader), 403);
  expect_problem(post(small_study()), 401);
  for (const char* path : {"", "/report", "/files/values.json"}) {
    expect_problem(get(self + path, other), 404);
  }
  expect_problem(client().Post(self + "/cancel", other, "", "application/json"), 404);
  expect_problem(client().Delete(self, other), 404);
  EXPECT_EQ(json::parse(get(kRoute, other)->body)["studies"].size(), 0U);
  EXPECT_EQ(get(self, admin)->status, 200);
  EXPECT_EQ(client().Delete(self, mine)->status, 204);
}

TEST_F(StudyApi, AScenarioThatItNamesIsNotRemoved) {
  SKIP_WITHOUT_PROGRAM();
  const auto uploaded = client().Post("/v1/scenarios?name=mine", yard_bundle(), "application/zip");
  ASSERT_EQ(uploaded->status, 201) << uploaded->body;
  ::setenv("THRONG_FAULTS", "slow:*:600", 1);
  json study = small_study();
  study["cases"][0]["scenario"] = "mine/yard";
  const std::string self = submitted(study);
  EXPECT_EQ(client().Delete("/v1/scenarios/mine")->status, 409);
  EXPECT_EQ(client().Delete(self)->status, 204);
  EXPECT_EQ(client().Delete("/v1/scenarios/mine")->status, 204);
}

/// A service that is begun again on the same data.
class StudyRestart : public ServiceFixture {
 protected:
  ~StudyRestart() override { ::unsetenv("THRONG_SCENARIOS"); }
};

TEST_F(StudyRestart, GoesOnWithTheRunsThatItHas) {
  SKIP_WITHOUT_PROGRAM();
  std::string id;
  ::setenv("THRONG_FAULTS", "slow:simulation/000002:600", 1);
  {
    Service first(options(), executor);
    ::setenv("THRONG_SCENARIOS", first.folders().scenarios().c_str(), 1);
    id = first.studies().submit(small_study(), {}).id;
    const fs::path second_run = first.folders().study_folder(id) / "runs/yard/d/000.json";
    ASSERT_TRUE(wait_until([&] { return fs::exists(second_run); }));
  }
  ::unsetenv("THRONG_FAULTS");
  const fs::path folder = data.path() / "studies" / id;
  EXPECT_FALSE(fs::exists(folder / "runs/yard/none/001.json"));
  const auto written = fs::last_write_time(folder / "runs/yard/d/000.json");
  write_file_atomically(folder / "runs/yard/none/000.json.tmp.1", "left by a killed worker");
  Service second(options(), executor);
  ASSERT_TRUE(reaches(second, id, jobs::JobState::succeeded));
  EXPECT_EQ(second.queue().get(id)->attempt, 2);
  EXPECT_EQ(fs::last_write_time(folder / "runs/yard/d/000.json"), written);
  EXPECT_FALSE(fs::exists(folder / "runs/yard/none/000.json.tmp.1"));
}

TEST_F(StudyRestart, ResultsOfAnotherVersionAreMadeAgain) {
  SKIP_WITHOUT_PROGRAM();
  std::string id;
  ::setenv("THRONG_FAULTS", "slow:simulation/000002:600", 1);
  {
    Service first(options(), executor);
    ::setenv("THRONG_SCENARIOS", first.folders().scenarios().c_str(), 1);
    id = first.studies().submit(small_study(), {}).id;
    ASSERT_TRUE(wait_until(
        [&] { return fs::exists(first.folders().study_folder(id) / "runs/yard/d/000.json"); }));
  }
  ::unsetenv("THRONG_FAULTS");
  const fs::path folder = data.path() / "studies" / id;
  write_file_atomically(folder / "runs/yard/d/000.json", "of an earlier version");
  write_file_atomically(folder / study::kGeneratorName, "throng 0.0.1");
  Service second(options(), executor);
  ASSERT_TRUE(reaches(second, id, jobs::JobState::succeeded));
  EXPECT_THAT(read_file(folder / "runs/yard/d/000.json"), HasSubstr("fingerprint"));
}

}  // namespace
}  // namespace throng::server
