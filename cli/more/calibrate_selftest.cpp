// throng calibrate selftest: renders a board through a distorting camera, calibrates from those
// images, and compares with the truth.
#include <fmt/core.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "annotate/rasters/png.h"
#include "base/error.h"
#include "base/files/files.h"
#include "base/graphics/drawing/drawing.h"
#include "base/graphics/images/gray_image.h"
#include "calibration/board.h"
#include "calibration/intrinsics.h"
#include "calibration/residual_plot.h"
#include "calibration/result.h"
#include "cli/more/board_scene.h"
#include "cli/more/more_commands.h"
#include "cli/shell/interrupt.h"
#include "cli/shell/progress_bar.h"
#include "render/lens/lens.h"
#include "render/renderer.h"
#include "skinning/population.h"
#include "spec/calibration/foreign/read_camera_file.h"

namespace throng::cli {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Tolerances.
constexpr double kMaxFocalError = 1e-3;  // of the focal length
constexpr double kMaxCenterErrorPx = 0.5;
constexpr double kMaxRmsPx = 0.2;
constexpr double kMaxTruthErrorPx = 0.05;

struct SelftestArguments {
  std::string camera;
  int views = 30;
  std::uint64_t seed = 1;
  std::string device = "auto";
  std::string people = skinning::population_folder().string();
  std::string images;
  std::string output;
  std::string plot;
};

/// A wide camera with clear barrel distortion and its axis off the middle.
calibrate::CameraFile usual_camera() {
  return {calibrate::Lens::brown5,
          {900, 897, 642.3, 356.1, 0, -0.25, 0.08, 0.0006, -0.0004, -0.01},
          {1280, 720}};
}

/// A folder for the board's mesh that ends with the test.
class WorkFolder {
 public:
  WorkFolder() : path_(fs::temp_directory_path() / fmt::format("throng-selftest-{}", ::getpid())) {
    fs::create_directories(path_);
  }
  ~WorkFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

images::GrayImage to_gray(const render::Frame& frame) {
  images::GrayImage image{frame.width(), frame.camera.intrinsics.height, {}};
  constexpr double kRed = 0.299;  // as cameras' JPEG files weigh them
  constexpr double kGreen = 0.587;
  constexpr double kBlue = 0.114;
  for (std::size_t i = 0; i + 2 < frame.rgb.size(); i += 3) {
    image.pixels.push_back(static_cast<std::uint8_t>(
        std::lround(kRed * frame.rgb[i] + kGreen * frame.rgb[i + 1] + kBlue * frame.rgb[i + 2])));
  }
  return image;
}

/// How far the corners that were found are from where the true camera shows them: the mean of the
/// differences, in which the noise of single corners cancels.
class TruthError {
 public:
  void add(const calibrate::View& view, const camera::Camera& camera,
           const std::vector<Eigen::Vector3d>& corners) {
    for (const Eigen::Vector2d& found : view.pixels) {
      Eigen::Vector2d nearest = Eigen::Vector2d::Constant(INFINITY);
      for (const Eigen::Vector3d& corner : corners) {
        const Eigen::Vector2d off = found - camera.project(corner).pixel;
        if (off.norm() < nearest.norm()) nearest = off;
      }
      sum_ += nearest;
      squares_ += nearest.squaredNorm();
      ++count_;
    }
  }
  double mean_px() const { return (sum_ / count_).norm(); }
  double rms_px() const { return std::sqrt(squares_ / count_); }

