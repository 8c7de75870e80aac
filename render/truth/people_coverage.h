// How much of each person in view is visible, and how much would be if nothing hid them: areas and
// masks of whole silhouettes.
#pragma once

#include <vector>

#include "camera/camera.h"
#include "render/frame/frame.h"
#include "render/frame/pixel_weights.h"
#include "render/people/people_in_view.h"
#include "render/people/people_pass.h"
#include "render/props/scene.h"
#include "render/truth/coverage.h"
#include "render/truth/silhouettes.h"

namespace throng::render {

class PeopleCoverage {
 public:
  /// Reserves a tile for each person wholly within the image who has not been painted
  /// (DistantPass, which measures them), as far as there is room, and
  /// binds the atlas of tiles for PeoplePass::Purpose::truth.
  void prepare(const camera::Camera& camera, std::vector<Seen>& seen);

  /// Sets the areas (px, by `weights` unless null) and, with `whole_masks`, the masks of whole
  /// people, after they were rendered into `frame`; those without a tile are rendered again.
  /// Boxes of `seen` are limited to the pixels `measured`.
  void measure(PeoplePass& pass, const Scene& scene, const Frame& frame,
               const Eigen::AlignedBox2i& measured, const PixelWeights* weights, bool whole_masks,
               std::vector<Seen>& seen);

 private:
  Silhouettes silhouettes_;
  CoverageCounter counter_;
};

}  // namespace throng::render
