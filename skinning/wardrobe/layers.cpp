#include "skinning/wardrobe/layers.h"

#include <algorithm>

namespace throng::skinning {

namespace {

std::vector<Eigen::Vector3f> fitted_to(const Proxy& proxy, std::span<const Eigen::Vector3f> body) {
  std::vector<Eigen::Vector3f> fitted;
  fitted.reserve(proxy.anchors.size());
  for (const Proxy::Anchor& anchor : proxy.anchors) {
    Eigen::Vector3f position = anchor.offset;
    for (std::size_t i = 0; i < 3; ++i) position += anchor.weight[i] * body[anchor.body_vertex[i]];
    fitted.push_back(position);
  }
  return fitted;
}

}  // namespace

float trunk_weight(const BoneWeights& weights) {
  return weights[index_from(Bone::hips)] + weights[index_from(Bone::spine)] +
         weights[index_from(Bone::chest)];
}

Surface wear(const Garment& garment, const DressedPerson& dressed) {
  const std::vector<Eigen::Vector3f> fitted = fitted_to(*garment.proxy, dressed.body);
  Surface surface = make_surface(garment.quads, garment.proxy->uvs, fitted, garment.proxy->weights,
                                 dressed.to_neutral);
  surface.texture = garment.texture;
  surface.tint = garment.tint;
  surface.alpha_tested = garment.alpha_tested;
  return surface;
}

std::vector<Surface> wear_all(const Worn& worn, const DressedPerson& dressed) {
  std::vector<Surface> surfaces;
  surfaces.reserve(worn.pieces.size());
  for (const Garment& garment : worn.pieces) surfaces.push_back(wear(garment, dressed));
  return surfaces;
}

void cut_below(std::vector<Surface>& surfaces, float height_m) {
  for (Surface& surface : surfaces) {
    std::vector<float> above;
    above.reserve(surface.fitted.size());
    for (const Eigen::Vector3f& point : surface.fitted) above.push_back(point.z() - height_m);
    cut_surface(surface, above);
  }
}

void tuck_in(Surface& surface, std::size_t i, float tuck_m, const Palette& to_neutral) {
  surface.positions[i] -= tuck_m * surface.normals[i];
  // The A-pose differs by a rotation: that of the bones.
  Eigen::Matrix3f turn = Eigen::Matrix3f::Zero();
  for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
    turn += surface.weights[i][bone] * to_neutral[bone].leftCols<3>();
  }
  surface.fitted[i] -= tuck_m * (turn.transpose() * surface.normals[i]).normalized();
}

void thicken(std::vector<Surface>& surfaces, float by_m, const Palette& to_neutral) {
  for (Surface& surface : surfaces) {
    for (std::size_t i = 0; i < surface.positions.size(); ++i) {
      tuck_in(surface, i, -by_m, to_neutral);
    }
  }
}

void hide_above(std::vector<Surface>& surfaces, float height_m) {
  for (Surface& surface : surfaces) {
    std::vector<float> below;
    below.reserve(surface.positions.size());
    for (const Eigen::Vector3f& point : surface.positions) below.push_back(height_m - point.z());
    cut_surface(surface, below);
  }
}

void tuck_under(std::vector<Surface>& bottoms, const Rim& hem, const DressedPerson& dressed) {
  constexpr float kOverlapM = 0.03F;
  constexpr float kSoftM = 0.01F;
  constexpr float kTuckM = 0.01F;
  const Eigen::Vector3f& hips = dressed.joints[0];
  const auto above_hem = [&](const Eigen::Vector3f& point) {
    return point.z() - hem.highest(point - hips);
  };
  for (Surface& surface : bottoms) {
    keep_triangles(surface, [&](std::size_t at) {
      return !all_corners(surface, at, [&](std::uint32_t vertex) {
        return above_hem(surface.positions[vertex]) > kOverlapM;
      });
    });
    for (std::size_t i = 0; i < surface.positions.size(); ++i) {
      const float share = std::clamp(above_hem(surface.positions[i]) / kSoftM, 0.0F, 1.0F);
      if (share > 0) tuck_in(surface, i, share * kTuckM, dressed.to_neutral);
    }
  }
}

void hide_under(std::vector<Surface>& hair, const std::vector<Surface>& hat) {
  constexpr float kOverlapM = 0.008F;
  constexpr float kNowhereM = 10;
  Eigen::Vector3f middle = Eigen::Vector3f::Zero();
  std::size_t count = 0;
  for (const Surface& surface : hat) {
    for (const Eigen::Vector3f& point : surface.positions) middle += point;
    count += surface.positions.size();
  }
  middle /= static_cast<float>(std::max<std::size_t>(count, 1));
  std::array<float, Rim::kSectors> rim_m{};
  rim_m.fill(kNowhereM);
  for (const Surface& surface : hat) {
    for (const Eigen::Vector3f& point : surface.positions) {
      float& here = rim_m[Rim::sector_of(point - middle)];
      here = std::min(here, point.z());
    }
  }
  for (Surface& surface : hair) {
    std::vector<float> below;
    below.reserve(surface.positions.size());
    for (const Eigen::Vector3f& point : surface.positions) {
      below.push_back(rim_m[Rim::sector_of(point - middle)] + kOverlapM - point.z());
    }
    cut_surface(surface, below);
  }
}

void add_tail(const Worn& tail, float hem_m, const Rim& top, const DressedPerson& dressed,
              std::vector<Surface>& bottoms) {
  if (tail.pieces.empty()) return;
  constexpr float kInsideM = 0.1F;  // a look up from below the hem must find trousers
  for (Surface& surface : bottoms) {
    std::vector<float> below;
    below.reserve(surface.fitted.size());
    for (const Eigen::Vector3f& point : surface.fitted)
      below.push_back(hem_m + kInsideM - point.z());
    cut_surface(surface, below);
  }
  std::vector<Surface> cone = wear_all(tail, dressed);
  cut_below(cone, hem_m);
  thicken(cone, kOuterwearM, dressed.to_neutral);
  tuck_under(cone, top, dressed);
  for (Surface& surface : cone) bottoms.push_back(std::move(surface));
}

}  // namespace throng::skinning
