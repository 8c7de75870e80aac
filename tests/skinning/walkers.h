// People with made-up joints and a few vertices, and what their feet do on the ground.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "skinning/animate/clips.h"
#include "skinning/animate/figure.h"
#include "skinning/animate/plan.h"
#include "tests/skinning/made_up.h"

namespace throng::skinning {

/// Vertices by which a foot is judged: heel, ball and tip.
using FootMarks = std::array<Vertex, 3>;

inline FootMarks made_up_marks(Side side, float scale = 1) {
  const float y = side_sign(side);
  const Bone foot = on(side, Bone::left_foot);
  const Bone toe = on(side, Bone::left_toe);
  return {made_up_vertex(scale * Eigen::Vector3f(-0.06F, y * 0.08F, 0), foot, foot, 0),
          made_up_vertex(scale * Eigen::Vector3f(0.14F, y * 0.09F, 0), toe, toe, 0),
          made_up_vertex(scale * Eigen::Vector3f(0.2F, y * 0.09F, 0), toe, toe, 0)};
}

/// A walker of 1.8 m times `scale`.
inline Walker made_up_walker(float scale = 1) {
  Walker walker{made_up_joints(), 1.8F * scale, {}, {}, {}};
  for (Eigen::Vector3f& joint : walker.joints) joint *= scale;
  for (const Side side : kSides) {
    for (const Vertex& vertex : made_up_marks(side, scale)) walker.soles.push_back(vertex);
  }
  // Round limbs: points around every joint.
  for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
    for (const Eigen::Vector3f& offset :
         {Eigen::Vector3f(0.05F, 0, 0), Eigen::Vector3f(-0.05F, 0, 0), Eigen::Vector3f(0, 0.05F, 0),
          Eigen::Vector3f(0, -0.05F, 0), Eigen::Vector3f(0, 0, 0.02F)}) {
      const auto named = static_cast<Bone>(bone);
      walker.body.push_back(made_up_vertex(walker.joints[bone] + scale * offset, named, named, 0));
    }
  }
  walker.body.insert(walker.body.end(), walker.soles.begin(), walker.soles.end());
  return walker;
}

/// One character for each walker, with the standard clips.
inline Population make_population(const std::vector<Walker>& walkers) {
  Population population;
  population.clips = standard_clips();
  population.palettes_per_character =
      population.clips.back().first + population.clips.back().frames;
  for (const Walker& walker : walkers) {
    Character& character = population.characters.emplace_back();
    character.stature_m = walker.stature_m;
    character.age_years = static_cast<float>(walker.manner.age_years);
    for (const Clip& clip : population.clips) {
      const std::vector<Palette> palettes = bake_clip(walker, clip);
      population.palettes.append(palettes);
    }
  }
  return population;
}

/// A straight trajectory along +x with this speed, in m/s, at every step.
inline std::vector<Moment> straight_trajectory(std::span<const double> speed_mps, double dt_s) {
  std::vector<Moment> moments(1);
  for (const double speed : speed_mps) {
    Moment next = moments.back();
    next.position.x() += static_cast<float>(speed * dt_s);
    moments.push_back(next);
  }
  return moments;
}

/// Ground position of a person's vertex along a trajectory, at a step.
inline Eigen::Vector3f placed(const Population& population, std::size_t character,
                              const MotionPlan& plan, std::span<const Moment> moments, double step,
                              const Vertex& vertex) {
  const PoseBlend pose = plan.at(step);
  const Eigen::Vector3f model = skin(vertex, population.palette(character, pose.a),
                                     population.palette(character, pose.b), pose.blend);
  const auto before = std::min(static_cast<std::size_t>(step), moments.size() - 1);
  const std::size_t after = std::min(before + 1, moments.size() - 1);
  const auto share = static_cast<float>(step - static_cast<double>(before));
  const float yaw = moments[before].yaw_rad +
                    share * static_cast<float>(std::remainder(
                                moments[after].yaw_rad - moments[before].yaw_rad, 2 * 3.14159265));
  Eigen::Vector3f world = turn_z(yaw) * model;
  world.head<2>() +=
      moments[before].position + share * (moments[after].position - moments[before].position);
  return world;
}

/// How far, at most, a vertex moves over the ground while it is on it, how low it ever is, and how
/// often it comes down.
struct Contact {
  double slide_m = 0;
  double lowest_m = 1;
  int landings = 0;
};

/// On the ground is what is within `near_m` of it, or of the vertex's own lowest place when that is
/// higher; `trim` of each contact is left out at both ends, where a foot comes and goes.
inline Contact find_contact(const Population& population, std::size_t character,
                            const MotionPlan& plan, std::span<const Moment> moments,
                            double from_step, double to_step, const Vertex& vertex,
                            float near_m = 0.0005F, double trim = 0) {
  std::vector<Eigen::Vector3f> path;
  Contact contact;
  for (double step = from_step; step <= to_step; step += 0.05) {
    path.push_back(placed(population, character, plan, moments, step, vertex));
    contact.lowest_m = std::min<double>(contact.lowest_m, path.back().z());
  }
  const float ground_m = std::max(static_cast<float>(contact.lowest_m), 0.0F) + near_m;
  for (std::size_t begin = 0; begin < path.size(); ++begin) {
    if (path[begin].z() >= ground_m) continue;
    std::size_t end = begin;
    while (end < path.size() && path[end].z() < ground_m) ++end;
    const auto left_out = static_cast<std::size_t>(trim * static_cast<double>(end - begin));
    Eigen::Vector2f low = path[begin + left_out].head<2>();
    Eigen::Vector2f high = low;
    for (std::size_t i = begin + left_out; i < end - left_out; ++i) {
      low = low.cwiseMin(path[i].head<2>());
      high = high.cwiseMax(path[i].head<2>());
    }
    contact.slide_m = std::max<double>(contact.slide_m, (high - low).norm());
    ++contact.landings;
    begin = end;
  }
  return contact;
}

}  // namespace throng::skinning
