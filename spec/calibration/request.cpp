#include "spec/calibration/request.h"

#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/error.h"
#include "base/json/field_table.h"
#include "base/json/json_describe.h"

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
  place.reject(describe(value), "the name of a file that was sent along");
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

/// Objects by the names of parameters, whose values have a schema.
fields::Values by_parameter(nlohmann::ordered_json values) {
  return raw({{"type", "object"}, {"additionalProperties", std::move(values)}},
             "an object by parameter");
}
nlohmann::ordered_json object_schema(nlohmann::ordered_json fields) {
  fields["type"] = "object";
  return fields;
}

void add_file(FieldTable<ReadRequest>& table, const char* path, fs::path Request::*member,
              const char* help) {
  table.add_read(
      path, text(),
      [member](ReadRequest& read, const json& value, const FieldLocation& place) {
        read.request.*member = resolve_path(value, read.folder, place);
      },
      help);
}

const FieldTable<Board>& board_fields() {
  static const FieldTable<Board> table = [] {
    FieldTable<Board> fields;
    fields.add_word("kind", "", kBoardKinds, at(&Board::kind), "Kind of board.");
    fields.add("columns", "", "", fields::integers(kMinBoardSide, kMaxBoardSide),
               at(&Board::columns),
               "Inner corners of a chessboard, squares of a ChArUco board, circles of a grid.");
    fields.add("rows", "", "", fields::integers(kMinBoardSide, kMaxBoardSide), at(&Board::rows),
               "As the columns.");
    fields.add("square", "", "", number_above_0(), at(&Board::square),
               "Side of a square; of circles half the distance between two of a row. Its unit is "
               "that of the translations.");
    fields.add("marker", "", "", number_from_0(), at(&Board::marker),
               "Side of a ChArUco marker; 0: 0.75 squares.");
    fields.add("dictionary", "", "", fields::one_of_words(kDictionaries), at(&Board::dictionary),
               "ChArUco: OpenCV's name without DICT_.");
    return fields;
  }();
  return table;
}

const FieldTable<Tie>& tie_fields() {
  static const FieldTable<Tie> table = [] {
    FieldTable<Tie> fields;
    fields.add("to", "", "", text(), at(&Tie::to), "The other parameter.").required();
    fields.add("ratio", "", "", number(), at(&Tie::ratio), "The parameter by the other one.");
    return fields;
  }();
  return table;
}

const FieldTable<Prior>& prior_fields() {
  static const FieldTable<Prior> table = [] {
    FieldTable<Prior> fields;
    fields.add("mean", "", "", number(), at(&Prior::mean), "The expected value.").required();
    fields.add("sd", "", "", number_above_0(), at(&Prior::sd), "The standard deviation.")
        .required();
    return fields;
  }();
  return table;
}

void set_board(ReadRequest& read, const json& value, const FieldLocation& place) {
  board_fields().read_checked(value, read.request.board, place);
}

void set_images(ReadRequest& read, const json& value, const FieldLocation& place) {
  for (std::size_t i = 0; i < value.size(); ++i) {
    read.request.images.push_back(resolve_path(value[i], read.folder, place.below(i)));
  }
}

ParameterSettings& settings_in(ReadRequest& read) { return read.request.options.settings; }

void set_fixed(ReadRequest& read, const json& value, const FieldLocation& place) {
  for (const auto& [name, fixed] : value.items()) {
    if (fixed.is_null() || fixed.is_number()) {
      settings_in(read).fixed[name] =
          fixed.is_null() ? std::nullopt : std::optional(fixed.get<double>());
    } else {
      place.below(name).reject(describe(fixed), "a number or null");
    }
  }
}

void set_ties(ReadRequest& read, const json& value, const FieldLocation& place) {
  for (const auto& [name, tie] : value.items()) {
    tie_fields().read_checked(tie, settings_in(read).tied[name], place.below(name));
  }
}

void set_priors(ReadRequest& read, const json& value, const FieldLocation& place) {
  for (const auto& [name, prior] : value.items()) {
    prior_fields().read_checked(prior, settings_in(read).priors[name], place.below(name));
  }
}

void set_lens(ReadRequest& read, const json& value, const FieldLocation& place) {
  IntrinsicsOptions& options = read.request.options;
  options.choose_lens = value == "auto";
  if (options.choose_lens) return;
  options.lens = lens_named(value.get<std::string>(), place.pointer);
}

