#include "tests/render/synthetic_people.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace throng::render {

namespace {

using skinning::Bone;
using skinning::Tint;

struct Box {
  Bone bone;
  Tint tint;
  int texture;
  Eigen::Vector3f min;
  Eigen::Vector3f max;
};

constexpr int kSkin = 0;
constexpr int kCloth = 1;
constexpr int kHair = 2;
constexpr int kTextureSize = 16;
constexpr std::uint32_t kFramesPerStride = 8;

/// Facing +x, left is +y; hands a little apart from the body.
std::vector<Box> body() {
  std::vector<Box> boxes = {
      {Bone::hips, Tint::bottom, kCloth, {-0.11F, -0.17F, 0.85F}, {0.11F, 0.17F, 1.05F}},
      {Bone::chest, Tint::top, kCloth, {-0.12F, -0.21F, 1.05F}, {0.12F, 0.21F, 1.50F}},
      {Bone::head, Tint::none, kSkin, {-0.10F, -0.08F, 1.50F}, {0.10F, 0.08F, 1.74F}},
      {Bone::head, Tint::hair, kHair, {-0.13F, -0.10F, 1.60F}, {0.06F, 0.10F, 1.80F}},
  };
  for (const float side : {1.0F, -1.0F}) {
    const bool left = side > 0;
    const auto add = [&](Bone bone, Tint tint, int texture, Eigen::Vector3f min,
                         Eigen::Vector3f max) {
      if (!left) {
        const float low = -max.y();
        max.y() = -min.y();
        min.y() = low;
      }
      boxes.push_back({bone, tint, texture, min, max});
    };
    add(left ? Bone::left_upper_arm : Bone::right_upper_arm, Tint::top, kCloth,
        {-0.06F, 0.23F, 1.15F}, {0.06F, 0.33F, 1.48F});
    add(left ? Bone::left_forearm : Bone::right_forearm, Tint::none, kSkin, {-0.05F, 0.24F, 0.80F},
        {0.05F, 0.32F, 1.15F});
    add(left ? Bone::left_thigh : Bone::right_thigh, Tint::bottom, kCloth, {-0.09F, 0.02F, 0.45F},
        {0.09F, 0.17F, 0.86F});
    add(left ? Bone::left_shin : Bone::right_shin, Tint::bottom, kCloth, {-0.07F, 0.03F, 0.07F},
        {0.07F, 0.15F, 0.46F});
    add(left ? Bone::left_foot : Bone::right_foot, Tint::shoes, kCloth, {-0.08F, 0.03F, 0.0F},
        {0.20F, 0.14F, 0.08F});
  }
  return boxes;
}

/// One face of a box: the corner from which `u` and `v` span it, u x v pointing outwards.
void add_face(const Box& box, const Eigen::Vector3f& corner, const Eigen::Vector3f& u,
              const Eigen::Vector3f& v, int cuts, skinning::Mesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const Eigen::Vector3f normal = u.cross(v).normalized();
  for (int row = 0; row <= cuts; ++row) {
    for (int column = 0; column <= cuts; ++column) {
      const float s = static_cast<float>(column) / static_cast<float>(cuts);
      const float t = static_cast<float>(row) / static_cast<float>(cuts);
      const Eigen::Vector3f p = corner + s * u + t * v;
      mesh.vertices.push_back({{p.x(), p.y(), p.z()},
                               {normal.x(), normal.y(), normal.z()},
                               {s, t},
                               {static_cast<std::uint8_t>(box.bone), 0, 0, 0},
                               {255, 0, 0, 0}});
    }
  }
  const auto side = static_cast<std::uint32_t>(cuts + 1);
  for (std::uint32_t row = 0; row + 1 < side; ++row) {
    for (std::uint32_t column = 0; column + 1 < side; ++column) {
      const std::uint32_t a = first + row * side + column;
      for (const std::uint32_t index : {a, a + 1, a + side + 1, a, a + side + 1, a + side}) {
        mesh.indices.push_back(index);
      }
    }
  }
}

void add_box(const Box& box, int cuts, skinning::Mesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.indices.size());
  const Eigen::Vector3f size = box.max - box.min;
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::Vector3f u = Eigen::Vector3f::Zero();
    Eigen::Vector3f v = Eigen::Vector3f::Zero();
    u[(axis + 1) % 3] = size[(axis + 1) % 3];
    v[(axis + 2) % 3] = size[(axis + 2) % 3];
    Eigen::Vector3f upper = box.min;
    upper[axis] = box.max[axis];
    add_face(box, upper, u, v, cuts, mesh);
    add_face(box, box.min, v, u, cuts, mesh);
  }
  mesh.parts.push_back({first, static_cast<std::uint32_t>(mesh.indices.size()) - first, box.texture,
                        box.tint, box.texture == kHair});
}

skinning::Mesh boxes_mesh(int cuts) {
  skinning::Mesh mesh;
  for (const Box& box : body()) add_box(box, cuts, mesh);
  return mesh;
}

skinning::Texture plain(std::uint8_t r, std::uint8_t g, std::uint8_t b) {
  skinning::Texture texture;
  for (int i = 0; i < kTextureSize * kTextureSize; ++i) {
    texture.rgba.insert(texture.rgba.end(), {r, g, b, 255});
  }
  return texture;
}

/// Diagonal strands with gaps between them.
skinning::Texture strands() {
  skinning::Texture texture = plain(230, 230, 230);
  for (int i = 0; i < kTextureSize * kTextureSize; ++i) {
    const bool gap = (i % kTextureSize + i / kTextureSize) % 8 < 3;
    if (gap) texture.rgba[static_cast<std::size_t>(i) * 4 + 3] = 0;
  }
  return texture;
}

