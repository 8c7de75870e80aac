#include "render/people/people_meshes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

#include "base/error.h"
#include "render/people/corner_colors.h"
#include "skinning/levels.h"

namespace throng::render {

namespace {

constexpr Rgba kWhiteRgba = {255, 255, 255, 255};

/// A portrait's shades as they are in light.
Rgba linear_shades(const Rgba& shades) {
  Rgba light = shades;
  for (std::size_t c = 0; c < 3; ++c) {
    light[c] = static_cast<std::uint8_t>(
        std::lround(255 * std::pow(static_cast<float>(shades[c]) / 255.0F, 2.2F)));
  }
  return light;
}

std::uint32_t pack_bytes(const std::array<std::uint8_t, 4>& bytes) {
  return bytes[0] | (static_cast<std::uint32_t>(bytes[1]) << 8U) |
         (static_cast<std::uint32_t>(bytes[2]) << 16U) |
         (static_cast<std::uint32_t>(bytes[3]) << 24U);
}

/// A unit vector on the octahedron |x| + |y| + |z| = 1, whose lower half is folded out (Meyer et
/// al. 2010): two 16-bit integers of 32767.
std::uint32_t octahedral(const std::array<float, 3>& normal) {
  const float length = std::abs(normal[0]) + std::abs(normal[1]) + std::abs(normal[2]);
  if (!(length > 0)) return 0;
  float x = normal[0] / length;
  float y = normal[1] / length;
  if (normal[2] < 0) {
    const float folded = std::copysign(1 - std::abs(y), x);
    y = std::copysign(1 - std::abs(x), y);
    x = folded;
  }
  const auto bits = [](float share) {
    return static_cast<std::uint32_t>(
        static_cast<std::uint16_t>(static_cast<std::int16_t>(std::lround(32767 * share))));
  };
  return bits(x) | (bits(y) << 16U);
}

/// Bones and weights in order of falling weight.
void pack_skin(const skinning::Vertex& vertex, DeviceVertex& packed) {
  std::array<std::size_t, 4> order = {0, 1, 2, 3};
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return vertex.weights[a] > vertex.weights[b];
  });
  std::array<std::uint8_t, 4> bones{};
  std::array<std::uint8_t, 4> weights{};
  for (std::size_t k = 0; k < order.size(); ++k) {
    weights[k] = vertex.weights[order[k]];
    if (weights[k] > 0) bones[k] = vertex.bones[order[k]];
  }
  packed.bones = pack_bytes(bones);
  packed.weights = pack_bytes(weights);
}

/// Shader data of a part; `white` is the layer of those without a texture.
std::uint32_t pack_info(const skinning::Part& part, bool apart, std::uint32_t white) {
  const auto layer = [](std::int32_t number) { return static_cast<std::uint32_t>(number); };
  const std::uint32_t texture = part.texture < 0 ? white : layer(part.texture);
  const std::uint32_t shades = part.shades < 0 ? 0 : layer(part.shades);
  check(std::max(texture, shades) < 1U << 12U, "twelve bits number the people's textures");
  return texture | (shades << 12U) | (static_cast<std::uint32_t>(part.tint) << 24U) |
         (apart ? 1U << 31U : 0U);
}

/// Packs meshes one after the other.
class Packer {
 public:
  explicit Packer(const skinning::Population& population) : population_(population) {}

  PeopleLevel add(const skinning::Character& character, const skinning::Mesh& mesh, bool weld) {
    character_ = &character;
    PeopleLevel level;
    first_vertex_ = static_cast<std::uint32_t>(vertices_.size());
    level.first_vertex = static_cast<std::int32_t>(first_vertex_);
    for (const bool alpha_tested : {false, true}) {
      Range& range = alpha_tested ? level.alpha_tested : level.opaque;
      range.first = static_cast<std::uint32_t>(indices_.size());
      for (const skinning::Part& part : mesh.parts) {
        if (part.alpha_tested == alpha_tested) add_part(mesh, part, weld && !alpha_tested);
      }
      range.count = static_cast<std::uint32_t>(indices_.size()) - range.first;
    }
    return level;
  }

  /// A copy of what was added last.
  PackedMesh copy_of(const PeopleLevel& level) const {
    const auto first = indices_.begin() + level.opaque.first;
    return {{vertices_.begin() + level.first_vertex, vertices_.end()},
            {first, first + level.opaque.count},
            level.alpha_tested.count > 0};
  }

  Buffer vertices() const { return make_buffer(vertices_); }
  Buffer indices() const { return make_buffer(indices_); }

 private:
  /// Position and normal of a vertex; also its index in the mesh, if that matters.
  using VertexKey = std::array<std::uint32_t, 7>;

