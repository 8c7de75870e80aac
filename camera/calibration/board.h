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

struct Board {
  enum class Kind { chessboard, charuco, circles };
  Kind kind = Kind::chessboard;
  /// Inner corners of a chessboard, squares of a ChArUco board, circles of a grid (of which every
  /// other row is shifted by half a distance).
  int columns = 9;
  int rows = 6;
  /// Side of a square; of circles: half the distance between two of one row. Translations have the
  /// same unit.
  double square = 1;
  double marker = 0;                  ///< ChArUco: side of a marker; 0: 0.75 squares
  std::string dictionary = "4X4_50";  ///< ChArUco: OpenCV's name without DICT_
};

std::string_view to_string(Board::Kind kind);
/// Throws InputError naming `source` for any other word.
Board::Kind board_kind_named(std::string_view name, const std::string& source);

/// Throws InputError naming `source` for a board that cannot be: too small, or of a dictionary that
/// is not there.
void check_board(const Board& board, const std::string& source);

/// The board's points in an image, to a fraction of a pixel, or why there are none (also: which
/// size of chessboard is there instead). The window that a corner is refined in is adapted to the
/// board's size in the image: at most 11 pixels to each side, and 0.45 of the distance to the
/// next corner.
std::variant<View, Problem> find_board(const images::GrayImage& image, const Board& board,
                                       const std::string& name);

/// The board's points in the plane z = 0, in the order in which they are found.
std::vector<Eigen::Vector3d> board_points(const Board& board);

/// Looks for the board in all images, several at once. Images of another size than most have,
/// or without the board, are left out. Throws InputError with one problem per image when none can
/// be used; Cancelled when `on_image` (called after each) says false.
Correspondences find_boards(const std::vector<std::filesystem::path>& images, const Board& board,
                            const std::function<bool(std::size_t done)>& on_image = {});

}  // namespace throng::calibrate
