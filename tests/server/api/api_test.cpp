#include "server/routes/api.h"

#include <gmock/gmock.h>

#include "base/error.h"
#include "base/files/files.h"
#include "base/files/hash.h"
#include "jobs/queue/trace_seal.h"
#include "spec/job/spec.h"
#include "tests/server/api_fixture.h"

namespace throng::server {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST_F(ApiTest, AJobFromSubmissionToMetrics) {
  const httplib::Result answer = client().Post("/v1/jobs", kJob, "application/json; charset=utf-8");
  ASSERT_EQ(answer->status, 201);
  const json job = json::parse(answer->body);
  const std::string self = "/v1/jobs/" + job["id"].get<std::string>();
  EXPECT_EQ(answer->get_header_value("Location"), self);
  EXPECT_EQ(job["state"], "queued");
  EXPECT_EQ(job["links"]["self"], self);
  EXPECT_EQ(job["job"]["scenario"], "yard");
  ASSERT_TRUE(wait_until([&] { return get_json(self)["state"] == "succeeded"; }));
  const json done = get_json(self);
  EXPECT_EQ(done["progress"]["frames_done"], 3);
  EXPECT_EQ(done["error"], nullptr);
  EXPECT_THAT(done["ended_at"].get<std::string>(), StartsWith("20"));
  EXPECT_EQ(get_json(done["links"]["metrics"]), json::parse(R"({"runs":[]})"));
  EXPECT_EQ(get(done["links"]["archive"])->status, 200);
  expect_problem(get(done["links"]["archive"].get<std::string>() + "?include=nothing"), 404);
  // The pretended dataset has no runs of its own.
  expect_problem(get(self + "/runs/0/metrics"), 404);
  write_file_atomically(service.folders().dataset_folder(job["id"]) / "metrics/run000.json",
                        R"({"people":3})");
  write_file_atomically(service.folders().dataset_folder(job["id"]) / "exits/run000.csv",
                        "frame\n");
  EXPECT_EQ(get_json(self + "/runs/0/metrics"), json::parse(R"({"people":3})"));
  EXPECT_EQ(get(self + "/runs/0/metrics.csv")->body, "frame\n");
  expect_problem(get(self + "/runs/1/metrics.csv"), 404);
  expect_problem(get(self + "/runs/99999999999999/metrics"), 404);
}

TEST_F(ApiTest, ARunsTraceIsSentAsSoonAsItIsThere) {
  const std::string id = submit();
  ASSERT_TRUE(wait_until([&] { return get_json("/v1/jobs/" + id)["state"] == "succeeded"; }));
  const std::string path = "/v1/jobs/" + id + "/runs/0/trace";
  expect_problem(get("/v1/jobs/" + id + "/runs/1/trace"), 404);
  const std::filesystem::path trace =
      service.folders().job_folder(id) / "work" / "run000" / "trace.h5";
  std::filesystem::remove(trace);  // a pretended worker may have written one
  expect_problem(get(path), 409);
  write_file_atomically(trace, "positions");
  jobs::seal_trace(trace);
  const httplib::Result whole = get(path);
  EXPECT_EQ(whole->body, "positions");
  EXPECT_EQ(whole->get_header_value("ETag"), '"' + sha256_hex("positions") + '"');
  EXPECT_THAT(whole->get_header_value("Content-Disposition"), HasSubstr("_run000.h5"));
  EXPECT_EQ(get(path, {{"Range", "bytes=3-5"}})->body, "iti");
}

TEST_F(ApiTest, MistakesComeBackWithTheirPointers) {
  const httplib::Result answer = client().Post(
      "/v1/jobs", R"({"scenario": "yard", "runs": 0, "colour": "red"})", "application/json");
  expect_problem(answer, 400);
  const json errors = json::parse(answer->body)["errors"];
  ASSERT_EQ(errors.size(), 2U);
  EXPECT_EQ(errors[0]["pointer"], "/colour");
  EXPECT_EQ(errors[1]["pointer"], "/runs");
  EXPECT_EQ(errors[1]["found"], "0");
  EXPECT_THAT(errors[1]["message"].get<std::string>(), HasSubstr("from 1 to 1000"));
  expect_problem(client().Post("/v1/jobs", "{", "application/json"), 400);
  expect_problem(client().Post("/v1/jobs", kJob, "text/plain"), 415);
  EXPECT_TRUE(get_json("/v1/jobs")["jobs"].empty());
}

TEST_F(ApiTest, TheListIsPagedNewestFirst) {
  std::vector<std::string> ids(5);
  for (std::string& id : ids) id = submit();
  const json first = get_json("/v1/jobs?limit=3");
  EXPECT_EQ(first["jobs"][0]["id"], ids[4]);
  EXPECT_EQ(first["next"], ids[2]);
  const json second = get_json("/v1/jobs?limit=3&after=" + ids[2]);
  EXPECT_EQ(second["jobs"].size(), 2U);
  EXPECT_EQ(second["jobs"][1]["id"], ids[0]);
  EXPECT_EQ(second["next"], nullptr);
  for (const char* query : {"limit=0", "limit=x", "limit=1000", "limit=1x", "after=../x"}) {
    expect_problem(get(fmt::format("/v1/jobs?{}", query)), 400);
  }
}

TEST_F(ApiTest, UnknownThingsAre404AndWrongMethods405) {
  for (const char* path :
       {"/v1", "/v1/job", "/v1/jobs/", "/v1/jobs/jnosuchjob000000", "/v1/jobs/..%2f..%2fetc",
        "/v1/jobs/jnosuchjob000000/archive", "/v1/jobs/jnosuchjob000000/metrics", "/v1/jobs/x/y"}) {
    expect_problem(get(path), 404);
  }
  expect_problem(client().Delete("/v1/jobs/jnosuchjob000000"), 404);
  const httplib::Result answer = client().Delete("/v1/jobs");
  expect_problem(answer, 405);
  EXPECT_EQ(answer->get_header_value("Allow"), "POST, GET, HEAD");
  expect_problem(client().Put("/v1/jobs", "{}", "application/json"), 405);
  expect_problem(client().Put("/v1/jobs/j1/runs/0/metrics.csv", "{}", "application/json"), 405);
  expect_problem(client().Put("/v1/jobs/j1/runs/x/metrics", "{}", "application/json"), 404);
  expect_problem(client().Post("/healthz", "", "application/json"), 405);
}

TEST_F(ApiTest, ResultsOfAnUnfinishedJobAreAConflict) {
  Gate gate(executor);
  const std::string id = submit();
  expect_problem(get("/v1/jobs/" + id + "/archive"), 409);
  expect_problem(get("/v1/jobs/" + id + "/metrics"), 409);
  expect_problem(get("/v1/jobs/" + id + "/report"), 409);
  gate.open();
}

TEST_F(ApiTest, ARunsFiguresAreThereOnceItWasMeasured) {
  Gate gate(executor);
  const std::string id = submit();
  ASSERT_TRUE(wait_until([&] { return gate.somebody_waits(); }));
  const std::string run = "/v1/jobs/" + id + "/runs/0";
  expect_problem(get(run + "/metrics"), 409);
  expect_problem(get("/v1/jobs/" + id + "/runs/1/metrics"), 404);
  const auto measured = service.folders().job_folder(id) / "work/run000/metrics";
  write_file_atomically(measured / "metrics/run000.json", R"({"people":3})");
  EXPECT_EQ(get_json(run + "/metrics"), json::parse(R"({"people":3})"));
  expect_problem(get(run + "/metrics.csv"), 404);  // this job did not ask for it
  gate.open();
}

TEST_F(ApiTest, AReportIsMadeOnceWhenAskedFor) {
  std::atomic<int> made = 0;
  reporter = [&](const std::filesystem::path& job, const std::filesystem::path& file,
                 const std::stop_token&) {
    ++made;
    write_file_atomically(file, "report of " + job.filename().string());
  };
  const std::string id = submit_and_wait();
  for (int i = 0; i < 2; ++i) {
    const httplib::Result page = report_of(id);
    EXPECT_EQ(page->status, 200);
    EXPECT_EQ(page->body, "report of " + id);
    EXPECT_EQ(page->get_header_value("Content-Type"), "text/html; charset=utf-8");
  }
  EXPECT_EQ(made, 1);
}

TEST_F(ApiTest, AReportThatFailsIsTriedAgain) {
  reporter = [](const auto&, const auto&, const auto&) { throw EnvironmentError("no room"); };
  const std::string id = submit_and_wait();
  const httplib::Result failed = report_of(id);
  expect_problem(failed, 503);
  EXPECT_EQ(failed->get_header_value("Retry-After"), "10");
  reporter = [](const auto&, const std::filesystem::path& file, const auto&) {
    write_file_atomically(file, "page");
  };
  EXPECT_EQ(report_of(id)->body, "page");
}

TEST_F(ApiTest, ControlCharactersInNamesAreRefused) {
  const auto refused = [&](const std::string& path, const std::string& body) {
    const httplib::Result answer = client().Post(path, body, "application/json");
    expect_problem(answer, 400);
    return json::parse(answer->body)["errors"][0]["pointer"].get<std::string>();
  };
  for (const char* name : {"a\\nb", "\\u001b[2J", "tab\\t", "del\x7f", "c1\xc2\x9b", "\\u0000"}) {
    EXPECT_EQ(refused("/v1/jobs", fmt::format(R"({{"scenario": "yard", "name": "{}"}})", name)),
              "/name")
        << name;
    EXPECT_EQ(refused("/v1/calibrations", fmt::format(R"({{"name": "{}"}})", name)), "/name")
        << name;
  }
  for (const char* label : {"a%0Ab", "%1B[2J", "%C2%9B", "%7F"}) {
    const httplib::Result answer =
        client().Post(fmt::format("/v1/jobs?label={}", label), kJob, "application/json");
    expect_problem(answer, 400);
    EXPECT_EQ(json::parse(answer->body)["errors"][0]["pointer"], "?label");
  }
  const char* sound =
      R"({"scenario": "yard", "capture": {"to_s": 2}, "name": "Zoë's “big” 群衆 <1>"})";
  EXPECT_EQ(client().Post("/v1/jobs?label=fa%C3%A7ade", sound, "application/json")->status, 201);
}

TEST_F(ApiTest, ErrorsAreSentInFullForAnyRange) {
  const httplib::Headers range = {{"Range", "bytes=0-10"}};
  expect_problem(get("/v1/jobs/jnosuchjob000000/archive", range), 404);
  expect_problem(get("/nothing", range), 404);
  const httplib::Result list = get("/v1/jobs", range);
  EXPECT_EQ(list->status, 200);
  EXPECT_TRUE(json::accept(list->body));
}

TEST_F(ApiTest, DeleteRemovesAndSaysSo) {
  const std::string id = submit_and_wait();
  EXPECT_EQ(client().Delete("/v1/jobs/" + id)->status, 204);
  expect_problem(get("/v1/jobs/" + id), 404);
  expect_problem(client().Delete("/v1/jobs/" + id), 404);
}

TEST_F(ApiTest, TheArchiveHasALengthATagAndParts) {
  const std::string path = "/v1/jobs/" + submit_and_wait() + "/archive";
  const httplib::Result whole = get(path);
  ASSERT_EQ(whole->status, 200);
  EXPECT_EQ(whole->get_header_value("Content-Length"), std::to_string(whole->body.size()));
  EXPECT_EQ(whole->get_header_value("Content-Type"), "application/x-tar");
  EXPECT_THAT(whole->get_header_value("Content-Disposition"), HasSubstr("yard.tar"));
  EXPECT_EQ(whole->body.substr(0, 9), "yard/mani");
  const std::string tag = whole->get_header_value("ETag");
  EXPECT_EQ(get(path)->body, whole->body);

  const httplib::Result part = get(path, {{"Range", "bytes=500-699"}, {"If-Range", tag}});
  ASSERT_EQ(part->status, 206);
  EXPECT_EQ(part->body, whole->body.substr(500, 200));
  EXPECT_EQ(part->get_header_value("Content-Range"),
            fmt::format("bytes 500-699/{}", whole->body.size()));
  const httplib::Result rest = get(path, {{"Range", "bytes=1000-99999999"}});
  ASSERT_EQ(rest->status, 206);
  EXPECT_EQ(rest->body, whole->body.substr(1000));
  const httplib::Result other = get(path, {{"Range", "bytes=5-6"}, {"If-Range", "\"x\""}});
  EXPECT_EQ(other->status, 200);
  EXPECT_EQ(other->body, whole->body);
  const httplib::Result past = get(path, {{"Range", "bytes=99999999-"}});
  expect_problem(past, 416);
  EXPECT_EQ(past->get_header_value("Content-Range"), fmt::format("bytes */{}", whole->body.size()));
}

TEST_F(ApiTest, UnclearLengthsAreRefused) {
  for (const char* lengths : {"Content-Length: abc\r\n", "Content-Length: -1\r\n",
                              "Content-Length: 2\r\nContent-Length: 3\r\n"}) {
    EXPECT_THAT(
        raw(fmt::format("POST /v1/jobs HTTP/1.1\r\nHost: localhost\r\n{}\r\n{{}}", lengths)),
        StartsWith("HTTP/1.1 400"));
  }
  EXPECT_EQ(get("/healthz")->status, 200);
}

TEST_F(ApiTest, WithoutALengthThereIsNoBody) {
  const std::string answers =
      raw("POST /v1/jobs/jnosuchjob000000/cancel HTTP/1.1\r\nHost: localhost\r\n\r\n"
          "GET /healthz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
  EXPECT_THAT(answers, StartsWith("HTTP/1.1 404"));
  EXPECT_THAT(answers, HasSubstr("HTTP/1.1 200"));
}

TEST_F(ApiTest, LargeBodiesAreRefused) {
  const httplib::Result answer =
      client().Post("/v1/jobs", std::string(2 << 20, ' '), "application/json");
  expect_problem(answer, 413);
}

TEST_F(ApiTest, PagesOfOtherSitesAreRefused) {
  expect_problem(get("/v1/jobs", {{"Host", "evil.example"}}), 421);
  EXPECT_EQ(get("/v1/jobs", {{"Host", "localhost:1234"}})->status, 200);
  EXPECT_EQ(get("/v1/jobs", {{"Host", "[::1]:1234"}})->status, 200);
}

TEST_F(ApiTest, SchemasOfFiles) {
  const auto names = client().Get("/v1/schemas");
  ASSERT_EQ(names->status, 200);
  const json listed = json::parse(names->body);
  for (const json& name : listed.at("schemas")) {
    const auto schema = client().Get("/v1/schemas/" + name.get<std::string>());
    ASSERT_EQ(schema->status, 200) << name;
    EXPECT_EQ(json::parse(schema->body)["type"], "object") << name;
  }
  const auto study = json::parse(client().Get("/v1/schemas/study")->body);
  EXPECT_TRUE(study.at("/definitions/crowd/properties/agents"_json_pointer).is_object());
  EXPECT_EQ(client().Get("/v1/schemas/nothing")->status, 404);
}

TEST_F(ApiTest, HealthAndSchema) {
  EXPECT_EQ(get_json("/healthz")["status"], "ok");
  EXPECT_EQ(get_json("/v1/schema"), jobs::job_schema());
  EXPECT_EQ(client().Head("/healthz")->status, 200);
}

TEST_F(ApiTest, AConnectionServesManyRequestsAndManyConnectionsAreServed) {
  std::vector<std::jthread> clients(16);
  for (std::jthread& thread_of_client : clients) {
    thread_of_client = std::jthread([this] {
      HttpClient kept = client();
      kept.set_keep_alive(true);
      for (int request = 0; request < 20; ++request) EXPECT_EQ(kept.Get("/healthz")->status, 200);
    });
  }
}

TEST_F(ApiTest, APortIsServedOnce) {
  EXPECT_THROW(Api(service, keys, hooks, {"127.0.0.1", api.port()}), EnvironmentError);
}

}  // namespace
}  // namespace throng::server
