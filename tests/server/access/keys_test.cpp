#include "server/access/keys.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <map>

#include "base/error.h"
#include "base/files/files.h"
#include "spec/job/spec.h"
#include "tests/server/api_fixture.h"

namespace throng::server {
namespace {

using ::testing::HasSubstr;

constexpr const char* kFlight =
    R"({"scenario": "yard", "drones": [{"id": "d", "start": [0, 0, 9]}]})";

constexpr std::int64_t kPastMs = 1'000'000'000'000;  // in 2001
constexpr std::int64_t kFarMs = 4'102'444'800'000;   // in 2100

class KeysTest : public ApiTest {
 protected:
  httplib::Headers with(const std::string& token) const {
    return {{"Authorization", "Bearer " + token}};
  }

  int posted(const std::string& path, const std::string& token, const char* body = "") const {
    return client().Post(path, with(token), body, "application/json")->status;
  }
};

TEST_F(KeysTest, WithoutKeysEverybodyMayAndFromTheFirstOnNobodyWithout) {
  EXPECT_EQ(get("/v1/jobs")->status, 200);
  const std::string token = keys.create("me", Scope::read);
  const httplib::Result refused = get("/v1/jobs");
  expect_problem(refused, 401);
  EXPECT_EQ(refused->get_header_value("WWW-Authenticate"), "Bearer");
  EXPECT_EQ(get("/v1/jobs", with(token))->status, 200);
  for (const std::string& wrong :
       {std::string("x"), token + "x", token.substr(0, token.size() - 1) + "!", std::string()}) {
    expect_problem(get("/v1/jobs", with(wrong)), 401);
  }
  for (const char* open : {"/healthz", "/readyz", "/v1/version", "/openapi.json"}) {
    EXPECT_EQ(get(open)->status, 200) << open;
  }
  ASSERT_EQ(keys.list().size(), 1U);
  EXPECT_TRUE(keys.revoke(keys.list()[0].id));
  EXPECT_FALSE(keys.revoke(keys.list()[0].id));
  expect_problem(get("/v1/jobs", with(token)), 401);
  EXPECT_TRUE(keys.are_needed()) << "the last key's end opens nothing";
}

TEST_F(KeysTest, AdministratorsMakeAndRevokeThemOverHttp) {
  const auto made = [&](const std::string& token, const json& body) {
    return client().Post("/v1/keys", with(token), body.dump(), "application/json");
  };
  // Nobody can lock the others out of a service without keys.
  expect_problem(client().Post("/v1/keys", R"({"name": "me"})", "application/json"), 403);
  EXPECT_FALSE(keys.are_needed());
  const std::string admin = keys.create("admin", Scope::admin);
  const std::string submitter = keys.create("submitter", Scope::submit);
  expect_problem(made(submitter, {{"name", "friend"}}), 403);
  expect_problem(get("/v1/keys", with(submitter)), 403);

  const httplib::Result answer = made(admin, {{"name", "friend"},
                                              {"scope", "read"},
                                              {"max_jobs", 3},
                                              {"max_bytes", 5},
                                              {"max_priority", -2}});
  ASSERT_EQ(answer->status, 201) << answer->body;
  const json key = json::parse(answer->body);
  EXPECT_EQ(answer->get_header_value("Location"), "/v1/keys/" + key["id"].get<std::string>());
  EXPECT_EQ(get("/v1/jobs", with(key["key"]))->status, 200);
  const auto rows = keys.list();
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[2].name, "friend");
  EXPECT_EQ(rows[2].scope, Scope::read);
  EXPECT_EQ(rows[2].max_active, 3);
  EXPECT_EQ(rows[2].max_bytes, 5);
  EXPECT_EQ(rows[2].max_priority, -2);

  const httplib::Result list = get("/v1/keys", with(admin));
  EXPECT_EQ(json::parse(list->body)["keys"].size(), 3U);
  EXPECT_EQ(list->body.find(key["key"].get<std::string>()), std::string::npos);

