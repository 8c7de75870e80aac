#include "render/passes/sky_pass.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/compute/random.h"
#include "render/frame/view.h"
#include "render/gl/color_only.h"
#include "render/gl/shaders.h"
#include "render/scenery/lighting.h"

namespace throng::render {

namespace {

/// Whether the plain around the scenario ends in view.
bool sees_sky(const camera::Camera& camera) {
  constexpr double kPlainM = 2000;
  const camera::Intrinsics& k = camera.intrinsics;
  const Eigen::Vector3d center = camera.pose.center();
  const std::array<Eigen::Vector2d, 4> corners = {
      Eigen::Vector2d(-0.5, -0.5), Eigen::Vector2d(k.width - 0.5, -0.5),
      Eigen::Vector2d(-0.5, k.height - 0.5), Eigen::Vector2d(k.width - 0.5, k.height - 0.5)};
  return std::any_of(corners.begin(), corners.end(), [&](const Eigen::Vector2d& corner) {
    const Eigen::Vector3d ray = camera.unproject(corner, 1.0) - center;
    return ray.z() > -center.z() / kPlainM * ray.head<2>().norm();
  });
}

/// Streaks in view: more rain has more drops, but also larger ones.
GLsizei drop_count(double rain_mm_per_h) {
  return static_cast<GLsizei>(900 * std::pow(rain_mm_per_h, 0.5));
}

}  // namespace

SkyPass::SkyPass(const Environment& environment)
    : environment_(environment),
      nothing_(make_vertex_array()),
      sky_(make_program({embedded::shader_view, embedded::shader_sky_vert},
                        {light_words(environment), embedded::shader_light, embedded::shader_noise,
                         embedded::shader_sky_frag})),
      rain_(
          make_program({embedded::shader_view, embedded::shader_noise, embedded::shader_rain_vert},
                       {embedded::shader_light, embedded::shader_rain_frag})) {}

void SkyPass::draw_sky(const camera::Camera& camera) const {
  if (!sees_sky(camera)) return;
  const ColorOnly guard;
  glDepthFunc(GL_GEQUAL);
  glBindVertexArray(nothing_.name());
  glUseProgram(sky_.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDepthFunc(GL_GREATER);
}

void SkyPass::draw_rain(const camera::Camera& camera, std::int64_t frame) const {
  if (environment_.weather != Weather::rain || environment_.rain_mm_per_h <= 0) return;
  const ColorOnly guard;
  glBindVertexArray(nothing_.name());
  glUseProgram(rain_.name());
  Random random(environment_.seed, Stream::environment, static_cast<std::uint64_t>(frame));
  glUniform1ui(glGetUniformLocation(rain_.name(), "salt"), random.bits());
  glUniform2f(glGetUniformLocation(rain_.name(), "image"),
              static_cast<float>(camera.intrinsics.width),
              static_cast<float>(camera.intrinsics.height));
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, drop_count(environment_.rain_mm_per_h));
}

}  // namespace throng::render
