// A chessboard in the renderer's world, and cameras that see it: what throng calibrate selftest
// photographs.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

#include "camera/calibration/board.h"
#include "camera/camera.h"
#include "spec/calibration/camera_file.h"
#include "world/scenario.h"

namespace throng::cli {

/// A board of squares of this side (m), upright, high above an empty place.
inline constexpr double kBoardSquareM = 0.25;

/// Writes the board as a mesh (OBJ and its materials) into `folder` and returns the place it is in.
world::Scenario board_place(const std::filesystem::path& folder, const calibrate::Board& board);

/// The board's inner corners in the world, row by row.
std::vector<Eigen::Vector3d> board_corners_in_world(const calibrate::Board& board);

/// Poses from which the camera sees the whole board: near and far, tilted by up to 45 degrees, in
/// all parts of the image. Drawn by the seed.
std::vector<camera::Pose> board_views(const calibrate::CameraFile& camera,
                                      const calibrate::Board& board, int count, std::uint64_t seed);

}  // namespace throng::cli
