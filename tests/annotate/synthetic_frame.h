// Frames without a renderer: people are ellipses and rectangles painted over each other.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "base/compute/random.h"
#include "render/frame/frame.h"

namespace throng::annotate {

struct SyntheticScene {
  int width = 160;
  int height = 120;
  int people = 20;
  double min_size_px = 1;  ///< of a person's width; people are up to three times as tall as wide
  double max_size_px = 40;
  std::uint64_t seed = 1;
};

/// An empty frame: ground below, sky in the top quarter, a camera that looks down on the ground.
inline render::Frame empty_frame(int width, int height) {
  render::Frame frame;
  frame.camera.intrinsics = camera::intrinsics_from_hfov(width, height, 1.3);
  frame.camera.pose = camera::pose_looking({0.3, -0.7, 12.1}, 0.4, -0.9);
  const auto pixels = static_cast<std::size_t>(width) * height;
  frame.rgb.resize(3 * pixels);
  frame.id.assign(pixels, render::kIdGround);
  std::fill_n(frame.id.begin(), static_cast<std::size_t>(width) * (height / 4), render::kIdNothing);
  for (std::size_t i = 0; i < frame.rgb.size(); ++i) {
    frame.rgb[i] = static_cast<std::uint8_t>(90 + (i / 3 % width) * 60 / width + i % 3 * 20);
  }
  return frame;
}

/// Paints people in the order of their ids, each over those before. Some leave the image, some end
/// up hidden altogether; both stay in Frame::people. Their ground positions project to the middle
/// of their amodal boxes' lower edge.
inline render::Frame synthetic_frame(const SyntheticScene& scene) {
  render::Frame frame = empty_frame(scene.width, scene.height);
  for (int i = 0; i < scene.people; ++i) {
    Random random(scene.seed, Stream::crowd_generator, i);
    const double rx = 0.5 * random.uniform(scene.min_size_px, scene.max_size_px);
    const double ry = rx * random.uniform(1, 3);
    const double cx = random.uniform(-rx, scene.width + rx);
    const double cy = random.uniform(-ry, scene.height + ry);
    const bool is_box = random.below(4) == 0;
    render::PersonInView person;
    person.agent = static_cast<std::uint32_t>(i * 2);  // ids have gaps: not everybody is in view
    person.amodal_box = {Eigen::Vector2d(cx - rx, cy - ry), Eigen::Vector2d(cx + rx, cy + ry)};
    person.hips = frame.camera.unproject({cx - 0.5, cy + ry - 0.5}, 9 + 0.01 * i);
    person.position = person.hips;
    person.head = frame.camera.unproject({cx - 0.5, cy - 0.8 * ry - 0.5}, 8.5 + 0.01 * i);
    person.velocity = {random.normal(0, 1), random.normal(0, 1)};
    const int top = std::max(0, static_cast<int>(cy - ry));
    const int bottom = std::min(scene.height - 1, static_cast<int>(cy + ry));
    const int left = std::max(0, static_cast<int>(cx - rx));
    const int right = std::min(scene.width - 1, static_cast<int>(cx + rx));
    for (int y = top; y <= bottom; ++y) {
      for (int x = left; x <= right; ++x) {
        const double u = (x + 0.5 - cx) / rx;
        const double v = (y + 0.5 - cy) / ry;
        if (is_box ? std::max(std::abs(u), std::abs(v)) > 1 : u * u + v * v > 1) continue;
        frame.id[static_cast<std::size_t>(y) * scene.width + x] = render::id_of_agent(person.agent);
        ++person.amodal_area_px;
      }
    }
    if (person.amodal_area_px > 0) frame.people.push_back(person);
  }
  return frame;
}

}  // namespace throng::annotate
