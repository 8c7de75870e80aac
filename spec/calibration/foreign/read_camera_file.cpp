#include "spec/calibration/foreign/read_camera_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "base/error.h"
#include "base/files/files.h"
#include "spec/calibration/foreign/colmap.h"
#include "spec/calibration/foreign/document.h"
#include "spec/calibration/foreign/foreign_camera.h"

namespace throng::calibrate {

using nlohmann::json;

namespace {

/// A format that throng does not read: texts of which a file has all, and what to give instead.
struct OtherFormat {
  std::string_view name;
  std::array<std::string_view, 2> texts;
  std::string_view instead;
};

constexpr std::array kOtherFormats = {
    OtherFormat{"ROS' .ini", {"[image]", "camera matrix"}, "the .yaml of the same calibration"},
    OtherFormat{"Agisoft Metashape's XML",
                {"<calibration", "<projection>"},
                "its calibration saved as OpenCV's XML"},
    OtherFormat{
        "Agisoft Metashape's XML", {"<chunk", "<camera"}, "its calibration saved as OpenCV's XML"},
    OtherFormat{"Pix4D's camera file", {"Pix4D", ""}, "OpenCV's or COLMAP's file"},
    OtherFormat{"Bundler's file", {"# Bundle file", ""}, "COLMAP's cameras.txt"},
    OtherFormat{"VisualSFM's NVM", {"NVM_V3", ""}, "COLMAP's cameras.txt"},
    OtherFormat{"RealityCapture's XMP", {"xcr:", "<rdf:"}, "COLMAP's cameras.txt"},
    OtherFormat{"NeRF's transforms.json", {"\"camera_angle_x\"", ""}, "COLMAP's cameras.txt"},
    OtherFormat{"NeRF's transforms.json", {"\"fl_x\"", ""}, "COLMAP's cameras.txt"},
    OtherFormat{
        "OpenSfM's reconstruction", {"\"reference_lla\"", "\"cameras\""}, "camera_models.json"},
    OtherFormat{"ORB-SLAM's settings", {"Camera.fx", ""}, "OpenCV's or Kalibr's file"},
    OtherFormat{"ORB-SLAM's settings", {"Camera1.fx", ""}, "OpenCV's or Kalibr's file"},
    OtherFormat{"VINS' settings", {"cam0_calib", ""}, "the file that cam0_calib names"},
    OtherFormat{"Basalt's calibration", {"\"value0\"", "\"intrinsics\""}, "Kalibr's camchain"},
    OtherFormat{"maplab's cameras", {"cameras:", "line-delay-nanoseconds"}, "Kalibr's camchain"}};

void refuse_other_formats(std::string_view text, const std::string& source) {
  for (const OtherFormat& other : kOtherFormats) {
    const bool is_this = std::all_of(other.texts.begin(), other.texts.end(), [&](auto part) {
      return text.find(part) != std::string_view::npos;
    });
    if (is_this) {
      throw InputError(Problem{source, "", std::string(other.name),
                               fmt::format("{} (docs/calibration.md)", other.instead)});
    }
  }
}

}  // namespace

CameraFile read_camera_file(const std::filesystem::path& file) {
  // FILE#NAME is one camera of several.
  const std::string whole = file.string();
  const auto mark = std::filesystem::exists(file) ? std::string::npos : whole.rfind('#');
  const std::string path = whole.substr(0, mark);
  const std::string name = mark == std::string::npos ? "" : whole.substr(mark + 1);
  const std::string text = read_file(path);
  if (const auto camera = read_colmap(text, name, path)) return *camera;
  refuse_other_formats(text, path);
  const json document = read_document(text, path);
  if (const auto camera = foreign_camera(document, name, path)) return *camera;
  if (document.is_object() && !document.contains("lens") && !document.contains("fx")) {
    throw InputError(Problem{path, "", "no camera of a format that throng knows",
                             "a file of throng, ROS, OpenCV, Kalibr, COLMAP, camodocal or OpenSfM "
                             "(docs/calibration.md)"});
  }
  return camera_from_json(document, path);
}

}  // namespace throng::calibrate
