#include "render/people/person_geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <tuple>
#include <vector>

#include "render/frame/view.h"
#include "skinning/levels.h"

namespace throng::render {

namespace {

SkinPoint skin_point(const skinning::Vertex& vertex) {
  SkinPoint point{{vertex.position[0], vertex.position[1], vertex.position[2], 1}, {}, {}, 0};
  for (std::size_t k = 0; k < vertex.weights.size(); ++k) {
    if (vertex.weights[k] == 0) continue;
    point.bones[point.bone_count] = vertex.bones[k];
    point.weights[point.bone_count] = static_cast<float>(vertex.weights[k]) / 255.0F;
    ++point.bone_count;
  }
  return point;
}

/// Takes points into the image as image_from_model does. Skinning is linear, so each bone takes its
/// share straight there.
class Projector {
 public:
  /// The palette must outlive this object.
  Projector(const skinning::Palette& palette, const Eigen::Matrix4f& image_from_model)
      : palette_(palette), image_from_model_(image_from_model), up_(image_from_model.col(2)) {}

  Eigen::Vector4f operator()(const SkinPoint& point) {
    Eigen::Vector4f p = point.weights[0] * (matrix(point.bones[0]) * point.rest);
    for (std::uint32_t k = 1; k < point.bone_count; ++k) {
      p += point.weights[k] * (matrix(point.bones[k]) * point.rest);
    }
    return p + std::max(kAboveGround - p.w(), 0.0F) * up_;
  }

 private:
  /// Computed for the bones that points have: few of a head, or of people in the distance.
  const Eigen::Matrix4f& matrix(std::size_t bone) {
    if ((known_ >> bone & 1U) == 0) {
      known_ |= 1U << bone;
      Eigen::Matrix4f posed = Eigen::Matrix4f::Identity();
      posed.topRows<3>() = skinning::bone_matrix(palette_, bone);
      image_from_rest_[bone] = image_from_model_ * posed;
    }
    return image_from_rest_[bone];
  }

