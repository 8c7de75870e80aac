// Renders people with instanced GPU skinning: for the image, into the shadow map, or as bare
// silhouettes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/gl/gl_objects.h"
#include "render/people/people_meshes.h"
#include "render/scene.h"
#include "skinning/population.h"
#include "spec/render/quality.h"

namespace throng::render {

/// How a person's colors come about, the costliest first.
enum class Shading : std::uint8_t {
  textured,        ///< texture and light for each pixel
  lit_by_corners,  ///< texture for each pixel, light for each corner
  by_corners       ///< both for each corner
};

/// One person in one draw.
struct PersonDraw {
  std::uint32_t person = 0;  ///< index into the scene's people
  std::uint32_t level = 0;   ///< of detail
  Shading shading = Shading::by_corners;
  float depth_m = 0;  ///< nearer ones are rendered first
  /// Pixels right and down: from the image to the person's silhouette (Purpose::coverage, and
  /// Purpose::image with silhouettes).
  std::array<std::int32_t, 2> shift = kNowhere;

  /// Leads out of every atlas.
  static constexpr std::array<std::int32_t, 2> kNowhere = {1 << 24, 1 << 24};
};

/// Holds every character's meshes, palettes and textures on the device. Expects the View and Light
/// blocks, the shadow map and the target to be bound.
class PeoplePass {
 public:
  /// `words` are the environment's of render/scenery/lighting.h.
  PeoplePass(const skinning::Population& population, const QualitySettings& quality,
             std::string_view words);

  /// With silhouettes an image's people also leave their whole outlines, hidden or not, in the
  /// image that is bound at unit 0 (render/truth/silhouettes.h).
  enum class Purpose { image, image_and_silhouettes, shadow, coverage };

  /// Renders level by level, near to far within a character. The order is a function of `draws`'
  /// values, so equal scenes give equal pixels.
  void draw(Purpose purpose, std::span<const PersonInstance> people, std::vector<PersonDraw> draws);

  /// The same for a SurfaceTarget; `next` are the people of the next frame (none: no flow), whose
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
  std::vector<Batch> upload(std::span<const PersonInstance> people,
                            const std::vector<PersonDraw>& draws);
  static void draw_batch(const Batch& batch, Range PeopleLevel::*range);
  static void draw_batches(const std::vector<Batch>& batches, Range PeopleLevel::*range);
  struct ImagePrograms {
    std::array<Program, 3> opaque;  ///< by Shading
    Program alpha_tested;
  };
  static ImagePrograms make_image_programs(std::string_view words, bool shadowed,
                                           std::string_view silhouettes);
  static void draw_image(const std::vector<Batch>& batches, const ImagePrograms& programs);
  void bind(const VertexArray& array) const;

  std::uint32_t palettes_per_character_;
  PeopleMeshes meshes_;
  Buffer palettes_;
  Texture palette_texels_;  ///< the same, as shaders read it
  Buffer instances_;
  Buffer next_instances_;
  VertexArray array_;
  VertexArray surface_array_;
  Texture textures_;
  ImagePrograms image_;
  ImagePrograms image_and_silhouettes_;
  Program shadow_;
  Program coverage_;
  Program coverage_alpha_;
  Program surface_;
  Program surface_alpha_;
};

}  // namespace throng::render
