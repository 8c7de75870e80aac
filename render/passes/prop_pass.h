// Renders trees, benches, lamp posts, cars and the like, the meshes of users, and rubble.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string_view>
#include <vector>

#include "render/gl/gl_objects.h"
#include "render/props/prop_shapes.h"
#include "render/scenery/scenery.h"
#include "render/view.h"
#include "spec/render/quality.h"
#include "world/scenario.h"

namespace throng::render {

/// How the device reads PropVertex from these buffers.
VertexArray make_prop_array(const Buffer& vertices, const Buffer& indices);

class PropPass {
 public:
  /// `words` are the environment's of render/scenery/lighting.h. Throws InputError for a mesh file
  /// that cannot be read.
  PropPass(const world::Scenario& scenario, std::string_view words, const QualitySettings& quality,
           bool semantic);

  /// The props that the camera may see at a time of the run. Expects what SceneryPass::draw()
  /// expects.
  void draw(const ClipPlanes& planes, double time_s) const;

  /// The props whose shade touches `area` of the ground, into the shadow map; `slope` is
  /// shadow_slope().
  void draw_shadow(const Eigen::AlignedBox2d& area, const Eigen::Vector2d& slope,
                   double time_s) const;

 private:
  /// One prop: a sphere that holds it and its triangles.
  struct Item {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    double radius_m = 0;
    Range solid;
    Range leaves;
    bool closed = true;  ///< only its outside can be seen
    double from_s = 0;   ///< not there before
  };
  /// Adds a mesh to the buffers in the making.
  Item& add(const PropMesh& mesh, bool closed, std::vector<PropVertex>& vertices,
            std::vector<std::uint32_t>& indices);
  void draw_ranges(const Program& program, const std::vector<const Item*>& items,
                   Range Item::*range) const;

  std::vector<Item> items_;
  Buffer vertices_;
  Buffer indices_;
  VertexArray array_;
  Program solid_;
  Program leaves_;
  Program shadow_;
};

}  // namespace throng::render
