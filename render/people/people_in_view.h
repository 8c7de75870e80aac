// Finds the people of a scene within the view, chooses their levels of detail, and measures their
// ground truth on the CPU.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "camera/camera.h"
#include "render/frame/frame.h"
#include "render/people/body_boxes.h"
#include "render/people/people_pass.h"
#include "render/people/person_geometry.h"
#include "render/props/scene.h"
#include "skinning/landmarks.h"
#include "skinning/population.h"
#include "spec/render/quality.h"

namespace throng::render {

/// Radius of a sphere around a person's center that contains any pose, as a share of stature.
inline constexpr double kPersonReach = 1.2;

/// A person in view, with the ground truth measured so far.
struct Seen {
  PersonDraw draw;
  bool is_painted = false;  ///< by DistantPass
  /// False if only the umbrella is within the image: the person is rendered, but not listed in
  /// Frame::people.
  bool is_listed = true;
  PersonInView truth;
  std::optional<std::size_t> tile;  ///< tile of the silhouette
};

/// Finds the people in view.
class PeopleFinder {
 public:
  /// `population` must outlive this object.
  /// `bone_turns`: measures these of people, too.
  PeopleFinder(const skinning::Population& population, const QualitySettings& quality,
               bool bone_turns = false);

  /// The people whose box, or whose umbrella's box, intersects the image of a pinhole camera, or
  /// comes within `margin_px` of it and lies in `measured`, by agent, with their boxes, levels of
  /// detail and shading. Boxes are limited to the pixels `measured`. Depends only on the arguments,
  /// but is not thread-safe.
  std::vector<Seen> find(const Scene& scene, const camera::Camera& camera,
                         const Eigen::AlignedBox2i& measured, int margin_px = 0) const;

  /// The points of a character's head from which the head boxes of people at this level are
  /// computed.
  std::span<const SkinPoint> head_points(std::uint32_t character, std::size_t level) const;

  /// Whether a person's shadow is drawn: of people on stands only if they are near.
  bool casts_shadow(const PersonInstance& instance, const camera::Camera& camera) const;
  /// The draw of a person into the shadow map: two levels finer than the coarsest, with a head and
  /// feet, where the camera would see a standing person kFineShadowPx tall or taller.
  PersonDraw caster(std::uint32_t person, const PersonInstance& instance,
                    const camera::Camera& camera) const;

 private:
  Shading shading_of(std::size_t level) const;
  PersonDraw draw_of(std::uint32_t person, double height_px, double depth_m,
                     std::size_t levels) const;
  void measure(const PersonInstance& person, const Stance& stance, const skinning::Palette& palette,
               PersonInView& truth) const;
  void texture_the_nearest(std::vector<Seen>& seen) const;

  const skinning::Population* population_;
  QualitySettings quality_;
  bool bone_turns_;
  std::vector<std::vector<BodyShape>> bodies_;  ///< [character][level]
  /// [character][level]; without points if there is none.
  std::vector<std::vector<BodyShape>> umbrellas_;
  std::vector<skinning::Landmarks> landmarks_;  ///< per character
  mutable std::vector<BodyBoxes> boxes_;        ///< per character; mutable for their caches
};

}  // namespace throng::render
