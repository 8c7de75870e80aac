// The scenario as triangles: ground, plain around it, walls and roofs. No GL here.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "world/scenario.h"

namespace throng::render {

/// Walls lower than this have no stories, windows or lamps (m); also in shaders/wall.frag.glsl.
inline constexpr double kMinStoryM = 2.6;

struct SceneryVertex {
  std::array<float, 3> position{};  ///< m
  std::array<float, 3> normal{};
  /// Walls: along the wall, up, wall length, wall height. Roofs: from the corner of the roof's
  /// bounds, then their size. In meters. Ground: ground_tone_at().
  std::array<float, 4> local{};
  float openness = 1;    ///< share of the sky's light that reaches the ground here, 0 to 1
  std::uint32_t id = 0;  ///< what the id buffer gets
  float facade = 0;      ///< walls: number of the world::Facade or WallLook
};

/// A run of triangles that share a shader.
struct Range {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

struct SceneryMesh {
  std::vector<SceneryVertex> vertices;
  std::vector<std::uint32_t> indices;  ///< counter-clockwise seen from outside
  Range walls;
  Range roofs;
  Range ground;
  Range surroundings;  ///< the plain beyond the ground's edge, to the horizon
};

SceneryMesh scenery_mesh(const world::Scenario& scenario);

/// Share of a uniform sky's light that reaches a point on the ground between the buildings.
float openness_at(const world::Scenario& scenario, const Eigen::Vector2d& point);

/// How bright the ground is at a point, compared with its material's mean: dirt and wear that no
/// texture repeats.
float ground_tone_at(const Eigen::Vector2d& point);

/// Height of the tallest building or prop, but at least of a person with raised arms (m).
double tallest_m(const world::Scenario& scenario);

}  // namespace throng::render
