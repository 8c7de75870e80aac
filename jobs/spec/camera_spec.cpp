#include "jobs/spec/camera_spec.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <string_view>
#include <tuple>

#include "base/angle.h"
#include "base/json_text.h"

namespace throng::embedded {
extern const std::string_view kCameras;
}

namespace throng::jobs {

using nlohmann::json;

namespace {

constexpr std::array kModels{"pinhole", "brown_conrady", "fisheye"};
constexpr std::array kGimbals{"ideal", "second_order"};
constexpr double kMostPixels = 20000;
constexpr double kMostCoefficient = 100;

/// A number of the job that may be drawn: its pointer below the camera and where it is kept.
struct Field {
  std::string name;
  double low;
  double high;
  std::function<std::optional<double>(const CameraSpec&)> get;
  std::function<void(CameraSpec&, double)> set;
};

template <typename Member>
Field field(const char* name, double low, double high, Member member) {
  return {name, low, high,
          [member](const CameraSpec& spec) { return std::optional<double>(member(spec)); },
          [member](CameraSpec& spec, double value) { member(spec) = value; }};
}

/// A field in degrees of an angle that is kept in radians.
Field angle_field(const char* name, double most_deg, double sim::GimbalSpec::*member) {
  // Digits that degrees need beyond these are those of the conversion.
  constexpr double kDigits = 1e12;
  return {
      name, 0, most_deg,
      [member](const CameraSpec& spec) {
        return std::optional<double>(std::round(spec.gimbal.*member / kDegree * kDigits) / kDigits);
      },
      [member](CameraSpec& spec, double value) { spec.gimbal.*member = value * kDegree; }};
}

std::vector<Field> gimbal_fields() {
  return {
      field(
          "gimbal/natural_rad_s", 1, 100, [](auto& s) -> auto& { return s.gimbal.natural_rad_s; }),
      field(
          "gimbal/damping", 0.1, 2, [](auto& s) -> auto& { return s.gimbal.damping; }),
      angle_field("gimbal/jitter_deg", 5, &sim::GimbalSpec::jitter_rad),
      angle_field("gimbal/bias_deg", 5, &sim::GimbalSpec::bias_rad),
      angle_field("gimbal/reading_deg", 5, &sim::GimbalSpec::reading_rad)};
}

std::vector<Field> make_fields() {
  std::vector<Field> fields = {
      field(
          "hfov_deg", 5, 150, [](auto& s) -> auto& { return s.hfov_deg; }),
      field(
          "fx_px", 1, 1e5, [](auto& s) -> auto& { return s.fx_px; }),
      field(
          "fy_px", 1, 1e5, [](auto& s) -> auto& { return s.fy_px; }),
      field(
          "cx_px", -kMostPixels, kMostPixels, [](auto& s) -> auto& { return s.cx_px; }),
      field(
          "cy_px", -kMostPixels, kMostPixels, [](auto& s) -> auto& { return s.cy_px; }),
      field(
          "pitch_deg", -90, 30, [](auto& s) -> auto& { return s.pitch_deg; }),
      field(
          "yaw_deg", -180, 180, [](auto& s) -> auto& { return s.yaw_deg; }),
      field(
          "sensor/ev", -6, 6, [](auto& s) -> auto& { return s.sensor.ev; }),
      field(
          "sensor/white_balance_k", 1667, 25000,
          [](auto& s) -> auto& { return s.sensor.white_balance_k; }),
      field(
          "sensor/vignette", 0, 1, [](auto& s) -> auto& { return s.sensor.vignette; }),
      field(
          "sensor/iso", 0, 409600, [](auto& s) -> auto& { return s.sensor.iso; }),
      field(
          "sensor/full_well_e", 100, 1e6, [](auto& s) -> auto& { return s.sensor.full_well_e; }),
      field(
          "sensor/read_noise_e", 0, 1000, [](auto& s) -> auto& { return s.sensor.read_noise_e; }),
      field(
          "sensor/exposure_s", 0, 0.5, [](auto& s) -> auto& { return s.exposure.exposure_s; }),
      field(
          "sensor/readout_s", 0, 0.5, [](auto& s) -> auto& { return s.exposure.readout_s; })};
  const std::array<std::tuple<const char*, double, double PerFrame::*>, 3> per_frame = {
      {{"per_frame/yaw_deg", 45, &PerFrame::yaw_deg},
       {"per_frame/pitch_deg", 45, &PerFrame::pitch_deg},
       {"per_frame/ev", 3, &PerFrame::ev}}};
  for (const auto& [name, most, member] : per_frame) {
    fields.push_back(field(
        name, 0, most, [member = member](auto& s) -> auto& { return s.per_frame.*member; }));
  }
  for (Field& gimbal : gimbal_fields()) fields.push_back(std::move(gimbal));
  const std::array<std::pair<const char*, double LensCoefficients::*>, 8> coefficients = {
      {{"distortion/k1", &LensCoefficients::k1},
       {"distortion/k2", &LensCoefficients::k2},
       {"distortion/k3", &LensCoefficients::k3},
       {"distortion/k4", &LensCoefficients::k4},
       {"distortion/k5", &LensCoefficients::k5},
       {"distortion/k6", &LensCoefficients::k6},
       {"distortion/p1", &LensCoefficients::p1},
       {"distortion/p2", &LensCoefficients::p2}}};
  for (const auto& [name, member] : coefficients) {
    fields.push_back(field(
        name, -kMostCoefficient,
        kMostCoefficient, [member = member](auto& s) -> auto& { return s.distortion.*member; }));
  }
  return fields;
}

const std::vector<Field>& fields() {
  static const std::vector<Field> list = make_fields();
  return list;
}

json::json_pointer below(const std::string& name) { return json::json_pointer("/" + name); }

const json& presets() {
  static const json list = parse_own_json(embedded::kCameras, "the list of cameras").at("cameras");
  return list;
}

bool gives(const json& value, const char* name) { return value.contains(below(name)); }

/// What contradicts itself in the object.
void check_choices(const json& value, const CameraSpec& spec, const std::string& pointer,
                   std::vector<Problem>& problems) {
  if (gives(value, "fx_px") && gives(value, "hfov_deg")) {
    problems.push_back({"", pointer + "/hfov_deg", "also fx_px", "one of the two"});
  }
  if (spec.fy_px && !spec.fx_px) {
    problems.push_back({"", pointer + "/fx_px", "nothing", "a focal length, since fy_px is given"});
  }
  const auto differs_from_zero = [&](const char* name) {
    const auto at = below(std::string("distortion/") + name);
    return value.contains(at) && value.at(at) != 0;
  };
  std::vector<const char*> unused;
  if (spec.model == LensModel::fisheye) unused = {"k5", "k6", "p1", "p2"};
  if (spec.model == LensModel::pinhole) unused = {"k1", "k2", "k3", "k4", "k5", "k6", "p1", "p2"};
  for (const char* name : unused) {
    if (!differs_from_zero(name)) continue;
    problems.push_back({"", fmt::format("{}/distortion/{}", pointer, name), "a coefficient",
                        fmt::format("none, since the model is \"{}\"",
                                    kModels.at(static_cast<std::size_t>(spec.model)))});
  }
}

std::optional<camera::Distortion> distortion_of(const CameraSpec& spec) {
  const LensCoefficients& c = spec.distortion;
  using Model = camera::Distortion::Model;
  if (spec.model == LensModel::brown_conrady) {
    return camera::Distortion(Model::brown_conrady,
                              {c.k1, c.k2, c.p1, c.p2, c.k3, c.k4, c.k5, c.k6});
  }
  if (spec.model == LensModel::fisheye) {
    return camera::Distortion(Model::fisheye, {c.k1, c.k2, c.k3, c.k4});
  }
  return std::nullopt;
}

/// What a calibration says, so that nothing else may.
constexpr std::array kCalibrated = {"preset", "width", "height", "hfov_deg", "fx_px",
                                    "fy_px",  "cx_px", "cy_px",  "model",    "distortion"};

bool is_calibrated(const std::string& field) {
  const std::string first = field.substr(0, field.find('/'));
  return std::find(kCalibrated.begin(), kCalibrated.end(), first) != kCalibrated.end();
}

void read_calibration(const json& value, const std::string& pointer, CameraSpec& spec,
                      std::vector<Problem>& problems) {
  const std::string at = pointer + "/calibration";
  const json& given = value.at("calibration");
  if (given.is_string()) {
    problems.push_back({"", at, given.dump(), "the id of a calibration that has succeeded"});
    return;
  }
  for (const char* field : kCalibrated) {
    if (value.contains(field)) {
      problems.push_back(
          {"", fmt::format("{}/{}", pointer, field), "also a calibration", "one of the two"});
    }
  }
  try {
    spec.calibration = calibrate::camera_from_json(given, "");
  } catch (const InputError& error) {
    for (Problem problem : error.problems()) {
      problem.where = at + problem.where;
      problems.push_back(std::move(problem));
    }
    return;
  }
  const calibrate::CameraFile& camera = *spec.calibration;
  spec.width = camera.size.width;
  spec.height = camera.size.height;
  spec.fx_px = camera.parameters[calibrate::kFx];
  spec.fy_px = camera.parameters[calibrate::kFy];
}

}  // namespace

std::string camera_pointer(std::size_t drone) { return fmt::format("/drones/{}/camera", drone); }

std::vector<std::string> camera_presets() {
  std::vector<std::string> names;
  for (const auto& preset : presets().items()) names.push_back(preset.key());
  return names;
}

CameraSpec read_camera(const json& value, const std::string& pointer,
                       std::vector<Problem>& problems) {
  CameraSpec spec;
  spec.preset = value.value("preset", "");
  json given = value;
  if (!spec.preset.empty()) {
    const auto found = presets().find(spec.preset);
    if (found == presets().end()) {
      problems.push_back({"", pointer + "/preset", fmt::format("\"{}\"", spec.preset),
                          fmt::format("one of: {}", fmt::join(camera_presets(), ", "))});
      return spec;
    }
    given = found->at("camera");
    // A field of view of the job's own counts, whatever the preset is made of.
    if (value.contains("hfov_deg")) given.erase("fx_px");
    given.merge_patch(value);
  }
  spec.width = given.value("width", spec.width);
  spec.height = given.value("height", spec.height);
  const std::string model = given.value("model", kModels.front());
  spec.model =
      static_cast<LensModel>(std::find(kModels.begin(), kModels.end(), model) - kModels.begin());
  const auto gimbal = below("gimbal/model");
  spec.gimbal.ideal = !given.contains(gimbal) || given.at(gimbal) == kGimbals.front();
  for (const Field& field : fields()) {
    const auto at = below(field.name);
    if (!given.contains(at)) continue;
    const json& found = given.at(at);
    const Distribution distribution = Distribution::read(
        found, number_quantity(field.low, field.high), pointer + at.to_string(), problems);
    field.set(spec, found.is_number() ? found.get<double>() : field.low);
    if (found.is_object()) spec.drawn.emplace(field.name, distribution);
  }
  check_choices(value, spec, pointer, problems);
  if (value.contains("calibration")) read_calibration(value, pointer, spec, problems);
  return spec;
}

json to_json(const CameraSpec& spec) {
  json value = {{"width", spec.width},
                {"height", spec.height},
                {"model", kModels.at(static_cast<std::size_t>(spec.model))}};
  if (spec.calibration) value = {{"calibration", calibrate::to_json(*spec.calibration)}};
  value["gimbal"]["model"] = kGimbals.at(spec.gimbal.ideal ? 0 : 1);
  if (!spec.preset.empty()) value["preset"] = spec.preset;
  for (const Field& field : fields()) {
    if (field.name == "hfov_deg" && spec.fx_px) continue;
    if (spec.calibration && is_calibrated(field.name)) continue;
    const auto drawn = spec.drawn.find(field.name);
    if (drawn != spec.drawn.end()) {
      value[below(field.name)] = drawn->second.to_json(number_quantity(field.low, field.high));
    } else if (const std::optional<double> number = field.get(spec)) {
      value[below(field.name)] = *number;
    }
  }
  return value;
}

CameraSpec camera_of_run(const CameraSpec& spec, std::uint64_t run_seed,
                         const std::string& pointer) {
  CameraSpec run_camera = spec;
  run_camera.drawn.clear();
  for (const Field& field : fields()) {
    const auto drawn = spec.drawn.find(field.name);
    if (drawn == spec.drawn.end()) continue;
    field.set(run_camera, drawn->second.draw(run_seed, pointer + "/" + field.name));
  }
  return run_camera;
}

std::optional<camera::Intrinsics> intrinsics_of(const CameraSpec& run_camera) {
  if (run_camera.calibration) return run_camera.calibration->intrinsics();
  camera::Intrinsics k = camera::intrinsics_from_hfov(run_camera.width, run_camera.height,
                                                      run_camera.hfov_deg * kDegree);
  k.distortion = distortion_of(run_camera);
  if (run_camera.fx_px) {
    k.fx_px = *run_camera.fx_px;
    k.fy_px = run_camera.fy_px.value_or(k.fx_px);
  } else if (k.distortion) {
    // The focal length with which the lens shows half the angle at the image's edge.
    const auto edge = k.distortion->distort({std::tan(0.5 * run_camera.hfov_deg * kDegree), 0});
    if (!edge || !(edge->x() > 0)) return std::nullopt;
    k.fx_px = 0.5 * run_camera.width / edge->x();
    k.fy_px = k.fx_px;
  }
  k.cx_px = run_camera.cx_px.value_or(k.cx_px);
  k.cy_px = run_camera.cy_px.value_or(k.cy_px);
  return k;
}

}  // namespace throng::jobs
