#include "render/passes/contact_pass.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/gl/color_only.h"
#include "render/gl/shaders.h"

namespace throng::render {

namespace {

using Eigen::Vector2d;

constexpr double kMinSizePx = 48;  // standing height of people who still get a rim: it costs as
                                   // much as they do, and shows as a few pixels
constexpr double kOnGroundM = 0.01;
constexpr double kPersonReachM = 0.5;
constexpr double kShadowReachM = 14;  // farther lamps cast no visible shadow
constexpr double kTypicalStatureM = 1.7;

/// How far around a prop its underside, which is near the ground, hides the sky (m).
double contact_reach_m(const world::PropType& type) {
  return world::is_vehicle(type.semantic_class) && type.half_size.y() > 0.5 ? 0.7 : 0.35;
}

}  // namespace

ContactPass::Rim ContactPass::rim(const Vector2d& middle, const Vector2d& half_size, double yaw_rad,
                                  double reach_m, double strength) {
  return {{static_cast<float>(middle.x()), static_cast<float>(middle.y()),
           static_cast<float>(half_size.x()), static_cast<float>(half_size.y())},
          {static_cast<float>(std::cos(yaw_rad)), static_cast<float>(std::sin(yaw_rad)),
           static_cast<float>(reach_m), static_cast<float>(strength)},
          0};
}

// In the sun the sky gives a smaller part of the light.
ContactPass::ContactPass(const world::Scenario& scenario, const Daylight& light)
    : strength_(light.soft || light.dark ? 0.62 : 0.42),
      instances_(make_buffer()),
      array_(make_vertex_array()),
      program_(make_program({embedded::shader_view, embedded::shader_contact_vert},
                            {embedded::shader_light, embedded::shader_contact_frag})) {
  for (const world::Prop& prop : scenario.props) {
    const world::PropType& type = world::prop_type(prop.kind);
    // Roofs on posts have none: the light that they take is baked.
    if (type.foot == world::Foot::posts) continue;
    still_.push_back(rim(prop.position, 0.9 * prop.scale * type.half_size, prop.yaw_rad,
                         contact_reach_m(type), 0.7 * strength_));
    if (type.foot == world::Foot::disc) still_.back().rounding_m = still_.back().footprint[2];
  }
  if (light.lamps_on) lamps_ = all_lamps(scenario);
  describe_vertices(array_, 0, instances_, sizeof(Rim), 1,
                    {{0, 4, GL_FLOAT, false, offsetof(Rim, footprint)},
                     {1, 4, GL_FLOAT, false, offsetof(Rim, shade)},
                     {2, 1, GL_FLOAT, false, offsetof(Rim, rounding_m)}});
}

// A lamp's shadow is as long as its height over the person's says, and wide: lamps are no points,
// and others shine into it.
void ContactPass::add_lamp_shadows(const PersonInstance& person) {
  constexpr double kMinShare = 0.12;  // of the light, that of a visible shadow
  constexpr double kMaxLengthM = 4;
  constexpr double kHalfWidthM = 0.16;
  constexpr double kEdgeM = 0.3;
  struct Shining {
    Vector2d away;
    double height_m;
    double light;
  };
  std::vector<Shining> shining;
  double sum = 0;
  const Vector2d foot = person.position.head<2>().cast<double>();
  for (const Lamp& lamp : lamps_) {
    const Vector2d away = foot - lamp.position.head<2>();
    if (away.norm() > kShadowReachM || (away.dot(lamp.away) <= 0 && !lamp.away.isZero())) continue;
    const double square = away.squaredNorm() + lamp.position.z() * lamp.position.z();
    shining.push_back({away, lamp.position.z(),
                       lamp.strength * lamp.position.z() / (square * std::sqrt(square))});
    sum += shining.back().light;
  }
  for (const Shining& lamp : shining) {
    const double share = lamp.light / sum;
    if (share < kMinShare || lamp.height_m < kTypicalStatureM + 0.3) continue;
    const double distance = std::max(lamp.away.norm(), 0.05);
    const double length =
        std::min(distance * kTypicalStatureM / (lamp.height_m - kTypicalStatureM), kMaxLengthM);
    const Vector2d along = lamp.away / distance;
    rims_.push_back(rim(foot + 0.5 * length * along, {0.5 * length, kHalfWidthM},
                        std::atan2(along.y(), along.x()), kEdgeM, 0.6 * share));
    rims_.back().rounding_m = static_cast<float>(std::min(0.5 * length, kHalfWidthM));
  }
}

void ContactPass::draw(std::span<const PersonInstance> people, const camera::Camera& camera) {
  const ClipPlanes planes = clip_planes(camera);
  const Eigen::Vector3d eye = camera.pose.center();
  const double max_distance_m = camera.intrinsics.fy_px * kTypicalStatureM / kMinSizePx;
  std::vector<const PersonInstance*> seen;
  for (const PersonInstance& person : people) {
    const Eigen::Vector3d foot = person.position.cast<double>();
    if (foot.z() > kOnGroundM) continue;  // on a stand
    if ((foot - eye).norm() > max_distance_m || is_outside(planes, foot, kPersonReachM)) continue;
    seen.push_back(&person);
  }
  // Rounding of overlapping rims depends on their order.
  std::sort(seen.begin(), seen.end(),
            [](const PersonInstance* a, const PersonInstance* b) { return a->agent < b->agent; });
  rims_ = still_;
  for (const PersonInstance* person : seen) {
    rims_.push_back(rim(person->position.head<2>().cast<double>(), {0.04, 0.1}, person->yaw_rad,
                        kPersonReachM, strength_));
  }
  for (const PersonInstance* person : seen) add_lamp_shadows(*person);
  if (rims_.empty()) return;
  glNamedBufferData(instances_.name(), static_cast<GLsizeiptr>(rims_.size() * sizeof(Rim)),
                    rims_.data(), GL_STREAM_DRAW);
  const ColorOnly guard;
  glBindVertexArray(array_.name());
  glUseProgram(program_.name());
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(rims_.size()));
}

}  // namespace throng::render
