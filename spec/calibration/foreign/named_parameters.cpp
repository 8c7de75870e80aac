#include "spec/calibration/foreign/named_parameters.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "spec/calibration/foreign/pixels.h"
#include "spec/calibration/foreign/radial_lens.h"

namespace throng::calibrate {

using nlohmann::json;

namespace {

/// A parameter by its name in the file and in throng: "f" is fx and fy; "" has no counterpart and
/// must be 0.
struct NamedParameter {
  std::string_view theirs;
  std::string_view ours;
};

struct NamedModel {
  std::string_view name;
  Lens lens;
  std::vector<NamedParameter> parameters;
};

constexpr std::string_view kMei = "MEI";  // the unified model of Mei and Rives 2007

/// Parameters whose names in the file are throng's.
std::vector<NamedParameter> same_names(std::initializer_list<std::string_view> names) {
  std::vector<NamedParameter> parameters;
  for (const std::string_view name : names) parameters.push_back({name, name});
  return parameters;
}

const std::vector<NamedModel>& camodocal_models() {
  static const std::vector<NamedModel> kModels = {
      {"PINHOLE", Lens::brown4, same_names({"fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2"})},
      {"PINHOLE_FULL", Lens::brown8,
       same_names({"fx", "fy", "cx", "cy", "k1", "k2", "k3", "k4", "k5", "k6", "p1", "p2"})},
      {"KANNALA_BRANDT",
       Lens::fisheye,
       {{"mu", "fx"},
        {"mv", "fy"},
        {"u0", "cx"},
        {"v0", "cy"},
        {"k2", "k1"},
        {"k3", "k2"},
        {"k4", "k3"},
        {"k5", "k4"}}},
      {kMei,
       Lens::pinhole,
       {{"gamma1", "fx"}, {"gamma2", "fy"}, {"u0", "cx"}, {"v0", "cy"}, {"p1", ""}, {"p2", ""}}}};
  return kModels;
}

std::vector<NamedModel> make_opensfm_models() {
  const auto affine = [](std::string_view name, Lens lens, std::vector<NamedParameter> distortion) {
    NamedModel model{
        name, lens, {{"focal_x", "fx"}, {"focal_y", "fy"}, {"c_x", "cx"}, {"c_y", "cy"}}};
    model.parameters.insert(model.parameters.end(), distortion.begin(), distortion.end());
    return model;
  };
  const std::vector<NamedParameter> uniform = {{"focal", "f"}, {"k1", "k1"}, {"k2", "k2"}};
  const std::vector<NamedParameter> four = same_names({"k1", "k2", "k3", "k4"});
  std::vector<NamedParameter> more = four;
  for (const char* name : {"k5", "k6", "p1", "p2", "s0", "s1", "s2", "s3"}) {
    more.push_back({name, ""});
  }
  return {{"perspective", Lens::brown2, uniform},
          affine("simple_radial", Lens::brown2, same_names({"k1"})),
          affine("radial", Lens::brown2, same_names({"k1", "k2"})),
          affine("brown", Lens::brown5, same_names({"k1", "k2", "p1", "p2", "k3"})),
          {"fisheye", Lens::fisheye, uniform},
          affine("fisheye_opencv", Lens::fisheye, four),
          affine("fisheye62", Lens::fisheye, more),
          affine("fisheye624", Lens::fisheye, more)};
}

const std::vector<NamedModel>& opensfm_models() {
  static const std::vector<NamedModel> kModels = make_opensfm_models();
  return kModels;
}

const NamedModel& find_model(std::span<const NamedModel> models, const std::string& name,
                             const std::string& pointer, const std::string& format,
                             const std::string& source) {
  std::vector<std::string_view> names;
  for (const NamedModel& model : models) {
    if (model.name == name) return model;
    names.push_back(model.name);
  }
  throw InputError(Problem{source, pointer, fmt::format("\"{}\" of {}", name, format),
                           fmt::format("one of: {}", fmt::join(names, ", "))});
}

/// The number with this name in the first of the groups that has it.
std::optional<double> number_in(std::span<const json* const> groups, std::string_view name,
                                const std::string& source) {
  for (const json* group : groups) {
    const auto found = group->find(std::string(name));
    if (found == group->end()) continue;
    if (found->is_number()) return found->get<double>();
    throw InputError(Problem{source, fmt::format("/{}", name), found->dump(), "a number"});
  }
  return std::nullopt;
}

/// The camera in units of the file: its focal lengths and center may be of any unit.
json stated_camera(const NamedModel& model, std::span<const json* const> groups,
                   const json& document, const std::string& source) {
  json camera = {{"lens", to_string(model.lens)}};
  for (const char* side : {"width", "height"}) {
    const std::string longer = fmt::format("image_{}", side);
    const std::string name = document.contains(longer) ? longer : side;
    const json* const whole[] = {&document};
    const auto value = number_in(whole, name, source);
    if (!value) throw InputError(Problem{source, "/" + name, "nothing", "a number of pixels"});
    camera[side] = pixels(*value, "/" + name, source);
  }
  for (std::size_t i = 0; i < kParameters; ++i) {
    const std::string name = parameter_name(model.lens, i);
    if (!name.empty()) camera[name] = 0;
  }
  for (const auto& [theirs, ours] : model.parameters) {
    const auto value = number_in(groups, theirs, source);
    const bool is_focal = ours.starts_with('f');
    if (is_focal && !value) {
      throw InputError(Problem{source, fmt::format("/{}", theirs), "nothing",
                               fmt::format("the focal length of {}", model.name)});
    }
    if (ours.empty() && value.value_or(0) != 0) {
      throw InputError(Problem{source, "", fmt::format("{} = {} of {}", theirs, *value, model.name),
                               "0: throng's fisheye has only k1, k2, k3 and k4"});
    }
    if (ours == "f") {
      camera["fx"] = camera["fy"] = *value;
    } else if (!ours.empty()) {
      camera[std::string(ours)] = value.value_or(0);
    }
  }
  return camera;
}

/// The unified model: a ray meets the unit sphere, seen from `xi` behind its middle.
RadialLens mei_lens(double xi, double k1, double k2) {
  return [=](double angle) {
    const double depth = std::cos(angle) + xi;
    if (depth <= 0) return 0.0;
    const double plane = std::sin(angle) / depth;
    const double square = plane * plane;
    return plane * (1 + square * (k1 + square * k2));
  };
}

}  // namespace

bool is_camodocal(const json& document) {
  const auto model = document.find("model_type");
  return model != document.end() && model->is_string() && document.contains("image_width");
}

bool is_opensfm(const json& value) {
  return value.is_object() && value.contains("projection_type") &&
         value["projection_type"].is_string();
}

CameraFile camodocal_camera(const json& document, const std::string& source) {
  const NamedModel& model =
      find_model(camodocal_models(), document.at("model_type"), "/model_type", "camodocal", source);
  std::vector<const json*> groups;
  for (const auto& [name, value] : document.items()) {
    if (value.is_object()) groups.push_back(&value);
  }
  const CameraFile camera =
      camera_from_json(stated_camera(model, groups, document, source), source);
  if (model.name != kMei) return camera;
  const auto value = [&](const char* name) { return number_in(groups, name, source).value_or(0); };
  return as_fisheye(camera, mei_lens(value("xi"), value("k1"), value("k2")), source);
}

CameraFile opensfm_camera(const json& camera, const std::string& source) {
  const NamedModel& model = find_model(opensfm_models(), camera.at("projection_type"),
                                       "/projection_type", "OpenSfM", source);
  const json* const groups[] = {&camera};
  json stated = stated_camera(model, groups, camera, source);
  // Lengths are in units of the image's longer side, from its middle.
  const int width = stated["width"];
  const int height = stated["height"];
  const double unit_px = std::max(width, height);
  for (const char* focal : {"fx", "fy"}) stated[focal] = unit_px * stated[focal].get<double>();
  stated["cx"] = unit_px * stated["cx"].get<double>() + 0.5 * (width - 1);
  stated["cy"] = unit_px * stated["cy"].get<double>() + 0.5 * (height - 1);
  return camera_from_json(stated, source);
}

}  // namespace throng::calibrate
