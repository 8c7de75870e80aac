#include "render/people_pass.h"

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <unordered_map>

#include "base/error.h"
#include "render/device_palettes.h"
#include "render/shaders.h"

namespace throng::render {

namespace {

/// A vertex on the device: the population's, and what its part says.
struct DeviceVertex {
  skinning::Vertex vertex;
  std::uint32_t part;                  ///< texture layer, a portrait's second one << 12, tint << 24
  std::array<std::uint8_t, 4> base;    ///< the texture around it, sRGB
  std::array<std::uint8_t, 4> shades;  ///< of a portrait, linear
};

/// What differs between people.
struct Instance {
  std::array<float, 3> position;
  std::uint32_t palette_a;
  std::uint32_t palette_b;
  std::uint32_t blend_bits;
  std::uint32_t id;
  std::array<std::uint32_t, 4> tints;
  std::array<std::int32_t, 2> shift;
  std::array<float, 2> facing;  ///< cosine and sine of the heading
};
static_assert(sizeof(Instance) == 60, "less than 64 bytes for each person and frame");

/// What differs between people's motion to the next frame.
struct NextInstance {
  std::array<float, 3> position;
  std::uint32_t palette_a;
  std::uint32_t palette_b;
  std::uint32_t blend_bits;
  std::uint32_t is_there;
  std::array<float, 2> facing;
};

using embedded::shader_light;
using embedded::shader_person_frag;
using embedded::shader_person_vert;
using embedded::shader_view;

constexpr std::string_view kShadow = "#define SHADOW\n";
constexpr std::string_view kCoverage = "#define COVERAGE\n";
constexpr std::string_view kAlphaTest = "#define ALPHA_TEST\n";
constexpr std::string_view kCorners = "#define CORNERS\n";
constexpr std::string_view kShadowed = "#define SHADOWED\n";
constexpr std::string_view kSurface = "#define SURFACE\n";

VertexArray make_person_array(const Buffer& vertices, const Buffer& indices,
                              const Buffer& instances) {
  using skinning::Vertex;
  VertexArray array = make_vertex_array();
  describe_vertices(array, 0, vertices, sizeof(DeviceVertex), 0,
                    {{0, 3, GL_FLOAT, false, offsetof(Vertex, position)},
                     {1, 3, GL_FLOAT, false, offsetof(Vertex, normal)},
                     {2, 2, GL_FLOAT, false, offsetof(Vertex, uv)},
                     {3, 4, GL_UNSIGNED_BYTE, false, offsetof(Vertex, bones)},
                     {4, 4, GL_UNSIGNED_BYTE, true, offsetof(Vertex, weights)},
                     {5, 1, GL_UNSIGNED_INT, false, offsetof(DeviceVertex, part)},
                     {11, 4, GL_UNSIGNED_BYTE, true, offsetof(DeviceVertex, base)},
                     {12, 4, GL_UNSIGNED_BYTE, true, offsetof(DeviceVertex, shades)}});
  describe_vertices(array, 1, instances, sizeof(Instance), 1,
                    {{6, 3, GL_FLOAT, false, offsetof(Instance, position)},
                     {7, 4, GL_UNSIGNED_INT, false, offsetof(Instance, palette_a)},
                     {8, 4, GL_UNSIGNED_INT, false, offsetof(Instance, tints)},
                     {9, 2, GL_INT, false, offsetof(Instance, shift)},
                     {10, 2, GL_FLOAT, false, offsetof(Instance, facing)}});
  glVertexArrayElementBuffer(array.name(), indices.name());
  return array;
}

/// The same, with where people are in the next frame in place of what CORNERS reads.
VertexArray make_surface_array(const Buffer& vertices, const Buffer& indices,
                               const Buffer& instances, const Buffer& next_instances) {
  VertexArray array = make_person_array(vertices, indices, instances);
  describe_vertices(array, 2, next_instances, sizeof(NextInstance), 1,
                    {{11, 3, GL_FLOAT, false, offsetof(NextInstance, position)},
                     {12, 4, GL_UNSIGNED_INT, false, offsetof(NextInstance, palette_a)},
                     {13, 2, GL_FLOAT, false, offsetof(NextInstance, facing)}});
  return array;
}

/// The vertex with its bones in order of falling weight: the shader stops at the first zero.
skinning::Vertex heaviest_first(const skinning::Vertex& vertex) {
  std::array<std::size_t, 4> order = {0, 1, 2, 3};
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return vertex.weights[a] > vertex.weights[b];
  });
  skinning::Vertex sorted = vertex;
  for (std::size_t k = 0; k < order.size(); ++k) {
    sorted.bones[k] = vertex.bones[order[k]];
    sorted.weights[k] = vertex.weights[order[k]];
  }
  return sorted;
}

