// Scene of `throng calibrate selftest`: a chessboard, and cameras that see it.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

#include "calibration/board.h"
#include "camera/camera.h"
#include "spec/calibration/camera_file.h"
#include "world/scenario.h"

namespace throng::cli {

/// Side of the board's squares (m). The board stands upright, high above empty ground.
inline constexpr double kBoardSquareM = 0.25;

/// Writes the board as a mesh (OBJ and its materials) into `folder` and returns its scenario.
world::Scenario board_place(const std::filesystem::path& folder, const calibrate::Board& board);

/// The board's inner corners in the world (m), row by row.
std::vector<Eigen::Vector3d> board_corners_in_world(const calibrate::Board& board);

/// Samples `count` poses from which the camera sees the whole board: near and far, tilted by up to
/// 45 degrees, in all parts of the image. The seed determines them.
std::vector<camera::Pose> board_views(const calibrate::CameraFile& camera,
                                      const calibrate::Board& board, int count, std::uint64_t seed);

}  // namespace throng::cli
