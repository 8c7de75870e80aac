// Draws ground and buildings.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "render/environment.h"
#include "render/gl_objects.h"
#include "render/ground_layers.h"
#include "render/place.h"
#include "render/quality.h"
#include "world/scenario.h"

namespace throng::render {

class PlacePass {
 public:
  /// Throws InputError when the scenario names a ground material that does not exist.
  PlacePass(const world::Scenario& scenario, const Environment& environment,
            const QualitySettings& quality);

  /// Expects the View and Light blocks, the shadow map and the target to be bound.
  void draw() const;

  /// Buildings into the shadow map.
  void draw_shadow() const;

 private:
  void draw_range(const Program& program, const Range& range) const;

  PlaceMesh mesh_;
  std::vector<GroundLayer> layers_;  ///< uppermost first
  Buffer vertices_;
  Buffer indices_;
  VertexArray array_;
  Program walls_;
  Program roofs_;
  Program ground_;
  std::vector<Program> layer_programs_;  ///< one for each of layers_
  Program surroundings_;
  Program shadow_;
};

}  // namespace throng::render
