#include "spec/calibration/foreign/foreign_camera.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/text/words.h"
#include "spec/calibration/foreign/colmap.h"
#include "spec/calibration/foreign/named_parameters.h"
#include "spec/calibration/foreign/pixels.h"
#include "spec/calibration/foreign/radial_lens.h"

namespace throng::calibrate {

using nlohmann::json;

namespace {

/// Names without case and underscores: OpenCV's samples write Camera_Matrix and cameraMatrix.
std::string plain_name(std::string_view name) {
  std::string plain = lower_case(name);
  std::erase(plain, '_');
  return plain;
}

/// A member under the first of several names, and its own name.
struct Member {
  std::string name;
  const json* value = nullptr;

  std::string text_or(const char* otherwise) const {
    return value != nullptr && value->is_string() ? value->get<std::string>() : otherwise;
  }
};

Member member(const json& object, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names) {
    for (const auto& [key, value] : object.items()) {
      if (plain_name(key) == name && !value.is_null()) return {key, &value};
    }
  }
  return {};
}

/// The numbers of a list, of OpenCV's or ROS' matrix, or of rows of lists.
std::vector<double> numbers(const Member& of, const std::string& source) {
  std::vector<double> list;
  const json* value = of.value;
  std::string pointer = "/" + of.name;
  if (value->is_object()) {
    if (!value->contains("data")) {
      throw InputError(Problem{source, pointer, "no member \"data\"", "a matrix with its data"});
    }
    value = &value->at("data");
    pointer += "/data";
  }
  const auto add = [&](const auto& self, const json& one) -> void {
    if (one.is_number()) {
      list.push_back(one);
    } else if (one.is_array()) {
      for (const json& element : one) self(self, element);
    } else {
      throw InputError(Problem{source, pointer, one.dump(), "numbers"});
    }
  };
  add(add, *value);
  return list;
}

/// The pixels under the first of several names; nothing if there is none.
std::optional<int> pixels_under(const json& object, std::initializer_list<std::string_view> names,
                                const std::string& source) {
  const Member found = member(object, names);
  if (found.value == nullptr) return std::nullopt;
  if (!found.value->is_number()) {
    throw InputError(Problem{source, "/" + found.name, found.value->dump(), "a number of pixels"});
  }
  return pixels(*found.value, "/" + found.name, source);
}

/// The values that all kinds of files have.
struct Found {
  int width = 0;
  int height = 0;
  double fx = 0;
  double fy = 0;
  double cx = 0;
  double cy = 0;
  double skew = 0;
  bool is_fisheye = false;
  std::vector<double> coefficients = {};  ///< OpenCV's order
};

Lens choose_lens(const Found& found, const std::string& source) {
  const std::size_t count = found.coefficients.size();
  if (found.is_fisheye) {
    constexpr std::size_t kFisheye = 4;
    if (count == kFisheye) return Lens::fisheye;
    throw InputError(Problem{source, "", fmt::format("{} coefficients of a fisheye", count),
                             "k1, k2, k3 and k4"});
  }
  for (const auto& [lens, needed] : {std::pair<Lens, std::size_t>{Lens::pinhole, 0},
                                     {Lens::brown2, 2},
                                     {Lens::brown4, 4},
                                     {Lens::brown5, 5},
                                     {Lens::brown8, 8}}) {
    if (count <= needed) return lens;
  }
  // Thin prism and tilt; calibrations that did not estimate them write zeros.
  constexpr std::ptrdiff_t kRational = 8;
  if (std::all_of(found.coefficients.begin() + kRational, found.coefficients.end(),
                  [](double value) { return value == 0; })) {
    return Lens::brown8;
  }
  throw InputError(Problem{source, "", fmt::format("{} coefficients of a lens", count),
                           "at most 8 (k1, k2, p1, p2, k3, k4, k5, k6): throng has no thin prism "
                           "and no tilted sensor; calibrate without them"});
}

CameraFile make_camera(const Found& found, const std::string& source) {
  const Lens lens = choose_lens(found, source);
  json camera = {{"width", found.width}, {"height", found.height}, {"lens", to_string(lens)},
                 {"fx", found.fx},       {"fy", found.fy},         {"cx", found.cx},
                 {"cy", found.cy},       {"skew", found.skew}};
  for (std::size_t i = kCoefficients; i < kParameters; ++i) {
    const std::string name = parameter_name(lens, i);
    const std::size_t at = i - kCoefficients;
    if (name.empty()) continue;
    camera[name] = at < found.coefficients.size() ? found.coefficients[at] : 0;
  }
  return camera_from_json(camera, source);
}

/// Words for models of a lens that ROS, OpenCV and Kalibr use.
bool is_fisheye_model(const Member& model, const std::string& source) {
  if (model.value == nullptr || !model.value->is_string()) return false;
  const std::string word = plain_name(model.value->get<std::string>());
  for (const char* name : {"equidistant", "fisheye", "equi", "kannalabrandt"}) {
    if (word == name) return true;
  }
  for (const char* name :
       {"plumbbob", "rationalpolynomial", "radtan", "none", "", "brownconrady", "pinhole"}) {
    if (word == name) return false;
  }
  throw InputError(Problem{source, "/" + model.name, model.value->dump(),
                           "plumb_bob, rational_polynomial, radtan, equidistant or none"});
}

void take_matrix(const std::vector<double>& k, const std::string& name, Found& found,
                 const std::string& source) {
  constexpr std::size_t kNine = 9;
  if (k.size() != kNine) {
    throw InputError(Problem{source, "/" + name, fmt::format("{} numbers", k.size()),
                             "a matrix of 3 x 3 numbers"});
  }
  found.fx = k[0];
  found.skew = k[1];
  found.cx = k[2];
  found.fy = k[4];
  found.cy = k[5];
}

void take_size(const Member& size, Found& found, const std::string& source) {
  const std::vector<double> sides =
      size.value == nullptr ? std::vector<double>{} : numbers(size, source);
  if (sides.size() != 2) {
    throw InputError(Problem{source, "/" + size.name, fmt::format("{} numbers", sides.size()),
                             "the width and the height of the image"});
  }
  found.width = pixels(sides[0], "/" + size.name, source);
  found.height = pixels(sides[1], "/" + size.name, source);
}

void take_size_of_matrix_camera(const json& document, Found& found, const std::string& source) {
  const Member size = member(document, {"imagesize", "imgsize", "resolution"});
  if (size.value != nullptr) return take_size(size, found, source);
  const auto width = pixels_under(document, {"imagewidth", "width"}, source);
  const auto height = pixels_under(document, {"imageheight", "height"}, source);
  if (!width || !height) {
    const char* missing = width ? "image_height" : "image_width";
    throw InputError(Problem{source, "", fmt::format("no {}", missing),
                             fmt::format("the image's size in pixels: add {}", missing)});
  }
  found.width = *width;
  found.height = *height;
}

/// ROS: the matrix is that of the whole sensor, of which the image is a region (`roi`, 0 x 0 for
/// all of it) whose pixels are joined (`binning_x`, 0 for 1). Centers of pixels have whole numbers.
void take_region(const json& document, Found& found, const std::string& source) {
  const Member roi = member(document, {"roi"});
  if (roi.value != nullptr && roi.value->is_object()) {
    const json& region = *roi.value;
    const int left = pixels_under(region, {"xoffset"}, source).value_or(0);
    const int top = pixels_under(region, {"yoffset"}, source).value_or(0);
    const int width = pixels_under(region, {"width"}, source).value_or(0);
    const int height = pixels_under(region, {"height"}, source).value_or(0);
    if (width > 0 && height > 0) {
      if (left + width > found.width || top + height > found.height) {
        throw InputError(
            Problem{source, "/" + roi.name,
                    fmt::format("{} x {} pixels at {}, {}", width, height, left, top),
                    fmt::format("a region of the {} x {} pixels", found.width, found.height)});
      }
      found.width = width;
      found.height = height;
      found.cx -= left;
      found.cy -= top;
    }
  }
  const int across = std::max(1, pixels_under(document, {"binningx"}, source).value_or(1));
  const int down = std::max(1, pixels_under(document, {"binningy"}, source).value_or(1));
  constexpr double kHalf = 0.5;  // from the edge of a pixel to its center
  found.width /= across;
  found.height /= down;
  found.fx /= across;
  found.skew /= across;
  found.cx = (found.cx + kHalf) / across - kHalf;
  found.fy /= down;
  found.cy = (found.cy + kHalf) / down - kHalf;
}

/// ROS' camera_info (from a file or a message), and OpenCV's files.
CameraFile matrix_camera(const json& document, const Member& matrix, const std::string& source) {
  Found found;
  take_size_of_matrix_camera(document, found, source);
  take_matrix(numbers(matrix, source), matrix.name, found, source);
  take_region(document, found, source);
  const Member model = member(document, {"distortionmodel", "cameramodel"});
  const Member fisheye = member(document, {"fisheyemodel", "fisheye"});
  found.is_fisheye =
      is_fisheye_model(model, source) || (fisheye.value != nullptr && *fisheye.value != 0 &&
                                          *fisheye.value != false && *fisheye.value != "0");
  const Member distortion =
      member(document, {"distortioncoefficients", "distcoeffs", "distortioncoeffs", "distcoef",
                        "distortion", "dist", "d", "d1"});
  if (distortion.value != nullptr) found.coefficients = numbers(distortion, source);
  constexpr std::size_t kOfTwoModels = 4;
  if (model.value == nullptr && fisheye.value == nullptr &&
      found.coefficients.size() == kOfTwoModels) {
    throw InputError(Problem{source, "/" + distortion.name, "4 coefficients without a model",
                             "\"distortion_model\": \"equidistant\" for k1, k2, k3, k4 of "
                             "cv::fisheye, or \"plumb_bob\" for k1, k2, p1, p2"});
  }
  return make_camera(found, source);
}

/// A camera model of Kalibr that has two parameters of its own before fx, fy, cx and cy, and no
/// distortion.
struct KalibrModel {
  std::string_view name;
  RadialLens (*lens)(double, double);
};
constexpr std::array kKalibrModels = {KalibrModel{"ds", double_sphere_lens},
                                      KalibrModel{"eucm", extended_unified_lens}};
constexpr std::size_t kOwnParameters = 2;

/// The last four of Kalibr's intrinsics.
void take_intrinsics(const std::vector<double>& intrinsics, std::size_t own_parameters,
                     Found& found, const std::string& source) {
  constexpr std::size_t kFour = 4;
  if (intrinsics.size() != own_parameters + kFour) {
    throw InputError(Problem{source, "/intrinsics", fmt::format("{} numbers", intrinsics.size()),
                             own_parameters == 0 ? "fx, fy, cx and cy"
                                                 : "the two of the model, then fx, fy, cx and cy"});
  }
  found.fx = intrinsics[own_parameters];
  found.fy = intrinsics[own_parameters + 1];
  found.cx = intrinsics[own_parameters + 2];
  found.cy = intrinsics[own_parameters + 3];
}

CameraFile kalibr_camera(const json& camera, const std::string& source) {
  const std::string model = member(camera, {"cameramodel"}).text_or("pinhole");
  const std::string distortion = member(camera, {"distortionmodel"}).text_or("none");
  const Member resolution = member(camera, {"resolution"});
  const std::vector<double> intrinsics = numbers(member(camera, {"intrinsics"}), source);
  Found found;
  take_size({"resolution", resolution.value}, found, source);
  for (const KalibrModel& known : kKalibrModels) {
    if (model != known.name || distortion != "none") continue;
    take_intrinsics(intrinsics, kOwnParameters, found, source);
    return as_fisheye(make_camera(found, source), known.lens(intrinsics[0], intrinsics[1]), source);
  }
  if (model != "pinhole") {
    throw InputError(Problem{source, "/camera_model", fmt::format("{}-{}", model, distortion),
                             "pinhole-radtan, pinhole-equi, pinhole-fov, ds-none or eucm-none"});
  }
  take_intrinsics(intrinsics, 0, found, source);
  const Member listed = member(camera, {"distortioncoeffs"});
  const std::vector<double> coefficients =
      listed.value == nullptr ? std::vector<double>{} : numbers(listed, source);
  if (distortion == "fov" && coefficients.size() == 1) {
    return as_fisheye(make_camera(found, source), fov_lens(coefficients[0]), source);
  }
  found.is_fisheye = is_fisheye_model(member(camera, {"distortionmodel"}), source);
  found.coefficients = coefficients;
  return make_camera(found, source);
}

bool is_kalibr(const json& value) {
  return value.is_object() && member(value, {"intrinsics"}).value != nullptr &&
         member(value, {"cameramodel", "resolution"}).value != nullptr;
}

}  // namespace

