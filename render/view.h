// The camera's geometry as drawing needs it: clip planes, levels of detail, the View block of
// shaders/view.glsl.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <vector>

#include "camera/camera.h"

namespace throng::render {

/// camera::kNearPlaneM as shaders count; also in shaders/view.glsl.
inline constexpr float kNear = static_cast<float>(camera::kNearPlaneM);

/// Pixels around the image in which triangles are rasterized rather than clipped.
inline constexpr int kGuardBand = 1024;

/// A window of image pixels as GL's viewport sees it.
struct Viewport {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

/// The viewport for drawing into a target of this size: the target and the guard band around it.
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

/// Half-spaces (unit normal inwards, offset) whose intersection is what the camera sees: the four
/// sides and the near plane. A point p is inside one if normal . p + offset >= 0.
using ClipPlanes = std::array<Eigen::Vector4d, 5>;
ClipPlanes clip_planes(const camera::Camera& camera);

/// Whether a sphere is wholly outside one of the planes.
bool is_outside(const ClipPlanes& planes, const Eigen::Vector3d& center, double radius_m);

/// Bounds (m) of the part of the horizontal rectangle `area` at height z that the camera sees;
/// empty if it sees none of it.
Eigen::AlignedBox2d visible_part(const ClipPlanes& planes, const Eigen::AlignedBox2d& area,
                                 double z);

/// Level of detail (skinning/levels.h) for somebody whose standing height covers `height_px`
/// pixels; at most the last of `levels` levels.
std::size_t level_of_detail(double height_px, std::size_t levels);

}  // namespace throng::render