using Rgba = std::array<std::uint8_t, 4>;

constexpr Rgba kWhite = {255, 255, 255, 255};

/// Mean of 3 x 3 texels around a vertex, value by value.
Rgba around(const skinning::Population& population, std::int32_t layer,
            const std::array<float, 2>& uv) {
  if (layer < 0) return kWhite;
  const std::vector<std::uint8_t>& texels =
      population.textures[static_cast<std::size_t>(layer)].rgba;
  const int size = population.texture_size;
  const auto texel_of = [&](float share) {
    return static_cast<int>(std::floor(share * static_cast<float>(size)));
  };
  std::array<int, 4> sum{};
  for (int j = -1; j <= 1; ++j) {
    for (int i = -1; i <= 1; ++i) {
      const int x = std::clamp(texel_of(uv[0]) + i, 0, size - 1);
      const int y = std::clamp(texel_of(uv[1]) + j, 0, size - 1);
      const auto at = 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(size) +
                           static_cast<std::size_t>(x));
      for (std::size_t c = 0; c < 4; ++c) sum[c] += texels[at + c];
    }
  }
  Rgba mean{};
  for (std::size_t c = 0; c < 4; ++c) mean[c] = static_cast<std::uint8_t>(sum[c] / 9);
  return mean;
}

/// A portrait's shades as they are in light.
Rgba linear_shades(const Rgba& shades) {
  Rgba light = shades;
  for (std::size_t c = 0; c < 3; ++c) {
    light[c] = static_cast<std::uint8_t>(
        std::lround(255 * std::pow(static_cast<float>(shades[c]) / 255.0F, 2.2F)));
  }
  return light;
}

/// Appends a part's triangles with its own copies of their vertices, since a vertex on the device
/// belongs to one part.
void append_part(const skinning::Population& population, const skinning::Mesh& mesh,
                 const skinning::Part& part, std::uint32_t info, std::uint32_t first_vertex,
                 std::vector<DeviceVertex>& vertices, std::vector<std::uint32_t>& indices) {
  constexpr std::uint32_t kUnseen = ~0U;
  std::vector<std::uint32_t> copy_of(mesh.vertices.size(), kUnseen);
  for (std::uint32_t i = part.first_index; i < part.first_index + part.index_count; ++i) {
    std::uint32_t& copy = copy_of[mesh.indices[i]];
    if (copy == kUnseen) {
      copy = static_cast<std::uint32_t>(vertices.size()) - first_vertex;
      const skinning::Vertex& vertex = mesh.vertices[mesh.indices[i]];
      const Rgba shades =
          part.shades < 0 ? Rgba{} : linear_shades(around(population, part.shades, vertex.uv));
      vertices.push_back(
          {heaviest_first(vertex), info, around(population, part.texture, vertex.uv), shades});
    }
    indices.push_back(copy);
  }
}

/// The five tints in four words: three bytes each of top, bottom, hair and shoes, red lowest, with
/// the item's red, green and blue as the first three words' high bytes.
std::array<std::uint32_t, 4> packed(const std::array<skinning::Rgb, skinning::kTintCount>& tint) {
  std::array<std::uint32_t, 4> words{};
  const skinning::Rgb& item = tint[static_cast<std::size_t>(skinning::Tint::item)];
  for (std::size_t i = 0; i < words.size(); ++i) {
    const skinning::Rgb& srgb = tint[i + 1];
    words[i] = srgb[0] | (static_cast<std::uint32_t>(srgb[1]) << 8U) |
               (static_cast<std::uint32_t>(srgb[2]) << 16U);
    if (i < item.size()) words[i] |= static_cast<std::uint32_t>(item[i]) << 24U;
  }
  return words;
}

