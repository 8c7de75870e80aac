// Operations on jobs over HTTP, and the stream of their events.
#include <gmock/gmock.h>
#include <atomic>

#include "jobs/queue/dataset/publication.h"
#include "tests/server/api_fixture.h"

namespace throng::server {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class JobsApi : public ApiTest {
 protected:
  json post(const std::string& path, int status, const std::string& body = "") const {
    const httplib::Result answer = client().Post(path, body, "application/json");
    EXPECT_EQ(answer->status, status) << path << ": " << answer->body;
    return json::parse(answer->body);
  }

  json submit_with(const std::string& query, int status = 201) const {
    return post("/v1/jobs" + query, status, kJob);
  }

  std::vector<std::string> event_types(const std::string& id) const {
    std::vector<std::string> types;
    const json page = get_json("/v1/jobs/" + id + "/events");
    for (const json& event : page["events"]) types.push_back(event["type"]);
    return types;
  }
};

TEST_F(JobsApi, ADryRunQueuesNothing) {
  const json answer = submit_with("?dry_run=true", 200);
  EXPECT_EQ(answer["valid"], true);
  EXPECT_EQ(answer["frames"], 3);
  EXPECT_EQ(answer["job"]["scenario"], "yard");
  EXPECT_EQ(post("/v1/jobs?dry_run", 400, R"({"scenario": "moon"})")["errors"][0]["pointer"],
            "/scenario");
  EXPECT_TRUE(get_json("/v1/jobs")["jobs"].empty());
  expect_problem(client().Post("/v1/jobs?dry_run=maybe", kJob, "application/json"), 400);
  const std::string message = post("/v1/jobs?dryrun=true", 400, kJob)["errors"][0]["message"];
  EXPECT_THAT(message, testing::HasSubstr("did you mean \"dry_run\"?"));
  expect_problem(get("/v1/jobs?stat=queued"), 400);
  EXPECT_EQ(get("/v1/version?at=noon")->status, 200) << "caches of what is open to everybody";
}

TEST_F(JobsApi, ASubmissionThatIsRepeatedIsOneJob) {
  const httplib::Headers key = {{"Idempotency-Key", "4f0c"}};
  const httplib::Result first = client().Post("/v1/jobs", key, kJob, "application/json");
  const httplib::Result again = client().Post("/v1/jobs", key, kJob, "application/json");
  ASSERT_EQ(first->status, 201);
  ASSERT_EQ(again->status, 200);
  EXPECT_EQ(again->get_header_value("Idempotent-Replayed"), "true");
  EXPECT_EQ(json::parse(first->body)["id"], json::parse(again->body)["id"]);
  expect_problem(client().Post("/v1/jobs?priority=3", key, kJob, "application/json"), 422);
  EXPECT_EQ(get_json("/v1/jobs")["jobs"].size(), 1U);
}

TEST_F(JobsApi, CancelEndsTheWorkAndRetryGoesOnWithIt) {
  std::string id;
  std::string other;
  {
    Gate gate(executor);
    id = submit();
    other = submit();
    ASSERT_TRUE(wait_until([&] { return gate.somebody_waits(); }));
    EXPECT_EQ(post("/v1/jobs/" + other + "/cancel", 200)["state"], "cancelled");
    expect_problem(client().Post("/v1/jobs/" + id + "/retry", "", "application/json"), 409);
    const std::jthread canceller([&] {
      const json cancelled = post("/v1/jobs/" + id + "/cancel", 200);
      EXPECT_EQ(cancelled["state"], "cancelled");
      EXPECT_NE(cancelled["ended_at"], nullptr);
    });
    ASSERT_TRUE(wait_until([&] { return get_json("/v1/jobs/" + id)["state"] == "cancelled"; }));
    gate.open();
  }
  expect_problem(client().Post("/v1/jobs/" + id + "/cancel", "", "application/json"), 409);
  EXPECT_EQ(post("/v1/jobs/" + id + "/retry", 200)["state"], "queued");
  ASSERT_TRUE(wait_until([&] { return get_json("/v1/jobs/" + id)["state"] == "succeeded"; }))
      << get("/v1/jobs/" + id)->body;
  EXPECT_EQ(get_json("/v1/jobs/" + id)["attempt"], 2);
  expect_problem(client().Post("/v1/jobs/" + id + "/retry", "", "application/json"), 409);
  EXPECT_THAT(event_types(other), ElementsAre("submitted", "cancelled"));
}

TEST_F(JobsApi, ACloneIsTheSameJobExceptForChanges) {
  Gate gate(executor);
  const json job = submit_with("?priority=7&label=paper&label=night");
  EXPECT_EQ(job["labels"], json({"paper", "night"}));
  const std::string path = "/v1/jobs/" + job["id"].get<std::string>() + "/clone";
  const json clone = post(path, 201, R"({"seed": 77, "name": "again"})");
  EXPECT_NE(clone["id"], job["id"]);
  EXPECT_EQ(clone["priority"], 7);
  EXPECT_EQ(clone["labels"], job["labels"]);
  EXPECT_EQ(clone["job"]["seed"], 77);
  EXPECT_EQ(clone["job"]["capture"], job["job"]["capture"]);
  expect_problem(client().Post(path, R"({"runs": 0})", "application/json"), 400);
  expect_problem(client().Post(path, "[]", "application/json"), 400);
  gate.open();
}

TEST_F(JobsApi, ACloneOfASharedJobIsNotShared) {
  Gate gate(executor);
  const json job = submit_with("?label=paper&label=shared");
  const json clone = post("/v1/jobs/" + job["id"].get<std::string>() + "/clone", 201, "{}");
  EXPECT_EQ(clone["labels"], json({"paper"}));
  gate.open();
}

TEST_F(JobsApi, PriorityAndLabelsChange) {
  Gate gate(executor);
  const std::string path = "/v1/jobs/" + submit();
  const httplib::Result changed =
      client().Patch(path, R"({"priority": 9, "labels": ["x"]})", "application/json");
  ASSERT_EQ(changed->status, 200);
  EXPECT_EQ(json::parse(changed->body)["priority"], 9);
  EXPECT_EQ(get_json(path)["labels"], json({"x"}));
  for (const char* wrong :
       {"[]", "{", R"({"priority": "high"})", R"({"priority": 101})", R"({"labels": "x"})",
        R"({"labels": [1]})", R"({"labels": [""]})", R"({"state": "succeeded"})"}) {
    expect_problem(client().Patch(path, wrong, "application/json"), 400);
  }
  expect_problem(client().Post("/v1/jobs?priority=high", kJob, "application/json"), 400);
  expect_problem(client().Post("/v1/jobs?label=", kJob, "application/json"), 400);
  gate.open();
}

TEST_F(JobsApi, ListsAreFilteredAndSorted) {
  Gate gate(executor);
  const json first = submit_with("?label=a");
  const json second = submit_with("?label=b");
  post("/v1/jobs/" + second["id"].get<std::string>() + "/cancel", 200);
  const auto ids = [&](const std::string& query) {
    std::vector<std::string> found;
    const json page = get_json("/v1/jobs?" + query);
    for (const json& job : page["jobs"]) found.push_back(job["id"]);
    return found;
  };
  EXPECT_THAT(ids("state=cancelled"), ElementsAre(second["id"]));
  EXPECT_THAT(ids("state=cancelled&state=queued&state=running&sort=oldest"),
              ElementsAre(first["id"], second["id"]));
  EXPECT_THAT(ids("label=a"), ElementsAre(first["id"]));
  EXPECT_THAT(ids("name=YAR"), ElementsAre(second["id"], first["id"]));
  EXPECT_THAT(ids("name=moon"), ElementsAre());
  expect_problem(get("/v1/jobs?state=lost"), 400);
  expect_problem(get("/v1/jobs?sort=random"), 400);
  gate.open();
}

TEST_F(JobsApi, EventsArePagedAndWaitedFor) {
  const std::string id = submit_and_wait();
  const std::string path = "/v1/jobs/" + id + "/events";
  const json all = get_json(path);
  EXPECT_EQ(all["events"][0]["type"], "submitted");
  EXPECT_EQ(all["events"][1]["type"], "started");
  EXPECT_EQ(all["events"].back()["type"], "succeeded");
  EXPECT_EQ(all["events"].back()["data"]["state"], "succeeded");
  EXPECT_EQ(all["next"], all["events"].back()["seq"]);
  const json page = get_json(path + "?limit=2");
  EXPECT_EQ(page["events"].size(), 2U);
  const json rest = get_json(fmt::format("{}?after={}", path, page["next"].dump()));
  EXPECT_EQ(rest["events"].size() + 2, all["events"].size());
  // Waiting clients are notified at once.
  json waited;
  const std::string query = fmt::format("/v1/events?wait_s=30&after={}", all["next"].dump());
  std::jthread waiter([&] { waited = get_json(query); });
  const std::string next = submit();
  waiter.join();
  ASSERT_FALSE(waited["events"].empty());
  EXPECT_EQ(waited["events"][0]["job"], next);
  EXPECT_TRUE(get_json(fmt::format("/v1/events?wait_s=0&after={}", 1 << 30))["events"].empty());
  for (const char* query_part : {"after=-1", "after=x", "wait_s=61", "limit=0"}) {
    expect_problem(get(path + "?" + query_part), 400);
  }
}

TEST_F(JobsApi, AStreamTellsAllAndEndsWithTheJob) {
  Gate gate(executor);
  const std::string id = submit();
  std::string text;
  std::jthread reader([&] {
    client().Get("/v1/jobs/" + id + "/events", {{"Accept", "text/event-stream"}},
                 [&](const char* block, std::size_t count) {
                   text.append(block, count);
                   return true;
                 });
  });
  ASSERT_TRUE(wait_until([&] { return service.queue().watchers() == 1; }));
  gate.open();
  reader.join();
  EXPECT_THAT(text, HasSubstr("event: submitted\ndata: {"));
  EXPECT_THAT(text, HasSubstr("event: stage\n"));
  EXPECT_THAT(text, HasSubstr("event: succeeded\n"));
  EXPECT_TRUE(wait_until([&] { return service.queue().watchers() == 0; }));
  // A client that was cut off goes on behind the last event that it has seen.
  const std::string last = get_json("/v1/jobs/" + id + "/events?limit=2")["next"].dump();
  const httplib::Result rest =
      get("/v1/jobs/" + id + "/events", {{"Accept", "text/event-stream"}, {"Last-Event-ID", last}});
  EXPECT_EQ(rest->body.find("event: submitted"), std::string::npos);
  EXPECT_THAT(rest->body, HasSubstr("event: succeeded\n"));
  expect_problem(
      get("/v1/jobs/" + id + "/events", {{"Accept", "text/event-stream"}, {"Last-Event-ID", "x"}}),
      400);
}

TEST_F(JobsApi, AStreamOfARunningJobTellsThePastBeforeItsProgress) {
  Gate gate(executor);
  const std::string id = submit();
  ASSERT_TRUE(wait_until([&] { return gate.somebody_waits(); }));
  const std::string self = "/v1/jobs/" + id;
  // Progress is there, and so are events, before anybody looks.
  ASSERT_FALSE(get_json(self)["progress"].is_null());
  std::vector<std::string> past = event_types(id);
  ASSERT_GE(past.size(), 2U);
  past.emplace_back("progress");
  std::vector<std::string> first;
  const auto has_ended = [&](const std::vector<std::string>& types) {
    if (types.size() < past.size()) return false;
    if (first.empty()) first.assign(types.begin(), types.begin() + static_cast<int>(past.size()));
    gate.open();
    return false;
  };
  const std::vector<std::string> all = streamed(self + "/events", has_ended);
  EXPECT_EQ(first, past);
  EXPECT_EQ(all.back(), "succeeded");
  EXPECT_EQ(streamed(self + "/events", [](const auto&) { return false; }), event_types(id))
      << "no progress once it has ended";
}

TEST_F(JobsApi, TooManyStreamsAreRefusedAndOthersServed) {
  Gate gate(executor);
  const std::string id = submit();
  std::vector<std::shared_ptr<void>> watches;
  while (auto watch = service.queue().begin_watch("")) watches.push_back(watch);
  EXPECT_EQ(watches.size(), 192U);
  expect_problem(get("/v1/jobs/" + id + "/events", {{"Accept", "text/event-stream"}}), 429);
  expect_problem(get("/v1/jobs/" + id + "/events?wait_s=60&after=1000000"), 429);
  EXPECT_EQ(get("/v1/jobs/" + id + "/events?after=1000000")->status, 200);
  EXPECT_EQ(get("/v1/jobs/" + id)->status, 200);
  gate.open();
}

TEST_F(JobsApi, AJobCanBeKeptForGood) {
  const std::string self = "/v1/jobs/" + submit_and_wait();
  EXPECT_FALSE(get_json(self)["keep"]);
  EXPECT_TRUE(get_json(self)["expires_at"].is_null());
  const auto kept = client().Patch(self, R"({"keep": true})", "application/json");
  EXPECT_EQ(kept->status, 200);
  EXPECT_TRUE(get_json(self)["keep"]);
  expect_problem(client().Patch(self, R"({"keep": 1})", "application/json"), 400);
}

TEST_F(JobsApi, PreviewsAreThereWhileTheJobRuns) {
  Gate gate(executor);
  const std::string id = submit();
  const std::string self = "/v1/jobs/" + id;
  ASSERT_TRUE(wait_until([&] { return gate.somebody_waits(); }));
  EXPECT_TRUE(get_json(self + "/previews")["previews"].empty());
  jobs::Publication shard(service.folders().job_folder(id) / "work/run000/shard0000");
  shard.add("previews/run000/d1/000001.jpg", "drawn");
  shard.add("images/run000/d1/000000.jpg", "another");
  shard.add("images/run000/d1/000001.jpg", "clean");
  shard.publish({});
  const json previews = get_json(self + "/previews")["previews"];
  ASSERT_EQ(previews.size(), 1U);
  EXPECT_EQ(previews[0]["name"], "run000/d1/000001.jpg");
  EXPECT_EQ(get(previews[0]["href"])->body, "drawn");
  EXPECT_EQ(get(previews[0]["clean"])->body, "clean");
  // Streams say which one is the newest.
  std::atomic<bool> is_told = false;
  std::jthread reader([&] {
    std::string text;
    client().Get(self + "/events", {{"Accept", "text/event-stream"}},
                 [&](const char* block, std::size_t count) {
                   text.append(block, count);
                   is_told = text.find("event: preview\ndata: {") != std::string::npos &&
                             text.find("run000/d1/000001.jpg") != std::string::npos;
                   return !is_told;
                 });
  });
  EXPECT_TRUE(wait_until([&] { return is_told.load(); }));
  expect_problem(get(self + "/previews/run000/d1/000000.jpg?clean"), 404);
}

}  // namespace
}  // namespace throng::server