  const skinning::Palette& palette_;
  Eigen::Matrix4f image_from_model_;
  std::uint32_t known_ = 0;
  std::array<Eigen::Matrix4f, skinning::kBoneCount + 1> image_from_rest_;
  Eigen::Vector4f up_;
};

std::vector<Eigen::Vector4f> projected_vertices(const skinning::Mesh& mesh, Projector project) {
  std::vector<Eigen::Vector4f> projected;
  projected.reserve(mesh.vertices.size());
  for (const skinning::Vertex& vertex : mesh.vertices) {
    projected.push_back(project(skin_point(vertex)));
  }
  return projected;
}

/// Calls `see(a, b)` for every side of these parts' triangles with the indices of its ends.
template <typename See>
void for_each_side(const skinning::Mesh& mesh, const std::vector<skinning::Part>& parts, See see) {
  for (const skinning::Part& part : parts) {
    for (std::uint32_t i = 0; i < part.index_count; ++i) {
      const std::uint32_t next = i % 3 == 2 ? i - 2 : i + 1;
      see(mesh.indices[part.first_index + i], mesh.indices[part.first_index + next]);
    }
  }
}

/// Bounds of the triangles' parts in front of the near plane.
Eigen::AlignedBox2f cut_box(const BodyShape& shape, const std::vector<Eigen::Vector4f>& projected) {
  Eigen::AlignedBox2f box;
  const auto extend = [&](const Eigen::Vector4f& p) { box.extend(p.head<2>() / p.z()); };
  for_each_side(*shape.mesh, shape.parts, [&](std::uint32_t from, std::uint32_t to) {
    const Eigen::Vector4f& a = projected[from];
    const Eigen::Vector4f& b = projected[to];
    if (a.z() >= kNear) extend(a);
    if ((a.z() >= kNear) != (b.z() >= kNear)) {
      extend(a + (b - a) * ((kNear - a.z()) / (b.z() - a.z())));
    }
  });
  return box;
}

}  // namespace

skinning::PoseBlend drawn_pose(const skinning::PoseBlend& pose, std::size_t level) {
  if (level < skinning::kDistantLevel) return pose;
  const std::uint32_t nearer = pose.blend < 0.5F ? pose.a : pose.b;
  return {nearer, nearer, 0};
}

skinning::Palette blended_palette(const skinning::Population& population,
                                  const PersonInstance& person) {
  const skinning::Palette a = population.palette(person.appearance.character, person.pose.a);
  if (person.pose.blend == 0) return a;
  const skinning::Palette b = population.palette(person.appearance.character, person.pose.b);
  skinning::Palette blended;
  for (std::size_t bone = 0; bone < blended.size(); ++bone) {
    blended[bone] = (1.0F - person.pose.blend) * a[bone] + person.pose.blend * b[bone];
  }
  return blended;
}

Stance::Stance(const PersonInstance& person) : position(person.position.cast<double>()) {
  const double sine = std::sin(static_cast<double>(person.yaw_rad));
  const double cosine = std::cos(static_cast<double>(person.yaw_rad));
  turn << cosine, -sine, 0, sine, cosine, 0, 0, 0, 1;
}

Eigen::Matrix4f image_from_model(const Stance& stance, const camera::Camera& camera) {
  const camera::Intrinsics& k = camera.intrinsics;
  Eigen::Matrix3d to_boxes;
  to_boxes << k.fx_px, 0, k.cx_px + 0.5, 0, k.fy_px, k.cy_px + 0.5, 0, 0, 1;
  Eigen::Matrix4d m = Eigen::Matrix4d::Zero();
  m.topLeftCorner<3, 3>() = to_boxes * camera.pose.R * stance.turn;
  m.topRightCorner<3, 1>() = to_boxes * (camera.pose.R * stance.position + camera.pose.t);
  m(3, 2) = 1;
  return m.cast<float>();
}

Eigen::Vector3d posed_point(const skinning::Palette& palette, const Stance& stance,
                            skinning::Bone bone, float height_m) {
  const Eigen::Vector4f standing(0, 0, height_m, 1);
  const Eigen::Vector3f posed = palette[static_cast<std::size_t>(bone)] * standing;
  return stance.position + stance.turn * posed.cast<double>();
}

std::vector<skinning::Part> select_parts(const skinning::Character& character,
                                         const skinning::Mesh& mesh, Share share) {
  std::vector<skinning::Part> parts;
  std::copy_if(mesh.parts.begin(), mesh.parts.end(), std::back_inserter(parts),
               [&](const skinning::Part& part) {
                 return skinning::is_apart(character, part) == (share == Share::umbrella);
               });
  return parts;
}

BodyShape::BodyShape(const skinning::Mesh& of_mesh, std::vector<skinning::Part> its_parts)
    : mesh(&of_mesh), parts(std::move(its_parts)) {
  using VertexKey =
      std::tuple<std::array<float, 3>, std::array<std::uint8_t, 4>, std::array<std::uint8_t, 4>>;
  std::set<VertexKey> known;
  for (const skinning::Part& part : parts) {
    for (std::uint32_t i = part.first_index; i < part.first_index + part.index_count; ++i) {
      const skinning::Vertex& vertex = mesh->vertices[mesh->indices[i]];
      if (!known.emplace(vertex.position, vertex.bones, vertex.weights).second) continue;
      points.push_back(skin_point(vertex));
      if (skinning::moves_mostly_with(vertex, {skinning::Bone::head}))
        head.push_back(points.back());
    }
  }
  // Loops over equal numbers of bones are the fastest.
  std::stable_sort(points.begin(), points.end(), [](const SkinPoint& a, const SkinPoint& b) {
    return a.bone_count < b.bone_count;
  });
}

void measure_body(const Eigen::AlignedBox3f& box, const skinning::Landmarks& landmarks,
                  const skinning::Palette& palette, const Stance& stance, PersonInView& truth) {
  const Eigen::Matrix3f to_world = stance.turn.cast<float>();
  const Eigen::Vector3f position = stance.position.cast<float>();
  truth.keypoints = skinning::posed_keypoints(landmarks, palette);
  for (Eigen::Vector3f& point : truth.keypoints) point = position + to_world * point;
  truth.box_middle = position + to_world * box.center();
  truth.box_size = box.sizes();
}

void measure_turns(const skinning::Palette& palette, const Stance& stance, PersonInView& truth) {
  const Eigen::Matrix3f to_world = stance.turn.cast<float>();
  truth.bone_turns.reserve(palette.size());
  for (const skinning::BoneMatrix& bone : palette) {
    const Eigen::Matrix3f turned = bone.leftCols<3>();
    // Blends of poses shrink bones by some thousandths.
    truth.bone_turns.push_back(Eigen::Quaternionf(Eigen::Matrix3f(to_world * turned)).normalized());
  }
}

Eigen::AlignedBox2i measured_pixels(const camera::Intrinsics& image) {
  const Eigen::Vector2i size(image.width, image.height);
  return {-size, 2 * size};
}

Eigen::AlignedBox2i measured_pixels(const camera::Intrinsics& image, const Rows& rows) {
  Eigen::AlignedBox2i pixels = measured_pixels(image);
  if (rows.first > 0) pixels.min().y() = rows.first;
  if (rows.end < image.height) pixels.max().y() = rows.end;
  return pixels;
}

Eigen::AlignedBox2d silhouette_box(const BodyShape& shape, const skinning::Palette& palette,
                                   const Stance& stance, const camera::Camera& camera) {
  Projector project(palette, image_from_model(stance, camera));
  // Bounds of u, v and z at once; the fourth value is unused.
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Eigen::Array4f low = Eigen::Array4f::Constant(kInfinity);
  Eigen::Array4f high = Eigen::Array4f::Constant(-kInfinity);
  for (const SkinPoint& point : shape.points) {
    const Eigen::Vector4f p = project(point);
    const float per_z = 1 / p.z();
    const Eigen::Array4f at = p.array() * Eigen::Array4f(per_z, per_z, 1, 1);
    low = low.min(at);
    high = high.max(at);
  }
  if (shape.points.empty()) return {};
  Eigen::AlignedBox2f box(low.head<2>().matrix(), high.head<2>().matrix());
  if (low.z() < kNear) {
    box = cut_box(shape, projected_vertices(*shape.mesh, project));
  }
  return box.isEmpty() ? Eigen::AlignedBox2d() : box.cast<double>();
}

namespace {

/// Projection of directions (u z, v z, z) into box coordinates of a camera; nothing before the near
/// plane and outside the domain of the lens model.
std::optional<Eigen::Vector2d> shown_place(const camera::Intrinsics& k, const Eigen::Vector4f& p) {
  if (p.z() < kNear) return std::nullopt;
  std::optional<Eigen::Vector2d> shown =
      k.pixel_of(p.head<2>().cast<double>() / static_cast<double>(p.z()));
  if (shown) shown->array() += 0.5;
  return shown;
}

/// The last visible point on the segment from a visible point to one that is not.
Eigen::Vector2d last_shown(const camera::Intrinsics& k, Eigen::Vector4f from, Eigen::Vector4f to) {
  constexpr int kHalvings = 16;
  for (int i = 0; i < kHalvings; ++i) {
    const Eigen::Vector4f middle = 0.5F * (from + to);
    (shown_place(k, middle) ? from : to) = middle;
  }
  return *shown_place(k, from);
}

/// A camera without lens, whose "pixels" are directions.
camera::Camera viewing_camera(const camera::Camera& camera) {
  return {{1, 1, 1, 1, -0.5, -0.5}, camera.pose};
}

/// As far as a box of somebody in the image may leave it.
Eigen::AlignedBox2d limited(const Eigen::AlignedBox2d& box, const camera::Intrinsics& k) {
  return box.intersection(measured_pixels(k).cast<double>());
}

}  // namespace

Eigen::AlignedBox2d head_box(std::span<const SkinPoint> head, const skinning::Palette& palette,
                             const Stance& stance, const camera::Camera& camera) {
  Projector project(palette, image_from_model(stance, viewing_camera(camera)));
  Eigen::AlignedBox2d box;
  for (const SkinPoint& point : head) {
    if (const auto place = shown_place(camera.intrinsics, project(point))) box.extend(*place);
  }
  return box.isEmpty() ? box : limited(box, camera.intrinsics);
}

Eigen::AlignedBox2d shown_box(const skinning::Mesh& mesh, const std::vector<skinning::Part>& parts,
                              const skinning::Palette& palette, const Stance& stance,
                              const camera::Camera& camera, const Rows& rows, bool& is_cut) {
  const camera::Intrinsics& k = camera.intrinsics;
  constexpr double kEverywhere = std::numeric_limits<double>::infinity();
  const double top = rows.first == 0 ? -kEverywhere : rows.first;
  const double bottom = rows.end == k.height ? kEverywhere : rows.end;
  const std::vector<Eigen::Vector4f> places = projected_vertices(
      mesh, Projector(palette, image_from_model(stance, viewing_camera(camera))));
  std::vector<std::optional<Eigen::Vector2d>> shown;
  shown.reserve(places.size());
  for (const Eigen::Vector4f& place : places) shown.push_back(shown_place(k, place));
  is_cut = std::find(shown.begin(), shown.end(), std::nullopt) != shown.end();
  Eigen::AlignedBox2d box;
  for_each_side(mesh, parts, [&](std::uint32_t from, std::uint32_t to) {
    if (!shown[from]) std::swap(from, to);
    const auto& a = shown[from];
    std::optional<Eigen::Vector2d> b = shown[to];
    if (!a) return;
    if (a->y() >= top && a->y() <= bottom) box.extend(*a);
    if (!b) {
      b = last_shown(k, places[from], places[to]);
      if (b->y() >= top && b->y() <= bottom) box.extend(*b);
    }
    for (const double border : {top, bottom}) {
      if ((a->y() < border) == (b->y() < border)) continue;
      box.extend(Eigen::Vector2d(*a + (*b - *a) * ((border - a->y()) / (b->y() - a->y()))));
    }
  });
  return box.isEmpty() ? box : limited(box, k);
}

}  // namespace throng::render
