// Calibration boards in images: chessboards, ChArUco boards and asymmetric grids of circles,
// found by OpenCV.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/graphics/images/gray_image.h"
#include "camera/calibration/correspondences.h"

namespace throng::calibrate {

/// A calibration board.
struct Board {
  enum class Kind { chessboard, charuco, circles };
  Kind kind = Kind::chessboard;
  /// Number of inner corners of a chessboard, of squares of a ChArUco board, of circles of a grid
  /// (every other row of which is shifted by half the distance of its circles).
  int columns = 9;
  int rows = 6;
  /// Side of a square, or half the distance between neighboring circles of a row. Its unit is the
  /// unit of the estimated translations.
  double square = 1;
  double marker = 0;  ///< ChArUco: side of a marker, in the unit of `square`; 0: 0.75 squares
  std::string dictionary = "4X4_50";  ///< ChArUco: OpenCV's name without DICT_
};

std::string_view to_string(Board::Kind kind);
/// The inverse of to_string(). Throws InputError naming `source` for any other word.
Board::Kind board_kind_named(std::string_view name, const std::string& source);

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