void set_size(ReadRequest& read, const json& value, const FieldLocation& place) {
  collect(place,
          [&] { read.request.size = parse_image_size(value.get<std::string>(), place.pointer); });
}

void add_inputs(FieldTable<ReadRequest>& table) {
  table.add("kind", "", "", fields::one_of_words(kRequestKinds),
            at(&ReadRequest::request, &Request::kind), "Kind of calibration.");
  table.add("name", "", "", text(), at(&ReadRequest::request, &Request::name),
            "Name for people, and of the camera in the file for ROS.");
  table.add_read("images",
                 raw({{"type", "array"}, {"items", {{"type", "string"}}}}, "a list of files"),
                 set_images, "Images of a board (intrinsics).");
  fields::Values board = fields::object_with(board_fields().schema());
  board.expected = "an object: kind, columns, rows, square";
  table.add_read("board", std::move(board), set_board, "The board in the images.");
  add_file(table, "points", &Request::points, "Instead of images, a table: image,i,X,Y,Z,u,v.");
  table.add_read("size", fields::texts_like("^[0-9]+x[0-9]+$", "a size as 1920x1080"), set_size,
                 "Size of the images to which the table refers: 1920x1080.");
  add_file(table, "observations", &Request::observations, "pose, bundle: a table image,point,u,v.");
  add_file(table, "gcp", &Request::control_points,
           "pose, bundle: ground control points, a table point,X,Y,Z[,sd].");
  add_file(table, "camera", &Request::camera, "pose: the lens; bundle: its initial values.");
}

void add_lens(FieldTable<ReadRequest>& table) {
  std::vector<std::string> lenses{"auto"};
  for (const Lens lens : kLenses) lenses.emplace_back(to_string(lens));
  table.add("fix_lens", "", "", fields::booleans(), at(&ReadRequest::request, &Request::fix_lens),
            "bundle: the lens stays as it is.");
  table.add_read("lens", fields::one_of_words(lenses), set_lens, "Lens model; auto: by BIC.")
      .with_default("brown5");
  table.add("skew", "", "", fields::booleans(),
            at(&ReadRequest::request, &Request::options, &IntrinsicsOptions::settings,
               &ParameterSettings::skew),
            "Whether the skew is estimated.");
  table.add_read("fix", by_parameter({{"type", {"number", "null"}}}), set_fixed,
                 "Values of parameters that are not estimated; null: the initial value.");
  table.add_read("tie", by_parameter(object_schema(tie_fields().schema())), set_ties,
                 "Parameters that are multiples of others.");
  table.add_read("prior", by_parameter(object_schema(prior_fields().schema())), set_priors,
                 "Normal priors of parameters.");
}

void add_fit(FieldTable<ReadRequest>& table) {
  const auto fit = [](auto member) {
    return at(&ReadRequest::request, &Request::options, &IntrinsicsOptions::fit, member);
  };
  table.add("reject", "", "", fields::booleans(), fit(&FitOptions::reject), "Leave out outliers.");
  table.add("outlier_px", "", "px", number_from_0(), fit(&FitOptions::outlier_px),
            "Residuals up to this length are kept.");
  table.add("loss_px", "", "px", number_from_0(), fit(&FitOptions::loss_px),
            "Scale of Cauchy's loss; 0: least squares.");
  table.add("sigma_px", "", "px", number_above_0(), fit(&FitOptions::sigma_px),
            "Standard deviation of a coordinate; default: from the residuals.");
}

const FieldTable<ReadRequest>& request_fields() {
  static const FieldTable<ReadRequest> table = [] {
    FieldTable<ReadRequest> fields;
    add_inputs(fields);
    add_lens(fields);
    add_fit(fields);
    return fields;
  }();
  return table;
}

}  // namespace

Request read_request_fields(const json& value, const fs::path& folder,
                            std::vector<Problem>& problems) {
  ReadRequest read;
  read.folder = folder;
  read.request.options.source = "request";
  const std::string no_source;
  request_fields().read_checked(value, read, {"", no_source, problems});
  return std::move(read.request);
}

nlohmann::ordered_json request_schema() {
  return fields::document_schema(
      "throng calibration request",
      "Files are named as they were sent along. docs/calibration.md says what each field means.",
      request_fields().schema());
}

}  // namespace throng::calibrate
