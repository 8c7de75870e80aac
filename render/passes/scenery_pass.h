// Renders ground and buildings.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "render/gl/gl_objects.h"
#include "render/scenery/place_meshes.h"
#include "spec/render/environment.h"
#include "spec/render/quality.h"
#include "world/scenario.h"

namespace throng::render {

class SceneryPass {
 public:
  /// Throws InputError if the scenario names an unknown ground material.
  SceneryPass(const PlaceMeshes& meshes, const world::Scenario& scenario,
              const Environment& environment, const QualitySettings& quality);

  /// Draws ground and buildings. Expects the View and Light blocks, the shadow map and the target
  /// to be bound.
  void draw() const;

  /// Draws only the ids and the depth of the same triangles.
  void draw_ids() const;

  /// Draws buildings into the shadow map.
  void draw_shadow() const;

 private:
  /// Shader and texture of a material; drafts, strips and paint need no texture.
  struct Look {
    Program program;
    Texture texture;
  };
  /// A part of a range, and the program that draws it.
  struct Part {
    Program program;
    Range range;
  };
  /// Makes the look of a material unless it exists.
  void learn(const std::string& material, std::string_view shader, std::string_view words,
             const QualitySettings& quality);
  void draw_ground(const std::string& material, const Range& range) const;
  void draw_range(const Program& program, const Range& range) const;

  Range wall_range_;
  Range roof_range_;
  Range ground_range_;
  Range surroundings_range_;
  Range decal_range_;
  std::vector<GroundLayer> layers_;  ///< uppermost first
  Buffer vertices_;
  Buffer indices_;
  VertexArray array_;
  std::vector<Part> parts_;            ///< walls and roofs
  std::vector<Part> decals_;           ///< none for drafts
  std::map<std::string, Look> looks_;  ///< by the ground's material
  std::string material_;               ///< material of the ground that no layer covers
  Program shadow_;
  Program ids_;
};

}  // namespace throng::render
