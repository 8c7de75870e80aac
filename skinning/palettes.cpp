#include "skinning/palettes.h"

#include <Eigen/Geometry>
#include <cmath>

#include "base/error.h"

namespace throng::skinning {

namespace {

constexpr float kUnit = 32767;

std::uint32_t pack_two(float low, float high) {
  const auto bits = [](float value) {
    return static_cast<std::uint32_t>(
        static_cast<std::uint16_t>(static_cast<std::int16_t>(std::lround(kUnit * value))));
  };
  return bits(low) | (bits(high) << 16U);
}

bool is_rigid(const BoneMatrix& matrix) {
  constexpr float kTolerance = 1e-3F;
  const Eigen::Matrix3f turn = matrix.leftCols<3>();
  return matrix.allFinite() &&
         (turn * turn.transpose() - Eigen::Matrix3f::Identity()).norm() < kTolerance &&
         turn.determinant() > 0 && matrix.col(3).cwiseAbs().maxCoeff() <= kMaxShiftM;
}

PackedBone packed_bone(const BoneMatrix& matrix) {
  const Eigen::Matrix3f turn = matrix.leftCols<3>();
  const Eigen::Vector4f q = Eigen::Quaternionf(turn).normalized().coeffs();
  const Eigen::Vector3f shift = matrix.col(3) / kMaxShiftM;
  return {pack_two(q[0], q[1]), pack_two(q[2], q[3]), pack_two(shift[0], shift[1]),
          pack_two(shift[2], 0)};
}

BoneMatrix unpacked_bone(const PackedBone& bone) {
  const auto value = [&](std::size_t word, unsigned shift) {
    const auto bits = static_cast<std::uint16_t>(bone[word] >> shift);
    return static_cast<float>(static_cast<std::int16_t>(bits)) / kUnit;
  };
  const Eigen::Quaternionf turn(value(1, 16), value(0, 0), value(0, 16), value(1, 0));
  BoneMatrix matrix;
  matrix.leftCols<3>() = turn.normalized().toRotationMatrix();
  matrix.col(3) = kMaxShiftM * Eigen::Vector3f(value(2, 0), value(2, 16), value(3, 0));
  return matrix;
}

}  // namespace

void Palettes::push_back(const Palette& palette) {
  for (const BoneMatrix& matrix : palette) {
    check(is_rigid(matrix), "bones are turned and moved by 8 m at most");
    bones_.push_back(packed_bone(matrix));
  }
}

void Palettes::append(std::span<const Palette> palettes) {
  for (const Palette& palette : palettes) push_back(palette);
}

Palette Palettes::operator[](std::size_t index) const {
  Palette palette;
  for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
    palette[bone] = unpacked_bone(bones_[index * kBoneCount + bone]);
  }
  return palette;
}

}  // namespace throng::skinning
