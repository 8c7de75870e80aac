#include "spec/calibration/foreign/read_camera_file.h"

#include <nlohmann/json.hpp>
#include <string>

#include "base/files/files.h"
#include "spec/calibration/foreign/colmap.h"
#include "spec/calibration/foreign/document.h"
#include "spec/calibration/foreign/foreign_camera.h"

namespace throng::calibrate {

using nlohmann::json;

CameraFile read_camera_file(const std::filesystem::path& file) {
  // FILE#NAME is one camera of several.
  const std::string whole = file.string();
  const auto mark = std::filesystem::exists(file) ? std::string::npos : whole.rfind('#');
  const std::string path = whole.substr(0, mark);
  const std::string name = mark == std::string::npos ? "" : whole.substr(mark + 1);
  const std::string text = read_file(path);
  if (const auto camera = read_colmap(text, name, path)) return *camera;
  const json document = read_document(text, path);
  if (const auto camera = foreign_camera(document, name, path)) return *camera;
  return camera_from_json(document, path);
}

}  // namespace throng::calibrate
