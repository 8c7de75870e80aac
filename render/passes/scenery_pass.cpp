#include "render/passes/scenery_pass.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "render/buildings/building_mesh.h"
#include "render/buildings/facade_style.h"
#include "render/gl/color_only.h"
#include "render/gl/shaders.h"
#include "render/ground/ground_decals.h"
#include "render/ground/ground_texture.h"
#include "render/scenery/land_pattern.h"
#include "render/scenery/lighting.h"

namespace throng::render {

namespace {

using embedded::shader_light;
using embedded::shader_noise;
using embedded::shader_scenery_vert;
using embedded::shader_view;

/// Below this the shadows on the ground are so long that texels of the shadow map show.
constexpr double kLowSunRad = 0.6;

constexpr GLuint kGroundUnit = 3;  // also in shaders/ground.frag.glsl

std::string_view choose_shader(const std::string& material, const world::Scenario& scenario) {
  const std::array<std::pair<std::string_view, std::string_view>, 10> materials = {{
      {"pavers", embedded::shader_ground_pavers},
      {"asphalt", embedded::shader_ground_asphalt},
      {"grass", embedded::shader_ground_grass},
      {"concrete", embedded::shader_ground_concrete},
      {"dirt", embedded::shader_ground_dirt},
      {"kerb", embedded::shader_ground_kerb},
      {"paint", embedded::shader_ground_paint},
      {"setts", embedded::shader_ground_setts},
      {"gutter", embedded::shader_ground_setts},
      {"tactile", embedded::shader_ground_tactile},
  }};
  for (const auto& [name, text] : materials) {
    if (name == material) return text;
  }
  throw InputError(Problem{scenario.id, "ground material", '"' + material + '"',
                           R"("pavers", "asphalt", "grass", "concrete" or "dirt")"});
}

/// A surface's own shader on top of light and noise.
Program make_scenery_program(std::string_view words, std::string_view surface,
                             std::string_view more = "") {
  return make_program({shader_view, shader_scenery_vert},
                      {words, shader_light, shader_noise, surface, more});
}

constexpr std::string_view kWideFilter = "#define WIDE_FILTER\n";
constexpr std::string_view kTextured = "#define TEXTURED\n";
constexpr std::string_view kStrip = "#define STRIP\n";
constexpr std::string_view kDecal = "#define DECAL\n";
constexpr std::string_view kNoPuddles = "#define NO_PUDDLES\n";
/// Grass and earth follow no grid, so that a second, turned look-up hides how their texture
/// repeats; at their edges there is bare soil, or grass grows in.
constexpr std::string_view kGrass =
    "#define NO_PUDDLES\n#define EDGE_ALBEDO vec3(0.19, 0.155, 0.10)\n";
constexpr std::string_view kDirt = "#define EDGE_ALBEDO vec3(0.115, 0.155, 0.052)\n";
constexpr std::string_view kPlain = "surroundings";

/// Whether a ground's pattern is looked up rather than worked out for each pixel: those that are
/// small or follow no tile are not.
bool is_baked(std::string_view material) {
  return !is_strip(material) && material != "paint" && material != kPlain;
}

/// The paint of facades and roofs, in the words of a ground; windows darken walls.
constexpr std::string_view kWallAlbedo =
    "layout(location = 6) in vec4 paint;\n"
    "vec3 ground_albedo(vec2 p, vec2 width) { return 0.8 * paint.rgb; }\n";
constexpr std::string_view kRoofAlbedo =
    "layout(location = 6) in vec4 paint;\n"
    "vec3 ground_albedo(vec2 p, vec2 width) { return paint.rgb; }\n";

// Surfaces whose triangles have programs of their own, because a software renderer works out every
// branch of a shader for every pixel: the words that choose the program of a triangle.

std::string_view wall_words(const SceneryVertex& vertex) {
  const auto is = [&](auto look) { return vertex.facade == static_cast<float>(look); };
  if (is(world::Facade::glass)) return "#define GLASS\n";
  if (is(world::Facade::screen) || is(WallLook::open_door) || is(WallLook::closed_door) ||
      is(WallLook::gable) || is(WallLook::brick_gable) || is(WallLook::glazing)) {
    return "";
  }
  if (is(world::Facade::hedge) || is(world::Facade::blank) ||
      vertex.local[3] < static_cast<float>(kMinStoryM)) {
    return "#define PLAIN\n";
  }
  constexpr std::uint8_t kShops = 0x80;
  return (vertex.paint[3] & kShops) != 0 ? "#define STORIES\n#define SHOPS\n" : "#define STORIES\n";
}

std::string_view roof_words(const SceneryVertex& vertex) {
  const auto is = [&](world::Covering look) { return vertex.facade == static_cast<float>(look); };
  return is(world::Covering::tiles) || is(world::Covering::slate) ? "#define LAPPED\n" : "";
}

std::string_view decal_words(const SceneryVertex& vertex) {
  switch (static_cast<DecalKind>(vertex.facade)) {
    case DecalKind::stain:
    case DecalKind::tires:
    case DecalKind::tracks:
    case DecalKind::wet:
    case DecalKind::shade:
      return "#define DARKENS\n";
    case DecalKind::leaves:
    case DecalKind::litter:
    case DecalKind::gum:
    case DecalKind::daisies:
    case DecalKind::weeds:
      return "#define SMALL\n";
    default:
      return "";
  }
}

/// Brings triangles of a range together that have the same words; returns the words' ranges.
std::map<std::string_view, Range> sort_triangles(const std::vector<SceneryVertex>& vertices,
                                                 const Range& range,
                                                 std::string_view (*words)(const SceneryVertex&),
                                                 std::vector<std::uint32_t>& indices) {
  std::map<std::string_view, std::vector<std::uint32_t>> parts;
  for (std::size_t i = range.first; i < range.first + range.count; i += 3) {
    std::vector<std::uint32_t>& part = parts[words(vertices[indices[i]])];
    part.insert(part.end(), &indices[i], &indices[i] + 3);
  }
  std::map<std::string_view, Range> ranges;
  std::uint32_t first = range.first;
  for (const auto& [name, part] : parts) {
    ranges[name] = {first, static_cast<std::uint32_t>(part.size())};
    std::copy(part.begin(), part.end(), indices.begin() + first);
    first += ranges[name].count;
  }
  return ranges;
}

Program make_corners_program(std::string_view words, std::string_view material) {
  return make_program({words, shader_view, shader_light, shader_noise, embedded::shader_ground_tile,
                       material, embedded::shader_scenery_corners_vert},
                      {embedded::shader_silhouette, embedded::shader_corners_frag});
}

/// Tells the land around the scenario where this is, and how much of it is built over.
void tell_place(const Program& program, const world::Scenario& scenario) {
  const world::Rectangle& ground = scenario.ground;
  const GLint where = glGetUniformLocation(program.name(), "place");
  const Eigen::Vector4f corners(
      static_cast<float>(ground.min.x()), static_cast<float>(ground.min.y()),
      static_cast<float>(ground.max.x()), static_cast<float>(ground.max.y()));
  if (where >= 0) glProgramUniform4fv(program.name(), where, 1, corners.data());
  const GLint built = glGetUniformLocation(program.name(), "built_share");
  if (built >= 0) {
    glProgramUniform1f(program.name(), built, static_cast<float>(built_share(scenario)));
  }
}

}  // namespace

SceneryPass::SceneryPass(const PlaceMeshes& meshes, const world::Scenario& scenario,
                         const Environment& environment, const QualitySettings& quality)
    : wall_range_(meshes.scenery.walls),
      roof_range_(meshes.scenery.roofs),
      ground_range_(meshes.scenery.ground),
      surroundings_range_(meshes.scenery.surroundings),
      decal_range_(meshes.scenery.decals),
      layers_(meshes.layers),
      vertices_(make_buffer(meshes.scenery.vertices)),
      array_(make_vertex_array()),
      material_(scenario.ground_material),
      shadow_(make_program({shader_light, embedded::shader_scenery_shadow_vert}, {})),
      ids_(make_program({shader_view, shader_scenery_vert}, {embedded::shader_ids_frag})) {
  const std::string words =
      light_words(environment, scenario.disasters).append(shadow_words(quality));
  const std::string ground_words =
      words + std::string(environment.sun_elevation_rad < kLowSunRad ? kWideFilter : "");
  std::vector<std::uint32_t> indices = meshes.scenery.indices;
  if (quality.textured) {
    using Words = std::string_view (*)(const SceneryVertex&);
    const auto add = [&](const Range& range, Words part_words, const std::string& all_words,
                         std::string_view surface, std::string_view more, std::vector<Part>& to) {
      for (const auto& [own, part] :
           sort_triangles(meshes.scenery.vertices, range, part_words, indices)) {
        to.push_back({make_scenery_program(all_words + std::string(own), surface, more), part});
      }
    };
    const std::string wide = words + std::string(kWideFilter);
    const std::string wall = facade_words() + std::string(embedded::shader_wall_frag);
    add(wall_range_, wall_words, wide, embedded::shader_screen, wall, parts_);
    add(roof_range_, roof_words, wide, embedded::shader_roof_frag, "", parts_);
    add(decal_range_, decal_words, ground_words + std::string(kDecal), embedded::shader_ground_frag,
        embedded::shader_ground_decals, decals_);
  } else {
    parts_.push_back({make_corners_program(words, kWallAlbedo), wall_range_});
    parts_.push_back({make_corners_program(words, kRoofAlbedo), roof_range_});
  }
  indices_ = make_buffer(indices);
  describe_vertices(array_, 0, vertices_, sizeof(SceneryVertex), 0,
                    {{0, 3, GL_FLOAT, false, offsetof(SceneryVertex, position)},
                     {1, 3, GL_FLOAT, false, offsetof(SceneryVertex, normal)},
                     {2, 4, GL_FLOAT, false, offsetof(SceneryVertex, local)},
                     {3, 3, GL_FLOAT, false, offsetof(SceneryVertex, light)},
                     {4, 1, GL_UNSIGNED_INT, false, offsetof(SceneryVertex, id)},
                     {5, 1, GL_FLOAT, false, offsetof(SceneryVertex, facade)},
                     {6, 4, GL_UNSIGNED_BYTE, true, offsetof(SceneryVertex, paint)}});
  glVertexArrayElementBuffer(array_.name(), indices_.name());
  learn(material_, choose_shader(material_, scenario), ground_words, quality);
  learn(std::string(kPlain), embedded::shader_ground_surroundings, ground_words, quality);
  tell_place(looks_.at(std::string(kPlain)).program, scenario);
  for (const GroundLayer& layer : layers_) {
    learn(layer.material, choose_shader(layer.material, scenario), ground_words, quality);
  }
  check_gl("loading the scenery");
}

void SceneryPass::learn(const std::string& material, std::string_view shader,
                        std::string_view words, const QualitySettings& quality) {
  if (looks_.contains(material)) return;
  Look& look = looks_[material];
  if (!quality.textured) {
    look.program = make_corners_program(words, shader);
  } else if (is_baked(material)) {
    const std::string own = std::string(words).append(material == "grass"  ? kGrass
                                                      : material == "dirt" ? kDirt
                                                                           : "");
    look.program = make_scenery_program(own, kTextured, embedded::shader_ground_frag);
    look.texture = bake_ground(shader, quality.ground_texels);
  } else {
    const std::string own = std::string(words).append(material == kPlain   ? kNoPuddles
                                                      : is_strip(material) ? kStrip
                                                                           : "");
    look.program = make_scenery_program(own, shader, embedded::shader_ground_frag);
  }
}

void SceneryPass::draw_ground(const std::string& material, const Range& range) const {
  const Look& look = looks_.at(material);
  glBindTextureUnit(kGroundUnit, look.texture.name());
  draw_range(look.program, range);
}

void SceneryPass::draw_range(const Program& program, const Range& range) const {
  if (range.count == 0) return;
  glUseProgram(program.name());
  const std::size_t offset = range.first * sizeof(std::uint32_t);
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(range.count), GL_UNSIGNED_INT,
                 reinterpret_cast<const void*>(offset));  // NOLINT(performance-no-int-to-ptr)
}

void SceneryPass::draw() const {
  glEnable(GL_CULL_FACE);
  glBindVertexArray(array_.name());
  for (const Part& part : parts_) draw_range(part.program, part.range);
  for (const GroundLayer& layer : layers_) draw_ground(layer.material, layer.range);
  draw_ground(material_, ground_range_);
  draw_ground(std::string(kPlain), surroundings_range_);
  const ColorOnly guard;
  for (const Part& part : decals_) draw_range(part.program, part.range);
}

void SceneryPass::draw_ids() const {
  glEnable(GL_CULL_FACE);
  glBindVertexArray(array_.name());
  draw_range(ids_, wall_range_);
  draw_range(ids_, roof_range_);
  for (const GroundLayer& layer : layers_) draw_range(ids_, layer.range);
  draw_range(ids_, ground_range_);
  draw_range(ids_, surroundings_range_);
}

void SceneryPass::draw_shadow() const {
  glDisable(GL_CULL_FACE);
  glBindVertexArray(array_.name());
  draw_range(shadow_, wall_range_);
  draw_range(shadow_, roof_range_);
}

}  // namespace throng::render