/// Fewer triangles of the same vertices, in place of those from `first` on.
void append_proxy(const std::vector<DeviceVertex>& vertices, std::uint32_t first_vertex,
                  std::uint32_t first, std::vector<std::uint32_t>& indices) {
  constexpr float kAnyError = 1;
  const std::vector<std::uint32_t> fine(indices.begin() + first, indices.end());
  std::vector<std::uint32_t> coarse(fine.size());
  coarse.resize(meshopt_simplify(coarse.data(), fine.data(), fine.size(),
                                 vertices[first_vertex].vertex.position.data(),
                                 vertices.size() - first_vertex, sizeof(DeviceVertex),
                                 static_cast<std::size_t>(kProxyTriangles) * 3, kAnyError));
  indices.insert(indices.end(), coarse.begin(), coarse.end());
}

/// What a shader may read of one buffer, in bytes.
std::uint64_t largest_storage() {
  GLint64 bytes = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bytes);
  return static_cast<std::uint64_t>(bytes);
}

/// What the shader knows of a part; `white` is the layer of those without a texture.
std::uint32_t info_of(const skinning::Part& part, std::uint32_t white) {
  const auto layer = [](std::int32_t number) { return static_cast<std::uint32_t>(number); };
  const std::uint32_t texture = part.texture < 0 ? white : layer(part.texture);
  const std::uint32_t shades = part.shades < 0 ? 0 : layer(part.shades);
  check(std::max(texture, shades) < 1U << 12U, "twelve bits number the people's textures");
  return texture | (shades << 12U) | (static_cast<std::uint32_t>(part.tint) << 24U);
}

}  // namespace

PeoplePass::PeoplePass(const skinning::Population& population, const QualitySettings& quality,
                       std::string_view words)
    : palettes_per_character_(population.palettes_per_character),
      textured_levels_(static_cast<std::uint32_t>(quality.textured_levels)),
      palettes_(make_buffer(device_palettes(population, largest_storage()))),
      instances_(make_buffer()),
      next_instances_(make_buffer()) {
  load_meshes(population);
  load_textures(population);
  array_ = make_person_array(vertices_, indices_, instances_);
  const auto camera_program = [&](std::string_view a, std::string_view b) {
    return make_program({words, shader_view, shader_light, shader_person_vert},
                        {words, a, b, shader_light, shader_person_frag});
  };
  picture_ = camera_program("", "");
  corners_ = make_program({words, kCorners, quality.shadow_texels > 0 ? kShadowed : "", shader_view,
                           shader_light, shader_person_vert},
                          {embedded::shader_corners_frag});
  picture_alpha_ = camera_program(kAlphaTest, "");
  coverage_ = camera_program(kCoverage, "");
  coverage_alpha_ = camera_program(kCoverage, kAlphaTest);
  shadow_ = make_program({kShadow, shader_light, shader_person_vert}, {});
  surface_array_ = make_surface_array(vertices_, indices_, instances_, next_instances_);
  const auto surface_program = [](std::string_view alpha) {
    return make_program({kSurface, shader_view, embedded::shader_next_view, shader_person_vert},
                        {alpha, embedded::shader_person_surface_frag});
  };
  surface_ = surface_program("");
  surface_alpha_ = surface_program(kAlphaTest);
  check_gl("loading people");
}

void PeoplePass::load_meshes(const skinning::Population& population) {
  std::vector<DeviceVertex> vertices;
  std::vector<std::uint32_t> indices;
  const auto white_layer = static_cast<std::uint32_t>(population.textures.size());
  for (const skinning::Character& character : population.characters) {
    std::vector<Level>& levels = levels_.emplace_back();
    for (const skinning::Mesh& mesh : character.levels) {
      Level level;
      const auto first_vertex = static_cast<std::uint32_t>(vertices.size());
      level.first_vertex = static_cast<std::int32_t>(first_vertex);
      for (const bool alpha_tested : {false, true}) {
        Range& range = alpha_tested ? level.alpha_tested : level.opaque;
        range.first = static_cast<std::uint32_t>(indices.size());
        for (const skinning::Part& part : mesh.parts) {
          if (part.alpha_tested != alpha_tested) continue;
          append_part(population, mesh, part, info_of(part, white_layer), first_vertex, vertices,
                      indices);
        }
        range.count = static_cast<std::uint32_t>(indices.size()) - range.first;
      }
      levels.push_back(level);
    }
    if (levels.empty()) continue;
    Level proxy = levels.back();
    const auto first = static_cast<std::uint32_t>(indices.size());
    append_proxy(vertices, static_cast<std::uint32_t>(proxy.first_vertex), proxy.opaque.first,
                 indices);
    proxy.opaque = {first, static_cast<std::uint32_t>(indices.size()) - first};
    levels.push_back(proxy);
  }
  vertices_ = make_buffer(vertices);
  indices_ = make_buffer(indices);
}