std::optional<CameraFile> foreign_camera(const json& document, const std::string& name,
                                         const std::string& source) {
  if (!document.is_object()) return std::nullopt;
  std::vector<std::string> chain;
  for (const auto& [key, value] : document.items()) {
    if (is_kalibr(value) || is_opensfm(value)) chain.push_back(key);
  }
  if (!chain.empty()) {
    const bool has_name = std::find(chain.begin(), chain.end(), name) != chain.end();
    if (has_name || (name.empty() && chain.size() == 1)) {
      const std::string& chosen = has_name ? name : chain.front();
      const std::string its_source = fmt::format("{}#{}", source, chosen);
      const json& camera = document.at(chosen);
      return is_kalibr(camera) ? kalibr_camera(camera, its_source)
                               : opensfm_camera(camera, its_source);
    }
    throw InputError(Problem{
        source, "", name.empty() ? counted(std::ssize(chain), "camera") : fmt::format("#{}", name),
        fmt::format("FILE#NAME with one of: {}", fmt::join(chain, ", "))});
  }
  if (is_kalibr(document)) return kalibr_camera(document, source);
  if (is_opensfm(document)) return opensfm_camera(document, source);
  if (is_camodocal(document)) return camodocal_camera(document, source);
  if (document.contains("model") && document.contains("params")) {
    return colmap_camera(document, source);
  }
  const Member matrix = member(document, {"cameramatrix", "intrinsicmatrix", "k", "k1", "m1"});
  if (matrix.value != nullptr && (matrix.value->is_object() || matrix.value->is_array())) {
    return matrix_camera(document, matrix, source);
  }
  return std::nullopt;
}

}  // namespace throng::calibrate
