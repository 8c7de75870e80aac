#include "calibrate/request.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "base/files.h"
#include "base/json_text.h"
#include "calibrate/pose.h"
#include "calibrate/residual_plot.h"
#include "calibrate/result.h"
#include "calibrate/spec/camera_file.h"

namespace throng::calibrate {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr std::array kRequestKinds = {"intrinsics", "pose", "bundle"};

[[noreturn]] void refuse(const std::string& pointer, const json& found, std::string expected) {
  throw InputError(Problem{"", pointer, found.dump(), std::move(expected)});
}

/// The member `name` of the object at `pointer`; `otherwise` when it is not there.
template <typename T>
T member(const json& object, const std::string& pointer, const char* name, T otherwise) {
  const auto found = object.find(name);
  if (found == object.end()) return otherwise;
  try {
    // A library that takes 1 for true and 0.5 for 0 has to be asked more strictly.
    const bool fits = std::is_same_v<T, bool>       ? found->is_boolean()
                      : std::is_same_v<T, int>      ? found->is_number_integer()
                      : std::is_floating_point_v<T> ? found->is_number()
                                                    : found->is_string();
    if (fits) return found->get<T>();
  } catch (const json::exception&) {
    // said below
  }
  refuse(pointer + "/" + name, *found,
         fmt::format("the input of {}: see docs/calibration.md", name));
}

/// A file of the request, which must be one of those that came with it.
fs::path file_of(const json& value, const std::string& pointer, const fs::path& folder) {
  if (value.is_string()) {
    const fs::path name = value.get<std::string>();
    const bool plain = name == name.filename() && !name.empty() && name != "." && name != "..";
    if (plain && fs::is_regular_file(folder / name)) return folder / name;
  }
  refuse(pointer, value, "the name of a file that was sent along");
}

fs::path file_member(const json& value, const char* name, const fs::path& folder) {
  const auto found = value.find(name);
  return found == value.end() ? fs::path() : file_of(*found, fmt::format("/{}", name), folder);
}

Board board_of(const json& value) {
  Board board;
  const std::string at = "/board";
  if (!value.is_object()) refuse(at, value, "an object: kind, columns, rows, square");
  board.kind = board_kind_named(member<std::string>(value, at, "kind", "chessboard"), at);
  board.columns = member(value, at, "columns", board.columns);
  board.rows = member(value, at, "rows", board.rows);
  board.square = member(value, at, "square", board.square);
  board.marker = member(value, at, "marker", board.marker);
  board.dictionary = member(value, at, "dictionary", board.dictionary);
  check_board(board, at);
  return board;
}

Wishes wishes_of(const json& value) {
  Wishes wishes;
  wishes.skew = member(value, "", "skew", false);
  const auto object = [&](const char* name) {
    const json found = value.value(name, json::object());
    if (!found.is_object()) refuse(fmt::format("/{}", name), found, "an object by parameter");
    return found;
  };
  const json fixes = object("fix");
  for (const auto& [name, fixed] : fixes.items()) {
    if (!fixed.is_null() && !fixed.is_number()) refuse("/fix/" + name, fixed, "a number or null");
    wishes.fixed[name] = fixed.is_null() ? std::nullopt : std::optional(fixed.get<double>());
  }
  const json ties = object("tie");
  for (const auto& [name, tie] : ties.items()) {
    const std::string at = "/tie/" + name;
    if (!tie.is_object()) refuse(at, tie, "an object: to, ratio");
    wishes.tied[name] = {member<std::string>(tie, at, "to", ""), member(tie, at, "ratio", 1.0)};
  }
  const json priors = object("prior");
  for (const auto& [name, prior] : priors.items()) {
    const std::string at = "/prior/" + name;
    if (!prior.is_object()) refuse(at, prior, "an object: mean, sd");
    wishes.priors[name] = {member(prior, at, "mean", 0.0), member(prior, at, "sd", 0.0)};
  }
  return wishes;
}

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

Calibration carry_out_intrinsics(const Request& request, const OnProgress& on_progress) {
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
  warn(0.9, "solving");
  return calibrate_intrinsics(all, request.options);
}

}  // namespace

