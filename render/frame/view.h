// The camera's geometry for rendering: clip planes, levels of detail, the View block of
// shaders/view.glsl.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <vector>

#include "camera/camera.h"

namespace throng::render {

/// camera::kNearPlaneM as float; also in shaders/view.glsl.
inline constexpr float kNear = static_cast<float>(camera::kNearPlaneM);

/// Width (px) of the band around the image in which triangles are rasterized instead of clipped.
inline constexpr int kGuardBand = 1024;

/// The arguments of glViewport().
struct Viewport {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

/// The viewport for a target of this size: the target and the guard band around it.
Viewport guarded_viewport(int width, int height);

/// The View uniform block (std140).
struct ViewBlock {
  std::array<float, 4> right{};
  std::array<float, 4> down{};
  std::array<float, 4> forward{};
  std::array<float, 4> center{};
  std::array<float, 4> focal{};
  std::array<float, 4> viewport{};
};

ViewBlock view_block(const camera::Camera& camera, const Viewport& viewport);

/// Half-spaces (inward unit normal, offset) whose intersection is the camera's view: the four sides
/// and the near plane. A point p is inside a half-space if normal . p + offset >= 0.
using ClipPlanes = std::array<Eigen::Vector4d, 5>;
ClipPlanes clip_planes(const camera::Camera& camera);

/// Whether a sphere is completely outside of one of the half-spaces.
bool is_outside(const ClipPlanes& planes, const Eigen::Vector3d& center, double radius_m);

/// Whether a box along the axes is completely outside of one of the half-spaces.
bool is_outside(const ClipPlanes& planes, const Eigen::AlignedBox3d& box);

/// Bounds (m) of the visible part of the horizontal rectangle `area` at height `z`; empty if none
/// is visible.
Eigen::AlignedBox2d visible_part(const ClipPlanes& planes, const Eigen::AlignedBox2d& area,
                                 double z);

/// Level of detail (skinning/levels.h) of a person whose standing height in the image is
/// `height_px`; at most `levels` - 1.
std::size_t level_of_detail(double height_px, std::size_t levels);

}  // namespace throng::render
