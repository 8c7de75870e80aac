#include "camera/calibration/request.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/files/files.h"
#include "base/graphics/images/gray_image.h"
#include "base/json/field_table.h"
#include "base/json/json_describe.h"
#include "base/json/json_text.h"
#include "camera/calibration/pose.h"
#include "camera/calibration/residual_plot.h"
#include "camera/calibration/result.h"
#include "spec/calibration/foreign/read_camera_file.h"

namespace throng::calibrate {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr std::array kRequestKinds = {"intrinsics", "pose", "bundle"};

using fields::at;
using fields::FieldLocation;
using fields::FieldTable;
using fields::raw;

/// A request, and where its files lie.
struct ReadRequest {
  Request request;
  fs::path folder;
};

/// A file of the request, which must be one of those that came with it.
fs::path resolve_path(const json& value, const fs::path& folder, const FieldLocation& place) {
  if (value.is_string()) {
    const fs::path name = value.get<std::string>();
    const bool plain = name == name.filename() && !name.empty() && name != "." && name != "..";
    if (plain && fs::is_regular_file(folder / name)) return folder / name;
  }
  place.problems.push_back(
      {place.source, place.pointer, describe(value), "the name of a file that was sent along"});
  return {};
}

/// Runs a reader that throws; its problems are the field's.
template <typename Read>
void collect(const FieldLocation& place, const Read& read) {
  try {
    read();
  } catch (const InputError& error) {
    place.problems.insert(place.problems.end(), error.problems().begin(), error.problems().end());
  }
}

fields::Values text() { return raw({{"type", "string"}}); }
fields::Values number() { return raw({{"type", "number"}}); }
fields::Values number_above_0() { return raw({{"type", "number"}, {"exclusiveMinimum", 0}}); }
fields::Values number_from_0() { return raw({{"type", "number"}, {"minimum", 0}}); }

void add_file(FieldTable<ReadRequest>& table, const char* path, fs::path Request::*member) {
  table.add_read(path, text(),
                 [member](ReadRequest& read, const json& value, const FieldLocation& place) {
                   read.request.*member = resolve_path(value, read.folder, place);
                 });
}

FieldTable<Board> make_board_fields() {
  FieldTable<Board> table;
  table.add_read("kind", fields::one_of_words(std::array{"chessboard", "charuco", "circles"}),
                 [](Board& board, const json& value, const FieldLocation& place) {
                   board.kind = board_kind_named(value.get<std::string>(), place.pointer);
                 });
  table.add("columns", "", "", fields::integers(3, 100), at(&Board::columns), "");
  table.add("rows", "", "", fields::integers(3, 100), at(&Board::rows), "");
  table.add("square", "", "", number_above_0(), at(&Board::square), "");
  table.add("marker", "", "", number_from_0(), at(&Board::marker), "");
  table.add("dictionary", "", "", text(), at(&Board::dictionary), "");
  return table;
}

void set_board(ReadRequest& read, const json& value, const FieldLocation& place) {
  static const FieldTable<Board> table = make_board_fields();
  const std::size_t before = place.problems.size();
  table.read_checked(value, read.request.board, place);
  if (place.problems.size() > before) return;
  collect(place, [&] { check_board(read.request.board, place.pointer); });
}

void set_images(ReadRequest& read, const json& value, const FieldLocation& place) {
  for (std::size_t i = 0; i < value.size(); ++i) {
    read.request.images.push_back(
        resolve_path(value[i], read.folder, place.below(std::to_string(i))));
  }
}

Wishes& wishes_in(ReadRequest& read) { return read.request.options.wishes; }

void set_fixed(ReadRequest& read, const json& value, const FieldLocation& place) {
  for (const auto& [name, fixed] : value.items()) {
    if (fixed.is_null() || fixed.is_number()) {
      wishes_in(read).fixed[name] =
          fixed.is_null() ? std::nullopt : std::optional(fixed.get<double>());
    } else {
      place.problems.push_back(
          {place.source, place.below(name).pointer, describe(fixed), "a number or null"});
    }
  }
}

void set_ties(ReadRequest& read, const json& value, const FieldLocation& place) {
  static const FieldTable<Tie> table = [] {
    FieldTable<Tie> fields;
    fields.add("to", "", "", text(), at(&Tie::to), "").required();
    fields.add("ratio", "", "", number(), at(&Tie::ratio), "");
    return fields;
  }();
  for (const auto& [name, tie] : value.items()) {
    table.read_checked(tie, wishes_in(read).tied[name], place.below(name));
  }
}

void set_priors(ReadRequest& read, const json& value, const FieldLocation& place) {
  static const FieldTable<Prior> table = [] {
    FieldTable<Prior> fields;
    fields.add("mean", "", "", number(), at(&Prior::mean), "").required();
    fields.add("sd", "", "", number_above_0(), at(&Prior::sd), "").required();
    return fields;
  }();
  for (const auto& [name, prior] : value.items()) {
    table.read_checked(prior, wishes_in(read).priors[name], place.below(name));
  }
}

void set_lens(ReadRequest& read, const json& value, const FieldLocation& place) {
  IntrinsicsOptions& options = read.request.options;
  options.choose_lens = value == "auto";
  if (options.choose_lens) return;
  options.lens = lens_named(value.get<std::string>(), place.pointer);
}

void add_inputs(FieldTable<ReadRequest>& table) {
  table.add_read("name", text(), [](ReadRequest&, const json&, const FieldLocation&) {});
  table.add("kind", "", "", fields::one_of_words(kRequestKinds),
            at(&ReadRequest::request, &Request::kind), "");
  table.add_read("images", raw({{"type", "array"}}, "a list of files"), set_images);
  table.add_read("board", raw({{"type", "object"}}, "an object: kind, columns, rows, square"),
                 set_board);
  add_file(table, "points", &Request::points);
  add_file(table, "observations", &Request::observations);
  add_file(table, "gcp", &Request::control_points);
  add_file(table, "camera", &Request::camera);
  table.add_read("size", text(),
                 [](ReadRequest& read, const json& value, const FieldLocation& place) {
                   collect(place, [&] {
                     read.request.size = parse_image_size(value.get<std::string>(), place.pointer);
                   });
                 });
}

void add_options(FieldTable<ReadRequest>& table) {
  const auto by_parameter = [] { return raw({{"type", "object"}}, "an object by parameter"); };
  const auto fit = [](auto member) {
    return at(&ReadRequest::request, &Request::options, &IntrinsicsOptions::fit, member);
  };
  std::vector<std::string> lenses{"auto"};
  for (const Lens lens : kLenses) lenses.emplace_back(to_string(lens));
  table.add_read("lens", fields::one_of_words(lenses), set_lens);
  table.add("fix_lens", "", "", fields::booleans(), at(&ReadRequest::request, &Request::fix_lens),
            "");
  table.add("skew", "", "", fields::booleans(),
            at(&ReadRequest::request, &Request::options, &IntrinsicsOptions::wishes, &Wishes::skew),
            "");
  table.add_read("fix", by_parameter(), set_fixed);
  table.add_read("tie", by_parameter(), set_ties);
  table.add_read("prior", by_parameter(), set_priors);
  table.add("reject", "", "", fields::booleans(), fit(&FitOptions::reject), "");
  table.add("outlier_px", "", "px", number_from_0(), fit(&FitOptions::outlier_px), "");
  table.add("loss_px", "", "px", number_from_0(), fit(&FitOptions::loss_px), "");
  table.add("sigma_px", "", "px", number_above_0(), fit(&FitOptions::sigma_px), "");
}

const FieldTable<ReadRequest>& request_fields() {
  static const FieldTable<ReadRequest> table = [] {
    FieldTable<ReadRequest> fields;
    add_inputs(fields);
    add_options(fields);
    return fields;
  }();
  return table;
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
  ReadRequest read;
  read.folder = folder;
  IntrinsicsOptions& options = read.request.options;
  options.source = "request";
  options.lens = Lens::brown5;
  options.fit.reject = true;
  options.fit.loss_px = 0;
  const std::string no_source;
  std::vector<Problem> problems;
  request_fields().read_checked(value, read, {"", no_source, problems});
  if (!problems.empty()) throw InputError(std::move(problems));
  require_inputs(read.request, "request");
  return std::move(read.request);
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
                       {options.fit, options.wishes, request.fix_lens, options.source});
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
                        ros_yaml(calibration, value.value("name", std::string("camera"))));
  drawing::write_drawing(residual_plot(calibration), folder / kPlotName);
  write_file_atomically(folder / kCameraName, to_json(calibration).dump(2) + "\n");
}

}  // namespace throng::calibrate
