// User input is checked outside of the service: its answers, and files that the service itself does
// not touch.
#include <gmock/gmock.h>

#include <atomic>
#include <future>

#include "base/error.h"
#include "spec/job/resolved_job.h"
#include "tests/server/api_fixture.h"
#include "tests/server/bundles.h"

namespace throng::server {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// The service with its own children also for jobs.
class RealChecks : public ServiceFixture {
 protected:
  static ServiceOptions really(ServiceOptions options) {
    options.confined = real_checks();
    return options;
  }

  std::vector<Problem> list_problems(const std::string& job, std::int64_t max_task_mib = 0) {
    ServiceOptions really_options = really(options());
    really_options.max_task_mib = max_task_mib;
    Service service(really_options, executor);
    try {
      service.queue().dry_run(nlohmann::json::parse(job));
    } catch (const InputError& error) {
      return error.problems();
    }
    return {};
  }
};

TEST_F(RealChecks, AJobIsRefusedIfItsScenarioCannotDoIt) {
  SKIP_WITHOUT_PROGRAM();
  const std::pair<const char*, const char*> cases[] = {
      {R"({"scenario": "nowhere"})", "/scenario"},
      {R"({"scenario": "yard", "crowd": {"agents": 3}})", "/crowd/agents"},
      {R"({"scenario": "yard", "crowd": {"model": "orka"}})", "/crowd/model"},
      {R"({"scenario": "yard", "drones": [{"id": "other"}]})", "/drones/0/start"},
      {R"({"scenario": "yard", "outputs": {"formats": ["docx"]}})", "/outputs/formats/0"},
      {R"({"scenario": "yard", "drones": [{"id": "d1", "camera":
           {"model": "brown_conrady", "distortion": {"k1": -0.9}}}]})",
       "/drones/0/camera/distortion"},
  };
  for (const auto& [job, pointer] : cases) {
    const std::vector<Problem> problems = list_problems(job);
    ASSERT_EQ(problems.size(), 1U) << job;
    EXPECT_EQ(problems[0].where, pointer) << job;
    EXPECT_EQ(problems[0].source, "");
    EXPECT_FALSE(problems[0].found.empty());
    EXPECT_FALSE(problems[0].expected.empty());
  }
  EXPECT_TRUE(list_problems(R"({"scenario": "yard", "crowd": {"agents": 2}})").empty());
}

TEST_F(RealChecks, AJobThatNeedsMoreMemoryThanThereIsIsRefused) {
  SKIP_WITHOUT_PROGRAM();
  constexpr std::int64_t kMaxMib = 1000;
  const char* small = R"({"scenario": "yard", "drones": [{"id": "d1"}]})";
  EXPECT_TRUE(list_problems(small, kMaxMib).empty());
  const char* large = R"({"scenario": "yard", "drones": [{"id": "d1", "camera":
                          {"width": 7680, "height": 4320}}]})";
  EXPECT_TRUE(list_problems(large).empty());
  const std::vector<Problem> problems = list_problems(large, kMaxMib);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].where, "/drones");
  EXPECT_THAT(problems[0].expected, HasSubstr("1000 MiB"));
}

TEST_F(RealChecks, TheScenarioCompletesTheJob) {
  SKIP_WITHOUT_PROGRAM();
  Service service(really(options()), executor);
  const std::string resolved = service.queue().dry_run(job_document()).at("job").dump();
  const jobs::JobSpec job = jobs::read_resolved_job(resolved, "").spec();
  EXPECT_FALSE(job.crowd.model.empty());
  ASSERT_EQ(job.drones.size(), 1U);
  EXPECT_EQ(job.drones[0].mission.moves_goal, (world::GoalRef{99, 0}));
}

TEST_F(ServiceFixture, AChildThatDiesCostsOneRequest) {
  ServiceOptions dying = options();
  dying.confined = jobs::confined_task_in_child({"sh", "-c", "kill -SEGV $$"});
  Service service(dying, executor);
  try {
    service.queue().submit({job_document()});
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("ended by signal 11"));
  }
  EXPECT_TRUE(service.queue().list({}).empty());
  for (const auto& entry : fs::directory_iterator(data.path())) {
    EXPECT_THAT(entry.path().filename().string(), ::testing::Not(HasSubstr("check.tmp")));
  }
}

TEST_F(ServiceFixture, AChildThatWasTakenOverWritesNoFileElsewhere) {
  for (const char* name : {"../../evil", "/tmp/throng-evil", "a/b", "..", ""}) {
    ServiceOptions hostile = options();
    hostile.confined = [&](const auto&, const auto&) { return json{{"files", {{name, "x"}}}}; };
    Service service(hostile, executor);
    EXPECT_ANY_THROW(service.uploads().scenarios().stage_blueprint("drawn", json::object(), ""))
        << name;
    EXPECT_FALSE(fs::exists("/tmp/throng-evil"));
    EXPECT_FALSE(fs::exists(data.path() / "evil"));
    EXPECT_FALSE(fs::exists(data.path() / "uploads" / "evil"));
  }
}

