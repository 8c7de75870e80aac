#include "spec/calibration/foreign/colmap.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/text/words.h"
#include "spec/calibration/foreign/pixels.h"
#include "spec/calibration/foreign/radial_lens.h"

namespace throng::calibrate {

namespace {

constexpr std::string_view kOmega = "omega";  // the field of view of fov_lens()

/// A model; each parameter by its name in throng, "f" for fx = fy. Parameters that throng's lens
/// does not have (p1, p2, sx1 and sy1 of a fisheye) must be 0.
struct Model {
  std::string_view name;
  Lens lens;
  std::vector<std::string_view> parameters;
};

/// COLMAP's models in the order of their numbers.
const std::vector<Model>& models() {
  static const std::vector<Model> kModels = {
      {"SIMPLE_PINHOLE", Lens::pinhole, {"f", "cx", "cy"}},
      {"PINHOLE", Lens::pinhole, {"fx", "fy", "cx", "cy"}},
      {"SIMPLE_RADIAL", Lens::brown2, {"f", "cx", "cy", "k1"}},
      {"RADIAL", Lens::brown2, {"f", "cx", "cy", "k1", "k2"}},
      {"OPENCV", Lens::brown4, {"fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2"}},
      {"OPENCV_FISHEYE", Lens::fisheye, {"fx", "fy", "cx", "cy", "k1", "k2", "k3", "k4"}},
      {"FULL_OPENCV",
       Lens::brown8,
       {"fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"}},
      {"FOV", Lens::pinhole, {"fx", "fy", "cx", "cy", kOmega}},
      {"SIMPLE_RADIAL_FISHEYE", Lens::fisheye, {"f", "cx", "cy", "k1"}},
      {"RADIAL_FISHEYE", Lens::fisheye, {"f", "cx", "cy", "k1", "k2"}},
      {"THIN_PRISM_FISHEYE",
       Lens::fisheye,
       {"fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "k3", "k4", "sx1", "sy1"}}};
  return kModels;
}

/// A camera as a file states it. `source` says where.
struct Stated {
  std::string model;
  double width = 0;
  double height = 0;
  std::vector<double> values = {};
  std::string source;
};

const Model& model_named(std::string_view name, const std::string& source) {
  std::vector<std::string_view> names;
  for (const Model& model : models()) {
    if (model.name == name) return model;
    names.push_back(model.name);
  }
  throw InputError(Problem{source, "", fmt::format("COLMAP's camera model \"{}\"", name),
                           fmt::format("one of: {}", fmt::join(names, ", "))});
}

CameraFile make_camera(const Stated& stated) {
  const std::string& source = stated.source;
  const Model& model = model_named(stated.model, source);
  if (stated.values.size() != model.parameters.size()) {
    throw InputError(Problem{source, "", fmt::format("{} parameters", stated.values.size()),
                             fmt::format("{} of {}: {}", model.parameters.size(), model.name,
                                         fmt::join(model.parameters, ", "))});
  }
  nlohmann::json camera = {{"width", pixels(stated.width, "", source)},
                           {"height", pixels(stated.height, "", source)},
                           {"lens", to_string(model.lens)}};
  for (std::size_t i = 0; i < kParameters; ++i) {
    const std::string name = parameter_name(model.lens, i);
    if (!name.empty()) camera[name] = 0;
  }
  constexpr double kPixelCenter = 0.5;
  std::optional<double> omega_rad;
  for (std::size_t i = 0; i < stated.values.size(); ++i) {
    const std::string name(model.parameters[i]);
    const double value = stated.values[i];
    if (name == "f") {
      camera["fx"] = camera["fy"] = value;
    } else if (name == kOmega) {
      omega_rad = value;
    } else if (camera.contains(name)) {
      camera[name] = name == "cx" || name == "cy" ? value - kPixelCenter : value;
    } else if (value != 0) {
      throw InputError(Problem{source, "", fmt::format("{} = {} of {}", name, value, model.name),
                               "0: throng's fisheye has neither prism nor tangential distortion"});
    }
  }
  const CameraFile read = camera_from_json(camera, source);
  return omega_rad ? as_fisheye(read, fov_lens(*omega_rad), source) : read;
}

/// Names such as SIMPLE_RADIAL, of models that throng knows or not.
bool is_model_name(std::string_view word) {
  return word.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789") == std::string_view::npos;
}

/// Cameras by their CAMERA_ID.
using Cameras = std::map<std::string, Stated>;

std::optional<Cameras> read_text(std::string_view bytes, const std::string& source) {
  Cameras cameras;
  std::istringstream lines{std::string(bytes)};
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const std::string_view text = trimmed(line);
    if (text.empty() || text.starts_with('#')) continue;
    std::istringstream words{std::string(text)};
    std::int64_t id = 0;
    std::string model;
    double width = 0;
    double height = 0;
    const bool is_camera = words >> id >> model >> width >> height && is_model_name(model);
    if (!is_camera) {
      if (cameras.empty()) return std::nullopt;  // another kind of file
      throw InputError(Problem{source, fmt::format("line {}", number), std::string(text),
                               "CAMERA_ID MODEL WIDTH HEIGHT PARAMS"});
    }
    std::vector<double> values;
    for (double value = 0; words >> value;) values.push_back(value);
    cameras[std::to_string(id)] = {model, width, height, values,
                                   fmt::format("{}, line {}", source, number)};
  }
  return cameras.empty() ? std::nullopt : std::optional(cameras);
}

/// Little-endian values in the order of the file, as long as there are bytes.
class Bytes {
 public:
  explicit Bytes(std::string_view bytes) : rest_(bytes) {}
  template <typename Value>
  Value next() {
    Value value{};
    if (rest_.size() < sizeof(value)) {
      is_short_ = true;
      return value;
    }
    std::memcpy(&value, rest_.data(), sizeof(value));
    rest_.remove_prefix(sizeof(value));
    return value;
  }
  bool is_whole() const { return !is_short_ && rest_.empty(); }
  bool is_short() const { return is_short_; }

 private:
  std::string_view rest_;
  bool is_short_ = false;
};

std::optional<Cameras> read_binary(std::string_view bytes, const std::string& source) {
  constexpr std::uint64_t kMaxCameras = 100'000;
  Bytes values(bytes);
  const auto count = values.next<std::uint64_t>();
  if (values.is_short() || count == 0 || count > kMaxCameras) return std::nullopt;
  Cameras cameras;
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto id = values.next<std::uint32_t>();
    const auto model = values.next<std::int32_t>();
    const auto width = values.next<std::uint64_t>();
    const auto height = values.next<std::uint64_t>();
    if (values.is_short() || model < 0 || static_cast<std::size_t>(model) >= models().size()) {
      return std::nullopt;
    }
    const Model& known = models()[static_cast<std::size_t>(model)];
    std::vector<double> parameters(known.parameters.size());
    for (double& parameter : parameters) parameter = values.next<double>();
    if (values.is_short()) return std::nullopt;
    cameras[std::to_string(id)] = {std::string(known.name), static_cast<double>(width),
                                   static_cast<double>(height), parameters, source};
  }
  return values.is_whole() ? std::optional(cameras) : std::nullopt;
}

}  // namespace

std::optional<CameraFile> read_colmap(std::string_view bytes, const std::string& name,
                                      const std::string& source) {
  const bool is_binary = bytes.find('\0') != std::string_view::npos;
  const auto cameras = is_binary ? read_binary(bytes, source) : read_text(bytes, source);
  if (!cameras) return std::nullopt;
  const auto found = cameras->find(name);
  if (found != cameras->end()) return make_camera(found->second);
  if (name.empty() && cameras->size() == 1) return make_camera(cameras->begin()->second);
  std::vector<std::string> ids;
  for (const auto& [id, camera] : *cameras) ids.push_back(id);
  throw InputError(Problem{
      source, "", name.empty() ? counted(std::ssize(ids), "camera") : fmt::format("#{}", name),
      fmt::format("FILE#CAMERA_ID with one of: {}", fmt::join(ids, ", "))});
}

CameraFile colmap_camera(const nlohmann::json& value, const std::string& source) {
  std::vector<double> parameters;
  for (const nlohmann::json& parameter : value.at("params")) {
    if (!parameter.is_number()) {
      throw InputError(Problem{source, "/params", parameter.dump(), "numbers"});
    }
    parameters.push_back(parameter);
  }
  for (const char* side : {"width", "height"}) {
    if (!value.contains(side) || !value[side].is_number()) {
      throw InputError(Problem{source, fmt::format("/{}", side),
                               value.contains(side) ? value[side].dump() : "nothing",
                               "the size of the image in pixels"});
    }
  }
  if (!value.at("model").is_string()) {
    throw InputError(Problem{source, "/model", value["model"].dump(), "the name of a model"});
  }
  return make_camera(
      {value["model"].get<std::string>(), value["width"], value["height"], parameters, source});
}

}  // namespace throng::calibrate
