#include "calibration/request.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "base/files/files.h"
#include "base/graphics/images/gray_image.h"
#include "base/json/json_text.h"
#include "calibration/board.h"
#include "calibration/intrinsics.h"
#include "calibration/pose.h"
#include "calibration/residual_plot.h"
#include "calibration/result.h"
#include "spec/calibration/foreign/read_camera_file.h"

namespace throng::calibrate {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

/// Required fields of the kind that are missing.
void require_inputs(const Request& request, const std::string& source) {
  const auto require = [&](bool there, const char* expected) {
    if (!there) throw InputError(Problem{source, "", "nothing of the kind", expected});
  };
  if (request.kind == "intrinsics") {
    require(request.images.empty() != request.points.empty(),
            "either images of a board or a table of points");
    require(request.points.empty() || request.size.has_value(),
            "the size of the images that the points are of");
    return;
  }
  require(!request.observations.empty(), "a table of observed points");
  require(!request.control_points.empty(), "a table of ground control points");
  require(!request.camera.empty(), "a camera (a JSON file of throng calibrate)");
}

/// A board that is found in a few images only was probably described wrongly, and what was found is
/// a part of it. Films may have it in a small part of many images.
void require_enough_boards(const Correspondences& all, std::size_t images,
                           const std::string& source) {
  constexpr std::size_t kEnoughViews = 10;
  const std::size_t views = all.views.size();
  if (2 * views >= images || views >= kEnoughViews) return;
  std::vector<Problem> problems = {
      {source, "", fmt::format("the board in {} of {} images", views, images),
       fmt::format("it in at least half of them or in {}: check its kind, columns and rows, or "
                   "leave the other images out",
                   kEnoughViews)}};
  problems.insert(problems.end(), all.left_out.begin(), all.left_out.end());
  throw InputError(std::move(problems));
}

Calibration carry_out_intrinsics(const Request& request, const OnProgress& on_progress,
                                 const OnFound& on_found) {
  const auto warn = [&](double share, const std::string& what) {
    if (on_progress) on_progress(share, what);
  };
  Correspondences all;
  if (request.images.empty()) {
    all = read_correspondences(request.points, *request.size);
  } else {
    constexpr double kShareOfSearch = 0.9;
    const auto count = static_cast<double>(request.images.size());
    all = find_boards(request.images, request.board, [&](std::size_t done) {
      warn(kShareOfSearch * static_cast<double>(done) / count,
           fmt::format("image {} of {}", done, request.images.size()));
      return !request.options.fit.should_continue || request.options.fit.should_continue();
    });
  }
  if (on_found) on_found(all);
  if (!request.images.empty()) {
    require_enough_boards(all, request.images.size(), request.options.source);
  }
  warn(0.9, "solving");
  return calibrate_intrinsics(all, request.options);
}

/// Files are named as they were sent, not by their paths on this machine.
void name_as_sent(std::string& name, const fs::path& folder) {
  if (fs::path(name).parent_path() == folder) name = fs::path(name).filename().string();
}

template <typename Result>
Result named_as_sent(Result result, const fs::path& folder) {
  for (auto& view : result.views) name_as_sent(view.name, folder);
  for (Problem& problem : result.left_out) name_as_sent(problem.source, folder);
  return result;
}

}  // namespace

Request request_from_json(const json& value, const fs::path& folder) {
  std::vector<Problem> problems;
  Request request = read_request_fields(value, folder, problems);
  if (!problems.empty()) throw InputError(std::move(problems));
  check_board(request.board, "/board");
  require_inputs(request, "request");
  return request;
}

std::int64_t max_image_pixels(const Request& request) {
  std::int64_t most = 0;
  for (const fs::path& file : request.images) {
    if (fs::exists(file)) most = std::max(most, images::pixels_of_image(file));
  }
  return most;
}

Calibration carry_out(const Request& request, const OnProgress& on_progress,
                      const OnFound& on_found) {
  const IntrinsicsOptions& options = request.options;
  require_inputs(request, options.source);
  if (request.kind == "intrinsics") {
    return carry_out_intrinsics(request, on_progress, on_found);
  }
  const CameraFile camera = read_camera_file(request.camera);
  const ControlPoints control = read_control_points(request.control_points);
  const std::vector<NamedPixel> pixels = read_named_pixels(request.observations);
  if (request.kind == "pose") {
    return calibrate_pose(camera, control, pixels, {options.fit, options.source});
  }
  return adjust_bundle(camera, control, pixels,
                       {options.fit, options.settings, request.fix_lens, options.source});
}

void carry_out_in(const fs::path& folder, const OnProgress& on_progress,
                  const std::function<bool()>& should_continue) {
  const json value = parse_json(read_file(folder / "request.json"), "request.json");
  const fs::path files = folder / "files";
  Request request = request_from_json(value, files);
  request.options.fit.should_continue = should_continue;
  const auto write_points = [&](const json& points) {
    write_file_atomically(folder / kPointsName, points.dump() + "\n");
  };
  const OnFound on_found = [&](const Correspondences& found) {
    write_points(points_json(named_as_sent(found, files)));
  };
  const Calibration calibration = named_as_sent(carry_out(request, on_progress, on_found), files);
  write_points(points_json(calibration));
  write_file_atomically(folder / kOpenCvName, opencv_yaml(calibration));
  write_file_atomically(folder / kRosName,
                        ros_yaml(calibration, request.name.empty() ? "camera" : request.name));
  drawing::write_drawing(residual_plot(calibration), folder / kPlotName);
  write_file_atomically(folder / kCameraName, to_json(calibration).dump(2) + "\n");
}

}  // namespace throng::calibrate
