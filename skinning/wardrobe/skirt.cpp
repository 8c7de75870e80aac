#include "skinning/wardrobe/skirt.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "base/geometry/smoothstep.h"
#include "skinning/skeleton.h"
#include "skinning/wardrobe/cloth.h"
#include "skinning/wardrobe/garments.h"

namespace throng::skinning {

namespace {

constexpr double kPi = std::numbers::pi;

// Heights on the unmorphed body, in meters from its middle.
constexpr float kWaist = 0.184F;
constexpr float kKnee = -0.37F;
constexpr float kHem = -0.728F;

BoneWeights hang(const Eigen::Vector3f& point) {
  const float legs = 1 - geometry::smoothstep(-0.16F, 0.04F, point.z());
  const float spine = geometry::smoothstep(0.08F, 0.2F, point.z());
  const float shins = 0.5F * (1 - geometry::smoothstep(kKnee - 0.12F, kKnee + 0.05F, point.z()));
  const float left = geometry::smoothstep(-0.07F, 0.07F, point.y());
  BoneWeights weights{};
  weights[index_from(Bone::spine)] = spine;
  weights[index_from(Bone::hips)] = (1 - legs) * (1 - spine);
  for (const bool is_left : {true, false}) {
    const float share = legs * (is_left ? left : 1 - left);
    weights[index_from(is_left ? Bone::left_thigh : Bone::right_thigh)] = share * (1 - shins);
    weights[index_from(is_left ? Bone::left_shin : Bone::right_shin)] = share * shins;
  }
  return weights;
}

// Once around, the seam behind; the corners of one face lie on one side of it.
std::array<Eigen::Vector2f, 4> unrolled(const Quad& quad, const MakeHuman& makehuman) {
  std::array<Eigen::Vector2f, 4> uv;
  for (std::size_t corner = 0; corner < 4; ++corner) {
    const Eigen::Vector3f& point = makehuman.base_positions()[quad.vertex[corner]];
    const double turn = std::atan2(point.y(), point.x()) / (2 * kPi) + 0.5;
    uv[corner] = {static_cast<float>(turn), (kWaist - point.z()) / (kWaist - kHem)};
    if (corner > 0 && uv[corner].x() - uv[0].x() > 0.5F) uv[corner].x() = 0;
    if (corner > 0 && uv[0].x() - uv[corner].x() > 0.5F) uv[corner].x() = 1;
  }
  return uv;
}

}  // namespace

Proxy make_skirt(const MakeHuman& makehuman) {
  Proxy proxy;
  proxy.name = std::string(kSkirt);
  const std::vector<Eigen::Vector3f>& body = makehuman.base_positions();
  std::map<std::uint32_t, std::uint32_t> place;
  for (const Quad& quad : makehuman.skirt()) {
    Quad own{};
    const auto uvs = unrolled(quad, makehuman);
    for (std::size_t corner = 0; corner < 4; ++corner) {
      const std::uint32_t vertex = quad.vertex[corner];
      const auto [entry, is_new] =
          place.try_emplace(vertex, static_cast<std::uint32_t>(proxy.positions.size()));
      if (is_new) {
        proxy.positions.push_back(body[vertex]);
        proxy.anchors.push_back({{vertex, vertex, vertex}, {1, 0, 0}, Eigen::Vector3f::Zero()});
        proxy.weights.push_back(hang(body[vertex]));
      }
      own.vertex[corner] = entry->second;
      own.uv[corner] = static_cast<std::uint32_t>(proxy.uvs.size());
      proxy.uvs.push_back(uvs[corner]);
    }
    proxy.quads.push_back(own);
  }
  proxy.hides.assign(body.size(), false);
  for (const Quad& quad : makehuman.skin()) {
    for (const std::uint32_t vertex : quad.vertex) {
      const Eigen::Vector3f& point = body[vertex];
      const bool arm = std::abs(point.y()) > 0.25F;
      proxy.hides[vertex] = !arm && point.z() < kWaist - 0.04F;
    }
  }
  return proxy;
}

Image skirt_cloth(int size, double depth) {
  Image image(size, size);
  constexpr double kFolds = 11;
  for (int y = 0; y < size; ++y) {
    const double down = (y + 0.5) / size;
    for (int x = 0; x < size; ++x) {
      const double around = (x + 0.5) / size;
      const double fold = std::sin(2 * kPi * kFolds * around + 1.3 * std::sin(6 * kPi * around));
      const double shade = 1 + depth * std::min(1.0, 2 * down) * fold;
      std::uint8_t* pixel = image.pixel(x, y);
      pixel[0] = pixel[1] = pixel[2] =
          static_cast<std::uint8_t>(std::lround(std::min(255.0, kMedianShade * shade)));
      pixel[3] = 255;
    }
  }
  return image;
}

}  // namespace throng::skinning
