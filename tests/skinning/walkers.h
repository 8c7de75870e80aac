// People with made-up joints and a few vertices, and what their feet do on the ground.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "made_up.h"
#include "skinning/clips.h"
#include "skinning/figure.h"
#include "skinning/plan.h"

namespace throng::skinning {

/// Vertices by which a foot is judged: heel, ball and tip.
using FootMarks = std::array<Vertex, 3>;

inline FootMarks made_up_marks(Side side, float scale = 1) {
  const float y = sign_of(side);
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
inline Population population_of(const std::vector<Walker>& walkers) {
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
      population.palettes.insert(population.palettes.end(), palettes.begin(), palettes.end());
    }
  }
  return population;
}

/// A straight way along +x with this speed, in m/s, at every step.
inline std::vector<Moment> straight_way(std::span<const double> speed_mps, double dt_s) {
  std::vector<Moment> moments(1);
  for (const double speed : speed_mps) {
    Moment next = moments.back();
    next.position.x() += static_cast<float>(speed * dt_s);
    moments.push_back(next);
  }
  return moments;
}

/// Where a vertex of somebody is on the ground of a way, at a step.
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

/// How far, at most, a vertex moves over the ground while it is on it (within 0.5 mm), and how far
/// it ever gets below it.
struct Contact {
  double slide_m = 0;
  double lowest_m = 0;
  int landings = 0;
};

inline Contact contact_of(const Population& population, std::size_t character,
                          const MotionPlan& plan, std::span<const Moment> moments, double from_step,
                          double to_step, const Vertex& vertex) {
  Contact contact;
  bool down = false;
  Eigen::Vector2f low(0, 0);
  Eigen::Vector2f high(0, 0);
  for (double step = from_step; step <= to_step; step += 0.05) {
    const Eigen::Vector3f at = placed(population, character, plan, moments, step, vertex);
    contact.lowest_m = std::min<double>(contact.lowest_m, at.z());
    const bool on_ground = at.z() < 0.0005F;
    if (on_ground && !down) {
      low = high = at.head<2>();
      ++contact.landings;
    }
    if (on_ground) {
      low = low.cwiseMin(at.head<2>());
      high = high.cwiseMax(at.head<2>());
      contact.slide_m = std::max<double>(contact.slide_m, (high - low).norm());
    }
    down = on_ground;
  }
  return contact;
}

}  // namespace throng::skinning