  static VertexKey place_of(const skinning::Vertex& vertex, std::uint32_t own) {
    DeviceVertex skin{};
    pack_skin(vertex, skin);
    VertexKey place{0, 0, 0, skin.bones, skin.weights, octahedral(vertex.normal), own};
    std::memcpy(place.data(), vertex.position.data(), sizeof(vertex.position));
    return place;
  }

  DeviceVertex packed(const skinning::Vertex& vertex, const skinning::Part& part) const {
    DeviceVertex packed{};
    packed.position = vertex.position;
    pack_skin(vertex, packed);
    packed.part = pack_info(part, skinning::is_apart(*character_, part),
                            static_cast<std::uint32_t>(population_.textures.size()));
    packed.normal = octahedral(vertex.normal);
    packed.uv = vertex.uv;
    packed.base = pack_bytes(kWhiteRgba);
    return packed;
  }

  /// A part has its own copies of its vertices, since a vertex on the device belongs to one part.
  void add_part(const skinning::Mesh& mesh, const skinning::Part& part, bool weld) {
    const std::size_t first = vertices_.size();
    std::map<VertexKey, std::uint32_t> copy_of;
    for (std::uint32_t i = part.first_index; i < part.first_index + part.index_count; ++i) {
      const std::uint32_t index = mesh.indices[i];
      const skinning::Vertex& vertex = mesh.vertices[index];
      const auto [copy, is_new] =
          copy_of.emplace(place_of(vertex, weld ? 0 : index),
                          static_cast<std::uint32_t>(vertices_.size()) - first_vertex_);
      if (is_new) vertices_.push_back(packed(vertex, part));
      indices_.push_back(copy->second);
    }
    if (weld) color_corners(mesh, part, first);
  }

  /// Colors the vertices from number `first` on, which are those of the part that came last.
  void color_corners(const skinning::Mesh& mesh, const skinning::Part& part, std::size_t first) {
    const std::size_t count = vertices_.size() - first;
    const std::size_t first_index = indices_.size() - part.index_count;
    std::vector<TexturedTriangle> triangles(part.index_count / 3);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      std::array<Eigen::Vector3f, 3> at;
      for (std::size_t k = 0; k < 3; ++k) {
        const skinning::Vertex& vertex = mesh.vertices[mesh.indices[part.first_index + 3 * t + k]];
        at[k] = Eigen::Map<const Eigen::Vector3f>(vertex.position.data());
        triangles[t].uv[k] = vertex.uv;
        triangles[t].corners[k] =
            static_cast<std::uint32_t>(indices_[first_index + 3 * t + k] + first_vertex_ - first);
      }
      triangles[t].weight = 0.5F * (at[1] - at[0]).cross(at[2] - at[0]).norm();
    }
    const auto fit = [&](std::int32_t layer) {
      return corner_colors(population_.textures[static_cast<std::size_t>(layer)],
                           population_.texture_size, triangles, count);
    };
    if (part.texture >= 0) {
      const std::vector<Rgba> base = fit(part.texture);
      for (std::size_t i = 0; i < count; ++i) vertices_[first + i].base = pack_bytes(base[i]);
    }
    if (part.shades >= 0) {
      const std::vector<Rgba> shades = fit(part.shades);
      for (std::size_t i = 0; i < count; ++i) {
        vertices_[first + i].shades = pack_bytes(linear_shades(shades[i]));
      }
    }
  }

  const skinning::Population& population_;
  std::vector<DeviceVertex> vertices_;
  std::vector<std::uint32_t> indices_;
  const skinning::Character* character_ = nullptr;  ///< whose level is being added
  std::uint32_t first_vertex_ = 0;                  ///< of that level
};

}  // namespace

PeopleMeshes people_meshes(const skinning::Population& population, const Packing& packing) {
  PeopleMeshes meshes;
  Packer packer(population);
  for (const skinning::Character& character : population.characters) {
    std::vector<PeopleLevel>& textured = meshes.textured.emplace_back();
    std::vector<PeopleLevel>& by_corners = meshes.by_corners.emplace_back();
    PackedMesh& distant = meshes.distant.emplace_back();
    for (std::size_t level = 0; level < character.levels.size(); ++level) {
      const skinning::Mesh& mesh = character.levels[level];
      textured.push_back(level < packing.textured_below ? packer.add(character, mesh, false)
                                                        : PeopleLevel{});
      const bool has_corners = level >= packing.corners_from;
      by_corners.push_back(has_corners ? packer.add(character, mesh, true) : PeopleLevel{});
      if (has_corners && level == skinning::kDistantLevel) {
        distant = packer.copy_of(by_corners.back());
      }
    }
  }
  meshes.vertices = packer.vertices();
  meshes.indices = packer.indices();
  return meshes;
}

}  // namespace throng::render
