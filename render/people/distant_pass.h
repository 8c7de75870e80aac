// People in the distance, painted by the CPU and lit by the device.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "camera/camera.h"
#include "render/frame/pixel_weights.h"
#include "render/gl/gl_objects.h"
#include "render/light/probe_grid.h"
#include "render/people/distant_mesh.h"
#include "render/people/distant_painter.h"
#include "render/people/people_in_view.h"
#include "render/people/people_meshes.h"
#include "render/props/scene.h"
#include "skinning/population.h"

namespace throng::render {

class DistantPass {
 public:
  /// `population` and `air` must outlive this object; `words` are as in PeoplePass.
  DistantPass(const skinning::Population& population, const PeopleMeshes& meshes,
              const ProbeGrid& air, bool shadowed, std::string_view words);

  /// Ground truth that is measured while people are painted.
  struct Measured {
    bool areas = true;
    const PixelWeights* weights = nullptr;  ///< as in DrawChoice
    bool masks = false;                     ///< of whole people
  };

  /// Paints those of the people in view who are in the distance and wholly within the image, and
  /// sets their Seen::is_painted, their areas and masks. `sun` is the direction toward the sun.
  void paint(const Scene& scene, const camera::Camera& camera, const Eigen::Vector3f& sun,
             const Measured& measured, std::vector<Seen>& seen);

  /// Draws what was painted last into a Target. Expects the View and Light blocks and the shadow
  /// map to be bound.
  void draw() const;

 private:
  void upload();

  const skinning::Population* population_;
  const ProbeGrid* air_;
  std::vector<DistantMesh> meshes_;  ///< by character
  DistantPainter painter_;
  Texture pixels_;
  int texture_width_ = 0;
  int texture_height_ = 0;
  Buffer corners_;
  VertexArray array_;
  GLsizei corner_count_ = 0;
  Program program_;
};

}  // namespace throng::render