  const std::string path = "/v1/keys/" + key["id"].get<std::string>();
  EXPECT_EQ(client().Delete(path, with(admin))->status, 200);
  expect_problem(get("/v1/jobs", with(key["key"])), 401);
  expect_problem(client().Delete(path, with(admin)), 409);
  expect_problem(client().Delete("/v1/keys/aaaaaaaa", with(admin)), 404);
  expect_problem(client().Delete("/v1/keys/" + admin.substr(7, 8), with(admin)), 409);
}

TEST_F(KeysTest, RevokingAKeyCancelsWhatItHasUnderWay) {
  const std::string admin = keys.create("admin", Scope::admin);
  const std::string here = keys.create("revoked over HTTP", Scope::submit);
  const std::string elsewhere = keys.create("revoked by throng keys", Scope::submit);
  Gate gate(executor);
  const auto submitted = [&](const std::string& token) {
    const httplib::Result answer = client().Post("/v1/jobs", with(token), kJob, "application/json");
    return json::parse(answer->body)["id"].get<std::string>();
  };
  const auto state = [&](const std::string& id) {
    return json::parse(get("/v1/jobs/" + id, with(admin))->body)["state"].get<std::string>();
  };
  const std::string running = submitted(here);
  ASSERT_TRUE(wait_until([&] { return gate.somebody_waits(); }));
  const std::string queued = submitted(here);
  const std::string queued_too = submitted(here);
  const std::string of_other = submitted(elsewhere);
  const std::string of_admin = submitted(admin);

  const httplib::Result revoked =
      client().Delete("/v1/keys/" + keys.caller_of(here)->key_id, with(admin));
  ASSERT_EQ(revoked->status, 200);
  EXPECT_EQ(json::parse(revoked->body)["ended"], json({{"jobs", 3}, {"live_flights", 0}}));
  for (const std::string& id : {running, queued, queued_too}) EXPECT_EQ(state(id), "cancelled");
  expect_problem(client().Post("/v1/jobs/" + queued + "/retry", with(admin), "", ""), 409);
  EXPECT_NE(state(of_other), "cancelled");

  EXPECT_TRUE(keys.revoke(keys.caller_of(elsewhere)->key_id));
  EXPECT_TRUE(wait_until([&] { return state(of_other) == "cancelled"; }));
  gate.open();
  EXPECT_TRUE(wait_until([&] { return state(of_admin) == "succeeded"; }));
  EXPECT_EQ(state(running), "cancelled");
}

TEST_F(KeysTest, RecordingsOfLiveFlightsCountForTheDiskOfAKey) {
  constexpr std::int64_t kShare = 40 << 20;
  const std::string token = keys.create("flier", Scope::submit, 0, kShare);
  const std::string id = keys.caller_of(token)->key_id;
  const auto submitted = [&] {
    return client().Post("/v1/jobs", with(token), kJob, "application/json");
  };
  EXPECT_EQ(submitted()->status, 201);
  const auto flight =
      service.live().begin(jobs::ResolvedJob(jobs::parse_job(kFlight, ""), {10}), id, true);
  write_file_atomically(flight->recording(), std::string(kShare, 'x'));
  EXPECT_GE(service.live().disk_bytes_of(id), kShare);
  EXPECT_EQ(service.live().disk_bytes_of("another"), 0);
  expect_problem(submitted(), 429);
  const json another = {{"job", json::parse(kFlight)}, {"record", true}};
  const httplib::Result refused =
      client().Post("/v1/live", with(token), another.dump(), "application/json");
  expect_problem(refused, 429);
  EXPECT_THAT(refused->body, HasSubstr("without a recording"));
  EXPECT_TRUE(service.live().remove(flight->spec().id));
  EXPECT_EQ(submitted()->status, 201);
}

TEST_F(KeysTest, WrongFieldsOfAKeyAreNamed) {
  const std::string admin = keys.create("admin", Scope::admin);
  const std::pair<json, const char*> wrong[] = {
      {json::object(), "/name"},
      {{{"name", ""}}, "/name"},
      {{{"name", "two\nlines"}}, "/name"},
      {{{"name", "\x1b[2J"}}, "/name"},
      {{{"name", "del\x7f"}}, "/name"},
      {{{"name", "c1\xc2\x9b"}}, "/name"},
      {{{"name", "a"}, {"scope", "root"}}, "/scope"},
      {{{"name", "a"}, {"scope", "anybody"}}, "/scope"},
      {{{"name", "a"}, {"max_jobs", -1}}, "/max_jobs"},
      {{{"name", "a"}, {"max_bytes", 1.5}}, "/max_bytes"},
      {{{"name", "a"}, {"max_priority", 101}}, "/max_priority"},
      {{{"name", "a"}, {"jobs", 1}}, "/jobs"}};
  for (const auto& [body, pointer] : wrong) {
    const auto answer = client().Post("/v1/keys", with(admin), body.dump(), "application/json");
    expect_problem(answer, 400);
    EXPECT_EQ(json::parse(answer->body)["errors"][0]["pointer"], pointer) << body;
  }
  EXPECT_EQ(keys.list().size(), 1U);
}

TEST_F(KeysTest, AKeyExpires) {
  const std::string admin = keys.create("admin", Scope::admin);
  const std::string later = keys.create("later", Scope::read, 0, 0, 0, kFarMs);
  const std::string expired = keys.create("expired", Scope::admin, 0, 0, 0, kPastMs);
  EXPECT_EQ(get("/v1/jobs", with(later))->status, 200);
  const httplib::Result refused = get("/v1/jobs", with(expired));
  expect_problem(refused, 401);
  EXPECT_THAT(refused->body, HasSubstr("this key expired at 2001-09-09T01:46:40.000Z"));
  const json sign_in = {{"key", expired}};
  EXPECT_THAT(client().Post("/v1/session", sign_in.dump(), "application/json")->body,
              HasSubstr("this key expired at"));
  std::string wrong = expired;
  wrong.back() = wrong.back() == 'a' ? 'b' : 'a';
  EXPECT_THAT(get("/v1/jobs", with(wrong))->body, HasSubstr("not known"))
      << "whoever knows the id alone learns nothing";
  // Streams end, and the service with no other key is not open to everybody.
  EXPECT_FALSE(keys.is_valid({expired.substr(7, 8), Scope::admin}));
  EXPECT_TRUE(keys.is_valid({later.substr(7, 8), Scope::read}));
  const json list = json::parse(get("/v1/keys", with(admin))->body)["keys"];
  std::map<std::string, json> expiries;
  for (const json& key : list) expiries[key["name"]] = key["expires_at"];
  EXPECT_EQ(expiries["admin"], nullptr);
  EXPECT_EQ(expiries["expired"], "2001-09-09T01:46:40.000Z");
  EXPECT_EQ(expiries["later"], "2100-01-01T00:00:00.000Z");
}

TEST_F(KeysTest, WorkOfAKeyThatExpiresGoesOn) {
  const std::string token = keys.create("soon", Scope::submit, 0, 0, 0, kFarMs);
  Gate gate(executor);
  const httplib::Result answer = client().Post("/v1/jobs", with(token), kJob, "application/json");
  const std::string id = json::parse(answer->body)["id"];
  ASSERT_TRUE(wait_until([&] { return gate.somebody_waits(); }));
  SQLite::Database(data.path() / "keys.sqlite", SQLite::OPEN_READWRITE)
      .exec(fmt::format("UPDATE key SET expires_ms = {}", kPastMs));
  expect_problem(get("/v1/jobs", with(token)), 401);
  EXPECT_EQ(RevokedKeys(keys, service.queue(), service.live()).end_work().jobs, 0);
  gate.open();
  EXPECT_TRUE(reaches(service, id, jobs::JobState::succeeded));
}

TEST_F(KeysTest, ExpiriesAreDatesTimesAndDurations) {
  const std::string admin = keys.create("admin", Scope::admin);
  const auto made = [&](const json& expires_at) {
    const json body = {{"name", "a"}, {"expires_at", expires_at}};
    return client().Post("/v1/keys", with(admin), body.dump(), "application/json");
  };
  const std::pair<json, json> times[] = {
      {nullptr, nullptr},
      {"2100-02-28", "2100-02-28T00:00:00.000Z"},
      {"2100-02-28T12:30:00Z", "2100-02-28T12:30:00.000Z"},
      {"2100-02-28T12:30:00.25+02:00", "2100-02-28T10:30:00.000Z"},
      {"2100-01-01T00:30:00-01:30", "2100-01-01T02:00:00.000Z"}};
  for (const auto& [given, expected] : times) {
    const httplib::Result answer = made(given);
    ASSERT_EQ(answer->status, 201) << answer->body;
    EXPECT_EQ(json::parse(answer->body)["expires_at"], expected) << given;
  }
  for (const char* duration : {"1h", "30d", "99999w"}) {
    const httplib::Result answer = made(duration);
    ASSERT_EQ(answer->status, 201) << answer->body;
    const std::string key = json::parse(answer->body)["key"];
    EXPECT_EQ(get("/v1/jobs", with(key))->status, 200) << duration;
  }
  for (const json& wrong : std::vector<json>{"",
                                             "soon",
                                             "30",
                                             "d",
                                             "0d",
                                             "-1d",
                                             "1.5d",
                                             "30 d",
                                             "100000d",
                                             "30m",
                                             "2100-02-29",
                                             "2100-2-3",
                                             " 2100-02-03",
                                             "2100-02-03T12:00:00",
                                             "2100-02-03T25:00:00Z",
                                             "2100-02-03T12:00:00+2:00",
                                             "2100-02-03T12:00:00+99:00",
                                             "2100-02-03T12:00:00.Z",
                                             "2100-02-03T12:00:00Zulu",
                                             "2001-01-01",
                                             "1999-12-31T23:59:59Z",
                                             30,
                                             true}) {
    const httplib::Result answer = made(wrong);
    expect_problem(answer, 400);
    EXPECT_EQ(json::parse(answer->body)["errors"][0]["pointer"], "/expires_at") << wrong;
  }
}

TEST(KeyFile, OfAnOlderProgramIsTakenOverAndOneOfANewerProgramIsRefused) {
  const jobs::TemporaryFolder folder;
  const auto exec = [&](const std::string& statement) {
    SQLite::Database(folder.path() / "keys.sqlite", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE)
        .exec(statement);
  };
  exec(
      "CREATE TABLE key (id TEXT PRIMARY KEY, name TEXT NOT NULL, hash TEXT NOT NULL, scope TEXT "
      "NOT NULL, max_active INTEGER NOT NULL DEFAULT 0, created_ms INTEGER NOT NULL, revoked_ms "
      "INTEGER NOT NULL DEFAULT 0) WITHOUT ROWID");
  exec("INSERT INTO key (id, name, hash, scope, created_ms) VALUES ('a', 'old', 'h', 'admin', 5)");
  {
    const Keys keys(folder.path());
    ASSERT_EQ(keys.list().size(), 1U);
    EXPECT_EQ(keys.list()[0].expires_ms, 0);
  }
  exec("PRAGMA user_version = 7");
  try {
    const Keys keys(folder.path());
    ADD_FAILURE() << "expected an error";
  } catch (const EnvironmentError& error) {
    EXPECT_THAT(error.what(), HasSubstr("version 7; this program (throng "));
    EXPECT_THAT(error.what(), HasSubstr("knows up to 1"));
  }
}

TEST_F(KeysTest, ScopesLimitAKey) {
  const std::string reader = keys.create("reader", Scope::read);
  const std::string one = keys.create("one", Scope::submit);
  const std::string other = keys.create("other", Scope::submit);
  const std::string admin = keys.create("admin", Scope::admin);
  Gate gate(executor);
  expect_problem(client().Post("/v1/jobs", with(reader), kJob, "application/json"), 403);
  const httplib::Result answer = client().Post("/v1/jobs", with(one), kJob, "application/json");
  ASSERT_EQ(answer->status, 201);
  const json job = json::parse(answer->body);
  EXPECT_EQ(job["owner"], one.substr(7, 8));
  const std::string path = "/v1/jobs/" + job["id"].get<std::string>();
  EXPECT_EQ(get(path, with(other))->status, 404);
  EXPECT_EQ(posted(path + "/cancel", other), 404) << "it does not see the job";
  const std::string shared = R"({"labels": ["shared"]})";
  EXPECT_EQ(client().Patch(path, with(one), shared, "application/json")->status, 200);
  EXPECT_EQ(posted(path + "/cancel", other), 403);
  EXPECT_EQ(client().Delete(path, with(other))->status, 403);
  EXPECT_EQ(client().Patch(path, with(other), "{}", "application/json")->status, 403);
  EXPECT_EQ(client().Patch(path, with(one), "{}", "application/json")->status, 200);
  gate.open();
  EXPECT_EQ(client().Delete(path, with(admin))->status, 204);
}

TEST_F(KeysTest, AKeyMayHaveSoManyJobs) {
  const std::string token = keys.create("few", Scope::submit, 2);
  Gate gate(executor);
  EXPECT_EQ(posted("/v1/jobs", token, kJob), 201);
  httplib::Headers repeated = with(token);
  repeated.emplace("Idempotency-Key", "k");
  EXPECT_EQ(client().Post("/v1/jobs", repeated, kJob, "application/json")->status, 201);
  EXPECT_EQ(client().Post("/v1/jobs", repeated, kJob, "application/json")->status, 200)
      << "a repetition is no job more";
  const httplib::Result refused = client().Post("/v1/jobs", with(token), kJob, "application/json");
  expect_problem(refused, 429);
  EXPECT_EQ(refused->get_header_value("Retry-After"), "60");
  EXPECT_EQ(posted("/v1/jobs", keys.create("many", Scope::submit), kJob), 201);
  gate.open();
}

TEST_F(KeysTest, RetriesCountLikeNewJobs) {
  const std::string token = keys.create("few", Scope::submit, 1);
  const std::string admin = keys.create("admin", Scope::admin);
  Gate gate(executor);
  std::vector<std::string> paths;
  for (int i = 0; i < 5; ++i) {
    const httplib::Result answer = client().Post("/v1/jobs", with(token), kJob, "application/json");
    ASSERT_EQ(answer->status, 201);
    paths.push_back(answer->get_header_value("Location"));
    gate.open();
    const int cancelled = posted(paths.back() + "/cancel", token);
    EXPECT_TRUE(cancelled == 200 || cancelled == 409);
  }
  const auto is_active = [&](const std::string& path) {
    const std::string state = json::parse(get(path, with(admin))->body)["state"];
    return state == "queued" || state == "running";
  };
  Gate closed(executor);
  int accepted = 0;
  for (const std::string& path : paths) {
    const int status = posted(path + "/retry", token);
    EXPECT_TRUE(status == 200 || status == 429 || status == 409) << status;
    accepted += status == 200 ? 1 : 0;
  }
  EXPECT_EQ(accepted, 1);
  EXPECT_EQ(std::count_if(paths.begin(), paths.end(), is_active), 1);
  EXPECT_EQ(posted("/v1/jobs", token, kJob), 429);
  for (const std::string& path : paths) {
    if (is_active(path)) continue;
    const int status = posted(path + "/retry", admin);
    EXPECT_TRUE(status == 200 || status == 409) << "administrators may: " << status;
  }
  closed.open();
}

TEST_F(KeysTest, PrioritiesHaveALimit) {
  const std::string one = keys.create("one", Scope::submit);
  const std::string urgent = keys.create("urgent", Scope::submit, 0, 0, 10);
  const std::string admin = keys.create("admin", Scope::admin);
  Gate gate(executor);
  EXPECT_EQ(posted("/v1/jobs?priority=1", one, kJob), 403);
  EXPECT_EQ(posted("/v1/jobs?dry_run&priority=1", one, kJob), 403);
  EXPECT_EQ(posted("/v1/jobs?priority=0", one, kJob), 201);
  EXPECT_EQ(posted("/v1/jobs?priority=-100", one, kJob), 201);
  EXPECT_EQ(posted("/v1/jobs?priority=11", urgent, kJob), 403);
  EXPECT_EQ(posted("/v1/jobs?priority=10", urgent, kJob), 201);
  EXPECT_EQ(posted("/v1/jobs?priority=101", admin, kJob), 400);
  const httplib::Result high =
      client().Post("/v1/jobs?priority=100&label=shared", with(admin), kJob, "application/json");
  ASSERT_EQ(high->status, 201);
  // Nor by a copy of another key's.
  const httplib::Result copy = client().Post(high->get_header_value("Location") + "/clone",
                                             with(one), "{}", "application/json");
  ASSERT_EQ(copy->status, 201);
  EXPECT_EQ(json::parse(copy->body)["priority"], 0);
  // Nor later; what an administrator has given may stay, and may be lowered.
  const std::string path = copy->get_header_value("Location");
  const auto patched = [&](const std::string& key, const char* change) {
    return client().Patch(path, with(key), change, "application/json")->status;
  };
  EXPECT_EQ(patched(one, R"({"priority": 1})"), 403);
  EXPECT_EQ(patched(admin, R"({"priority": 50})"), 200);
  EXPECT_EQ(patched(one, R"({"labels": ["a"]})"), 200);
  EXPECT_EQ(patched(one, R"({"priority": 50})"), 200);
  EXPECT_EQ(patched(one, R"({"priority": 51})"), 403);
  EXPECT_EQ(patched(one, R"({"priority": 20})"), 200);
  EXPECT_EQ(patched(one, R"({"priority": 21})"), 403);
  gate.open();
}

TEST_F(KeysTest, KeysOfSubmissionsAreEachOwnersOwn) {
  Gate gate(executor);
  std::vector<std::string> ids;
  for (const char* name : {"one", "other"}) {
    httplib::Headers headers = with(keys.create(name, Scope::submit));
    headers.emplace("Idempotency-Key", "1");
    const httplib::Result answer = client().Post("/v1/jobs", headers, kJob, "application/json");
    ASSERT_EQ(answer->status, 201);
    ids.push_back(json::parse(answer->body)["id"]);
  }
  EXPECT_NE(ids[0], ids[1]);
  gate.open();
}

TEST_F(KeysTest, OnlyAHashIsKeptAndOnlyForItsOwner) {
  const std::string token = keys.create("me", Scope::admin);
  const std::filesystem::path file = data.path() / "keys.sqlite";
  EXPECT_EQ(read_file(file).find(token.substr(16)), std::string::npos);
  EXPECT_EQ(std::filesystem::status(file).permissions(),
            std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
}

TEST_F(KeysTest, PagesOfOtherSitesMayChangeNothing) {
  Gate gate(executor);
  const std::string path = "/v1/jobs/" + submit() + "/cancel";
  const httplib::Headers origin = {{"Origin", "https://evil.example"}};
  expect_problem(client().Post(path, origin, "", "text/plain"), 403);
  gate.open();
}

}  // namespace
}  // namespace throng::server
