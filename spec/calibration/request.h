// A calibration request as a client writes it; calibration/request.h carries it out.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "spec/calibration/board.h"
#include "spec/calibration/image_size.h"
#include "spec/calibration/options.h"

namespace throng::calibrate {

/// A calibration with its input files and options.
struct Request {
  std::string name;                           ///< of the camera in ROS' file; "": "camera"
  std::string kind = "intrinsics";            ///< "intrinsics", "pose" or "bundle"
  std::vector<std::filesystem::path> images;  ///< intrinsics: images of a board
  Board board;
  std::filesystem::path points;          ///< intrinsics, instead of images: table image,i,X,Y,Z,u,v
  std::filesystem::path observations;    ///< pose, bundle: table image,point,u,v
  std::filesystem::path control_points;  ///< pose, bundle: table point,X,Y,Z[,sd]
  std::optional<ImageSize> size;         ///< size of the images to which the tables refer
  /// File of a camera (spec/calibration/camera_file.h). pose: the lens; bundle: its initial values.
  std::filesystem::path camera;
  bool fix_lens = false;  ///< bundle: do not estimate the lens
  IntrinsicsOptions options;
};

/// Reads the fields of a request whose files are in `folder`. Adds a problem with its JSON pointer
/// for each mistake. Fields that belong together are not checked.
Request read_request_fields(const nlohmann::json& value, const std::filesystem::path& folder,
                            std::vector<Problem>& problems);

/// The JSON Schema of a request.
nlohmann::ordered_json request_schema();

}  // namespace throng::calibrate
