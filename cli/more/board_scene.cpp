#include "cli/more/board_scene.h"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>

#include "base/compute/random.h"
#include "base/error.h"
#include "base/files/files.h"

namespace throng::cli {

using Eigen::Vector3d;

namespace {

/// Position of the board's first inner corner.
const Vector3d& board_origin() {
  static const Vector3d origin(0, 0, 8);
  return origin;
}

/// Columns: the board's x (along a row), y (down) and z (away from who reads it) in the world.
Eigen::Matrix3d board_axes() {
  Eigen::Matrix3d axes;
  axes << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  return axes;
}

/// A point of the board's plane, in squares from its first inner corner, in the world.
Vector3d on_board(double column, double row) {
  return board_origin() + board_axes() * (kBoardSquareM * Vector3d(column, row, 0));
}

/// Squares with one of white around them: black where both count even or both odd.
bool is_black(int column, int row, const calibrate::Board& board) {
  const bool inside = column >= 0 && row >= 0 && column <= board.columns && row <= board.rows;
  return inside && (column + row) % 2 == 0;
}

bool sees_board(const camera::Camera& camera, const calibrate::Board& board) {
  constexpr double kMargin = 2;  // squares beyond the inner corners: the outer squares and white
  constexpr double kBorderPx = 4;
  for (const double column : {-kMargin, 0.5 * (board.columns - 1), board.columns - 1 + kMargin}) {
    for (const double row : {-kMargin, 0.5 * (board.rows - 1), board.rows - 1 + kMargin}) {
      const auto seen = camera.project(on_board(column, row));
      const bool inside = seen.visible && seen.pixel.minCoeff() > kBorderPx &&
                          seen.pixel.x() < camera.intrinsics.width - 1 - kBorderPx &&
                          seen.pixel.y() < camera.intrinsics.height - 1 - kBorderPx;
      if (!inside) return false;
    }
  }
  return true;
}

}  // namespace

world::Scenario board_place(const std::filesystem::path& folder, const calibrate::Board& board) {
  std::string faces[2];  // white, black
  std::string vertices;
  int count = 0;
  for (int row = -1; row <= board.rows + 1; ++row) {
    for (int column = -1; column <= board.columns + 1; ++column) {
      std::string& list = faces[is_black(column, row, board) ? 1 : 0];
      // Square (0, 0) lies before the first inner corner. Files have y up and z toward the reader.
      for (const auto& [x, y] :
           {std::pair(0, 1), std::pair(1, 1), std::pair(1, 0), std::pair(0, 0)}) {
        vertices += fmt::format("v {} {} 0\n", kBoardSquareM * (column + x - 1),
                                -kBoardSquareM * (row + y - 1));
      }
      list += fmt::format("f {} {} {} {}\n", count + 1, count + 2, count + 3, count + 4);
      count += 4;
    }
  }
  write_file_atomically(folder / "board.mtl",
                        "newmtl white\nKd 0.8 0.8 0.8\nnewmtl black\nKd 0.03 0.03 0.03\n");
  write_file_atomically(folder / "board.obj",
                        fmt::format("mtllib board.mtl\n{}usemtl white\n{}usemtl black\n{}",
                                    vertices, faces[0], faces[1]));
  world::Scenario scenario;
  scenario.id = "calibration_board";
  constexpr double kReach = 30;
  scenario.ground = {{-kReach, -kReach}, {kReach, kReach}};
  scenario.ground_material = "concrete";
  scenario.meshes.push_back({folder / "board.obj", board_origin(), 0, 1});
  return scenario;
}

std::vector<Vector3d> board_corners_in_world(const calibrate::Board& board) {
  std::vector<Vector3d> corners;
  for (int row = 0; row < board.rows; ++row) {
    for (int column = 0; column < board.columns; ++column) {
      corners.push_back(on_board(column, row));
    }
  }
  return corners;
}

std::vector<camera::Pose> board_views(const calibrate::CameraFile& camera,
                                      const calibrate::Board& board, int count,
                                      std::uint64_t seed) {
  constexpr std::uint64_t kMaxAttempts = 200'000;
  constexpr double kTilt = std::numbers::pi / 4;
  constexpr double kRoll = 0.3;
  const camera::Intrinsics lens = camera.intrinsics();
  const Vector3d middle = on_board(0.5 * (board.columns - 1), 0.5 * (board.rows - 1));
  const double width = kBoardSquareM * (board.columns + 3);
  std::vector<camera::Pose> poses;
  for (std::uint64_t i = 0; i < kMaxAttempts && static_cast<int>(poses.size()) < count; ++i) {
    Random random(seed, Stream::camera_noise, i);
    const Eigen::Matrix3d turn =
        (Eigen::AngleAxisd(random.uniform(-kTilt, kTilt), Vector3d::UnitX()) *
         Eigen::AngleAxisd(random.uniform(-kTilt, kTilt), Vector3d::UnitY()) *
         Eigen::AngleAxisd(random.uniform(-kRoll, kRoll), Vector3d::UnitZ()))
            .toRotationMatrix();
    const auto direction =
        lens.direction_of({random.uniform(0, lens.width), random.uniform(0, lens.height)});
    const double share = random.uniform(0.5, 0.95);  // of the image's width that the board takes
    const double depth = width * lens.fx_px / (share * lens.width);
    if (!direction) continue;
    camera::Pose pose;
    pose.R = turn * board_axes().transpose();
    pose.t = depth * direction->homogeneous() - pose.R * middle;
    if (pose.center().z() > 1 && sees_board({lens, pose}, board)) poses.push_back(pose);
  }
  if (static_cast<int>(poses.size()) < count) {
    throw InputError(Problem{"throng calibrate selftest", "",
                             "a camera that does not see the board",
                             "a lens that shows a whole board in its image"});
  }
  return poses;
}

}  // namespace throng::cli
