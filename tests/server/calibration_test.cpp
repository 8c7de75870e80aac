// Calibrations over HTTP: queued like jobs, and cameras for them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <signal.h>
#include <zlib.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/error.h"
#include "base/files/files.h"
#include "base/files/hash.h"
#include "jobs/queue/confine/file_fence.h"
#include "spec/calibration/request_files.h"
#include "tests/server/api_fixture.h"

namespace throng::server {
namespace {

namespace fs = std::filesystem;
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
      const int row = i / 6;
      const double x = 0.1 * (i % 6 - 2.5);
      const double y = 0.1 * (row - 2.0);
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

std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (const unsigned int shift : {24U, 16U, 8U, 0U}) {
    bytes += static_cast<char>((value >> shift) & 0xFFU);
  }
  return bytes;
}

std::string png_chunk(const std::string& type_and_data) {
  return big_endian(static_cast<std::uint32_t>(type_and_data.size() - 4)) + type_and_data +
         big_endian(crc32(type_and_data));
}

/// A gray image of 480 x 360 px with a chessboard of 10 x 7 squares of 40 px.
std::string chessboard_png() {
  constexpr int kWidth = 480;
  constexpr int kHeight = 360;
  std::string rows;
  for (int y = 0; y < kHeight; ++y) {
    rows += '\0';  // no filter
    for (int x = 0; x < kWidth; ++x) {
      const bool is_board = x >= 40 && x < 440 && y >= 40 && y < 320;
      rows += is_board && (x / 40 + y / 40) % 2 == 0 ? '\x10' : '\xf0';
    }
  }
  uLongf size = ::compressBound(static_cast<uLong>(rows.size()));
  std::string packed(size, '\0');
  ::compress(reinterpret_cast<Bytef*>(packed.data()), &size,
             reinterpret_cast<const Bytef*>(rows.data()), static_cast<uLong>(rows.size()));
  packed.resize(size);
  const std::string head =
      "IHDR" + big_endian(kWidth) + big_endian(kHeight) + std::string("\x08\x00\x00\x00\x00", 5);
  return "\x89PNG\r\n\x1a\n" + png_chunk(head) + png_chunk("IDAT" + packed) + png_chunk("IEND");
}

class CalibrationApi : public ApiTest {
 protected:
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
  const json points = get_json(done["links"]["points"]);
  ASSERT_EQ(points["views"].size(), 3U);
  EXPECT_EQ(points["width"], 640);
  EXPECT_EQ(points["views"][0]["points"].size(), 30U);
  EXPECT_NEAR(points["views"][0]["points"][0]["residual_px"][0].get<double>(), 0, 1e-3);
  EXPECT_EQ(points["views"][0]["points"][0]["used"], true);
  EXPECT_EQ(client().Get(self + "/images/points.csv")->status, 404) << "it is no image";
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

TEST_F(CalibrationApi, ImagesAndTheirCornersCanBeFetchedEvenWhenNothingIsEstimated) {
  SKIP_WITHOUT_PROGRAM();
  const std::string board = chessboard_png();
  const json asked = {{"images", {"board 1.png"}}, {"board", {{"columns", 9}, {"rows", 6}}}};
  const httplib::MultipartFormDataItems items = {{"request", asked.dump(), "", "application/json"},
                                                 {"file", board, "board 1.png", "image/png"},
                                                 {"file", "secret", "other.png", "image/png"}};
  const auto answer = client().Post(kRoute, items);
  ASSERT_EQ(answer->status, 201) << answer->body;
  const std::string self = answer->get_header_value("Location");
  EXPECT_EQ(ended(self)["state"], "failed") << "one view";
  const json points = get_json(self + "/points");
  ASSERT_EQ(points["views"].size(), 1U);
  EXPECT_EQ(points["views"][0]["image"], "board 1.png") << "not its path on the server";
  EXPECT_EQ(points["views"][0]["points"].size(), 54U);
  EXPECT_EQ(points["views"][0]["points"][0]["residual_px"], nullptr);
  const auto image = client().Get(self + "/images/board%201.png");
  EXPECT_EQ(image->get_header_value("Content-Type"), "image/png");
  EXPECT_EQ(image->body, board);
  for (const char* name : {"other.png", "..%2frequest.json", "nothing.png"}) {
    EXPECT_EQ(client().Get(self + "/images/" + name)->status, 404) << name;
  }
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

/// The processes that work on a folder.
std::vector<pid_t> list_workers(const fs::path& folder) {
  std::vector<pid_t> found;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    std::ifstream file(entry.path() / "cmdline", std::ios::binary);
    std::string line;
    std::getline(file, line);  // nothing of a process that has ended
    if (line.find("worker") == std::string::npos) continue;
    if (line.find(folder.string()) == std::string::npos) continue;
    found.push_back(std::stoi(entry.path().filename()));
  }
  return found;
}

std::string find_line(const fs::path& file, const std::string& beginning) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with(beginning)) return line;
  }
  return "";
}

/// A calibration whose first worker stands still before it begins.
class SlowCalibration : public CalibrationApi {
 protected:
  SlowCalibration() { ::setenv("THRONG_FAULTS", "hang:calibration:1", 1); }
  ~SlowCalibration() override { ::unsetenv("THRONG_FAULTS"); }

