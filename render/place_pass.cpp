#include "render/place_pass.h"

#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "render/lighting.h"
#include "render/shaders.h"

namespace throng::render {

namespace {

using embedded::shader_light;
using embedded::shader_noise;
using embedded::shader_place_vert;
using embedded::shader_view;

std::string_view shader_of(const std::string& material, const world::Scenario& scenario) {
  const std::array<std::pair<std::string_view, std::string_view>, 7> materials = {{
      {"pavers", embedded::shader_ground_pavers},
      {"asphalt", embedded::shader_ground_asphalt},
      {"grass", embedded::shader_ground_grass},
      {"concrete", embedded::shader_ground_concrete},
      {"dirt", embedded::shader_ground_dirt},
      {"kerb", embedded::shader_ground_kerb},
      {"paint", embedded::shader_ground_paint},
  }};
  for (const auto& [name, text] : materials) {
    if (name == material) return text;
  }
  throw InputError(Problem{scenario.id, "ground material", '"' + material + '"',
                           R"("pavers", "asphalt", "grass", "concrete" or "dirt")"});
}

/// A surface's own shader on top of light and noise.
Program make_place_program(std::string_view words, std::string_view surface,
                           std::string_view more = "") {
  return make_program({shader_view, shader_place_vert},
                      {words, shader_light, shader_noise, surface, more});
}

Program make_ground_program(std::string_view words, std::string_view material) {
  return make_place_program(words, material, embedded::shader_ground_frag);
}

/// Mean colours of facades and roofs, in the words of a ground.
constexpr std::string_view kWallAlbedo =
    "vec3 ground_albedo(vec2 p, vec2 width) { return vec3(0.41, 0.36, 0.30); }\n";
constexpr std::string_view kRoofAlbedo =
    "vec3 ground_albedo(vec2 p, vec2 width) { return vec3(0.31, 0.29, 0.27); }\n";

Program make_corners_program(std::string_view words, std::string_view material) {
  return make_program({words, shader_view, shader_light, shader_noise, material,
                       embedded::shader_place_corners_vert},
                      {embedded::shader_corners_frag});
}

}  // namespace

PlacePass::PlacePass(const world::Scenario& scenario, const Environment& environment,
                     const QualitySettings& quality)
    : mesh_(place_mesh(scenario)),
      layers_(add_ground_layers(
          scenario, [&](const Eigen::Vector2d& p) { return openness_at(scenario, p); }, mesh_)),
      vertices_(make_buffer(mesh_.vertices)),
      indices_(make_buffer(mesh_.indices)),
      array_(make_vertex_array()),
      shadow_(make_program({shader_light, embedded::shader_place_shadow_vert}, {})) {
  const std::string words = light_words(environment).append(shadow_words(quality));
  const std::string_view main_material = shader_of(scenario.ground_material, scenario);
  if (quality.textured) {
    walls_ = make_place_program(words, embedded::shader_wall_frag);
    roofs_ = make_place_program(words, embedded::shader_roof_frag);
    ground_ = make_ground_program(words, main_material);
    surroundings_ = make_ground_program(words, embedded::shader_ground_surroundings);
  } else {
    walls_ = make_corners_program(words, kWallAlbedo);
    roofs_ = make_corners_program(words, kRoofAlbedo);
    ground_ = make_corners_program(words, main_material);
    surroundings_ = make_corners_program(words, embedded::shader_ground_surroundings);
  }
  describe_vertices(array_, 0, vertices_, sizeof(PlaceVertex), 0,
                    {{0, 3, GL_FLOAT, false, offsetof(PlaceVertex, position)},
                     {1, 3, GL_FLOAT, false, offsetof(PlaceVertex, normal)},
                     {2, 4, GL_FLOAT, false, offsetof(PlaceVertex, local)},
                     {3, 1, GL_FLOAT, false, offsetof(PlaceVertex, openness)},
                     {4, 1, GL_UNSIGNED_INT, false, offsetof(PlaceVertex, id)},
                     {5, 1, GL_FLOAT, false, offsetof(PlaceVertex, facade)}});
  glVertexArrayElementBuffer(array_.name(), indices_.name());
  for (const GroundLayer& layer : layers_) {
    const std::string_view material = shader_of(layer.material, scenario);
    layer_programs_.push_back(quality.textured ? make_ground_program(words, material)
                                               : make_corners_program(words, material));
  }
  check_gl("loading the place");
}

void PlacePass::draw_range(const Program& program, const Range& range) const {
  if (range.count == 0) return;
  glUseProgram(program.name());
  const std::size_t offset = range.first * sizeof(std::uint32_t);
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(range.count), GL_UNSIGNED_INT,
                 reinterpret_cast<const void*>(offset));  // NOLINT(performance-no-int-to-ptr)
}

void PlacePass::draw() const {
  glEnable(GL_CULL_FACE);
  glBindVertexArray(array_.name());
  draw_range(walls_, mesh_.walls);
  draw_range(roofs_, mesh_.roofs);
  for (std::size_t i = 0; i < layers_.size(); ++i) draw_range(layer_programs_[i], layers_[i].range);
  draw_range(ground_, mesh_.ground);
  draw_range(surroundings_, mesh_.surroundings);
}

void PlacePass::draw_shadow() const {
  glDisable(GL_CULL_FACE);
  glBindVertexArray(array_.name());
  draw_range(shadow_, mesh_.walls);
  draw_range(shadow_, mesh_.roofs);
}

}  // namespace throng::render
