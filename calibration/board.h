// Calibration boards in images: chessboards, ChArUco boards and asymmetric grids of circles,
// found by OpenCV.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "base/graphics/images/gray_image.h"
#include "calibration/correspondences.h"
#include "spec/calibration/board.h"

namespace throng::calibrate {

/// Throws InputError naming `source` if the board is impossible: too small, or with an unknown
/// dictionary.
void check_board(const Board& board, const std::string& source);

/// Returns the board's points in an image to a fraction of a pixel; or a problem that says why
/// there are none, for example that the image shows a chessboard of another size. `name` is the
/// image's name in results. The window for the refinement of a corner extends to each side by at
/// most 11 pixels and 0.45 of the distance to the next corner.
std::variant<View, Problem> find_board(const images::GrayImage& image, const Board& board,
                                       const std::string& name);

/// The board's points in the plane z = 0, in the order of detection.
std::vector<Eigen::Vector3d> board_points(const Board& board);

/// Detects the board in all images, using several threads. Excludes images without the board or of
/// another size than the majority. Throws InputError with one problem per image if none is usable,
/// and Cancelled if `on_image`, which is called after each image, returns false.
Correspondences find_boards(const std::vector<std::filesystem::path>& images, const Board& board,
                            const std::function<bool(std::size_t done)>& on_image = {});

}  // namespace throng::calibrate