  /// Queues one and waits for its worker.
  pid_t begin() {
    self = post(request())->get_header_value("Location");
    folder = service.folders().calibration_folder(fs::path(self).filename());
    std::vector<pid_t> workers;
    EXPECT_TRUE(wait_until([&] {
      workers = list_workers(folder);
      // Its log is begun once it has limited itself.
      return workers.size() == 1 && fs::exists(folder / "logs/calibration.log") &&
             fs::file_size(folder / "logs/calibration.log") > 0;
    }));
    return workers.empty() ? -1 : workers[0];
  }

  std::string self;
  fs::path folder;
};

TEST_F(SlowCalibration, IsLimitedLikeTheWorkersOfJobs) {
  SKIP_WITHOUT_PROGRAM();
  const fs::path process = fs::path("/proc") / std::to_string(begin());
  EXPECT_EQ(find_line(process / "status", "Seccomp:"), "Seccomp:\t2");
  EXPECT_THAT(find_line(process / "limits", "Max core file size"), HasSubstr(" 0 "));
}

TEST_F(CalibrationApi, AWorkerReadsNothingElseOfTheDataFolder) {
  SKIP_WITHOUT_PROGRAM();
  write_file_atomically(data.path() / "other.csv", grid_table());
  const fs::path folder = data.path() / "calibrations/x";
  write_file_atomically(folder / "request.json", request().dump());
  fs::create_directories(folder / "files");
  fs::create_symlink(data.path() / "other.csv", folder / "files/points.csv");
  const auto outcome = [&] {
    const std::array tasks = {jobs::Task{jobs::Task::Kind::calibrate}};
    jobs::LocalProcesses quick({.command = {kProgram, "worker"}, .attempts = 1});
    return quick.run(jobs::JobFolder(folder), tasks, {}, {}).at(0);
  };
  EXPECT_EQ(outcome().outcome, jobs::Outcome::succeeded);
  fs::remove(folder / calibrate::kCameraName);
  ::setenv(jobs::kPrivateFolderVariable, data.path().c_str(), 1);
  const jobs::TaskResult hidden = outcome();
  ::unsetenv(jobs::kPrivateFolderVariable);
  const bool has_landlock =
      read_file(folder / "logs/calibration.log").find("limit files") == std::string::npos;
  if (!has_landlock) GTEST_SKIP() << "no Landlock";
  EXPECT_NE(hidden.outcome, jobs::Outcome::succeeded);
  EXPECT_FALSE(fs::exists(folder / calibrate::kCameraName));
}

TEST_F(SlowCalibration, OneThatIsKilledIsTriedAgain) {
  SKIP_WITHOUT_PROGRAM();
  ASSERT_EQ(::kill(begin(), SIGKILL), 0);
  EXPECT_EQ(ended(self)["state"], "succeeded");
}

TEST_F(SlowCalibration, EndsWithItsCancellation) {
  SKIP_WITHOUT_PROGRAM();
  begin();
  EXPECT_EQ(client().Delete(self)->status, 204);
  EXPECT_TRUE(list_workers(folder).empty());
  EXPECT_FALSE(fs::exists(folder));
}

/// The beginning of a black-and-white PNG file: what it will unpack to is known from that.
std::string head_of_png(std::uint32_t width, std::uint32_t height) {
  using namespace std::string_literals;
  const std::string header = "IHDR" + big_endian(width) + big_endian(height) + "\1\0\0\0\0"s;
  return "\x89PNG\r\n\x1a\n" + big_endian(13) + header + big_endian(crc32(header)) +
         big_endian(1000) + "IDAT";
}

TEST_F(CalibrationApi, ImagesOfTooManyPixelsAreRefusedUnread) {
  SKIP_WITHOUT_PROGRAM();
  const std::string png = head_of_png(25000, 25000);
  const json board = {{"images", {"a.png"}}, {"board", {{"columns", 7}, {"rows", 5}}}};
  const httplib::MultipartFormDataItems items = {{"request", board.dump(), "", "application/json"},
                                                 {"file", png, "a.png", "image/png"}};
  const httplib::Result answer = client().Post(kRoute, items);
  ASSERT_EQ(answer->status, 400) << answer->body;
  EXPECT_THAT(answer->body, HasSubstr("25000 x 25000 pixels"));
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
  EXPECT_EQ(client().Get(path, as(other))->status, 404);
  EXPECT_EQ(client().Delete(path, as(other))->status, 404);
  EXPECT_EQ(client().Get(path, as(owner))->status, 200);
  const json job = {{"scenario", "yard"},
                    {"drones",
                     {{{"id", "d1"},
                       {"start", {0, 0, 12}},
                       {"camera", {{"calibration", path.substr(path.rfind('/') + 1)}}}}}}};
  for (const char* query : {"?dry_run", ""}) {
    const std::string route = std::string("/v1/jobs") + query;
    EXPECT_EQ(client().Post(route, as(other), job.dump(), "application/json")->status, 400);
  }
  EXPECT_LT(client().Post("/v1/jobs?dry_run", as(owner), job.dump(), "application/json")->status,
            300);
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
