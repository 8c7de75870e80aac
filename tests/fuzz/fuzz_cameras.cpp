// Any camera file of throng, ROS, OpenCV, Kalibr or COLMAP: it is refused, or is a camera whose
// own file is read back.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/error.h"
#include "spec/calibration/camera_file.h"
#include "spec/calibration/foreign/read_camera_file.h"
#include "tests/fuzz/fuzz_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const throng::crowd::fuzz::Folder folder;
  const auto file = folder.write("camera", {reinterpret_cast<const char*>(data), size});
  try {
    const auto camera = to_json(throng::calibrate::read_camera_file(file));
    if (to_json(throng::calibrate::camera_from_json(camera, "")) != camera) std::abort();
  } catch (const throng::InputError&) {
    // Refused.
  }
  return 0;
}
