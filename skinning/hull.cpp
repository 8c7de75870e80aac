#include "skinning/hull.h"

#include <meshoptimizer.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include "skinning/raster.h"

namespace throng::skinning {

namespace {

// Which way the camera of a portrait looks down: enough to see crowns and shoulders.
constexpr double kElevation_rad = 30 * std::numbers::pi / 180;
constexpr float kMargin_px = 3;

using Triangles = std::vector<std::uint32_t>;

// Closes every hole of a triangle mesh with a fan about its first vertex.
void close_holes(Triangles& triangles) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (std::size_t at = 0; at < triangles.size(); at += 3) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      edges.emplace(triangles[at + corner], triangles[at + (corner + 1) % 3]);
    }
  }
  std::map<std::uint32_t, std::uint32_t> next;  // along the border, the way a closing face runs
  for (const auto& [from, to] : edges) {
    if (!edges.contains({to, from})) next[to] = from;
  }
  while (!next.empty()) {
    const std::uint32_t first = next.begin()->first;
    std::vector<std::uint32_t> loop;
    for (std::uint32_t vertex = first; next.contains(vertex);) {
      loop.push_back(vertex);
      const std::uint32_t following = next.at(vertex);
      next.erase(vertex);
      vertex = following;
    }
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
      triangles.insert(triangles.end(), {loop[0], loop[i], loop[i + 1]});
    }
  }
}

enum class Limb : std::uint8_t { trunk, left_arm, right_arm, left_leg, right_leg };

Limb limb_of(const BoneWeights& weights) {
  const auto strongest =
      static_cast<Bone>(std::max_element(weights.begin(), weights.end()) - weights.begin());
  if (strongest >= Bone::right_thigh) return Limb::right_leg;
  if (strongest >= Bone::left_thigh) return Limb::left_leg;
  if (strongest >= Bone::right_upper_arm) return Limb::right_arm;
  if (strongest == Bone::right_clavicle) return Limb::trunk;
  if (strongest >= Bone::left_upper_arm) return Limb::left_arm;
  return Limb::trunk;
}

bool may_cover(Limb garment, Limb body) {
  return garment == body || garment == Limb::trunk || body == Limb::trunk;
}

const std::uint8_t* texel_at(const Image& image, const Eigen::Vector2f& uv) {
  const auto at = [](float value, int count) {
    return std::clamp(static_cast<int>(std::floor(value * static_cast<float>(count))), 0,
                      count - 1);
  };
  return image.pixel(at(uv.x(), image.width), at(uv.y(), image.height));
}

Eigen::Vector2f uv_at(const Surface& surface, std::size_t at, const Eigen::Vector3f& barycentric) {
  return barycentric.x() * surface.uvs[surface.indices[at]] +
         barycentric.y() * surface.uvs[surface.indices[at + 1]] +
         barycentric.z() * surface.uvs[surface.indices[at + 2]];
}

struct Cover {
  float distance_m = 0;
  Tint tint = Tint::none;
};

// Everything worn, for finding what lies over a point of the skin.
class Clothing {
 public:
  Clothing(const DressedPerson& person, const std::map<std::string, Image>& textures) {
    for (std::size_t i = 1; i < person.surfaces.size(); ++i) {
      const Surface& surface = person.surfaces[i];
      const Image& image = textures.at(surface.texture);
      for (std::size_t at = 0; at < surface.indices.size(); at += 3) {
        const std::uint32_t a = surface.indices[at];
        const Eigen::Vector3f& corner = surface.fitted[a];
        Triangle triangle{corner, surface.fitted[surface.indices[at + 1]] - corner,
                          surface.fitted[surface.indices[at + 2]] - corner,
                          limb_of(surface.weights[a]), surface.tint};
        if (surface.alpha_tested) {
          const Eigen::Vector2f uv = uv_at(surface, at, Eigen::Vector3f::Constant(1 / 3.0F));
          if (texel_at(image, uv)[3] < 128) continue;
          triangle.two_sided = true;
        }
        triangles_.push_back(triangle);
      }
    }
  }

