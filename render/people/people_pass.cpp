#include "render/people/people_pass.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <unordered_map>

#include "base/error.h"
#include "render/frame/frame.h"
#include "render/gl/shaders.h"
#include "render/people/device_palettes.h"
#include "render/people/person_geometry.h"

namespace throng::render {

namespace {

/// Per-instance data of people.
struct Instance {
  std::array<float, 3> position;
  std::uint32_t palette_a;
  std::uint32_t palette_b;
  std::uint32_t blend_bits;
  std::uint32_t id;
  std::array<std::uint32_t, 4> tints;
  std::array<std::int32_t, 2> shift;
  std::array<std::uint32_t, 2> facing_bits;  ///< cosine and sine of the heading
  std::array<std::uint32_t, 6> light;        ///< the LightField, half floats
};
static_assert(sizeof(Instance) == 84, "less than 100 bytes for each person and frame");

/// Per-instance data of people's motion to the next frame.
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
constexpr std::string_view kLitCorners = "#define LIT_CORNERS\n";
constexpr std::string_view kShadowed = "#define SHADOWED\n";
constexpr std::string_view kSurface = "#define SURFACE\n";
constexpr std::string_view kSilhouettes = "#define SILHOUETTES\n";
constexpr std::string_view kSilhouettesAndIds = "#define SILHOUETTES\n#define IDS_ONLY\n";

VertexArray make_person_array(const PeopleMeshes& meshes, const Buffer& instances) {
  VertexArray array = make_vertex_array();
  describe_vertices(array, 0, meshes.vertices, sizeof(DeviceVertex), 0,
                    {{0, 3, GL_FLOAT, false, offsetof(DeviceVertex, position)},
                     {1, 4, GL_UNSIGNED_INT, false, offsetof(DeviceVertex, bones)},
                     {2, 2, GL_FLOAT, false, offsetof(DeviceVertex, uv)},
                     {3, 2, GL_UNSIGNED_INT, false, offsetof(DeviceVertex, base)}});
  describe_vertices(array, 1, instances, sizeof(Instance), 1,
                    {{4, 3, GL_FLOAT, false, offsetof(Instance, position)},
                     {5, 4, GL_UNSIGNED_INT, false, offsetof(Instance, palette_a)},
                     {6, 4, GL_UNSIGNED_INT, false, offsetof(Instance, tints)},
                     {7, 4, GL_UNSIGNED_INT, false, offsetof(Instance, shift)},
                     {11, 4, GL_UNSIGNED_INT, false, offsetof(Instance, light)},
                     {12, 2, GL_UNSIGNED_INT, false, offsetof(Instance, light) + 16}});
  glVertexArrayElementBuffer(array.name(), meshes.indices.name());
  return array;
}

/// The same, with where people are in the next frame.
VertexArray make_surface_array(const PeopleMeshes& meshes, const Buffer& instances,
                               const Buffer& next_instances) {
  VertexArray array = make_person_array(meshes, instances);
  describe_vertices(array, 2, next_instances, sizeof(NextInstance), 1,
                    {{8, 3, GL_FLOAT, false, offsetof(NextInstance, position)},
                     {9, 4, GL_UNSIGNED_INT, false, offsetof(NextInstance, palette_a)},
                     {10, 2, GL_FLOAT, false, offsetof(NextInstance, facing)}});
  return array;
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

/// Pairs of half floats: the even light, then the vector of each color.
std::array<std::uint32_t, 6> packed(const LightField& field) {
  const std::array<float, LightField::kNumbers> values = field.numbers();
  std::array<std::uint32_t, 6> words{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::uint32_t half = Eigen::half_impl::float_to_half_rtne(values.at(i)).x;
    words.at(i / 2) |= half << (16U * (i % 2));
  }
  return words;
}

/// Without textured people no level has textures; shadows take the last level by its corners.
Packing choose_packing(const QualitySettings& quality) {
  constexpr std::size_t kAll = 99;
  const auto always = static_cast<std::size_t>(quality.textured_levels);
  return {quality.people_positions > 0 ? kAll : always, always};
}

/// How many bytes of palettes shaders can read: four words to a texel.
std::uint64_t largest_palettes() {
  GLint texels = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &texels);
  return static_cast<std::uint64_t>(texels) * sizeof(skinning::PackedBone);
}

/// A texture's look-ups read whole texels, which a software driver does four times as fast as it
/// reads a storage buffer.
Texture make_buffer_texture(GLenum format, const Buffer& buffer) {
  Texture texture = make_texture(GL_TEXTURE_BUFFER);
  glTextureBuffer(texture.name(), format, buffer.name());
  return texture;
}

}  // namespace

PeoplePass::PeoplePass(const skinning::Population& population, const ProbeGrid& air,
                       const QualitySettings& quality, std::string_view words, bool color_apart)
    : air_(air),
      palettes_per_character_(population.palettes_per_character),
      meshes_(people_meshes(population, choose_packing(quality))),
      palettes_(make_buffer(device_palettes(population, largest_palettes()))),
      palette_texels_(make_buffer_texture(GL_RGBA32UI, palettes_)),
      instances_(make_buffer()),
      next_instances_(make_buffer()) {
  load_textures(population);
  array_ = make_person_array(meshes_, instances_);
  const bool shadowed = quality.shadow_texels > 0;
  image_ = make_image_programs(words, shadowed, "");
  truth_ = make_image_programs(words, shadowed, color_apart ? kSilhouettesAndIds : kSilhouettes);
  const auto coverage_program = [&](std::string_view alpha) {
    return make_program({kCoverage, shader_view, shader_person_vert},
                        {alpha, embedded::shader_coverage_frag});
  };
  coverage_ = coverage_program("");
  coverage_alpha_ = coverage_program(kAlphaTest);
  shadow_ = make_program({kShadow, shader_light, shader_person_vert}, {});
  surface_array_ = make_surface_array(meshes_, instances_, next_instances_);
  const auto surface_program = [](std::string_view alpha) {
    return make_program({kSurface, shader_view, embedded::shader_next_view, shader_person_vert},
                        {alpha, embedded::shader_person_surface_frag});
  };
  surface_ = surface_program("");
  surface_alpha_ = surface_program(kAlphaTest);
  check_gl("loading people");
}

PeoplePass::ImagePrograms PeoplePass::make_image_programs(std::string_view words, bool shadowed,
                                                          std::string_view outputs) {
  const std::string_view shadows = shadowed ? kShadowed : "";
  const auto textured = [&](std::string_view lit, std::string_view alpha) {
    return make_program(
        {words, outputs, lit, shadows, shader_view, shader_light, shader_person_vert},
        {words, outputs, lit, alpha, shader_light, embedded::shader_silhouette,
         shader_person_frag});
  };
  Program by_corners = make_program(
      {words, outputs, kCorners, shadows, shader_view, shader_light, shader_person_vert},
      {outputs, embedded::shader_silhouette, embedded::shader_corners_frag});
  return {{textured("", ""), textured(kLitCorners, ""), std::move(by_corners)},
          textured("", kAlphaTest)};
}

void PeoplePass::load_textures(const skinning::Population& population) {
  const int size = std::max(population.texture_size, 1);
  const auto layers = static_cast<GLsizei>(population.textures.size() + 1);
  GLint max_layers = 0;
  glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &max_layers);
  if (layers > max_layers) {
    throw InputError({"", "people", fmt::format("{} textures", layers - 1),
                      fmt::format("at most {} on this graphics device (run `throng people build` "
                                  "with a lower --count)",
                                  max_layers - 1)});
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
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
}

std::vector<PeoplePass::Batch> PeoplePass::upload(std::span<const PersonInstance> people,
                                                  const std::vector<PersonDraw>& draws,
                                                  bool is_lit) {
  std::vector<Instance> instances;
  instances.reserve(draws.size());
  std::vector<Batch> batches;
  for (const PersonDraw& draw : draws) {
    const PersonInstance& person = people[draw.person];
    const std::uint32_t character = person.appearance.character;
    const auto& levels =
        draw.shading == Shading::by_corners ? meshes_.by_corners : meshes_.textured;
    check(character < levels.size() && draw.level < levels[character].size() &&
              std::max(person.pose.a, person.pose.b) < palettes_per_character_,
          "people use characters and palettes that the population has");
    const std::uint32_t first_palette = character * palettes_per_character_;
    const PeopleLevel* level = &levels[character][draw.level];
    if (batches.empty() || batches.back().level != level) {
      batches.push_back({level, draw.shading, static_cast<std::uint32_t>(instances.size()), 0});
    }
    ++batches.back().count;
    const skinning::PoseBlend pose = drawn_pose(person.pose, draw.level);
    instances.push_back(
        {{person.position.x(), person.position.y(), person.position.z()},
         first_palette + pose.a,
         first_palette + pose.b,
         std::bit_cast<std::uint32_t>(pose.blend),
         id_of_agent(person.agent),
         packed(person.appearance.tint),
         draw.shift,
         {std::bit_cast<std::uint32_t>(std::cos(person.yaw_rad)),
          std::bit_cast<std::uint32_t>(std::sin(person.yaw_rad))},
         is_lit ? packed(air_.at(light_point(person.position))) : std::array<std::uint32_t, 6>{}});
  }
  glNamedBufferData(instances_.name(), static_cast<GLsizeiptr>(instances.size() * sizeof(Instance)),
                    instances.data(), GL_STREAM_DRAW);
  return batches;
}

void PeoplePass::draw_batch(const Batch& batch, Range PeopleLevel::*range) {
  const Range& triangles = batch.level->*range;
  if (triangles.count == 0) return;
  const std::size_t offset = triangles.first * sizeof(std::uint32_t);
  glDrawElementsInstancedBaseVertexBaseInstance(
      GL_TRIANGLES, static_cast<GLsizei>(triangles.count), GL_UNSIGNED_INT,
      reinterpret_cast<const void*>(offset),  // NOLINT(performance-no-int-to-ptr): GL's interface
      static_cast<GLsizei>(batch.count), batch.level->first_vertex, batch.first);
}

void PeoplePass::draw_batches(const std::vector<Batch>& batches, Range PeopleLevel::*range) {
  for (const Batch& batch : batches) draw_batch(batch, range);
}

void PeoplePass::draw_image(const std::vector<Batch>& batches, const ImagePrograms& programs) {
  glEnable(GL_CULL_FACE);
  for (const Shading shading : {Shading::textured, Shading::lit_by_corners, Shading::by_corners}) {
    glUseProgram(programs.opaque[static_cast<std::size_t>(shading)].name());
    for (const Batch& batch : batches) {
      if (batch.shading == shading) draw_batch(batch, &PeopleLevel::opaque);
    }
  }
  glDisable(GL_CULL_FACE);
  glUseProgram(programs.alpha_tested.name());
  draw_batches(batches, &PeopleLevel::alpha_tested);
}

void PeoplePass::bind(const VertexArray& array) const {
  glBindVertexArray(array.name());
  glBindTextureUnit(0, textures_.name());
  glBindTextureUnit(3, palette_texels_.name());
}

void PeoplePass::sort(std::span<const PersonInstance> people,
                      std::vector<PersonDraw>& draws) const {
  const auto key = [&](const PersonDraw& draw) {
    const PersonInstance& person = people[draw.person];
    return std::tuple(draw.level, person.appearance.character, draw.shading, draw.depth_m,
                      person.agent, draw.shift);
  };
  std::sort(draws.begin(), draws.end(),
            [&](const PersonDraw& a, const PersonDraw& b) { return key(a) < key(b); });
}

void PeoplePass::upload_next(std::span<const PersonInstance> people,
                             const std::vector<PersonDraw>& draws,
                             std::span<const PersonInstance> next) {
  std::unordered_map<std::uint32_t, const PersonInstance*> next_by_agent;
  for (const PersonInstance& person : next) next_by_agent[person.agent] = &person;
  std::vector<NextInstance> instances;
  instances.reserve(draws.size());
  for (const PersonDraw& draw : draws) {
    NextInstance& instance = instances.emplace_back();
    const auto found = next_by_agent.find(people[draw.person].agent);
    if (found == next_by_agent.end()) continue;
    const PersonInstance& person = *found->second;
    check(person.appearance.character == people[draw.person].appearance.character &&
              std::max(person.pose.a, person.pose.b) < palettes_per_character_,
          "people keep their bodies");
    const std::uint32_t first_palette = person.appearance.character * palettes_per_character_;
    const skinning::PoseBlend pose = drawn_pose(person.pose, draw.level);
    instance = {{person.position.x(), person.position.y(), person.position.z()},
                first_palette + pose.a,
                first_palette + pose.b,
                std::bit_cast<std::uint32_t>(pose.blend),
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
  const std::vector<Batch> batches = upload(people, draws, false);
  upload_next(people, draws, next);
  bind(surface_array_);
  glEnable(GL_CULL_FACE);
  glUseProgram(surface_.name());
  draw_batches(batches, &PeopleLevel::opaque);
  glDisable(GL_CULL_FACE);
  glUseProgram(surface_alpha_.name());
  draw_batches(batches, &PeopleLevel::alpha_tested);
}

void PeoplePass::draw(Purpose purpose, std::span<const PersonInstance> people,
                      std::vector<PersonDraw> draws) {
  if (draws.empty()) return;
  sort(people, draws);
  const bool is_lit = purpose == Purpose::image || purpose == Purpose::truth;
  const std::vector<Batch> batches = upload(people, draws, is_lit);
  bind(array_);
  if (purpose == Purpose::shadow) {
    // Faces toward the sun are counter-clockwise in the map, which is not upside down like the
    // image.
    glEnable(GL_CULL_FACE);
    glCullFace(GL_FRONT);
    glUseProgram(shadow_.name());
    draw_batches(batches, &PeopleLevel::opaque);
    glDisable(GL_CULL_FACE);
    glCullFace(GL_BACK);
    draw_batches(batches, &PeopleLevel::alpha_tested);
    return;
  }
  if (purpose == Purpose::image) return draw_image(batches, image_);
  if (purpose == Purpose::truth) return draw_image(batches, truth_);
  glEnable(GL_CULL_FACE);
  glUseProgram(coverage_.name());
  draw_batches(batches, &PeopleLevel::opaque);
  glDisable(GL_CULL_FACE);
  glUseProgram(coverage_alpha_.name());
  draw_batches(batches, &PeopleLevel::alpha_tested);
}

}  // namespace throng::render
