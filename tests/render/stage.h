// A small place, a renderer on the CPU and views of it, shared by the tests on pixels.
#pragma once

#include <cmath>
#include <vector>

#include "base/geometry/angle.h"
#include "render/renderer.h"
#include "tests/render/synthetic_people.h"

namespace throng::render {

/// A building with an axis-aligned footprint and nothing on it.
inline world::Building block(double min_x, double max_x, double min_y, double max_y,
                             double height_m) {
  world::Building building;
  building.id = "block";
  building.footprint = {{min_x, min_y}, {max_x, min_y}, {max_x, max_y}, {min_x, max_y}};
  building.height_m = height_m;
  building.facade = world::Facade::blank;
  return building;
}

/// 80 x 80 m of concrete around the origin.
inline world::Scenario open_ground(std::vector<world::Building> buildings = {}) {
  world::Scenario scenario;
  scenario.id = "test";
  scenario.ground = {{-40, -40}, {40, 40}};
  scenario.ground_material = "concrete";
  scenario.buildings = std::move(buildings);
  return scenario;
}

inline camera::Camera camera_at(const Eigen::Vector3d& center, double yaw_deg, double pitch_deg,
                                int width = 320, int height = 240, double hfov_deg = 60) {
  return {camera::intrinsics_from_hfov(width, height, hfov_deg * kDegree),
          camera::pose_looking(center, yaw_deg * kDegree, pitch_deg * kDegree)};
}

inline std::size_t pixel_index(const Frame& frame, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width()) +
         static_cast<std::size_t>(x);
}

/// Pixels with one id, and their bounds.
struct Mask {
  std::uint64_t pixels = 0;
  Eigen::AlignedBox2d box;  ///< box coordinates
};

inline Mask instance_mask(const Frame& frame, std::uint32_t id) {
  Mask mask;
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      if (frame.id[pixel_index(frame, x, y)] != id) continue;
      ++mask.pixels;
      mask.box.extend(Eigen::Vector2d(x, y));
      mask.box.extend(Eigen::Vector2d(x + 1, y + 1));
    }
  }
  return mask;
}

inline const PersonInView& find_person(const Frame& frame, std::uint32_t agent) {
  for (const PersonInView& person : frame.people) {
    if (person.agent == agent) return person;
  }
  throw std::out_of_range("agent is not in view");
}

/// Sum of the color channels of a pixel.
inline int brightness(const Frame& frame, int x, int y) {
  const std::size_t i = pixel_index(frame, x, y) * 3;
  return frame.rgb[i] + frame.rgb[i + 1] + frame.rgb[i + 2];
}

/// A renderer of `scenario` on the CPU, with the population it renders.
class Stage {
 public:
  explicit Stage(world::Scenario scenario, Environment lighting = {},
                 const RenderOptions& options = {},
                 skinning::Population people = synthetic_people())
      : scenario_(std::move(scenario)),
        people_(std::move(people)),
        renderer_(scenario_, people_, lighting, {"software"}, options) {}

  const skinning::Population& people() const { return people_; }
  Renderer& renderer() { return renderer_; }

  PersonInstance standing(std::uint32_t agent, double x, double y, double yaw_rad = 0) const {
    return render::standing(people_, agent, x, y, yaw_rad);
  }

  Frame draw(const camera::Camera& camera, std::vector<PersonInstance> people = {}) {
    Scene scene;
    scene.people = std::move(people);
    return renderer_.draw(scene, camera);
  }

 private:
  world::Scenario scenario_;
  skinning::Population people_;
  Renderer renderer_;
};

/// Somebody in the middle of a step: `phase` of a stride.
inline PersonInstance stepping(const Stage& stage, std::uint32_t agent, const Eigen::Vector2d& at,
                               double yaw_rad, double phase) {
  PersonInstance person = stage.standing(agent, at.x(), at.y(), yaw_rad);
  const skinning::Clip& walk = stage.people().clips[1];
  const double position = phase * walk.frames;
  const auto frame = static_cast<std::uint32_t>(position);
  person.pose = {walk.first + frame % walk.frames, walk.first + (frame + 1) % walk.frames,
                 static_cast<float>(position - frame)};
  return person;
}

/// Share of the pixels of either mask that are in both: `agent`'s pixels of `frame` carried along
/// the flow, against those of `next`. Carried pixels spread, so each fills a 3 x 3 block of
/// quarters.
inline double carried_overlap(const Frame& frame, const Frame& next, std::uint32_t agent) {
  const std::uint32_t id = id_of_agent(agent);
  std::vector<char> carried(frame.id.size(), 0);
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      const std::size_t i = pixel_index(frame, x, y);
      if (frame.id[i] != id) continue;
      for (const double dy : {-0.4, 0.0, 0.4}) {
        for (const double dx : {-0.4, 0.0, 0.4}) {
          const auto to_x = static_cast<int>(std::lround(x + dx + frame.flow[i * 2]));
          const auto to_y = static_cast<int>(std::lround(y + dy + frame.flow[i * 2 + 1]));
          if (to_x < 0 || to_y < 0 || to_x >= frame.width() || to_y >= frame.height()) continue;
          carried[pixel_index(frame, to_x, to_y)] = 1;
        }
      }
    }
  }
  double both = 0;
  double either = 0;
  for (std::size_t i = 0; i < carried.size(); ++i) {
    const bool there = next.id[i] == id;
    both += there && carried[i] != 0 ? 1 : 0;
    either += there || carried[i] != 0 ? 1 : 0;
  }
  return both / either;
}

}  // namespace throng::render