  // The outermost cover of a point of the skin, looking along its normal.
  std::optional<Cover> over(const Eigen::Vector3f& point, const Eigen::Vector3f& normal,
                            Limb limb) const {
    constexpr float kBelow_m = 0.02F;
    const float reach = limb == Limb::trunk ? 0.12F : 0.07F;
    const Eigen::Vector3f origin = point - kBelow_m * normal;
    std::optional<Cover> outermost;
    for (const Triangle& triangle : triangles_) {
      if (!may_cover(triangle.limb, limb)) continue;
      const Eigen::Vector3f p = normal.cross(triangle.to_c);
      const float determinant = triangle.to_b.dot(p);  // positive when it faces outwards
      if (triangle.two_sided ? std::abs(determinant) < 1e-12F : determinant < 1e-12F) continue;
      const Eigen::Vector3f s = origin - triangle.corner;
      const float u = s.dot(p) / determinant;
      if (u < 0 || u > 1) continue;
      const Eigen::Vector3f q = s.cross(triangle.to_b);
      const float v = normal.dot(q) / determinant;
      if (v < 0 || u + v > 1) continue;
      const float distance = triangle.to_c.dot(q) / determinant - kBelow_m;
      if (distance < -kBelow_m || distance > reach) continue;
      if (!outermost || distance > outermost->distance_m) {
        outermost = Cover{distance, triangle.tint};
      }
    }
    return outermost;
  }

 private:
  struct Triangle {
    Eigen::Vector3f corner;
    Eigen::Vector3f to_b;
    Eigen::Vector3f to_c;
    Limb limb;
    Tint tint;
    bool two_sided = false;
  };
  std::vector<Triangle> triangles_;
};

std::vector<Eigen::Vector3f> vertex_normals(std::span<const Eigen::Vector3f> positions,
                                            const std::vector<std::uint32_t>& indices) {
  std::vector<Eigen::Vector3f> normals(positions.size(), Eigen::Vector3f::Zero());
  for (std::size_t at = 0; at < indices.size(); at += 3) {
    const Eigen::Vector3f& a = positions[indices[at]];
    const Eigen::Vector3f normal =
        (positions[indices[at + 1]] - a).cross(positions[indices[at + 2]] - a);
    for (std::size_t corner = 0; corner < 3; ++corner) normals[indices[at + corner]] += normal;
  }
  for (Eigen::Vector3f& normal : normals) {
    normal = normal.norm() > 0 ? normal.normalized() : Eigen::Vector3f::UnitZ();
  }
  return normals;
}

// The camera's picture plane (right, up) and the direction towards the camera.
Eigen::Vector3f view_of(const Eigen::Vector3f& point, bool front) {
  const auto c = static_cast<float>(std::cos(kElevation_rad));
  const auto s = static_cast<float>(std::sin(kElevation_rad));
  const float forward = front ? point.x() : -point.x();
  return {point.y(), point.z() * c - forward * s, forward * c + point.z() * s};
}

}  // namespace

HullTopology simplify_skin(const MakeHuman& makehuman, std::size_t triangles) {
  Triangles all;
  for (const Quad& quad : makehuman.skin()) {
    for (const std::size_t corner : {0, 1, 2, 0, 2, 3}) all.push_back(quad.vertex[corner]);
  }
  close_holes(all);
  const std::vector<Eigen::Vector3f>& positions = makehuman.base_positions();
  Triangles simple(all.size());
  const std::size_t target = std::min(3 * triangles, all.size());
  simple.resize(meshopt_simplify(simple.data(), all.data(), all.size(), positions.front().data(),
                                 positions.size(), sizeof(Eigen::Vector3f), target, 1.0F, 0,
                                 nullptr));
  HullTopology topology;
  std::map<std::uint32_t, std::uint32_t> place;
  for (const std::uint32_t vertex : simple) {
    const auto [entry, is_new] =
        place.try_emplace(vertex, static_cast<std::uint32_t>(topology.vertices.size()));
    if (is_new) topology.vertices.push_back(vertex);
    topology.indices.push_back(entry->second);
  }
  return topology;
}