void PeoplePass::load_textures(const skinning::Population& population) {
  const int size = std::max(population.texture_size, 1);
  const auto layers = static_cast<GLsizei>(population.textures.size() + 1);
  GLint most_layers = 0;
  glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &most_layers);
  if (layers > most_layers) {
    throw InputError({"", "people", fmt::format("{} textures", layers - 1),
                      fmt::format("at most {} on this graphics device (run `throng people build` "
                                  "with a lower --count)",
                                  most_layers - 1)});
  }
  textures_ = make_texture(GL_TEXTURE_2D_ARRAY);
  const GLuint name = textures_.name();
  const auto mip_levels = std::bit_width(static_cast<unsigned>(size));
  glTextureStorage3D(name, mip_levels, GL_SRGB8_ALPHA8, size, size, layers);
  const auto upload = [&](GLint layer, const std::vector<std::uint8_t>& rgba) {
    glTextureSubImage3D(name, 0, 0, 0, layer, size, size, 1, GL_RGBA, GL_UNSIGNED_BYTE,
                        rgba.data());
  };
  for (GLint layer = 0; layer + 1 < layers; ++layer) {
    upload(layer, population.textures[static_cast<std::size_t>(layer)].rgba);
  }
  const auto texels = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
  upload(layers - 1, std::vector<std::uint8_t>(texels * 4, 255));  // parts without a texture
  glGenerateTextureMipmap(name);
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
}

std::vector<PeoplePass::Batch> PeoplePass::upload(std::span<const PersonInstance> people,
                                                  const std::vector<PersonDraw>& draws) {
  std::vector<Instance> instances;
  instances.reserve(draws.size());
  std::vector<Batch> batches;
  for (const PersonDraw& draw : draws) {
    const PersonInstance& person = people[draw.person];
    const std::uint32_t character = person.appearance.character;
    check(character < levels_.size() && draw.level < levels_[character].size() &&
              std::max(person.pose.a, person.pose.b) < palettes_per_character_,
          "people use characters and palettes that the population has");
    const std::uint32_t first_palette = character * palettes_per_character_;
    const Level* level = &levels_[character][draw.level];
    if (batches.empty() || batches.back().level != level) {
      batches.push_back(
          {level, draw.level < textured_levels_, static_cast<std::uint32_t>(instances.size()), 0});
    }
    ++batches.back().count;
    instances.push_back({{person.position.x(), person.position.y(), person.position.z()},
                         first_palette + person.pose.a,
                         first_palette + person.pose.b,
                         std::bit_cast<std::uint32_t>(person.pose.blend),
                         id_of_agent(person.agent),
                         packed(person.appearance.tint),
                         draw.shift,
                         {std::cos(person.yaw_rad), std::sin(person.yaw_rad)}});
  }
  glNamedBufferData(instances_.name(), static_cast<GLsizeiptr>(instances.size() * sizeof(Instance)),
                    instances.data(), GL_STREAM_DRAW);
  return batches;
}

void PeoplePass::draw_batch(const Batch& batch, Range Level::*range) {
  const Range& triangles = batch.level->*range;
  if (triangles.count == 0) return;
  const std::size_t offset = triangles.first * sizeof(std::uint32_t);
  glDrawElementsInstancedBaseVertexBaseInstance(
      GL_TRIANGLES, static_cast<GLsizei>(triangles.count), GL_UNSIGNED_INT,
      reinterpret_cast<const void*>(offset),  // NOLINT(performance-no-int-to-ptr): GL's interface
      static_cast<GLsizei>(batch.count), batch.level->first_vertex, batch.first);
}

void PeoplePass::draw_batches(const std::vector<Batch>& batches, Range Level::*range) {
  for (const Batch& batch : batches) draw_batch(batch, range);
}