Request request_from_json(const json& value, const fs::path& folder) {
  if (!value.is_object()) refuse("", value, "an object");
  static const json kFields = parse_own_json(request_schema(), "the schema").at("properties");
  for (const auto& entry : value.items()) {
    if (!kFields.contains(entry.key())) {
      refuse("/" + entry.key(), entry.value(), "no such field: see docs/calibration.md");
    }
  }
  member<std::string>(value, "", "name", "");
  Request request;
  request.kind = member<std::string>(value, "", "kind", "intrinsics");
  if (std::find(kRequestKinds.begin(), kRequestKinds.end(), request.kind) == kRequestKinds.end()) {
    refuse("/kind", request.kind, "intrinsics, pose or bundle");
  }
  const json images = value.value("images", json::array());
  if (!images.is_array()) refuse("/images", images, "a list of files");
  for (std::size_t i = 0; i < images.size(); ++i) {
    request.images.push_back(file_of(images[i], fmt::format("/images/{}", i), folder));
  }
  if (value.contains("board")) request.board = board_of(value["board"]);
  request.points = file_member(value, "points", folder);
  request.observations = file_member(value, "observations", folder);
  request.control_points = file_member(value, "gcp", folder);
  request.camera = file_member(value, "camera", folder);
  if (value.contains("size")) {
    request.size = image_size_of(member<std::string>(value, "", "size", ""), "/size");
  }
  request.fix_lens = member(value, "", "fix_lens", false);
  IntrinsicsOptions& options = request.options;
  options.source = "request";
  const std::string lens = member<std::string>(value, "", "lens", "brown5");
  options.choose_lens = lens == "auto";
  if (!options.choose_lens) options.lens = lens_named(lens, "/lens");
  options.wishes = wishes_of(value);
  options.fit.reject = member(value, "", "reject", true);
  options.fit.loss_px = member(value, "", "loss_px", 0.0);
  options.fit.outlier_px = member(value, "", "outlier_px", options.fit.outlier_px);
  if (value.contains("sigma_px")) options.fit.sigma_px = member(value, "", "sigma_px", 0.0);
  if (options.fit.sigma_px && !(*options.fit.sigma_px > 0)) {
    refuse("/sigma_px", value["sigma_px"], "a number above 0");
  }
  require_inputs(request, "request");
  return request;
}

Calibration carry_out(const Request& request, const OnProgress& on_progress) {
  const IntrinsicsOptions& options = request.options;
  require_inputs(request, options.source);
  if (request.kind == "intrinsics") return carry_out_intrinsics(request, on_progress);
  const CameraFile camera = read_camera_file(request.camera);
  const ControlPoints control = read_control_points(request.control_points);
  const std::vector<NamedPixel> pixels = read_named_pixels(request.observations);
  if (request.kind == "pose") {
    return calibrate_pose(camera, control, pixels, {options.fit, options.source});
  }
  return adjust_bundle(camera, control, pixels,
                       {options.fit, options.wishes, request.fix_lens, options.source});
}

void carry_out_in(const fs::path& folder, const OnProgress& on_progress,
                  const std::function<bool()>& should_continue) {
  const json value = parse_json(read_file(folder / "request.json"), "request.json");
  Request request = request_from_json(value, folder / "files");
  request.options.fit.should_continue = should_continue;
  const Calibration calibration = carry_out(request, on_progress);
  write_file_atomically(folder / kOpenCvName, opencv_yaml(calibration));
  write_file_atomically(folder / kRosName,
                        ros_yaml(calibration, value.value("name", std::string("camera"))));
  drawing::write_drawing(residual_plot(calibration), folder / kPlotName);
  write_file_atomically(folder / kCameraName, to_json(calibration).dump(2) + "\n");
}

}  // namespace throng::calibrate