Portrait::Portrait(const DressedPerson& person, const std::map<std::string, Image>& textures,
                   int size)
    : textures_(&textures),
      size_(size),
      colours_(size, size),
      texels_(static_cast<std::size_t>(size) * size),
      wanted_(texels_.size(), 0) {
  Eigen::AlignedBox2f bounds;
  for (const Surface& surface : person.surfaces) {
    for (const std::uint32_t index : surface.indices) {
      for (const bool front : {true, false}) {
        bounds.extend(Eigen::Vector2f(view_of(surface.fitted[index], front).head<2>()));
      }
    }
  }
  low_ = bounds.min();
  extent_ = bounds.sizes();
  for (const Surface& surface : person.surfaces) {
    const Image& image = textures.at(surface.texture);
    for (std::size_t at = 0; at < surface.indices.size(); at += 3) {
      const std::array<Eigen::Vector3f, 3> corner = {surface.fitted[surface.indices[at]],
                                                     surface.fitted[surface.indices[at + 1]],
                                                     surface.fitted[surface.indices[at + 2]]};
      for (const bool front : {true, false}) {
        const Eigen::Vector3f depth(view_of(corner[0], front).z(), view_of(corner[1], front).z(),
                                    view_of(corner[2], front).z());
        for_each_pixel(
            texel_of(corner[0], front), texel_of(corner[1], front), texel_of(corner[2], front),
            size_, size_, [&](int x, int y, const Eigen::Vector3f& barycentric) {
              Texel& texel = texels_[static_cast<std::size_t>(y) * size_ + x];
              const float here = depth.dot(barycentric);
              if (here <= texel.depth) return;
              const std::uint8_t* from = texel_at(image, uv_at(surface, at, barycentric));
              if (surface.alpha_tested && from[3] < 128) return;
              texel = {here, surface.tint, true};
              std::copy_n(from, 3, colours_.pixel(x, y));
            });
      }
    }
  }
}

// Front view in the left half of the picture, back view in the right half.
Eigen::Vector2f Portrait::texel_of(const Eigen::Vector3f& point, bool front) const {
  const Eigen::Vector3f view = view_of(point, front);
  const float half = static_cast<float>(size_) / 2;
  const float across = (view.x() - low_.x()) / extent_.x();
  const float down = 1 - (view.y() - low_.y()) / extent_.y();
  return {(front ? 0 : half) + kMargin_px + across * (half - 2 * kMargin_px),
          kMargin_px + down * (static_cast<float>(size_) - 2 * kMargin_px)};
}

