#include "render/people/device_palettes.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "base/error.h"

namespace throng::render {

namespace {

constexpr float kOne = 32767;

std::uint32_t pack_half_floats(float low, float high) {
  const auto bits = [](float value) {
    return static_cast<std::uint32_t>(
        static_cast<std::uint16_t>(static_cast<std::int16_t>(std::lround(kOne * value))));
  };
  return bits(low) | (bits(high) << 16U);
}

bool is_rigid(const skinning::BoneMatrix& matrix) {
  constexpr float kTolerance = 1e-3F;
  const Eigen::Matrix3f turn = matrix.leftCols<3>();
  return matrix.allFinite() &&
         (turn * turn.transpose() - Eigen::Matrix3f::Identity()).norm() < kTolerance &&
         turn.determinant() > 0 && matrix.col(3).cwiseAbs().maxCoeff() <= kMaxShiftM;
}

DeviceBone device_bone(const skinning::BoneMatrix& matrix) {
  const Eigen::Matrix3f turn = matrix.leftCols<3>();
  const Eigen::Vector4f q = Eigen::Quaternionf(turn).normalized().coeffs();
  const Eigen::Vector3f shift = matrix.col(3) / kMaxShiftM;
  return {pack_half_floats(q[0], q[1]), pack_half_floats(q[2], q[3]),
          pack_half_floats(shift[0], shift[1]), pack_half_floats(shift[2], 0)};
}

}  // namespace

std::vector<DeviceBone> device_palettes(const skinning::Population& population,
                                        std::uint64_t max_bytes) {
  constexpr std::uint64_t kPaletteBytes = skinning::kBoneCount * sizeof(DeviceBone);
  if (population.palettes.size() * kPaletteBytes > max_bytes) {
    const std::uint64_t max_people =
        max_bytes / (kPaletteBytes * std::max(population.palettes_per_character, 1U));
    throw InputError({"", "people", fmt::format("{} of them", population.characters.size()),
                      fmt::format("at most {}, whose motion fits the {} MiB that this graphics "
                                  "device gives (run `throng people build --count {}`)",
                                  max_people, max_bytes >> 20U, max_people)});
  }
  std::vector<DeviceBone> bones;
  bones.reserve(population.palettes.size() * skinning::kBoneCount);
  for (std::size_t i = 0; i < population.palettes.size(); ++i) {
    for (const skinning::BoneMatrix& matrix : population.palettes[i]) {
      if (!is_rigid(matrix)) {
        throw InputError({"", fmt::format("palette {} of the people", i), "a bone that is bent",
                          "bones that are turned and moved by 8 m at most"});
      }
      bones.push_back(device_bone(matrix));
    }
  }
  return bones;
}

}  // namespace throng::render
