// Visible people of a scene: their level of detail, and which measurements are made on the CPU.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "camera/camera.h"
#include "render/frame.h"
#include "render/people/body_boxes.h"
#include "render/people/people_pass.h"
#include "render/people/person_geometry.h"
#include "render/scene.h"
#include "skinning/landmarks.h"
#include "skinning/population.h"
#include "spec/render/quality.h"

namespace throng::render {

/// A sphere about a person's middle, as a share of stature, that holds any pose.
inline constexpr double kPersonReach = 1.2;

/// A person who may be in view, and what was measured so far.
struct Seen {
  PersonDraw draw;
  /// Else only their umbrella touches the image: they are rendered, but not among the frame's
  /// people.
  bool is_listed = true;
  PersonInView truth;
  std::optional<std::size_t> tile;  ///< of their silhouette
};

class PeopleFinder {
 public:
  /// The population must outlive it.
  PeopleFinder(const skinning::Population& population, const QualitySettings& quality);

  /// Everybody whose box, or whose umbrella's, touches the image of a pinhole camera, by agent:
  /// with box, body, level of detail and whether they are rendered with textures. A pure function
  /// of the arguments, but not for several threads at once.
  std::vector<Seen> find(const Scene& scene, const camera::Camera& camera) const;

  /// Places on a character's head, as boxes of heads of people drawn at this level are taken from.
  std::span<const SkinPoint> head_points(std::uint32_t character, std::size_t level) const;

  /// How somebody is rendered into the shadow map, which shows no more than the coarsest level.
  PersonDraw caster(std::uint32_t person, const PersonInstance& instance) const;

 private:
  Shading shading_of(std::size_t level) const;
  PersonDraw draw_of(std::uint32_t person, double height_px, double depth_m,
                     std::size_t levels) const;
  void measure(const PersonInstance& person, const skinning::Palette& palette,
               PersonInView& truth) const;
  void texture_the_nearest(std::vector<Seen>& seen) const;

  const skinning::Population* population_;
  QualitySettings quality_;
  std::vector<std::vector<BodyShape>> bodies_;     ///< [character][level]
  std::vector<std::vector<BodyShape>> umbrellas_;  ///< the same; without points where there is none
  std::vector<skinning::Landmarks> landmarks_;     ///< per character
  mutable std::vector<BodyBoxes> boxes_;           ///< per character; they keep what they found
};

}  // namespace throng::render
