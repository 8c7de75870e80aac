#include "spec/job/camera_spec.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/json/json_text.h"
#include "base/text/suggest.h"
#include "spec/job/camera_fields.h"

namespace throng::embedded {
extern const std::string_view kCameras;
}

namespace throng::jobs {

using nlohmann::json;

namespace {

json::json_pointer below(const std::string& name) { return json::json_pointer("/" + name); }

const json& presets() {
  static const json list = parse_own_json(embedded::kCameras, "the list of cameras").at("cameras");
  return list;
}

bool gives(const json& value, const char* name) { return value.contains(below(name)); }

/// Replaces the fields of `lent` by those that are given, group by group: a distribution, too, is
/// replaced as a whole.
void lend(const json& given, json& lent) {
  for (const auto& [name, value] : given.items()) {
    const bool is_group = value.is_object() && !value.empty() &&
                          camera_fields().find(name + "/" + value.begin().key()) != nullptr;
    if (is_group && lent.contains(name)) {
      lent[name].update(value);
    } else {
      lent[name] = value;
    }
  }
}

/// Reports contradictions in the object.
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
  if (spec.lens.model == camera::LensModel::fisheye) unused = {"k5", "k6", "p1", "p2"};
  if (spec.lens.model == camera::LensModel::pinhole)
    unused = {"k1", "k2", "k3", "k4", "k5", "k6", "p1", "p2"};
  for (const char* name : unused) {
    if (!differs_from_zero(name)) continue;
    problems.push_back(
        {"", fmt::format("{}/distortion/{}", pointer, name), "a coefficient",
         fmt::format("none, since the model is \"{}\"", to_string(spec.lens.model))});
  }
  if (!value.contains("calibration") || value["calibration"].is_string()) return;
  for (const char* field : calibrated_fields()) {
    if (value.contains(field)) {
      problems.push_back(
          {"", fmt::format("{}/{}", pointer, field), "also a calibration", "one of the two"});
    }
  }
}

}  // namespace

std::string camera_pointer(std::size_t drone) { return fmt::format("/drones/{}/camera", drone); }

std::vector<std::string> camera_presets() {
  // In the order of the file.
  const auto document = parse_ordered_json(embedded::kCameras);
  std::vector<std::string> names;
  for (const auto& preset : document.at("cameras").items()) names.push_back(preset.key());
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
      const std::vector<std::string> names = camera_presets();
      problems.push_back(unknown_name("", pointer + "/preset", "preset", spec.preset,
                                      std::vector<std::string_view>(names.begin(), names.end())));
      return spec;
    }
    given = found->at("camera");
    // A field of view of the job's own counts, whatever the preset is made of.
    if (value.contains("hfov_deg")) given.erase("fx_px");
    lend(value, given);
  }
  const std::string no_source;
  camera_fields().read(given, spec, {pointer, no_source, problems});
  check_choices(value, spec, pointer, problems);
  return spec;
}

json to_json(const CameraSpec& spec) { return camera_fields().print(spec); }

CameraSpec camera_of_run(const CameraSpec& spec, std::uint64_t run_seed,
                         const std::string& pointer) {
  CameraSpec run_camera = spec;
  run_camera.sampled.clear();
  const std::string no_source;
  std::vector<Problem> problems;
  for (const auto& [path, distribution] : spec.sampled) {
    const std::string place = pointer + "/" + path;
    camera_fields().find(path)->set(run_camera, distribution.draw(run_seed, place),
                                    {place, no_source, problems});
  }
  return run_camera;
}

}  // namespace throng::jobs
