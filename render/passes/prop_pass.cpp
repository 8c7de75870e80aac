#include "render/passes/prop_pass.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <functional>
#include <string>

#include "render/gl/color_only.h"
#include "render/gl/shaders.h"
#include "render/props/leaf_sprites.h"
#include "render/props/letter_sprites.h"

namespace throng::render {

namespace {

using embedded::shader_light;

constexpr std::string_view kNoShadows = "#define NO_SHADOWS\n";
constexpr std::string_view kNoSun = "#define NO_SUN\n";
constexpr std::string_view kLeaves = "#define LEAVES\n";
constexpr GLuint kLeafUnit = 5;  // also in shaders/prop.frag.glsl

/// Props that are farther from the camera are drawn without details.
constexpr double kDetailsM = 55;

PropSurface choose_surface(Finish finish) {
  switch (finish) {
    case Finish::glossy:
    case Finish::lit_glass:
      return PropSurface::shiny;
    case Finish::bark:
      return PropSurface::bark;
    case Finish::water:
      return PropSurface::water;
    case Finish::screen:
      return PropSurface::screen;
    default:
      return PropSurface::plain;
  }
}

/// The triangles of a mesh that share a program, in the order of PropMesh::indices.
struct Triangles {
  std::vector<std::uint32_t> indices;
  std::size_t only_far = 0;
  std::size_t far_count = 0;
};

/// The triangles of a mesh whose vertices start at `base`, by PropSurface; leaves come last.
std::array<Triangles, kPropSurfaces + 1> sort_triangles(const PropMesh& mesh, std::uint32_t base) {
  std::array<Triangles, kPropSurfaces + 1> sorted;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const auto finish = static_cast<Finish>(mesh.vertices[mesh.indices[i]].paint[3]);
    Triangles& triangles = finish == Finish::leaves
                               ? sorted.back()
                               : sorted.at(static_cast<std::size_t>(choose_surface(finish)));
    for (std::size_t k = i; k < i + 3; ++k) triangles.indices.push_back(base + mesh.indices[k]);
    if (i < mesh.only_far) triangles.only_far = triangles.indices.size();
    if (i < mesh.far_indices) triangles.far_count = triangles.indices.size();
  }
  return sorted;
}

Texture make_leaf_sprites() {
  Texture texture = make_texture(GL_TEXTURE_2D_ARRAY);
  const GLuint name = texture.name();
  const int levels = std::bit_width(static_cast<unsigned>(kLeafTexels));
  glTextureStorage3D(name, levels, GL_RG8, kLeafTexels, kLeafTexels, kLeafSprites + kLetterSheets);
  glTextureParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  for (int sprite = 0; sprite < kLeafSprites + kLetterSheets; ++sprite) {
    const auto shown = sprite < kLeafSprites ? draw_leaf_sprite(static_cast<LeafSprite>(sprite))
                                             : draw_letter_sheet(sprite - kLeafSprites);
    for (int level = 0; level < levels; ++level) {
      const int size = kLeafTexels >> level;
      glTextureSubImage3D(name, level, 0, 0, sprite, size, size, 1, GL_RG, GL_UNSIGNED_BYTE,
                          shown.at(static_cast<std::size_t>(level)).data());
    }
  }
  return texture;
}

}  // namespace

