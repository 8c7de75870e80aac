#include "spec/calibration/camera_file.h"

#include <fmt/core.h>

#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/json/field_table.h"

namespace throng::calibrate {

using nlohmann::json;

namespace {

constexpr const char* kType = "throng-camera";
constexpr int kVersion = 1;

using fields::FieldLocation;
using fields::FieldTable;

/// A file's numbers by name, of which the lens has some.
struct ReadCamera {
  ImageSize size;
  Lens lens = Lens::pinhole;
  std::map<std::string, double> parameters;
};

constexpr double kMaxParameter = 1e7;

void add_parameter(FieldTable<ReadCamera>& table, const std::string& name, const char* unit,
                   double low, const char* help) {
  table
      .add_read(
          name, fields::numbers(low, kMaxParameter),
          [name](ReadCamera& read, const json& value, const FieldLocation&) {
            read.parameters[name] = value.get<double>();
          },
          help)
      .measured_in(unit);
}

FieldTable<ReadCamera> make_fields() {
  constexpr double kMaxSide = 20000;
  constexpr double kMinFocal = 1e-3;
  FieldTable<ReadCamera> table;
  table.add_schema_name();
  table.add_ignored("type",
                    fields::raw({{"type", "string"}, {"enum", {kType}}},
                                fmt::format("\"{}\", or no type", kType)),
                    "Kind of file.");
  table.add_ignored("version", fields::raw({{"type", "integer"}, {"enum", {kVersion}}}),
                    "Version of the format.");
  const auto side = [](int ImageSize::*member) {
    return [member](ReadCamera& read, const json& value, const FieldLocation&) {
      read.size.*member = static_cast<int>(value.get<double>());
    };
  };
  const fields::Values sides = fields::numbers(1, kMaxSide);
  table.add_read("width", sides, side(&ImageSize::width), "Width of the images.").measured_in("px");
  table.add_read("height", sides, side(&ImageSize::height), "Height of the images.")
      .measured_in("px");
  std::vector<std::string> lenses;
  lenses.reserve(kLenses.size());
  for (const Lens lens : kLenses) lenses.emplace_back(to_string(lens));
  table.add_read(
      "lens", fields::one_of_words(lenses),
      [](ReadCamera& read, const json& value, const FieldLocation& place) {
        read.lens = lens_named(value.get<std::string>(), place.source);
      },
      "Lens model.");
  add_parameter(table, "fx", "px", kMinFocal, "Focal length along x.");
  add_parameter(table, "fy", "px", kMinFocal, "Focal length along y.");
  add_parameter(table, "cx", "px", -kMaxParameter, "Principal point, x.");
  add_parameter(table, "cy", "px", -kMaxParameter, "Principal point, y.");
  add_parameter(table, "skew", "px", -kMaxParameter, "Skew.");
  for (const char* name : {"k1", "k2", "k3", "k4", "k5", "k6"}) {
    add_parameter(table, name, "", -kMaxParameter, "Radial coefficient.");
  }
  for (const char* name : {"p1", "p2"}) {
    add_parameter(table, name, "", -kMaxParameter, "Tangential coefficient.");
  }
  return table;
}

const FieldTable<ReadCamera>& camera_file_fields() {
  static const FieldTable<ReadCamera> table = make_fields();
  return table;
}

/// Names of the fields that every camera has.
constexpr std::array kRequired = {"width", "height", "lens", "fx", "fy", "cx", "cy"};

}  // namespace

camera::Intrinsics CameraFile::intrinsics() const {
  return to_intrinsics(lens, parameters, size.width, size.height);
}

json to_json(const CameraFile& camera) {
  json value = {{"type", kType},
                {"version", kVersion},
                {"width", camera.size.width},
                {"height", camera.size.height},
                {"lens", to_string(camera.lens)}};
  for (std::size_t i = 0; i < kParameters; ++i) {
    const std::string name = parameter_name(camera.lens, i);
    if (!name.empty()) value[name] = camera.parameters.at(i);
  }
  return value;
}

void require_principal_point_inside(const CameraFile& camera, const std::string& source) {
  const double cx = camera.parameters[kCx];
  const double cy = camera.parameters[kCy];
  const auto [width, height] = camera.size;
  if (cx > 0 && cx < width - 1 && cy > 0 && cy < height - 1) return;
  throw InputError(Problem{
      source, "",
      fmt::format("a principal point of ({:.1f}, {:.1f}) px, not inside an image of {} x {}", cx,
                  cy, width, height),
      fmt::format("one near the middle ({:g}, {:g}), for images of this size", 0.5 * (width - 1),
                  0.5 * (height - 1))});
}

CameraFile camera_from_json(const json& value, const std::string& source) {
  if (!value.is_object()) {
    throw InputError(Problem{source, "", value.type_name(),
                             "an object with the fields of a camera (docs/calibration.md)"});
  }
  // A calibration writes more than a lens.
  json known = json::object();
  for (const auto& [name, member] : value.items()) {
    if (camera_file_fields().find(name) != nullptr) known[name] = member;
  }
  ReadCamera read;
  std::vector<Problem> problems;
  const FieldLocation place{"", source, problems};
  const auto require = [&](const std::string& name) {
    if (!known.contains(name)) place.below(name).reject("nothing", "a value, which the lens has");
  };
  camera_file_fields().read_checked(known, read, place);
  for (const char* name : kRequired) require(name);
  CameraFile camera{.lens = read.lens, .parameters = {}, .size = read.size};
  for (std::size_t i = 0; i < kParameters; ++i) {
    const std::string name = parameter_name(camera.lens, i);
    if (name.empty()) continue;
    if (i >= kCoefficients) require(name);
    camera.parameters[i] = read.parameters[name];
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  require_principal_point_inside(camera, source);
  return camera;
}

nlohmann::ordered_json camera_file_schema() {
  nlohmann::ordered_json schema = camera_file_fields().schema();
  schema.erase("additionalProperties");
  schema["required"] = kRequired;
  return fields::document_schema("throng camera",
                                 "A calibrated camera, as throng calibrate writes it and "
                                 "camera.calibration of a job reads it (docs/calibration.md).",
                                 schema);
}

}  // namespace throng::calibrate
