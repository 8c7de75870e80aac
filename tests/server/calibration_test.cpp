// Calibrations over HTTP: queued like jobs, and cameras for them.
#include "server/api.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "base/error.h"
#include "base/files.h"
#include "server/http.h"
#include "tests/server/service_fixture.h"

namespace throng::server {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

constexpr const char* kRoute = "/v1/calibrations";

/// Three views of a flat grid through a pinhole of 800 px, turned about x, y and both.
std::string grid_table() {
  std::ostringstream text;
  text.precision(17);
  text << "image,i,X,Y,Z,u,v\n";
  for (int view = 0; view < 3; ++view) {
    const double lean_x = view == 1 ? 0.0 : 0.5;
    const double lean_y = view == 0 ? 0.0 : 0.6;
    for (int i = 0; i < 30; ++i) {
      const double x = 0.1 * (i % 6 - 2.5);
      const double y = 0.1 * (i / 6 - 2.0);
      const double y1 = std::cos(lean_x) * y;
      const double z1 = std::sin(lean_x) * y;
      const double x2 = std::cos(lean_y) * x + std::sin(lean_y) * z1;
      const double z2 = -std::sin(lean_y) * x + std::cos(lean_y) * z1 + 1.5;
      text << 'v' << view << ',' << i << ',' << x << ',' << y << ",0," << 800 * x2 / z2 + 322 << ','
           << 800 * y1 / z2 + 237 << '\n';
    }
  }
  return text.str();
}

class CalibrationApi : public ServiceFixture {
 protected:
  CalibrationApi()
      : service(options(), executor),
        hooks(service.queue(), data.path()),
        api(service, keys, hooks, {}),
        thread([this] { api.run(); }) {}
  ~CalibrationApi() override { api.stop(); }

  httplib::Client client() const { return httplib::Client("127.0.0.1", api.port()); }
  json get_json(const std::string& path) const { return json::parse(client().Get(path)->body); }

  static json request() {
    return {{"name", "wide"}, {"points", "points.csv"}, {"size", "640x480"}, {"lens", "pinhole"}};
  }
  httplib::Result post(const json& request, const std::string& table = grid_table()) const {
    const httplib::MultipartFormDataItems items = {
        {"request", request.dump(), "", "application/json"},
        {"file", table, "points.csv", "text/csv"}};
    return client().Post(kRoute, items);
  }
  json ended(const std::string& path) const {
    EXPECT_TRUE(wait_until([&] {
      const std::string state = get_json(path)["state"];
      return state == "succeeded" || state == "failed";
    }));
    return get_json(path);
  }

