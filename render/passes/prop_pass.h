// Renders props (trees, benches, lamp posts, cars, ...), users' meshes, rubble, the leaves of
// hedges and what stands on the land beyond the scenario (PlaceMeshes::props).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "render/frame/view.h"
#include "render/gl/gl_objects.h"
#include "render/props/prop_mesh.h"
#include "render/scenery/place_meshes.h"
#include "spec/render/quality.h"

namespace throng::render {

/// Surfaces with a program of their own, because a software renderer works out every branch of a
/// shader for every pixel.
enum class PropSurface : std::uint8_t { plain, shiny, bark, water, screen };
inline constexpr std::size_t kPropSurfaces = 5;

/// The fragment shader of a solid surface; `words` are light_words() of the environment and more.
Program make_prop_program(PropSurface surface, std::string_view words);

/// The vertex array that describes PropVertex in these buffers.
VertexArray make_prop_array(const Buffer& vertices, const Buffer& indices);

class PropPass {
 public:
  /// `words` are light_words() of the environment.
  PropPass(const std::vector<PlacedProp>& props, std::string_view words,
           const QualitySettings& quality);

  /// Draws the props in view at a time of the run, with their details (PropMesh::far_indices) where
  /// they are near. Expects the same bindings as SceneryPass::draw().
  void draw(const ClipPlanes& planes, double time_s) const;

  /// Draws only the ids and the depth of the same triangles.
  void draw_ids(const ClipPlanes& planes, double time_s) const;

  /// Draws the houses and trees on the land beyond into the color buffer, behind all else: like the
  /// hills on the horizon they change neither ids nor depth. Expects sky and ground to be drawn.
  void draw_backdrop(const ClipPlanes& planes) const;
  /// Whether any of the backdrop may be in view.
  bool sees_backdrop(const ClipPlanes& planes) const { return !backdrop_in(planes).empty(); }

  /// Draws the props whose shadows touch `area` of the ground into the shadow map; `slope` is
  /// shadow_slope().
  void draw_shadow(const Eigen::AlignedBox2d& area, const Eigen::Vector2d& slope,
                   double time_s) const;

 private:
  /// One prop: its bounds and its triangles.
  struct Item {
    Eigen::AlignedBox3d box;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    double radius_m = 0;
    std::array<Range, kPropSurfaces> solid;      ///< near, by PropSurface
    std::array<Range, kPropSurfaces> far_solid;  ///< far away
    Range leaves;
    bool closed = true;        ///< only its outside is visible
    bool casts = true;         ///< throws a shadow
    bool is_backdrop = false;  ///< only colors show it
    double from_s = 0;         ///< absent before this time
  };
  /// Appends a mesh to `vertices` and `indices`.
  void add(const PlacedProp& prop, std::vector<PropVertex>& vertices,
           std::vector<std::uint32_t>& indices);
  /// Draws the props in view, or only their ids.
  void draw_in_view(const ClipPlanes& planes, double time_s, bool only_ids) const;
  /// Draws solid surfaces, or only their ids, with details within kDetailsM of the plane `near`.
  void draw_solid(const std::vector<const Item*>& items, const Eigen::Vector4d& near,
                  bool only_ids) const;
  /// Parts of the backdrop that may be in view.
  std::vector<const Item*> backdrop_in(const ClipPlanes& planes) const;
  template <typename RangeOf>
  void draw_ranges(const Program& program, const std::vector<const Item*>& items,
                   const RangeOf& range_of) const;

  std::vector<Item> items_;
  Buffer vertices_;
  Buffer indices_;
  VertexArray array_;
  std::array<Program, kPropSurfaces> solid_;  ///< by PropSurface; none for absent ones
  Program leaves_;
  Program shadow_;
  Program leaf_shadow_;
  Program solid_ids_;
  Program leaf_ids_;
  Texture leaf_sprites_;
};

}  // namespace throng::render