void PeoplePass::draw_picture(const std::vector<Batch>& batches) const {
  glEnable(GL_CULL_FACE);
  for (const bool textured : {true, false}) {
    glUseProgram(textured ? picture_.name() : corners_.name());
    for (const Batch& batch : batches) {
      if (batch.textured == textured) draw_batch(batch, &Level::opaque);
    }
  }
  glDisable(GL_CULL_FACE);
  glUseProgram(picture_alpha_.name());
  draw_batches(batches, &Level::alpha_tested);
}

void PeoplePass::sort(std::span<const PersonInstance> people,
                      std::vector<PersonDraw>& draws) const {
  const auto key = [&](const PersonDraw& draw) {
    const PersonInstance& person = people[draw.person];
    return std::tuple(draw.level, person.appearance.character, draw.depth_m, person.agent,
                      draw.shift);
  };
  std::sort(draws.begin(), draws.end(),
            [&](const PersonDraw& a, const PersonDraw& b) { return key(a) < key(b); });
}

void PeoplePass::upload_next(std::span<const PersonInstance> people,
                             const std::vector<PersonDraw>& draws,
                             std::span<const PersonInstance> next) {
  std::unordered_map<std::uint32_t, const PersonInstance*> next_of;
  for (const PersonInstance& person : next) next_of[person.agent] = &person;
  std::vector<NextInstance> instances;
  instances.reserve(draws.size());
  for (const PersonDraw& draw : draws) {
    NextInstance& instance = instances.emplace_back();
    const auto found = next_of.find(people[draw.person].agent);
    if (found == next_of.end()) continue;
    const PersonInstance& person = *found->second;
    check(person.appearance.character == people[draw.person].appearance.character &&
              std::max(person.pose.a, person.pose.b) < palettes_per_character_,
          "people keep their bodies");
    const std::uint32_t first_palette = person.appearance.character * palettes_per_character_;
    instance = {{person.position.x(), person.position.y(), person.position.z()},
                first_palette + person.pose.a,
                first_palette + person.pose.b,
                std::bit_cast<std::uint32_t>(person.pose.blend),
                1,
                {std::cos(person.yaw_rad), std::sin(person.yaw_rad)}};
  }
  glNamedBufferData(next_instances_.name(),
                    static_cast<GLsizeiptr>(instances.size() * sizeof(NextInstance)),
                    instances.data(), GL_STREAM_DRAW);
}

void PeoplePass::draw_surfaces(std::span<const PersonInstance> people,
                               std::vector<PersonDraw> draws,
                               std::span<const PersonInstance> next) {
  if (draws.empty()) return;
  sort(people, draws);
  const std::vector<Batch> batches = upload(people, draws);
  upload_next(people, draws, next);
  glBindVertexArray(surface_array_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, palettes_.name());
  glBindTextureUnit(0, textures_.name());
  glEnable(GL_CULL_FACE);
  glUseProgram(surface_.name());
  draw_batches(batches, &Level::opaque);
  glDisable(GL_CULL_FACE);
  glUseProgram(surface_alpha_.name());
  draw_batches(batches, &Level::alpha_tested);
}

void PeoplePass::draw(Purpose purpose, std::span<const PersonInstance> people,
                      std::vector<PersonDraw> draws) {
  if (draws.empty()) return;
  sort(people, draws);
  const std::vector<Batch> batches = upload(people, draws);
  glBindVertexArray(array_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, palettes_.name());
  glBindTextureUnit(0, textures_.name());
  if (purpose == Purpose::shadow) {
    // What faces the sun is counter-clockwise in the map, which is not upside down like the
    // picture.
    glEnable(GL_CULL_FACE);
    glCullFace(GL_FRONT);
    glUseProgram(shadow_.name());
    draw_batches(batches, &Level::opaque);
    glDisable(GL_CULL_FACE);
    glCullFace(GL_BACK);
    draw_batches(batches, &Level::alpha_tested);
    return;
  }
  if (purpose == Purpose::picture) return draw_picture(batches);
  glEnable(GL_CULL_FACE);
  glUseProgram(coverage_.name());
  draw_batches(batches, &Level::opaque);
  glDisable(GL_CULL_FACE);
  glUseProgram(coverage_alpha_.name());
  draw_batches(batches, &Level::alpha_tested);
}

}  // namespace throng::render
