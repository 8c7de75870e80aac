// Access: what each key sees and may do, and what is noted of it.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <fstream>
#include <set>

#include "server/access/audit_log.h"
#include "tests/server/api_fixture.h"

namespace throng::server {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class AccessTest : public ApiTest {
 protected:
  httplib::Headers with(const std::string& key) const {
    return {{"Authorization", "Bearer " + key}};
  }

  std::vector<json> audit() const {
    std::ifstream file(data.path() / "audit.log");
    std::vector<json> lines;
    for (std::string line; std::getline(file, line);) lines.push_back(json::parse(line));
    return lines;
  }

  std::string reader = keys.create("reader", Scope::read);
  std::string submitter = keys.create("submitter", Scope::submit);
};

TEST_F(AccessTest, AProxyLearnsWhichKeysMaySendBodies) {
  expect_problem(get("/v1/access/submit"), 401);
  expect_problem(get("/v1/access/submit", with("throng_wrong")), 401);
  expect_problem(get("/v1/access/submit", with(reader)), 403);
  EXPECT_EQ(get("/v1/access/submit", with(submitter))->status, 204);
}

TEST_F(AccessTest, StrangersLearnNoFiguresOfTheMachine) {
  const httplib::Result stranger = get("/readyz");
  EXPECT_EQ(stranger->status, 200);
  EXPECT_EQ(json::parse(stranger->body), (json{{"status", "ready"}}));
  EXPECT_TRUE(json::parse(get("/readyz", with(reader))->body).contains("free_bytes"));
}

TEST_F(AccessTest, ChangesAndRefusalsAreNoted) {
  EXPECT_EQ(
      client().Post("/v1/jobs?label=secret", with(submitter), kJob, "application/json")->status,
      201);
  get("/v1/jobs", with(reader));
  get("/v1/jobs");
  client().Delete("/v1/jobs/j0", with(reader));
  const httplib::Headers forged = {{"X-Forwarded-For", "1.2.3.4\t\"key\""}};
  client().Post("/v1/jobs", forged, "{}", "application/json");
  const std::vector<json> lines = audit();
  ASSERT_EQ(lines.size(), 3U) << "the second refusal of an address within a minute is counted";
  EXPECT_EQ(lines[0]["key"], keys.caller_of(submitter)->key_id);
  EXPECT_EQ(lines[0]["method"], "POST");
  EXPECT_EQ(lines[0]["path"], "/v1/jobs");
  EXPECT_EQ(lines[0]["status"], 201);
  EXPECT_EQ(lines[0]["address"], "127.0.0.1");
  EXPECT_EQ(lines[1]["status"], 401);
  EXPECT_EQ(lines[1]["key"], nullptr);
  EXPECT_EQ(lines[2]["status"], 403);
  EXPECT_EQ(lines[2]["key"], keys.caller_of(reader)->key_id);
  const std::string text = read_file(data.path() / "audit.log");
  EXPECT_THAT(text, Not(HasSubstr("secret")));
  EXPECT_THAT(text, Not(HasSubstr(submitter)));
  struct stat status {};
  ASSERT_EQ(::stat((data.path() / "audit.log").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0600U);
}

/// An audit log with a clock of its own.
class AuditLogTest : public ::testing::Test {
 protected:
  std::vector<json> lines(const char* name = "audit.log") const {
    std::ifstream file(folder.path() / name);
    std::vector<json> all;
    for (std::string line; std::getline(file, line);) all.push_back(json::parse(line));
    return all;
  }

  static AuditEntry refused(const std::string& address) {
    return {"", "POST", "/" + std::string(8000, 'x'), 401, address, "1.2.3.4\t\"key\""};
  }

  jobs::TemporaryFolder folder;
  SteadyTime time = {};
};

TEST_F(AuditLogTest, RefusalsPushNoChangesOutOfIt) {
  AuditLog log(folder.path(), {.max_bytes = 64 << 10}, [this] { return time; });
  log.record({"k", "DELETE", "/v1/jobs/j1", 204, "10.0.0.1", ""});
  for (int i = 0; i < 17'200; ++i) {
    time += std::chrono::milliseconds(1);
    log.record_refusal(refused(fmt::format("10.0.{}.{}", i % 100, i % 7)));
  }
  time += std::chrono::minutes(1);
  log.record({"k", "DELETE", "/v1/jobs/j2", 204, "10.0.0.1", ""});
  const std::vector<json> all = lines();
  ASSERT_EQ(all.size(), 19U) << "two changes, sixteen senders, and the number of the others";
  EXPECT_EQ(all[0]["path"], "/v1/jobs/j1");
  EXPECT_EQ(all[1]["forwarded_for"], "1.2.3.4\t\"key\"");
  EXPECT_EQ(all[1]["path"].get<std::string>().size(), 256U);
  EXPECT_EQ(all[17]["more_refusals"], 17'200 - 16);
  EXPECT_EQ(all[17]["of"]["10.0.0.0"], 17'200 / 700);
  EXPECT_EQ(all[18]["path"], "/v1/jobs/j2");
}

TEST_F(AuditLogTest, OldFilesAreKeptToANumber) {
  AuditLog log(folder.path(), {.max_bytes = 1000, .max_files = 3});
  for (int i = 0; i < 100; ++i) log.record({"k", "POST", fmt::format("/{}", i), 201, "a", ""});
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "audit.log.3"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "audit.log.4"));
  const std::vector<json> newest = lines("audit.log.1");
  ASSERT_FALSE(newest.empty());
  EXPECT_GT(std::stoi(newest.front()["path"].get<std::string>().substr(1)), 70);
}

TEST_F(AccessTest, AnswersRunNoScriptsAndAreNotShownElsewhere) {
  for (const char* path : {"/v1/jobs", "/v1/jobs/none", "/v1/version", "/healthz"}) {
    const httplib::Result answer = get(path, with(reader));
    const std::string policy = answer->get_header_value("Content-Security-Policy");
    EXPECT_THAT(policy, HasSubstr("default-src 'none'")) << path;
    EXPECT_THAT(policy, HasSubstr("frame-ancestors 'none'")) << path;
    EXPECT_THAT(policy, HasSubstr("sandbox")) << path;
    EXPECT_EQ(answer->get_header_value_count("X-Content-Type-Options"), 1U) << path;
    EXPECT_EQ(answer->get_header_value("X-Content-Type-Options"), "nosniff") << path;
    EXPECT_EQ(answer->get_header_value("Referrer-Policy"), "no-referrer") << path;
    EXPECT_EQ(answer->get_header_value("Cache-Control"), "private, no-cache") << path;
  }
  EXPECT_EQ(get("/")->get_header_value_count("Content-Security-Policy"), 1U);
}

TEST_F(AccessTest, AKeySeesItsOwnJobsAndSharedOnes) {
  const std::string other = keys.create("other", Scope::submit);
  const std::string admin = keys.create("admin", Scope::admin);
  const auto post = [&](const std::string& key, const std::string& query) {
    const auto answer = client().Post("/v1/jobs" + query, with(key), kJob, "application/json");
    return json::parse(answer->body)["id"].get<std::string>();
  };
  const std::string mine = post(submitter, "");
  const std::string theirs = post(other, "?label=paper");
  const std::string shared = post(other, "?label=paper&label=shared");
  const auto ids = [&](const std::string& key, const std::string& path, const char* list,
                       const char* field) {
    std::set<std::string> found;
    const json answer = json::parse(get(path, with(key))->body);
    for (const json& item : answer.at(list)) found.insert(item.at(field));
    return found;
  };
  using Ids = std::set<std::string>;
  for (const char* path : {"/v1/jobs", "/v1/jobs?sort=oldest", "/v1/jobs?name=yard"}) {
    EXPECT_EQ(ids(submitter, path, "jobs", "id"), (Ids{mine, shared})) << path;
    EXPECT_EQ(ids(other, path, "jobs", "id"), (Ids{theirs, shared})) << path;
    EXPECT_EQ(ids(admin, path, "jobs", "id"), (Ids{mine, theirs, shared})) << path;
    EXPECT_EQ(ids(reader, path, "jobs", "id"), Ids{shared}) << path;
  }
  EXPECT_EQ(ids(submitter, "/v1/jobs?label=paper", "jobs", "id"), Ids{shared});
  EXPECT_EQ(ids(submitter, "/v1/events", "events", "job"), (Ids{mine, shared}));
  EXPECT_EQ(ids(admin, "/v1/events", "events", "job"), (Ids{mine, theirs, shared}));
  for (const std::string& job : {theirs, shared}) {
    ASSERT_TRUE(wait_until([&] {
      return json::parse(get("/v1/jobs/" + job, with(other))->body)["state"] == "succeeded";
    }));
  }
  const std::string path = "/v1/jobs/" + theirs;
  for (const char* part :
       {"", "/events", "/logs", "/logs/x.log", "/previews", "/previews/a.jpg", "/images",
        "/archive", "/manifest", "/files/README.md", "/metrics", "/report", "/plan",
        "/runs/0/metrics", "/runs/0/metrics.csv", "/runs/0/trace"}) {
    expect_problem(get(path + part, with(submitter)), 404);
    EXPECT_NE(
        json::parse(get(path + part, with(submitter))->body)["detail"].get<std::string>().find(
            "there is no job"),
        std::string::npos)
        << part;
  }
  for (const char* part : {"/cancel", "/retry", "/clone"}) {
    expect_problem(client().Post(path + part, with(submitter), "", "application/json"), 404);
  }
  expect_problem(
      client().Patch(path, with(submitter), R"({"labels": ["shared"]})", "application/json"), 404);
  expect_problem(client().Delete(path, with(submitter)), 404);
  EXPECT_EQ(get("/v1/jobs/" + shared + "/manifest", with(submitter))->status, 200);
  expect_problem(client().Delete("/v1/jobs/" + shared, with(submitter)), 403);
}

TEST(AuditLog, FollowsNoLinkAndFailsQuietly) {
  const jobs::TemporaryFolder folder;
  std::filesystem::create_symlink(folder.path() / "other", folder.path() / "audit.log");
  AuditLog(folder.path()).record({"k", "POST", "/", 201, "", ""});
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "other"));
}

}  // namespace
}  // namespace throng::server
