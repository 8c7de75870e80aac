// A calibration board as a user describes it.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace throng::calibrate {

/// Range of a board's columns and rows.
inline constexpr int kMinBoardSide = 3;
inline constexpr int kMaxBoardSide = 100;

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

/// Words for the kinds, in their order.
inline constexpr std::array kBoardKinds = {"chessboard", "charuco", "circles"};
/// Dictionaries of markers, in the order of OpenCV's numbers.
inline constexpr std::array kDictionaries = {
    "4X4_50",  "4X4_100",  "4X4_250", "4X4_1000", "5X5_50",        "5X5_100",
    "5X5_250", "5X5_1000", "6X6_50",  "6X6_100",  "6X6_250",       "6X6_1000",
    "7X7_50",  "7X7_100",  "7X7_250", "7X7_1000", "ARUCO_ORIGINAL"};

std::string_view to_string(Board::Kind kind);
/// The inverse of to_string(). Throws InputError naming `source` for any other word.
Board::Kind board_kind_named(std::string_view name, const std::string& source);

}  // namespace throng::calibrate