TEST_F(ServiceFixture, AJobThatTheSchemaRefusesStartsNoChild) {
  ServiceOptions counting = options();
  std::atomic<int> children = 0;
  counting.confined = [&](const auto& request, const auto&) {
    ++children;
    return check_lightly(request);
  };
  Service service(counting, executor);
  EXPECT_THROW(
      service.queue().submit({nlohmann::json::parse(R"({"scenario": "yard", "runs": 0})")}),
      InputError);
  EXPECT_EQ(children, 0);
  service.queue().submit({job_document()});
  EXPECT_EQ(children, 1);
}

TEST_F(ServiceFixture, ASlowCheckOfAJobWithABundleLetsOthersSubmit) {
  ServiceOptions slow = options();
  std::promise<void> begun;
  std::promise<void> go_on;
  const std::shared_future<void> may_go_on = go_on.get_future().share();
  slow.confined = [&, light = options().confined](const json& request, const fs::path& work) {
    if (request["task"] == "job" && request["job"].value("name", "") == "slow") {
      begun.set_value();
      may_go_on.wait();
    }
    return light(request, work);
  };
  Service service(slow, executor);
  const std::string bundle = yard_bundle();
  std::future<jobs::Added> first = std::async(std::launch::async, [&] {
    return service.queue().submit_with_bundle(
        {nlohmann::json::parse(
            R"({"name": "slow", "scenario": "bundle/yard", "capture": {"to_s": 2}})")},
        bundle);
  });
  begun.get_future().wait();
  EXPECT_TRUE(service.queue().submit({job_document()}).is_new);
  // The bundle stays for the one that waits, although another that came with it is refused.
  EXPECT_THROW(service.queue().submit_with_bundle(
                   {nlohmann::json::parse(R"({"scenario": "bundle/yard", "runs": 0})")}, bundle),
               InputError);
  go_on.set_value();
  const jobs::Added added = first.get();
  EXPECT_TRUE(added.is_new);
  EXPECT_TRUE(fs::exists(data.path() / "uploads" / bundle_name(bundle)));
  EXPECT_TRUE(service.housekeeping().remove(added.row.id));
  EXPECT_FALSE(fs::exists(data.path() / "uploads" / bundle_name(bundle)));
}

class UploadsOutside : public ApiTest {
 protected:
  void upload() const {
    const auto answer = client().Post("/v1/scenarios?name=mine", yard_bundle(), "application/zip");
    ASSERT_EQ(answer->status, 201) << answer->body;
  }
  fs::path file() const { return data.path() / "uploads/mine/files/yard.json"; }
};

TEST_F(UploadsOutside, AnUploadedScenarioIsNotLoadedByTheService) {
  upload();
  const json before = get_json("/v1/scenarios");
  const json one = get_json("/v1/scenarios/mine/yard");
  EXPECT_EQ(one["exits"].size(), 1U);
  // The service would stumble over this file, if it read it.
  write_file_atomically(file(), "{");
  EXPECT_EQ(get_json("/v1/scenarios"), before);
  EXPECT_EQ(get_json("/v1/scenarios/mine/yard"), one);
  // Its child does, for plans and jobs.
  const std::string job = R"({"scenario": "mine/yard", "crowd": {"agents": 2}})";
  expect_problem(client().Post("/v1/jobs?dry_run", job, "application/json"), 400);
  if (!kProgram.empty()) expect_problem(get("/v1/scenarios/mine/yard?format=svg"), 400);
}

TEST_F(UploadsOutside, OneOfAnEarlierVersionIsDescribedAtTheStart) {
  upload();
  const json one = get_json("/v1/scenarios/mine/yard");
  const fs::path note = data.path() / "uploads/mine/upload.json";
  json old = json::parse(read_file(note));
  ASSERT_EQ(old.erase("summaries"), 1U);
  write_file_atomically(note, old.dump());
  const ConfinedChecks checks(test_checks(), data.path());
  const ScenarioStore store(data.path(), scenarios.path(), checks, {});
  ASSERT_EQ(store.find("mine")->summaries.size(), 1U);
  EXPECT_EQ(store.find("mine")->summaries[0]["exits"], one["exits"]);
  EXPECT_TRUE(json::parse(read_file(note)).contains("summaries"));
}

}  // namespace
}  // namespace throng::server
