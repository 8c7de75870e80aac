// Renders people by instanced GPU skinning: into the image, the shadow map, or as silhouettes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/gl/gl_objects.h"
#include "render/light/probe_grid.h"
#include "render/people/people_meshes.h"
#include "render/props/scene.h"
#include "skinning/population.h"
#include "spec/render/quality.h"

namespace throng::render {

/// Methods for a person's colors, the most expensive first.
enum class Shading : std::uint8_t {
  textured,        ///< texture and light per pixel
  lit_by_corners,  ///< texture per pixel, light per vertex
  by_corners       ///< texture and light per vertex
};

/// One person in one draw.
struct PersonDraw {
  std::uint32_t person = 0;  ///< index into the scene's people
  std::uint32_t level = 0;   ///< level of detail
  Shading shading = Shading::by_corners;
  float depth_m = 0;  ///< nearer people are rendered first
  /// Offset (pixels, right and down) from the image to the person's silhouette in the atlas
  /// (Purpose::coverage and Purpose::truth).
  std::array<std::int32_t, 2> shift = kNowhere;

  /// An offset outside of every atlas.
  static constexpr std::array<std::int32_t, 2> kNowhere = {1 << 24, 1 << 24};
};

/// The place at which a person's light is taken: about at the hips, 1 m above the feet.
inline Eigen::Vector3f light_point(const Eigen::Vector3f& feet) {
  return feet + Eigen::Vector3f::UnitZ();
}

/// Owns the meshes, palettes and textures of all characters on the device. Draws expect the View
/// and Light blocks, the shadow map and the target to be bound.
class PeoplePass {
 public:
  /// People take the light of `air`, which must outlive this object. `words` are light_words() of
  /// the environment. With `color_apart` images are rendered on their own, and Purpose::truth
  /// writes no colors.
  PeoplePass(const skinning::Population& population, const ProbeGrid& air,
             const QualitySettings& quality, std::string_view words, bool color_apart);

  const PeopleMeshes& meshes() const { return meshes_; }

  /// truth also writes the people's whole silhouettes, visible or occluded, to the
  /// atlas that is bound to image unit 0 (render/truth/silhouettes.h).
  enum class Purpose { image, truth, shadow, coverage };

  /// Renders level by level, from near to far within a character. The order depends only on the
  /// values of `draws`, so that equal scenes give equal pixels.
  void draw(Purpose purpose, std::span<const PersonInstance> people, std::vector<PersonDraw> draws);

  /// Renders into a SurfaceTarget. `next` are the people of the next frame (empty: no flow), whose
  /// View block is expected at binding point 2.
  void draw_surfaces(std::span<const PersonInstance> people, std::vector<PersonDraw> draws,
                     std::span<const PersonInstance> next);

 private:
  /// People rendered by one call.
  struct Batch {
    const PeopleLevel* level;
    Shading shading;
    std::uint32_t first;
    std::uint32_t count;
  };

  void sort(std::span<const PersonInstance> people, std::vector<PersonDraw>& draws) const;
  void upload_next(std::span<const PersonInstance> people, const std::vector<PersonDraw>& draws,
                   std::span<const PersonInstance> next);
  void load_textures(const skinning::Population& population);
  /// `is_lit`: with the light around each person.
  std::vector<Batch> upload(std::span<const PersonInstance> people,
                            const std::vector<PersonDraw>& draws, bool is_lit);
  static void draw_batch(const Batch& batch, Range PeopleLevel::*range);
  static void draw_batches(const std::vector<Batch>& batches, Range PeopleLevel::*range);
  struct ImagePrograms {
    std::array<Program, 3> opaque;  ///< by Shading
    Program alpha_tested;
  };
  static ImagePrograms make_image_programs(std::string_view words, bool shadowed,
                                           std::string_view outputs);
  static void draw_image(const std::vector<Batch>& batches, const ImagePrograms& programs);
  void bind(const VertexArray& array) const;

  const ProbeGrid& air_;
  std::uint32_t palettes_per_character_;
  PeopleMeshes meshes_;
  Buffer palettes_;
  Texture palette_texels_;  ///< view of `palettes_` for shaders
  Buffer instances_;
  Buffer next_instances_;
  VertexArray array_;
  VertexArray surface_array_;
  Texture textures_;
  ImagePrograms image_;
  ImagePrograms truth_;
  Program shadow_;
  Program coverage_;
  Program coverage_alpha_;
  Program surface_;
  Program surface_alpha_;
};

}  // namespace throng::render