Mesh Portrait::add_hull(const MakeHuman& makehuman, const DressedPerson& person,
                        const HullTopology& topology, int texture) {
  const Clothing clothing(person, *textures_);
  const std::size_t count = topology.vertices.size();
  std::vector<Eigen::Vector3f> body(count);
  for (std::size_t i = 0; i < count; ++i) body[i] = person.body[topology.vertices[i]];
  const std::vector<Eigen::Vector3f> outwards = vertex_normals(body, topology.indices);

  std::vector<Eigen::Vector3f> fitted = body;
  std::vector<Eigen::Vector3f> standing(count);
  for (std::size_t i = 0; i < count; ++i) {
    const BoneWeights& weights = makehuman.weights()[topology.vertices[i]];
    const auto cover = clothing.over(body[i], outwards[i], limb_of(weights));
    if (cover) fitted[i] += cover->distance_m * outwards[i];
    standing[i] = move_point(fitted[i], weights, person.to_neutral);
  }
  const std::vector<Eigen::Vector3f> normals = vertex_normals(standing, topology.indices);

  // Triangles by (tint, side), so that each run of the mesh has one tint.
  std::map<std::pair<Tint, bool>, Triangles> groups;
  for (std::size_t at = 0; at < topology.indices.size(); at += 3) {
    const std::array<std::uint32_t, 3> corner = {topology.indices[at], topology.indices[at + 1],
                                                 topology.indices[at + 2]};
    const Eigen::Vector3f middle = (body[corner[0]] + body[corner[1]] + body[corner[2]]) / 3;
    const Eigen::Vector3f normal =
        (outwards[corner[0]] + outwards[corner[1]] + outwards[corner[2]]).normalized();
    const Limb limb = limb_of(makehuman.weights()[topology.vertices[corner[0]]]);
    const auto cover = clothing.over(middle, normal, limb);
    const Eigen::Vector3f face =
        (fitted[corner[1]] - fitted[corner[0]]).cross(fitted[corner[2]] - fitted[corner[0]]);
    auto& group = groups[{cover ? cover->tint : Tint::none, face.x() >= 0}];
    group.insert(group.end(), corner.begin(), corner.end());
  }

  Mesh mesh;
  for (const auto& [key, triangles] : groups) {
    const auto [tint, front] = key;
    std::map<std::uint32_t, std::uint32_t> place;
    const auto first_index = static_cast<std::uint32_t>(mesh.indices.size());
    for (const std::uint32_t i : triangles) {
      const auto [entry, is_new] =
          place.try_emplace(i, static_cast<std::uint32_t>(mesh.vertices.size()));
      if (is_new) {
        const Eigen::Vector2f uv = texel_of(fitted[i], front) / static_cast<float>(size_);
        Vertex vertex{};
        vertex.position = {standing[i].x(), standing[i].y(), standing[i].z()};
        vertex.normal = {normals[i].x(), normals[i].y(), normals[i].z()};
        vertex.uv = {uv.x(), uv.y()};
        set_weights(vertex, makehuman.weights()[topology.vertices[i]]);
        mesh.vertices.push_back(vertex);
      }
      mesh.indices.push_back(entry->second);
    }
    for (std::size_t at = 0; at < triangles.size(); at += 3) {
      for_each_pixel(texel_of(fitted[triangles[at]], front),
                     texel_of(fitted[triangles[at + 1]], front),
                     texel_of(fitted[triangles[at + 2]], front), size_, size_,
                     [&, tint = tint](int x, int y, const Eigen::Vector3f&) {
                       wanted_[static_cast<std::size_t>(y) * size_ + x] =
                           static_cast<std::uint8_t>(1 + static_cast<int>(tint));
                     });
    }
    const auto index_count = static_cast<std::uint32_t>(mesh.indices.size()) - first_index;
    if (!mesh.parts.empty() && mesh.parts.back().tint == tint) {
      mesh.parts.back().index_count += index_count;
    } else {
      mesh.parts.push_back({first_index, index_count, texture, tint, false});
    }
  }
  return mesh;
}

// Where a hull is coloured as skin but the picture shows a sleeve, and the like, the nearest texel
// of the right kind is taken.
Image Portrait::picture() const {
  Image result = colours_;
  Mask settled(texels_.size(), 0);
  for (std::uint8_t tint = 0; tint < kTintCount; ++tint) {
    Image of_tint = colours_;
    Mask seen(texels_.size(), 0);
    for (std::size_t at = 0; at < texels_.size(); ++at) {
      seen[at] = texels_[at].seen && static_cast<std::uint8_t>(texels_[at].tint) == tint ? 1 : 0;
    }
    fill_from_nearest(of_tint, std::move(seen));
    for (std::size_t at = 0; at < texels_.size(); ++at) {
      if (wanted_[at] != tint + 1) continue;
      std::copy_n(&of_tint.rgba[4 * at], 3, &result.rgba[4 * at]);
      settled[at] = 1;
    }
  }
  fill_from_nearest(result, std::move(settled));
  for (std::size_t at = 3; at < result.rgba.size(); at += 4) result.rgba[at] = 255;
  return result;
}

}  // namespace throng::skinning