  Service service;
  Keys keys{data.path()};
  WebhookSender hooks;
  Api api;
  std::jthread thread;
};

TEST_F(CalibrationApi, FromUploadToCameraToDataset) {
  SKIP_WITHOUT_PROGRAM();
  const httplib::Result answer = post(request());
  ASSERT_EQ(answer->status, 201) << answer->body;
  const json queued = json::parse(answer->body);
  const std::string self = answer->get_header_value("Location");
  EXPECT_EQ(queued["links"]["self"], self);
  EXPECT_EQ(queued["name"], "wide");
  const json done = ended(self);
  ASSERT_EQ(done["state"], "succeeded") << done.dump();
  EXPECT_NEAR(done["camera"]["fx"].get<double>(), 800, 1e-3);
  EXPECT_NEAR(done["camera"]["cx"].get<double>(), 322, 1e-3);
  EXPECT_EQ(done["progress"]["share"], 1);
  EXPECT_EQ(get_json(done["links"]["camera"])["fx"], done["camera"]["fx"]);
  const auto plot = client().Get(done["links"]["residuals"].get<std::string>());
  EXPECT_EQ(plot->get_header_value("Content-Type"), "image/svg+xml");
  EXPECT_THAT(plot->body, HasSubstr("<svg"));
  EXPECT_THAT(client().Get(done["links"]["opencv"].get<std::string>())->body,
              HasSubstr("camera_matrix"));
  EXPECT_EQ(client().Get(self + "/shoe")->status, 404);
  // It is listed among its own, and not among datasets.
  EXPECT_EQ(get_json(kRoute)["calibrations"].size(), 1U);
  EXPECT_EQ(get_json("/v1/jobs")["jobs"].size(), 0U);
  EXPECT_EQ(client().Get("/v1/jobs/" + done["id"].get<std::string>())->status, 404);
  // A job names it, and holds the camera from then on.
  const json job = {
      {"scenario", "yard"},
      {"capture", {{"to_s", 1}}},
      {"drones",
       {{{"id", "d1"}, {"start", {0, 0, 20}}, {"camera", {{"calibration", done["id"]}}}}}}};
  const auto accepted = client().Post("/v1/jobs", job.dump(), "application/json");
  ASSERT_EQ(accepted->status, 201) << accepted->body;
  const json camera = json::parse(accepted->body)["job"]["drones"][0]["camera"]["calibration"];
  EXPECT_EQ(camera["fx"], done["camera"]["fx"]);
  // Removing it takes its files along.
  EXPECT_EQ(client().Delete(self)->status, 204);
  EXPECT_EQ(client().Get(self)->status, 404);
  EXPECT_FALSE(fs::exists(service.folders().calibration_folder(done["id"])));
}

TEST_F(CalibrationApi, TextsMayComeInsideTheRequest) {
  SKIP_WITHOUT_PROGRAM();
  json body = request();
  body["files"]["points.csv"] = grid_table();
  const auto answer = client().Post(kRoute, body.dump(), "application/json");
  ASSERT_EQ(answer->status, 201) << answer->body;
  EXPECT_EQ(ended(answer->get_header_value("Location"))["state"], "succeeded");
}

TEST_F(CalibrationApi, MistakesComeBackAtOnce) {
  SKIP_WITHOUT_PROGRAM();
  json wrong = request();
  wrong["lens"] = "bottle";
  EXPECT_THAT(post(wrong)->body, HasSubstr("bottle"));
  EXPECT_EQ(post(wrong)->status, 400);
  wrong = request();
  wrong["points"] = "../jobs.sqlite";
  EXPECT_EQ(post(wrong)->status, 400);
  EXPECT_EQ(client().Post(kRoute, "{}", "application/json")->status, 400);
  EXPECT_EQ(client().Post(kRoute, "[", "application/json")->status, 400);
  EXPECT_EQ(client().Post(kRoute, "x", "text/plain")->status, 415);
  json outside = request();
  outside["files"]["../../evil"] = "text";
  EXPECT_EQ(client().Post(kRoute, outside.dump(), "application/json")->status, 400);
  EXPECT_EQ(
      client().Post(kRoute, {{"Origin", "http://evil.example"}}, "{}", "application/json")->status,
      403);
  EXPECT_EQ(get_json(kRoute)["calibrations"].size(), 0U);
  const json job = {{"scenario", "yard"},
                    {"drones", {{{"id", "d1"}, {"camera", {{"calibration", "/etc/passwd"}}}}}}};
  const auto refused = client().Post("/v1/jobs", job.dump(), "application/json");
  EXPECT_EQ(refused->status, 400);
  EXPECT_THAT(refused->body, HasSubstr("/drones/0/camera/calibration"));
}

TEST_F(CalibrationApi, FailuresSayWhy) {
  SKIP_WITHOUT_PROGRAM();
  const auto answer = post(request(), "image,i,X,Y,Z,u,v\nv0,0,0,0,0,nan,1\n");
  ASSERT_EQ(answer->status, 201);
  const std::string self = answer->get_header_value("Location");
  const json done = ended(self);
  EXPECT_EQ(done["state"], "failed");
  EXPECT_EQ(done["error"]["kind"], "input");
  EXPECT_THAT(done["error"]["problems"][0]["found"].get<std::string>(), HasSubstr("nan"));
  EXPECT_EQ(client().Get(self + "/camera")->status, 409);
}

TEST_F(CalibrationApi, OneThatWaitsCanBeCancelled) {
  Gate gate(executor);
  ASSERT_EQ(client().Post("/v1/jobs", kJob, "application/json")->status, 201);
  ASSERT_TRUE(wait_until([&] { return gate.somebody_waits(); }));
  const auto answer = post(request());
  const std::string self = answer->get_header_value("Location");
  EXPECT_EQ(get_json(self)["state"], "queued");
  EXPECT_EQ(client().Delete(self)->status, 204);
  gate.open();
  EXPECT_EQ(get_json(kRoute)["calibrations"].size(), 0U);
}

TEST(CalibrationChild, FailuresOfTheChildAreTold) {
  jobs::TemporaryFolder folder;
  const auto run = [&](std::vector<std::string> command) {
    calibrator_in_child(std::move(command))(folder.path(), [](double, const std::string&) {}, {});
  };
  run({"true"});
  EXPECT_THROW(run({"false"}), EnvironmentError);
  EXPECT_THROW(run({"/no/such/program"}), EnvironmentError);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(calibrator_in_child({"sh", "-c", "sleep 30"})(folder.path(), {}, stop.get_token()),
               Cancelled);
  SKIP_WITHOUT_PROGRAM();
  write_file_atomically(folder.path() / "request.json", R"({"kind": "guess"})");
  try {
    run({kProgram, "calibrate", "request"});
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().at(0).where, "/kind");
  }
}

