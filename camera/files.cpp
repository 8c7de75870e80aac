#include "camera/files.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

namespace throng::camera {

namespace {

using Model = Distortion::Model;

// Always with a point, so that readers that go by looks see a floating-point number.
std::string real(double value) {
  const std::string text = fmt::format("{}", value);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

std::string join_numbers(const std::vector<double>& values) {
  std::vector<std::string> words;
  words.reserve(values.size());
  for (const double value : values) words.push_back(real(value));
  return fmt::format("{}", fmt::join(words, ", "));
}

std::vector<double> intrinsic_matrix(const Intrinsics& k) {
  return {k.fx_px, k.skew_px, k.cx_px, 0, k.fy_px, k.cy_px, 0, 0, 1};
}

std::string opencv_matrix(const char* name, int rows, int cols, const std::vector<double>& data) {
  return fmt::format("{}: !!opencv-matrix\n   rows: {}\n   cols: {}\n   dt: d\n   data: [ {} ]\n",
                     name, rows, cols, join_numbers(data));
}

std::string ros_matrix(const char* name, int rows, int cols, const std::vector<double>& data) {
  return fmt::format("{}:\n  rows: {}\n  cols: {}\n  data: [{}]\n", name, rows, cols,
                     join_numbers(data));
}

}  // namespace

RosLens ros_lens(const Intrinsics& k) {
  if (!k.distortion) return {"plumb_bob", std::vector<double>(5, 0)};
  const auto& c = k.distortion->coefficients();
  if (k.distortion->model() == Model::fisheye) return {"equidistant", {c.begin(), c.begin() + 4}};
  const bool rational = std::any_of(c.begin() + 5, c.end(), [](double v) { return v != 0; });
  if (rational) return {"rational_polynomial", {c.begin(), c.end()}};
  return {"plumb_bob", {c.begin(), c.begin() + 5}};
}

std::string opencv_yaml(const Intrinsics& k) {
  const RosLens lens = ros_lens(k);
  const auto columns = static_cast<int>(lens.coefficients.size());
  return fmt::format("%YAML:1.0\n---\nimage_width: {}\nimage_height: {}\n", k.width, k.height) +
         opencv_matrix("camera_matrix", 3, 3, intrinsic_matrix(k)) +
         fmt::format("distortion_model: {}\n", lens.model) +
         opencv_matrix("distortion_coefficients", 1, columns, lens.coefficients);
}

std::string ros_yaml(const Intrinsics& k, const std::string& camera_name) {
  const RosLens lens = ros_lens(k);
  const auto columns = static_cast<int>(lens.coefficients.size());
  return fmt::format("image_width: {}\nimage_height: {}\ncamera_name: {}\n", k.width, k.height,
                     camera_name) +
         ros_matrix("camera_matrix", 3, 3, intrinsic_matrix(k)) +
         fmt::format("distortion_model: {}\n", lens.model) +
         ros_matrix("distortion_coefficients", 1, columns, lens.coefficients) +
         ros_matrix("rectification_matrix", 3, 3, {1, 0, 0, 0, 1, 0, 0, 0, 1}) +
         ros_matrix("projection_matrix", 3, 4,
                    {k.fx_px, k.skew_px, k.cx_px, 0, 0, k.fy_px, k.cy_px, 0, 0, 0, 1, 0});
}

}  // namespace throng::camera