/// Joints of the boxes.
std::array<Eigen::Vector3f, skinning::kBoneCount> joints() {
  std::array<Eigen::Vector3f, skinning::kBoneCount> joints;
  joints.fill({0.0F, 0.0F, 0.95F});
  const auto set = [&](Bone bone, float y, float z) {
    joints[static_cast<std::size_t>(bone)] = {0.0F, y, z};
  };
  set(Bone::chest, 0, 1.2F);
  set(Bone::neck, 0, 1.5F);
  set(Bone::head, 0, 1.55F);
  set(Bone::left_upper_arm, 0.28F, 1.45F);
  set(Bone::right_upper_arm, -0.28F, 1.45F);
  set(Bone::left_forearm, 0.28F, 1.15F);
  set(Bone::right_forearm, -0.28F, 1.15F);
  set(Bone::left_hand, 0.28F, 0.85F);
  set(Bone::right_hand, -0.28F, 0.85F);
  set(Bone::left_thigh, 0.095F, 0.86F);
  set(Bone::right_thigh, -0.095F, 0.86F);
  set(Bone::left_shin, 0.095F, 0.46F);
  set(Bone::right_shin, -0.095F, 0.46F);
  set(Bone::left_foot, 0.095F, 0.07F);
  set(Bone::right_foot, -0.095F, 0.07F);
  return joints;
}

/// Swings everything below a joint forwards (positive) or backwards.
skinning::BoneMatrix swung(float angle_rad, float joint_height) {
  const Eigen::Vector3f joint(0, 0, joint_height);
  const Eigen::Matrix3f turn =
      Eigen::AngleAxisf(-angle_rad, Eigen::Vector3f::UnitY()).toRotationMatrix();
  skinning::BoneMatrix bone;
  bone << turn, joint - turn * joint;
  return bone;
}

skinning::Palette pose(float leg_rad) {
  skinning::Palette palette;
  palette.fill(skinning::BoneMatrix::Identity());
  const auto set = [&](Bone bone, float angle, float height) {
    palette[static_cast<std::size_t>(bone)] = swung(angle, height);
  };
  for (const Bone bone : {Bone::left_thigh, Bone::left_shin, Bone::left_foot, Bone::left_toe}) {
    set(bone, leg_rad, 0.86F);
  }
  for (const Bone bone : {Bone::right_thigh, Bone::right_shin, Bone::right_foot, Bone::right_toe}) {
    set(bone, -leg_rad, 0.86F);
  }
  for (const Bone bone : {Bone::left_upper_arm, Bone::left_forearm, Bone::left_hand}) {
    set(bone, -0.8F * leg_rad, 1.45F);
  }
  for (const Bone bone : {Bone::right_upper_arm, Bone::right_forearm, Bone::right_hand}) {
    set(bone, 0.8F * leg_rad, 1.45F);
  }
  return palette;
}

}  // namespace

skinning::Population synthetic_people(std::size_t characters) {
  skinning::Population people;
  people.texture_size = kTextureSize;
  people.textures = {plain(205, 160, 130), plain(235, 235, 235), strands()};
  people.clips = {{"idle", 0.0F, 0, 1},
                  {"walk", 1.3F, 1, kFramesPerStride, 0.8F, 0.25F},
                  {"run", 3.0F, 1 + kFramesPerStride, kFramesPerStride, 1.2F, 0.13F}};
  people.palettes_per_character = 1 + 2 * kFramesPerStride;
  const skinning::Mesh fine = boxes_mesh(2);
  const skinning::Mesh coarse = boxes_mesh(1);
  for (std::size_t i = 0; i < characters; ++i) {
    skinning::Character& character = people.characters.emplace_back();
    character.name = "box man " + std::to_string(i);
    character.stature_m = kSyntheticStatureM;
    character.levels = {fine, coarse};
    character.joints = joints();
    people.palettes.push_back(pose(0));
    for (const float swing_rad : {0.4F, 0.7F}) {
      for (std::uint32_t frame = 0; frame < kFramesPerStride; ++frame) {
        const float phase = static_cast<float>(frame) / kFramesPerStride;
        people.palettes.push_back(
            pose(swing_rad * std::cos(2 * std::numbers::pi_v<float> * phase)));
      }
    }
  }
  return people;
}

skinning::Population under_umbrellas(float half_m, std::size_t characters) {
  skinning::Population people = synthetic_people(characters);
  const Box canopy = {
      Bone::chest, Tint::item, kCloth, {-half_m, -half_m, 1.9F}, {half_m, half_m, 1.95F}};
  for (skinning::Character& character : people.characters) {
    character.carries = skinning::Carry::umbrella;
    for (skinning::Mesh& level : character.levels) add_box(canopy, 1, level);
  }
  return people;
}

skinning::Population behind_prams(std::size_t characters) {
  skinning::Population people = synthetic_people(characters);
  const Box pram = {static_cast<Bone>(skinning::kStillBone),
                    Tint::item,
                    kCloth,
                    {0.6F, -0.3F, 0.1F},
                    {1.2F, 0.3F, 0.9F}};
  for (skinning::Character& character : people.characters) {
    character.carries = skinning::Carry::pram;
    for (skinning::Mesh& level : character.levels) add_box(pram, 1, level);
  }
  return people;
}

PersonInstance standing(const skinning::Population& population, std::uint32_t agent, double x,
                        double y, double yaw_rad) {
  PersonInstance person;
  person.agent = agent;
  person.position = {static_cast<float>(x), static_cast<float>(y), 0.0F};
  person.yaw_rad = static_cast<float>(yaw_rad);
  person.appearance.character = agent % static_cast<std::uint32_t>(population.characters.size());
  person.appearance.tint.fill({180, 60, 50});
  person.pose = {population.clips.front().first, population.clips.front().first, 0.0F};
  return person;
}

}  // namespace throng::render
