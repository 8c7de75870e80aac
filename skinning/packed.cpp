#include "skinning/packed.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace throng::skinning {

namespace {

constexpr float kOne = 32767;

struct Packed {
  std::array<std::array<std::int16_t, 4>, kBoneCount> turn;
  std::array<float, 3> shift;
};
static_assert(sizeof(Packed) == kPackedBytes);

Packed packed(const Joints& joints, const Palette& palette) {
  Packed result{};
  for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
    const Eigen::Matrix3f turn = palette[bone].leftCols<3>();
    const Eigen::Vector4f q = Eigen::Quaternionf(turn).normalized().coeffs();
    for (Eigen::Index i = 0; i < 4; ++i) {
      result.turn[bone][static_cast<std::size_t>(i)] =
          static_cast<std::int16_t>(std::lround(kOne * q[i]));
    }
  }
  const Eigen::Vector3f shift =
      palette[0].leftCols<3>() * joints[0] + palette[0].col(3) - joints[0];
  result.shift = {shift.x(), shift.y(), shift.z()};
  return result;
}

Palette unpacked(const Joints& joints, const Packed& from) {
  Pose pose;
  for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
    const auto& turn = from.turn[bone];
    const Eigen::Quaternionf q(turn[3], turn[0], turn[1], turn[2]);
    if (std::abs(q.norm() / kOne - 1) > 0.01F) throw std::out_of_range("turned bone");
    pose.rotation[bone] = q.normalized().toRotationMatrix();
  }
  pose.shift = {from.shift[0], from.shift[1], from.shift[2]};
  if (!pose.shift.allFinite() || pose.shift.norm() > 5) throw std::out_of_range("shift");
  return pose_palette(joints, pose);
}

}  // namespace

std::string pack(const Joints& joints, std::span<const Palette> palettes) {
  std::string bytes(palettes.size() * kPackedBytes, '\0');
  for (std::size_t i = 0; i < palettes.size(); ++i) {
    const Packed one = packed(joints, palettes[i]);
    std::memcpy(bytes.data() + i * kPackedBytes, &one, kPackedBytes);
  }
  return bytes;
}

std::vector<Palette> unpack(const Joints& joints, std::string_view bytes) {
  std::vector<Palette> palettes;
  palettes.reserve(bytes.size() / kPackedBytes);
  for (std::size_t at = 0; at + kPackedBytes <= bytes.size(); at += kPackedBytes) {
    Packed one{};
    std::memcpy(&one, bytes.data() + at, kPackedBytes);
    palettes.push_back(unpacked(joints, one));
  }
  return palettes;
}

}  // namespace throng::skinning