TEST_F(CalibrationApi, BelongToTheKeyThatSentThem) {
  SKIP_WITHOUT_PROGRAM();
  const std::string owner = keys.create("owner", Scope::submit, 1);
  const std::string other = keys.create("other", Scope::submit);
  const std::string admin = keys.create("admin", Scope::admin);
  const auto as = [](const std::string& key) {
    return httplib::Headers{{"Authorization", "Bearer " + key}};
  };
  const httplib::MultipartFormDataItems items = {
      {"request", request().dump(), "", "application/json"},
      {"file", grid_table(), "points.csv", "text/csv"}};
  const std::string path = client().Post(kRoute, as(owner), items)->get_header_value("Location");
  const auto state = [&] {
    return json::parse(client().Get(path, as(admin))->body)["state"].get<std::string>();
  };
  ASSERT_TRUE(wait_until([&] { return state() == "succeeded"; }));
  EXPECT_EQ(json::parse(client().Get(path, as(admin))->body)["owner"], owner.substr(7, 8));
  EXPECT_EQ(client().Get(path, as(other))->status, 200);
  EXPECT_EQ(client().Delete(path, as(other))->status, 403);
  EXPECT_EQ(client().Get(path, as(owner))->status, 200);
  EXPECT_EQ(client().Delete(path, as(owner))->status, 204);
  const std::string next = client().Post(kRoute, as(owner), items)->get_header_value("Location");
  EXPECT_EQ(client().Delete(next, as(admin))->status, 204);
}

TEST_F(CalibrationApi, CountAmongTheJobsOfAKey) {
  const std::string few = keys.create("few", Scope::submit, 2);
  const httplib::Headers headers = {{"Authorization", "Bearer " + few}};
  const httplib::MultipartFormDataItems items = {
      {"request", request().dump(), "", "application/json"},
      {"file", grid_table(), "points.csv", "text/csv"}};
  Gate gate(executor);
  // The first is worked on and holds the queue.
  EXPECT_EQ(client().Post("/v1/jobs", headers, kJob, "application/json")->status, 201);
  EXPECT_EQ(client().Post(kRoute, headers, items)->status, 201);
  EXPECT_EQ(client().Post(kRoute, headers, items)->status, 429);
  EXPECT_EQ(client().Post("/v1/jobs", headers, kJob, "application/json")->status, 429);
  gate.open();
}

}  // namespace
}  // namespace throng::server
