// Small test fixtures.
#pragma once

#include <string>
#include <vector>

#include "skinning/glb.h"
#include "skinning/image.h"
#include "skinning/skeleton.h"

namespace throng::skinning {

/// Joints of a person of 1.8 m with feet that point forwards.
inline Joints made_up_joints() {
  Joints joints;
  const auto put = [&](Bone bone, float x, float y, float z) {
    joints[index_from(bone)] = {x, y, z};
  };
  put(Bone::hips, 0, 0, 0.95F);
  put(Bone::spine, 0, 0, 1.05F);
  put(Bone::chest, 0, 0, 1.2F);
  put(Bone::neck, 0, 0, 1.5F);
  put(Bone::head, 0, 0, 1.6F);
  for (const bool left : {true, false}) {
    const float side = left ? 1 : -1;
    const auto of = [&](Bone bone) {
      return static_cast<Bone>(index_from(bone) + (left ? 0 : 4));  // each limb has four bones
    };
    put(of(Bone::left_clavicle), 0, side * 0.03F, 1.45F);
    put(of(Bone::left_upper_arm), 0, side * 0.18F, 1.45F);
    put(of(Bone::left_forearm), 0, side * 0.22F, 1.17F);
    put(of(Bone::left_hand), 0.02F, side * 0.24F, 0.92F);
    put(of(Bone::left_thigh), 0, side * 0.1F, 0.95F);
    put(of(Bone::left_shin), 0, side * 0.09F, 0.52F);
    put(of(Bone::left_foot), 0, side * 0.08F, 0.09F);
    put(of(Bone::left_toe), 0.14F, side * 0.09F, 0.03F);
  }
  return joints;
}

inline Vertex made_up_vertex(const Eigen::Vector3f& position, Bone bone, Bone other,
                             std::uint8_t share) {
  Vertex vertex{};
  vertex.position = {position.x(), position.y(), position.z()};
  vertex.normal = {0, 0, 1};
  vertex.uv = {0.25F, 0.75F};
  vertex.bones = {static_cast<std::uint8_t>(bone), static_cast<std::uint8_t>(other), 0, 0};
  vertex.weights = {static_cast<std::uint8_t>(255 - share), share, 0, 0};
  return vertex;
}

/// An image of one color.
inline Image plain(int size, Rgb color) {
  Image image(size, size);
  for (std::size_t at = 0; at < image.rgba.size(); at += 4) {
    std::copy(color.begin(), color.end(), image.rgba.begin() + static_cast<std::ptrdiff_t>(at));
    image.rgba[at + 3] = 255;
  }
  return image;
}

/// Two levels, three parts, two images; every bone is used.
inline CharacterAsset made_up_asset() {
  CharacterAsset asset;
  asset.name = "made_up";
  asset.joints = made_up_joints();
  Mesh mesh;
  for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
    const auto near = static_cast<Bone>(bone);
    const Eigen::Vector3f& joint = asset.joints[bone];
    for (const Eigen::Vector3f& offset :
         {Eigen::Vector3f(0.05F, 0, 0), Eigen::Vector3f(0, 0.05F, 0),
          Eigen::Vector3f(0, 0, 0.05F)}) {
      mesh.indices.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
      mesh.vertices.push_back(made_up_vertex(joint + offset, near, kParent[bone],
                                             bone == 0 ? 0 : static_cast<std::uint8_t>(7 * bone)));
    }
  }
  mesh.parts = {
      {0, 30, 0, Tint::none, false}, {30, 15, 1, Tint::top, false}, {45, 18, 1, Tint::hair, true}};
  asset.levels = {mesh, mesh};
  asset.images = {encode_png(plain(8, {10, 20, 30})), encode_png(plain(8, {200, 210, 220}))};
  return asset;
}

}  // namespace throng::skinning
