#include "spec/calibration/camera_file.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/schemas/schemas.h"

namespace throng::calibrate {

using nlohmann::json;

namespace {

constexpr const char* kType = "throng-camera";
constexpr int kVersion = 1;

double number_at(const json& value, const std::string& name, double low, double high,
                 const std::string& source) {
  const auto found = value.find(name);
  const bool good = found != value.end() && found->is_number() && *found >= low && *found <= high;
  if (!good) {
    throw InputError(Problem{source, "/" + name, found == value.end() ? "nothing" : found->dump(),
                             fmt::format("a number from {} to {}", low, high)});
  }
  return found->get<double>();
}

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
  if (const json type = value.value("type", json(kType)); type != kType) {
    throw InputError(
        Problem{source, "/type", type.dump(), fmt::format("\"{}\", or no type", kType)});
  }
  if (const json version = value.value("version", json(kVersion)); version != kVersion) {
    throw InputError(Problem{source, "/version", version.dump(),
                             fmt::format("{}, which this program knows, or no version", kVersion)});
  }
  CameraFile camera;
  constexpr double kMaxSide = 20000;
  constexpr double kMaxParameter = 1e7;
  constexpr double kMinFocal = 1e-3;
  camera.size.width = static_cast<int>(number_at(value, "width", 1, kMaxSide, source));
  camera.size.height = static_cast<int>(number_at(value, "height", 1, kMaxSide, source));
  const json lens = value.value("lens", json());
  camera.lens = lens_named(lens.is_string() ? lens.get<std::string>() : lens.dump(), source);
  for (std::size_t i = 0; i < kParameters; ++i) {
    const std::string name = parameter_name(camera.lens, i);
    if (name.empty() || (i == kSkew && !value.contains(name))) continue;
    const bool focal = i == kFx || i == kFy;
    camera.parameters[i] =
        number_at(value, name, focal ? kMinFocal : -kMaxParameter, kMaxParameter, source);
  }
  std::vector<Problem> problems;
  schemas::add_schema_problems(schemas::Kind::camera, value, source, problems);
  if (!problems.empty()) throw InputError(std::move(problems));
  require_principal_point_inside(camera, source);
  return camera;
}

}  // namespace throng::calibrate
