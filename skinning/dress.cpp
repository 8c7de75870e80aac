#include "skinning/dress.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/angle.h"

namespace throng::skinning {

namespace {

// MakeHuman's joints at which our bones start, in palette order.
constexpr std::array<const char*, kBoneCount> kJointNames = {
    "",  // the hips turn about the middle between the hip joints
    "spine04____head",
    "spine02____head",
    "neck01____head",
    "head____head",
    "clavicle.L____head",
    "upperarm01.L____head",
    "lowerarm01.L____head",
    "wrist.L____head",
    "clavicle.R____head",
    "upperarm01.R____head",
    "lowerarm01.R____head",
    "wrist.R____head",
    "upperleg01.L____head",
    "lowerleg01.L____head",
    "foot.L____head",
    "toe2-1.L____head",
    "upperleg01.R____head",
    "lowerleg01.R____head",
    "foot.R____head",
    "toe2-1.R____head",
};

Joints find_joints(const MakeHuman& makehuman, std::span<const Eigen::Vector3f> body) {
  Joints joints;
  for (std::size_t bone = 1; bone < kBoneCount; ++bone) {
    joints[bone] = makehuman.joint(kJointNames[bone], body);
  }
  joints[0] = 0.5F * (joints[index_of(Bone::left_thigh)] + joints[index_of(Bone::right_thigh)]);
  return joints;
}

void straighten_leg(const Joints& joints, Bone thigh, double stance, Pose& pose) {
  const std::size_t first = index_of(thigh);
  const Eigen::Vector3f& hip = joints[first];
  const Eigen::Vector3f& knee = joints[first + 1];
  const Eigen::Vector3f& ankle = joints[first + 2];
  const Eigen::Vector3f& ball = joints[first + 3];
  const float side = thigh == Bone::left_thigh ? 1.0F : -1.0F;
  const float length = (knee - hip).norm() + (ankle - knee).norm();
  const float splay = static_cast<float>(stance) - side * hip.y() / length;
  const Eigen::Vector3f down(0.02F, side * splay, -1);
  pose.rotation[first] = turn_between(knee - hip, down);
  pose.rotation[first + 1] = turn_between(ankle - knee, down);
  const double toe_out = side * 6 * kDegree;
  const double heading = std::atan2(ball.y() - ankle.y(), ball.x() - ankle.x());
  pose.rotation[first + 2] = pose.rotation[first + 3] = turn_z(toe_out - heading);
}

void lower_arm(const Joints& joints, Bone upper_arm, double out_deg, Pose& pose) {
  const std::size_t first = index_of(upper_arm);
  const Eigen::Vector3f& shoulder = joints[first];
  const Eigen::Vector3f& elbow = joints[first + 1];
  const Eigen::Vector3f& wrist = joints[first + 2];
  const float side = upper_arm == Bone::left_upper_arm ? 1.0F : -1.0F;
  const auto out = static_cast<float>(std::tan(out_deg * kDegree));
  const Eigen::Vector3f upper(0, side * out, -1);
  const Eigen::Vector3f lower(0.06F, side * 0.4F * out, -1);
  pose.rotation[first] = turn_between(elbow - shoulder, upper);
  // The A-pose bends the elbow forwards; unbend it with the upper arm already in place, so that
  // the palm ends up facing the thigh.
  const Eigen::Vector3f carried = pose.rotation[first] * (wrist - elbow);
  pose.rotation[first + 1] = turn_between(carried, lower) * pose.rotation[first];
  pose.rotation[first + 2] = pose.rotation[first + 1];
}

// From the A-pose to standing: straight legs below the hips, arms hanging.
Pose neutral_pose(const Joints& joints, const BodyShape& shape) {
  Pose pose;
  // Ankles stand 14 % of the leg apart, a usual step width. Heavier people stand wider and their
  // arms hang further from the body.
  const double heavy = std::max(0.0, shape.weight - 0.5);
  const double stance = 0.07 + 0.06 * heavy;
  straighten_leg(joints, Bone::left_thigh, stance, pose);
  straighten_leg(joints, Bone::right_thigh, stance, pose);
  const double arms_out_deg = 9 + 14 * heavy;
  lower_arm(joints, Bone::left_upper_arm, arms_out_deg, pose);
  lower_arm(joints, Bone::right_upper_arm, arms_out_deg, pose);
  return pose;
}

struct Stance {
  std::vector<Eigen::Vector3f> body;  // A-pose
  Joints joints;                      // neutral
  Palette to_neutral;
  float lowest = 0;
  float highest = 0;
};

Stance stand(const MakeHuman& makehuman, const BodyShape& shape) {
  Stance stance;
  stance.body = makehuman.morph(shape);
  const Joints joints = find_joints(makehuman, stance.body);
  const Pose pose = neutral_pose(joints, shape);
  stance.joints = pose_joints(joints, pose);
  stance.to_neutral = pose_palette(joints, pose);
  stance.lowest = std::numeric_limits<float>::max();
  stance.highest = std::numeric_limits<float>::lowest();
  for (const Quad& quad : makehuman.skin()) {
    const std::uint32_t vertex = quad.vertex[0];
    const BoneWeights& weights = makehuman.weights()[vertex];
    const float z = move_point(stance.body[vertex], weights, stance.to_neutral).z();
    stance.lowest = std::min(stance.lowest, z);
    stance.highest = std::max(stance.highest, z);
  }
  return stance;
}

// The height slider acts steeply and differently for every body: solve it.
Stance stand_at_height(const MakeHuman& makehuman, BodyShape shape, double height_m) {
  double low = 0;
  double high = 1;
  constexpr int kSteps = 12;  // to 0.3 mm
  for (int step = 0; step < kSteps; ++step) {
    shape.height = 0.5 * (low + high);
    const Stance stance = stand(makehuman, shape);
    (stance.highest - stance.lowest < height_m ? low : high) = shape.height;
  }
  return stand(makehuman, shape);
}

std::vector<Eigen::Vector3f> fit(const Proxy& proxy, std::span<const Eigen::Vector3f> body) {
  std::vector<Eigen::Vector3f> fitted;
  fitted.reserve(proxy.anchors.size());
  for (const Proxy::Anchor& anchor : proxy.anchors) {
    Eigen::Vector3f position = anchor.offset;
    for (std::size_t i = 0; i < 3; ++i) position += anchor.weight[i] * body[anchor.body_vertex[i]];
    fitted.push_back(position);
  }
  return fitted;
}

float below_waist(const BoneWeights& weights) {
  float sum = weights[index_of(Bone::hips)];
  for (std::size_t bone = index_of(Bone::left_thigh); bone < kBoneCount; ++bone) {
    sum += weights[bone];
  }
  return sum;
}

// A garment hides the skin of its own half only: worn over something else's trousers, a shirt must
// not hide the legs that its own trousers would have covered.
std::vector<bool> covered_skin(const MakeHuman& makehuman, const Wardrobe& wardrobe,
                               const PersonSpec& person) {
  const Proxy& top = wardrobe.proxy(person.top);
  const Proxy& bottom = wardrobe.proxy(person.bottom);
  const Proxy& shoes = wardrobe.proxy(person.shoes);
  std::vector<bool> covered(makehuman.weights().size());
  for (std::size_t vertex = 0; vertex < covered.size(); ++vertex) {
    const bool lower_half = below_waist(makehuman.weights()[vertex]) > 0.5F;
    covered[vertex] =
        shoes.hides[vertex] || (lower_half ? bottom.hides[vertex] : top.hides[vertex]);
  }
  return covered;
}

bool all_corners(const Surface& surface, std::size_t at, const auto& holds) {
  return holds(surface.indices[at]) && holds(surface.indices[at + 1]) &&
         holds(surface.indices[at + 2]);
}

// Lowest point of what covers the shins, per leg side; large when the legs are bare.
float hem_of(std::span<const Surface> bottoms) {
  float hem = std::numeric_limits<float>::max();
  for (const Surface& surface : bottoms) {
    for (const std::uint32_t index : surface.indices) {
      const BoneWeights& weights = surface.weights[index];
      const float shin = weights[index_of(Bone::left_shin)] + weights[index_of(Bone::right_shin)];
      if (shin > 0.5F) hem = std::min(hem, surface.positions[index].z());
    }
  }
  return hem;
}

// Height to which the top reaches down at least, all around the body.
float reach_of(std::span<const Surface> tops, const Joints& joints) {
  constexpr int kSectors = 16;
  std::array<float, kSectors> lowest{};
  lowest.fill(std::numeric_limits<float>::max());
  const Eigen::Vector3f& hips = joints[0];
  for (const Surface& surface : tops) {
    for (const std::uint32_t index : surface.indices) {
      const BoneWeights& weights = surface.weights[index];
      const float trunk = weights[index_of(Bone::hips)] + weights[index_of(Bone::spine)] +
                          weights[index_of(Bone::chest)];
      if (trunk < 0.6F) continue;
      const Eigen::Vector3f p = surface.positions[index] - hips;
      const double turn = std::atan2(p.y(), p.x()) / (2 * std::numbers::pi) + 0.5;
      const int sector = std::min(static_cast<int>(turn * kSectors), kSectors - 1);
      lowest[sector] = std::min(lowest[sector], surface.positions[index].z());
    }
  }
  return *std::max_element(lowest.begin(), lowest.end());
}

Surface wear(const Garment& garment, const DressedPerson& dressed) {
  const std::vector<Eigen::Vector3f> fitted = fit(*garment.proxy, dressed.body);
  Surface surface = make_surface(garment.quads, garment.proxy->uvs, fitted, garment.proxy->weights,
                                 dressed.to_neutral);
  surface.texture = garment.texture;
  surface.tint = garment.tint;
  surface.alpha_tested = garment.alpha_tested;
  return surface;
}

std::vector<Surface> wear_all(const std::vector<Garment>& garments, const DressedPerson& dressed) {
  std::vector<Surface> surfaces;
  surfaces.reserve(garments.size());
  for (const Garment& garment : garments) surfaces.push_back(wear(garment, dressed));
  return surfaces;
}

Surface skin_of(const MakeHuman& makehuman, const PersonSpec& person,
                const DressedPerson& dressed) {
  Surface skin = make_surface(makehuman.skin(), makehuman.uvs(), dressed.body, makehuman.weights(),
                              dressed.to_neutral);
  keep_triangles(skin, [&](std::size_t at) {
    return !all_corners(skin, at, [&](std::uint32_t vertex) -> bool {
      return dressed.covered[skin.source[vertex]];
    });
  });
  skin.texture = person.skin;
  return skin;
}

// Adds surfaces that together have about `triangles` triangles, each its share.
void add_simplified(std::vector<Surface> more, std::size_t triangles, std::vector<Surface>& all) {
  std::size_t indices = 0;
  for (const Surface& surface : more) indices += surface.indices.size();
  for (Surface& surface : more) {
    if (surface.indices.empty()) continue;
    simplify(surface, triangles * surface.indices.size() / indices);
    all.push_back(std::move(surface));
  }
}

// Moves everything so that the soles stand on z = 0 with the hips above the origin.
void put_on_ground(DressedPerson& dressed) {
  float lowest = std::numeric_limits<float>::max();
  for (const Surface& surface : dressed.surfaces) {
    for (const std::uint32_t index : surface.indices) {
      lowest = std::min(lowest, surface.positions[index].z());
    }
  }
  const Eigen::Vector3f shift(-dressed.joints[0].x(), -dressed.joints[0].y(), -lowest);
  for (Surface& surface : dressed.surfaces) {
    for (Eigen::Vector3f& position : surface.positions) position += shift;
  }
  for (Eigen::Vector3f& joint : dressed.joints) joint += shift;
  for (BoneMatrix& matrix : dressed.to_neutral) matrix.col(3) += shift;
  const Surface& skin = dressed.surfaces.front();
  for (const std::uint32_t index : skin.indices) {
    dressed.stature_m = std::max(dressed.stature_m, skin.positions[index].z());
  }
}

}  // namespace

DressedPerson dress(const MakeHuman& makehuman, const Wardrobe& wardrobe,
                    const PersonSpec& person) {
  DressedPerson dressed;
  Stance stance = stand_at_height(makehuman, person.shape, person.height_m);
  makehuman.curl_fingers(stance.body);
  dressed.body = std::move(stance.body);
  dressed.joints = stance.joints;
  dressed.to_neutral = stance.to_neutral;
  dressed.covered = covered_skin(makehuman, wardrobe, person);

  const std::vector<Surface> tops = wear_all(wardrobe.pieces(person.top, Tint::top), dressed);
  std::vector<Surface> bottoms = wear_all(wardrobe.pieces(person.bottom, Tint::bottom), dressed);
  std::vector<Surface> shoes = wear_all(wardrobe.pieces(person.shoes, Tint::shoes), dressed);

  // A waistband must not show through a shirt worn over it, nor a shoe through trousers.
  constexpr float kWaistOverlap_m = 0.03F;
  constexpr float kHemOverlap_m = 0.015F;
  if (person.top != person.bottom) {
    const float reach = reach_of(tops, dressed.joints) + kWaistOverlap_m;
    for (Surface& surface : bottoms) {
      keep_triangles(surface, [&](std::size_t at) {
        return !all_corners(surface, at, [&](std::uint32_t vertex) {
          return surface.positions[vertex].z() > reach;
        });
      });
    }
  }
  const float hem = hem_of(bottoms) + kHemOverlap_m;
  for (Surface& surface : shoes) {
    keep_triangles(surface, [&](std::size_t at) {
      return !all_corners(
          surface, at, [&](std::uint32_t vertex) { return surface.positions[vertex].z() > hem; });
    });
  }

  std::vector<Surface> face = wear_all(wardrobe.pieces(person.eyebrows, Tint::hair), dressed);
  const Proxy& eyes = wardrobe.proxy("Low-Poly");
  face.push_back(wear({&eyes, eyes.quads, Tint::none, false, person.eyes}, dressed));
  for (Surface& surface : face) surface.painted = true;

  // Triangles at full detail, about 8 200 in all: most where people look.
  auto& all = dressed.surfaces;
  add_simplified({skin_of(makehuman, person, dressed)}, 2600, all);
  add_simplified(tops, 1900, all);
  add_simplified(std::move(bottoms), 1000, all);
  add_simplified(std::move(shoes), 700, all);
  add_simplified(wear_all(wardrobe.pieces(person.hair, Tint::hair), dressed), 1700, all);
  add_simplified(std::move(face), 300, all);
  put_on_ground(dressed);
  return dressed;
}

}  // namespace throng::skinning