void PropPass::add(const PlacedProp& prop, std::vector<PropVertex>& vertices,
                   std::vector<std::uint32_t>& indices) {
  const PropMesh& mesh = prop.mesh;
  Eigen::AlignedBox3d bounds;
  for (const PropVertex& vertex : mesh.vertices) {
    bounds.extend(Eigen::Vector3f(vertex.position.data()).cast<double>());
  }
  const auto base = static_cast<std::uint32_t>(vertices.size());
  Item& item = items_.emplace_back();
  item.box = bounds;
  item.middle = bounds.center();
  item.radius_m = 0.5 * bounds.diagonal().norm();
  const auto sorted = sort_triangles(mesh, base);
  const auto append = [&](const Triangles& triangles) {
    const Range range{static_cast<std::uint32_t>(indices.size()),
                      static_cast<std::uint32_t>(triangles.indices.size())};
    indices.insert(indices.end(), triangles.indices.begin(), triangles.indices.end());
    return range;
  };
  for (std::size_t i = 0; i < kPropSurfaces; ++i) {
    const Range all = append(sorted.at(i));
    const auto only_far = static_cast<std::uint32_t>(sorted.at(i).only_far);
    item.solid.at(i) = {all.first + only_far, all.count - only_far};
    item.far_solid.at(i) = {all.first, static_cast<std::uint32_t>(sorted.at(i).far_count)};
  }
  item.leaves = append(sorted.back());
  item.closed = prop.closed;
  item.casts = prop.casts;
  item.is_backdrop = prop.is_backdrop;
  item.from_s = prop.from_s;
  vertices.insert(vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
}

Program make_prop_program(PropSurface surface, std::string_view words) {
  constexpr std::array<std::string_view, kPropSurfaces> kSurfaceWords = {
      "", "#define SHINY\n", "#define BARK\n", "#define WATER\n", "#define SCREEN\n"};
  return make_program(
      {embedded::shader_view, embedded::shader_prop_vert},
      {words, kSurfaceWords.at(static_cast<std::size_t>(surface)), shader_light,
       embedded::shader_noise, embedded::shader_screen, embedded::shader_prop_frag});
}

VertexArray make_prop_array(const Buffer& vertices, const Buffer& indices) {
  VertexArray array = make_vertex_array();
  describe_vertices(array, 0, vertices, sizeof(PropVertex), 0,
                    {{0, 3, GL_FLOAT, false, offsetof(PropVertex, position)},
                     {1, 3, GL_FLOAT, false, offsetof(PropVertex, normal)},
                     {2, 2, GL_FLOAT, false, offsetof(PropVertex, card)},
                     {3, 4, GL_UNSIGNED_BYTE, true, offsetof(PropVertex, paint)},
                     {4, 1, GL_UNSIGNED_INT, false, offsetof(PropVertex, id)},
                     {5, 3, GL_FLOAT, false, offsetof(PropVertex, light)}});
  glVertexArrayElementBuffer(array.name(), indices.name());
  return array;
}

PropPass::PropPass(const std::vector<PlacedProp>& props, std::string_view words,
                   const QualitySettings& quality) {
  std::vector<PropVertex> vertices;
  std::vector<std::uint32_t> indices;
  for (const PlacedProp& prop : props) add(prop, vertices, indices);
  if (items_.empty()) return;
  vertices_ = make_buffer(vertices);
  indices_ = make_buffer(indices);
  array_ = make_prop_array(vertices_, indices_);
  const std::string_view shadows = quality.shadow_texels > 0 ? "" : kNoShadows;
  const std::string_view sun = words.find(kNoSun) == std::string_view::npos ? "" : kNoSun;
  for (std::size_t i = 0; i < kPropSurfaces; ++i) {
    if (std::none_of(items_.begin(), items_.end(),
                     [&](const Item& item) { return item.solid.at(i).count > 0; })) {
      continue;
    }
    solid_.at(i) =
        make_prop_program(static_cast<PropSurface>(i), std::string(words).append(shadows));
  }
  leaves_ = make_program(
      {sun, shadows, kLeaves, shader_light, embedded::shader_view, embedded::shader_prop_vert},
      {words, shadows, kLeaves, shader_light, embedded::shader_prop_frag});
  shadow_ = make_program({shader_light, embedded::shader_scenery_shadow_vert}, {});
  leaf_shadow_ = make_program({shader_light, embedded::shader_leaf_shadow_vert},
                              {embedded::shader_leaf_shadow_frag});
  solid_ids_ = make_program({embedded::shader_view, embedded::shader_prop_vert},
                            {embedded::shader_ids_frag});
  leaf_ids_ = make_program({kNoShadows, kLeaves, embedded::shader_view, embedded::shader_prop_vert},
                           {embedded::shader_leaf_ids_frag});
  if (std::any_of(items_.begin(), items_.end(),
                  [](const Item& item) { return item.leaves.count > 0; })) {
    leaf_sprites_ = make_leaf_sprites();
  }
  check_gl("loading props");
}

template <typename RangeOf>
void PropPass::draw_ranges(const Program& program, const std::vector<const Item*>& items,
                           const RangeOf& range_of) const {
  std::vector<GLsizei> counts;
  std::vector<const void*> offsets;
  for (const Item* item : items) {
    const Range& triangles = std::invoke(range_of, *item);
    if (triangles.count == 0) continue;
    counts.push_back(static_cast<GLsizei>(triangles.count));
    const std::size_t offset = triangles.first * sizeof(std::uint32_t);
    offsets.push_back(reinterpret_cast<const void*>(offset));  // NOLINT(performance-no-int-to-ptr)
  }
  if (counts.empty()) return;
  glUseProgram(program.name());
  glMultiDrawElements(GL_TRIANGLES, counts.data(), GL_UNSIGNED_INT, offsets.data(),
                      static_cast<GLsizei>(counts.size()));
}

void PropPass::draw_solid(const std::vector<const Item*>& items, const Eigen::Vector4d& near,
                          bool only_ids) const {
  for (std::size_t i = 0; i < kPropSurfaces; ++i) {
    draw_ranges(only_ids ? solid_ids_ : solid_.at(i), items, [&](const Item& item) {
      const double distance_m = near.head<3>().dot(item.middle) + near.w();
      return distance_m > kDetailsM ? item.far_solid.at(i) : item.solid.at(i);
    });
  }
}

void PropPass::draw(const ClipPlanes& planes, double time_s) const {
  draw_in_view(planes, time_s, false);
}

void PropPass::draw_ids(const ClipPlanes& planes, double time_s) const {
  draw_in_view(planes, time_s, true);
}

void PropPass::draw_in_view(const ClipPlanes& planes, double time_s, bool only_ids) const {
  std::vector<const Item*> closed;
  std::vector<const Item*> open;
  for (const Item& item : items_) {
    if (time_s < item.from_s || item.is_backdrop || is_outside(planes, item.box)) continue;
    (item.closed ? closed : open).push_back(&item);
  }
  if (closed.empty() && open.empty()) return;
  // Near props hide far ones, which then cost little.
  const Eigen::Vector4d& near = planes.back();
  std::stable_sort(closed.begin(), closed.end(), [&](const Item* a, const Item* b) {
    return near.head<3>().dot(a->middle) < near.head<3>().dot(b->middle);
  });
  glBindVertexArray(array_.name());
  glEnable(GL_CULL_FACE);
  draw_solid(closed, near, only_ids);
  glDisable(GL_CULL_FACE);
  draw_solid(open, near, only_ids);
  glBindTextureUnit(kLeafUnit, leaf_sprites_.name());
  draw_ranges(only_ids ? leaf_ids_ : leaves_, closed, &Item::leaves);
}

std::vector<const PropPass::Item*> PropPass::backdrop_in(const ClipPlanes& planes) const {
  std::vector<const Item*> parts;
  for (const Item& item : items_) {
    if (item.is_backdrop && !is_outside(planes, item.box)) parts.push_back(&item);
  }
  return parts;
}

void PropPass::draw_backdrop(const ClipPlanes& planes) const {
  std::vector<const Item*> parts = backdrop_in(planes);
  if (parts.empty()) return;
  const Eigen::Vector4d& near = planes.back();
  std::stable_sort(parts.begin(), parts.end(), [&](const Item* a, const Item* b) {
    return near.head<3>().dot(a->middle) < near.head<3>().dot(b->middle);
  });
  const ColorOnly guard;
  glDepthMask(GL_TRUE);  // its houses and trees hide each other
  glBindVertexArray(array_.name());
  glEnable(GL_CULL_FACE);
  draw_solid(parts, near, false);
  glDisable(GL_CULL_FACE);
  glBindTextureUnit(kLeafUnit, leaf_sprites_.name());
  draw_ranges(leaves_, parts, &Item::leaves);
}

void PropPass::draw_shadow(const Eigen::AlignedBox2d& area, const Eigen::Vector2d& slope,
                           double time_s) const {
  std::vector<const Item*> casters;
  for (const Item& item : items_) {
    if (time_s < item.from_s || !item.casts) continue;
    const Eigen::Vector2d middle = item.middle.head<2>();
    Eigen::AlignedBox2d shade(middle);
    shade.extend(Eigen::Vector2d(middle - slope * (item.middle.z() + item.radius_m)));
    shade = {shade.min().array() - item.radius_m, shade.max().array() + item.radius_m};
    if (shade.intersects(area)) casters.push_back(&item);
  }
  if (casters.empty()) return;
  glBindVertexArray(array_.name());
  glDisable(GL_CULL_FACE);
  for (std::size_t i = 0; i < kPropSurfaces; ++i) {
    draw_ranges(shadow_, casters, [&](const Item& item) { return item.far_solid.at(i); });
  }
  glBindTextureUnit(kLeafUnit, leaf_sprites_.name());
  draw_ranges(leaf_shadow_, casters, &Item::leaves);
}

}  // namespace throng::render