 private:
  Eigen::Vector2d sum_ = Eigen::Vector2d::Zero();
  double squares_ = 0;
  double count_ = 0;
};

struct Photographs {
  calibrate::Correspondences all;
  TruthError truth;
  std::string device;
};

Photographs photograph(const SelftestArguments& arguments, const calibrate::CameraFile& truth,
                       const calibrate::Board& board) {
  const Interrupt interrupt;
  ProgressBar bar("rendering the board");
  const WorkFolder work;
  const world::Scenario scenario = board_place(work.path(), board);
  const skinning::Population people = skinning::load_population(arguments.people);
  render::Environment light;
  light.weather = render::Weather::overcast;
  render::Renderer renderer(scenario, people, light, {arguments.device},
                            {.quality = render::Quality::high});
  render::Lens lens(renderer, people);
  Photographs result;
  result.all.size = truth.size;
  result.device = renderer.device_description();
  const std::vector<camera::Pose> poses =
      board_views(truth, board, arguments.views, arguments.seed);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (interrupt.token().stop_requested()) throw Cancelled();
    const camera::Camera camera{truth.intrinsics(), poses[i]};
    const render::Frame frame = lens.draw({}, camera);
    const std::string name = fmt::format("view{:02}", i);
    const images::GrayImage gray = to_gray(frame);
    if (!arguments.images.empty()) {
      write_file_atomically(fs::path(arguments.images) / (name + ".png"),
                            annotate::png_bytes({gray.width, gray.height, 1}, gray.pixels));
    }
    auto found = calibrate::find_board(gray, board, name);
    if (const auto* problem = std::get_if<Problem>(&found)) {
      result.all.left_out.push_back(*problem);
    } else {
      result.truth.add(std::get<calibrate::View>(found), camera, board_corners_in_world(board));
      result.all.views.push_back(std::get<calibrate::View>(std::move(found)));
    }
    bar.show(static_cast<double>(i + 1) / static_cast<double>(poses.size()), name);
  }
  return result;
}

json comparison(const calibrate::CameraFile& truth, const calibrate::Calibration& found,
                const TruthError& truth_error) {
  json checks = json::array();
  const auto check_max = [&](const std::string& what, double value, double limit) {
    checks.push_back(
        {{"check", what}, {"value", value}, {"most", limit}, {"holds", value <= limit}});
  };
  const auto off = [&](std::size_t place) {
    return std::abs(found.parameters.at(place) - truth.parameters.at(place));
  };
  check_max("fx, share", off(calibrate::kFx) / truth.parameters[calibrate::kFx], kMaxFocalError);
  check_max("fy, share", off(calibrate::kFy) / truth.parameters[calibrate::kFy], kMaxFocalError);
  check_max("cx, px", off(calibrate::kCx), kMaxCenterErrorPx);
  check_max("cy, px", off(calibrate::kCy), kMaxCenterErrorPx);
  check_max("RMS, px", found.rms_px, kMaxRmsPx);
  check_max("corners against the ground truth, mean, px", truth_error.mean_px(), kMaxTruthErrorPx);
  return checks;
}

void selftest(const SelftestArguments& arguments) {
  const calibrate::CameraFile truth =
      arguments.camera.empty() ? usual_camera() : calibrate::read_camera_file(arguments.camera);
  calibrate::Board board;
  board.columns = 12;
  board.rows = 9;
  board.square = kBoardSquareM;
  const Photographs photographs = photograph(arguments, truth, board);
  calibrate::IntrinsicsOptions options;
  options.lens = truth.lens;
  options.settings.skew = truth.parameters[calibrate::kSkew] != 0;
  options.source = "throng calibrate selftest";
  const calibrate::Calibration found = calibrate::calibrate_intrinsics(photographs.all, options);
  const json checks = comparison(truth, found, photographs.truth);
  fmt::print("{}", calibrate::summary(found));
  bool all_hold = true;
  for (const json& entry : checks) {
    const bool holds = entry.at("holds");
    all_hold = all_hold && holds;
    fmt::print("{:<6} {}: {:.5f} (at most {})\n", holds ? "ok" : "FAILED",
               entry.at("check").get<std::string>(), entry.at("value").get<double>(),
               entry.at("most").get<double>());
  }
  if (!arguments.output.empty()) {
    const json report = {{"truth", calibrate::to_json(truth)},
                         {"found", calibrate::to_json(found)},
                         {"checks", checks},
                         {"corner_rms_px", photographs.truth.rms_px()},
                         {"device", photographs.device}};
    write_file_atomically(arguments.output, report.dump(2) + "\n");
  }
  if (!arguments.plot.empty()) {
    drawing::write_drawing(calibrate::residual_plot(found), arguments.plot);
  }
  if (!all_hold) throw EnvironmentError("the calibration differs from the camera that rendered");
}

}  // namespace

void add_calibrate_selftest(CLI::App& calibrate) {
  auto* command = calibrate.add_subcommand(
      "selftest", "Render a board through a lens, calibrate from the images, compare");
  const auto arguments = std::make_shared<SelftestArguments>();
  command->add_option(
      "--camera", arguments->camera,
      "Camera JSON to render with; default: a wide-angle lens with barrel distortion");
  command->add_option("--views", arguments->views, "Number of images of the board")
      ->check(CLI::Range(3, 200))
      ->capture_default_str();
  command->add_option("--seed", arguments->seed, "Seed of the camera positions")
      ->capture_default_str();
  command->add_option("--device", arguments->device, "auto, gpu or software")
      ->check(CLI::IsMember({"auto", "gpu", "software"}))
      ->capture_default_str();
  command->add_option("--people", arguments->people, "Folder of the character library")
      ->capture_default_str();
  command->add_option("--images", arguments->images, "Folder to keep the images in (PNG)");
  command->add_option("-o,--output", arguments->output, "JSON report to write");
  command->add_option("--plot", arguments->plot,
                      "Also plot residuals and coverage (.svg, .png or .pdf)");
  command->callback([arguments] { selftest(*arguments); });
}

}  // namespace throng::cli
