// A calibration request, from the command line or over HTTP, and its processing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "camera/calibration/board.h"
#include "camera/calibration/calibration.h"
#include "camera/calibration/correspondences.h"
#include "camera/calibration/intrinsics.h"
#include "spec/calibration/request_files.h"

namespace throng::calibrate {

struct Request {
  std::string kind = "intrinsics";            ///< or "pose" or "bundle"
  std::vector<std::filesystem::path> images;  ///< of a board
  Board board;
  std::filesystem::path points;          ///< intrinsics, instead of images: image,i,X,Y,Z,u,v
  std::filesystem::path observations;    ///< pose, bundle: image,point,u,v
  std::filesystem::path control_points;  ///< pose, bundle: point,X,Y,Z[,sd]
  std::optional<ImageSize> size;         ///< of what tables speak of
  /// pose: the lens; bundle: what it starts from.
  std::filesystem::path camera;
  bool fix_lens = false;  ///< bundle: leave the lens as it is
  IntrinsicsOptions options;
};

/// Reads what a client sent; paths are below `folder`, where its files lie. Throws InputError with
/// JSON pointers.
Request request_from_json(const nlohmann::json& value, const std::filesystem::path& folder);

/// Pixels of the largest of the request's images, by their heads: nothing is decoded. 0 without
/// images. Throws InputError for a file that is none, or has more pixels than are decoded.
std::int64_t max_image_pixels(const Request& request);

/// `done` of `total` of the work, and what it is.
using OnProgress = std::function<void(double share, const std::string& what)>;

/// Points that were found in the images, before anything is estimated from them.
using OnFound = std::function<void(const Correspondences&)>;

/// Throws InputError, EnvironmentError (a file cannot be read) and Cancelled (by
/// options.fit.should_continue).
Calibration carry_out(const Request& request, const OnProgress& on_progress = {},
                      const OnFound& on_found = {});

/// Reads folder/request.json, whose files lie in folder/files, and writes the results into the
/// folder, the camera last; the points of images also when nothing can be estimated from them.
/// Throws as carry_out().
void carry_out_in(const std::filesystem::path& folder, const OnProgress& on_progress,
                  const std::function<bool()>& should_continue);

}  // namespace throng::calibrate
