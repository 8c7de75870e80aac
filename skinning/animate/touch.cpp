#include "skinning/animate/touch.h"

#include <algorithm>
#include <initializer_list>

#include "skinning/animate/posture.h"
#include "skinning/items.h"
#include "skinning/population.h"

namespace throng::skinning {

namespace {

using Eigen::Vector3f;

/// A point that moves with a bone, in the rest pose, and where the elbow of the hand there points.
struct Attachment {
  Bone bone;
  Vector3f point;
  Vector3f elbow_to;
};

const Vector3f& rest_joint(const Walker& walker, Bone bone) {
  return walker.joints[index_from(bone)];
}

/// How far (m) body and clothes of some bones reach from a point along a direction, in the rest
/// pose; `min_m` if nothing is there.
float body_reach(const Walker& walker, std::initializer_list<Bone> bones, const Vector3f& from,
                 const Vector3f& along, float min_m) {
  constexpr float kNearM = 0.05F;
  float reach_m = min_m;
  for (const Vertex& vertex : walker.body) {
    if (!moves_mostly_with(vertex, bones)) continue;
    const Vector3f offset = Vector3f(vertex.position.data()) - from;
    const float ahead = offset.dot(along);
    if ((offset - ahead * along).norm() < kNearM) reach_m = std::max(reach_m, ahead);
  }
  return reach_m;
}

// Shares are of stature.
Attachment on_trunk(const Walker& walker, float sign, HandSpot spot) {
  const float s = walker.stature_m;
  const Vector3f aside = sign * Vector3f::UnitY();
  const Vector3f ahead = Vector3f::UnitX();
  const std::initializer_list<Bone> trunk = {Bone::hips, Bone::spine, Bone::chest, Bone::left_thigh,
                                             Bone::right_thigh};
  const Vector3f hips(0, 0, rest_joint(walker, Bone::left_thigh).z());
  const Vector3f waist = hips + Vector3f(0, 0, 0.075F * s);
  const Vector3f chest(0, 0, rest_joint(walker, Bone::left_upper_arm).z() - 0.09F * s);
  if (spot == HandSpot::pocket) {
    const float out_m = body_reach(walker, trunk, hips, aside, 0.085F * s);
    return {Bone::hips, hips + Vector3f(0.025F * s, sign * out_m, 0), {-1, 0.5F * sign, -0.2F}};
  }
  if (spot == HandSpot::waist) {
    const float out_m = body_reach(walker, trunk, waist, aside, 0.075F * s);
    return {Bone::spine, waist + Vector3f(0.01F, sign * (out_m + 0.02F), 0), {-0.35F, sign, 0}};
  }
  if (spot == HandSpot::back) {
    const float out_m = body_reach(walker, trunk, waist, -ahead, 0.06F * s);
    return {Bone::hips,
            waist + Vector3f(-out_m - 0.03F, 0.02F * sign, -0.02F * s),
            {-0.5F, 0.8F * sign, -0.3F}};
  }
  const float out_m = body_reach(walker, {Bone::spine, Bone::chest}, chest, ahead, 0.07F * s);
  if (spot == HandSpot::elbow) {
    // One forearm above the other.
    return {Bone::chest,
            chest + Vector3f(out_m + 0.02F, -0.075F * s * sign, (sign > 0 ? -0.025F : 0.005F) * s),
            {0.1F, 0.7F * sign, -1}};
  }
  return {Bone::chest,
          chest + Vector3f(out_m + 0.13F * s, 0.06F * s * sign, 0.01F * s),
          {-0.35F, 0.35F * sign, -1}};
}

Attachment on_head(const Walker& walker, float sign, HandSpot spot) {
  const float s = walker.stature_m;
  const std::initializer_list<Bone> head = {Bone::head};
  const Vector3f& joint = rest_joint(walker, Bone::head);
  const Vector3f middle = joint + Vector3f(0, 0, 0.045F * s);
  const float face_m = body_reach(walker, head, middle, Vector3f::UnitX(), 0.055F * s);
  if (spot == HandSpot::ear) {
    const float out_m = body_reach(walker, head, middle, sign * Vector3f::UnitY(), 0.045F * s);
    return {Bone::head,
            middle + Vector3f(0.01F, sign * (out_m + 0.025F), -0.012F * s),
            {0.5F, 0.6F * sign, -1}};
  }
  if (spot == HandSpot::mouth) {
    return {Bone::head,
            joint + Vector3f(face_m + 0.03F, 0.012F * s * sign, 0.012F * s),
            {0.1F, 0.6F * sign, -1}};
  }
  if (spot == HandSpot::eyes) {
    return {Bone::head,
            middle + Vector3f(face_m + 0.15F * s, 0.03F * s * sign, 0.005F * s),
            {0, 0.7F * sign, -1}};
  }
  if (spot == HandSpot::overhead) {
    return {
        Bone::chest, joint + Vector3f(0.14F * s, 0.05F * s * sign, 0.2F * s), {0.3F, sign, -0.6F}};
  }
  const float up_m = body_reach(walker, head, middle, Vector3f::UnitZ(), 0.055F * s);
  return {Bone::head,
          middle + Vector3f(-0.02F * s, 0.04F * s * sign, up_m + 0.01F),
          {0.6F, sign, -0.15F}};
}

Attachment find_place(const Walker& walker, Side side, HandSpot spot) {
  const float sign = side_sign(side);
  if (spot == HandSpot::knee) {
    const Bone shin = on(side, Bone::left_shin);
    return {on(side, Bone::left_thigh),
            rest_joint(walker, shin) + Vector3f(0.035F * walker.stature_m, 0, 0.01F),
            {-0.3F, sign, -0.6F}};
  }
  const bool is_on_trunk = spot <= HandSpot::chest;
  return is_on_trunk ? on_trunk(walker, sign, spot) : on_head(walker, sign, spot);
}

Vector3f posed_point(const Walker& walker, const Pose& pose, const Attachment& place) {
  const Vector3f joint = pose_joints(walker.joints, pose)[index_from(place.bone)];
  return joint +
         pose.rotation[index_from(place.bone)] * (place.point - rest_joint(walker, place.bone));
}

}  // namespace

void put_hand(const Walker& walker, Side side, HandSpot spot, Figure& figure) {
  put_hand(walker, side, spot, spot, 0, figure);
}

void put_hand(const Walker& walker, Side side, HandSpot from, HandSpot to, double share,
              Figure& figure) {
  const bool needs_legs = from == HandSpot::knee || to == HandSpot::knee;
  const Pose posed = needs_legs ? solve(walker, figure) : figure.pose;
  const Attachment first = find_place(walker, side, from);
  const Attachment second = find_place(walker, side, to);
  const auto t = static_cast<float>(share);
  const Vector3f point =
      (1 - t) * posed_point(walker, posed, first) + t * posed_point(walker, posed, second);
  const Eigen::Matrix3f& turn = figure.pose.of(Bone::chest);
  hold(walker, side, point, figure.pose, turn * ((1 - t) * first.elbow_to + t * second.elbow_to));
}

bool is_hand_busy(const Walker& walker, Side side) {
  if (walker.manner.carries == Carry::walking_stick && side == Side::right) return true;
  const std::vector<Grip> grips = find_grips(walker.manner.carries, walker.joints);
  return std::any_of(grips.begin(), grips.end(),
                     [&](const Grip& grip) { return grip.hand == on(side, Bone::left_hand); });
}

}  // namespace throng::skinning
