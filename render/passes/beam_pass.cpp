#include "render/passes/beam_pass.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "base/compute/random.h"
#include "render/gl/color_only.h"
#include "render/gl/shaders.h"

namespace throng::render {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::uint64_t kPhones = std::uint64_t{1} << 47;  // apart from other uses of the stream

std::array<float, 4> four(const Vector3d& v, double last) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()),
          static_cast<float>(last)};
}

}  // namespace

BeamPass::BeamPass(const world::Scenario& scenario, bool lamps_on, std::string_view words) {
  if (!lamps_on) return;
  for (const world::Prop& prop : scenario.props) {
    const std::vector<ShapeBeam> beams = shape_beams(world::prop_type(prop.kind).name);
    if (beams.empty()) continue;
    stages_.push_back(prop.position);
    const Eigen::AngleAxisd turn(prop.yaw_rad, Vector3d::UnitZ());
    const Vector3d at(prop.position.x(), prop.position.y(), 0);
    for (const ShapeBeam& beam : beams) {
      beams_.push_back(
          {at + prop.scale * (turn * beam.position), turn * beam.direction, beam.color});
    }
  }
  if (beams_.empty()) return;
  instances_ = make_buffer();
  array_ = make_vertex_array();
  program_ = make_program({embedded::shader_view, embedded::shader_beam_vert},
                          {words, embedded::shader_light, embedded::shader_beam_frag});
  describe_vertices(array_, 0, instances_, sizeof(Streak), 1,
                    {{0, 4, GL_FLOAT, false, offsetof(Streak, from)},
                     {1, 4, GL_FLOAT, false, offsetof(Streak, to)},
                     {2, 4, GL_FLOAT, false, offsetof(Streak, color)}});
}

void BeamPass::add_beams(double time_s) {
  constexpr double kLengthM = 34;
  constexpr double kLensM = 0.2;
  constexpr double kSpread = 0.03;  // radius per meter
  constexpr double kSwingRad = 0.32;
  constexpr double kLight = 2.6e-3;
  for (std::size_t i = 0; i < beams_.size(); ++i) {
    const ShapeBeam& beam = beams_[i];
    const auto phase = static_cast<double>(i);
    const Vector3d side = beam.direction.unitOrthogonal();
    const Vector3d other = beam.direction.cross(side);
    const Vector3d direction =
        (beam.direction + kSwingRad * std::sin(0.7 * time_s + 1.9 * phase) * side +
         kSwingRad * std::sin(0.5 * time_s + 0.8 * phase) * other)
            .normalized();
    double length = kLengthM;
    if (direction.z() < 0) length = std::min(length, -beam.position.z() / direction.z());
    const Vector3d light = kLight * beam.color.matrix();
    streaks_.push_back({four(beam.position, kLensM),
                        four(beam.position + length * direction, kLensM + kSpread * length),
                        four(light, 1 - length / kLengthM)});
  }
}

void BeamPass::add_phones(const Scene& scene) {
  constexpr double kShare = 0.07;
  constexpr double kReachM = 75;
  constexpr double kHoldS = 25;
  const Vector3d glow(0.9, 1.05, 1.3);
  for (const PersonInstance& person : scene.people) {
    const auto turn = static_cast<std::uint64_t>(scene.time_s / kHoldS + person.agent);
    Random random(person.agent * std::uint64_t{4096} + turn, Stream::environment, kPhones);
    if (random.uniform() > kShare) continue;
    const Vector2d at = person.position.head<2>().cast<double>();
    const bool is_near = std::any_of(stages_.begin(), stages_.end(), [&](const Vector2d& stage) {
      return (stage - at).norm() < kReachM;
    });
    if (!is_near) continue;
    const double yaw = person.yaw_rad;
    const double height = person.position.z() + random.uniform(1.35, 1.85);
    const Vector2d ahead = at + 0.38 * Vector2d(std::cos(yaw), std::sin(yaw));
    const Vector3d low(ahead.x(), ahead.y(), height);
    streaks_.push_back({four(low, 0.06), four(low + Vector3d(0, 0, 0.15), 0.06),
                        four(random.uniform(1.2e-3, 3e-3) * glow, 1)});
  }
}

void BeamPass::draw(const Scene& scene) {
  if (beams_.empty()) return;
  streaks_.clear();
  add_beams(scene.time_s);
  add_phones(scene);
  const auto bytes = static_cast<GLsizeiptr>(streaks_.size() * sizeof(Streak));
  glNamedBufferData(instances_.name(), bytes, streaks_.data(), GL_STREAM_DRAW);
  const ColorOnly guard;
  // Colors are as film shows them: light adds to what is dark, and never beyond white.
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_COLOR);
  glUseProgram(program_.name());
  glBindVertexArray(array_.name());
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(streaks_.size()));
}

}  // namespace throng::render
