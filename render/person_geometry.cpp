#include "render/person_geometry.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/view.h"

namespace throng::render {

namespace {

using Affine = Eigen::Matrix<float, 3, 4>;

constexpr float kAboveGround = 0.002F;  // m; also in shaders/person.vert.glsl

Eigen::Matrix3d turn(float yaw_rad) {
  return Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

/// Model space to (u z, v z, z), where (u, v) are box coordinates and z is the depth.
Affine image_from_model(const PersonInstance& person, const camera::Camera& camera) {
  const camera::Intrinsics& k = camera.intrinsics;
  Eigen::Matrix3d to_boxes;
  to_boxes << k.fx_px, 0, k.cx_px + 0.5, 0, k.fy_px, k.cy_px + 0.5, 0, 0, 1;
  Eigen::Matrix<double, 3, 4> m;
  m.leftCols<3>() = to_boxes * camera.pose.R * turn(person.yaw_rad);
  m.col(3) = to_boxes * (camera.pose.R * person.position.cast<double>() + camera.pose.t);
  return m.cast<float>();
}

Eigen::Vector3f skinned(const skinning::Vertex& vertex, const skinning::Palette& palette) {
  const Eigen::Vector4f rest(vertex.position[0], vertex.position[1], vertex.position[2], 1.0F);
  Eigen::Vector3f p = Eigen::Vector3f::Zero();
  for (std::size_t k = 0; k < 4; ++k) {
    if (vertex.weights[k] == 0) continue;
    p += (static_cast<float>(vertex.weights[k]) / 255.0F) * (palette[vertex.bones[k]] * rest);
  }
  p.z() = std::max(p.z(), kAboveGround);
  return p;
}

/// Bounds of the triangles' parts in front of the near plane.
Eigen::AlignedBox2f cut_box(const skinning::Mesh& mesh,
                            const std::vector<Eigen::Vector3f>& projected) {
  Eigen::AlignedBox2f box;
  const auto extend = [&](const Eigen::Vector3f& p) { box.extend(p.head<2>() / p.z()); };
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    const Eigen::Vector3f& a = projected[mesh.indices[i]];
    const Eigen::Vector3f& b = projected[mesh.indices[i % 3 == 2 ? i - 2 : i + 1]];
    if (a.z() >= kNear) extend(a);
    if ((a.z() >= kNear) != (b.z() >= kNear)) {
      extend(a + (b - a) * ((kNear - a.z()) / (b.z() - a.z())));
    }
  }
  return box;
}

}  // namespace

skinning::Palette blended_palette(const skinning::Population& population,
                                  const PersonInstance& person) {
  const skinning::Palette& a = population.palette(person.appearance.character, person.pose.a);
  const skinning::Palette& b = population.palette(person.appearance.character, person.pose.b);
  skinning::Palette blended;
  for (std::size_t bone = 0; bone < blended.size(); ++bone) {
    blended[bone] = (1.0F - person.pose.blend) * a[bone] + person.pose.blend * b[bone];
  }
  return blended;
}

Eigen::Vector3d head_position(const skinning::Palette& palette, const PersonInstance& person,
                              float stature_m) {
  const Eigen::Vector4f standing(0, 0, kHeadShare * stature_m, 1);
  const Eigen::Vector3f posed = palette[static_cast<std::size_t>(skinning::Bone::head)] * standing;
  return person.position.cast<double>() + turn(person.yaw_rad) * posed.cast<double>();
}

Eigen::AlignedBox2d projected_box(const skinning::Mesh& mesh, const skinning::Palette& palette,
                                  const PersonInstance& person, const camera::Camera& camera) {
  const Affine m = image_from_model(person, camera);
  std::vector<Eigen::Vector3f> projected(mesh.vertices.size());
  float nearest = std::numeric_limits<float>::infinity();
  Eigen::AlignedBox2f box;
  for (std::size_t i = 0; i < projected.size(); ++i) {
    projected[i] = m.leftCols<3>() * skinned(mesh.vertices[i], palette) + m.col(3);
    nearest = std::min(nearest, projected[i].z());
    box.extend(projected[i].head<2>() / projected[i].z());
  }
  if (nearest < kNear) box = cut_box(mesh, projected);
  if (box.isEmpty()) return {};
  const Eigen::Vector2d size(camera.intrinsics.width, camera.intrinsics.height);
  const Eigen::AlignedBox2d limit(-size, 2 * size);
  return Eigen::AlignedBox2d(box.min().cast<double>(), box.max().cast<double>())
      .intersection(limit);
}

}  // namespace throng::render
