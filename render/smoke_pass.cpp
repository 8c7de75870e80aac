#include "render/smoke_pass.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/random.h"
#include "render/colour_only.h"
#include "render/lighting.h"
#include "render/shaders.h"
#include "render/view.h"

namespace throng::render {

namespace {

constexpr std::uint64_t kSmoke = std::uint64_t{1} << 43;  // apart from other uses of the stream
constexpr std::uint64_t kPuffs = 130;                     // of one danger
constexpr std::uint64_t kDust = 40;                       // of them
constexpr double kLifeS = 15;
constexpr double kDriftMps = 0.45;

}  // namespace

SmokePass::SmokePass(const Environment& environment)
    : environment_(environment),
      instances_(make_buffer()),
      array_(make_vertex_array()),
      program_(make_program({embedded::shader_view, embedded::shader_smoke_vert},
                            {light_words(environment), embedded::shader_light,
                             embedded::shader_noise, embedded::shader_smoke_frag})) {
  describe_vertices(array_, 0, instances_, sizeof(Puff), 1,
                    {{0, 4, GL_FLOAT, false, offsetof(Puff, place)},
                     {1, 4, GL_FLOAT, false, offsetof(Puff, look)}});
}

// Every puff rises, widens and thins out over kLifeS, and then begins anew.
void SmokePass::add_puffs(const Eigen::Vector2d& danger, std::size_t number, double time_s,
                          const camera::Camera& camera) {
  Random wind(environment_.seed, Stream::environment, kSmoke);
  const double heading = wind.uniform(0, 2 * std::numbers::pi);
  const Eigen::Vector2d drift = kDriftMps * Eigen::Vector2d(std::cos(heading), std::sin(heading));
  for (std::uint64_t i = 0; i < kPuffs; ++i) {
    Random random(environment_.seed, Stream::environment, kSmoke + 1 + kPuffs * number + i);
    const double whole = time_s / kLifeS + random.uniform();
    const double age_s = kLifeS * (whole - std::floor(whole));
    const double angle = random.uniform(0, 2 * std::numbers::pi);
    const Eigen::Vector2d side(std::cos(angle), std::sin(angle));
    const double strength = environment_.smoke * std::min(age_s / 1.5, 1.0) *
                            std::pow(1 - age_s / kLifeS, 1.3) * random.uniform(0.5, 1);
    const bool dust = i < kDust;
    const double spread = random.uniform(0.2, 1);
    const Eigen::Vector2d at = danger +
                               side * (dust ? 0.6 + 0.35 * age_s : 0.3 + 0.1 * age_s) * spread +
                               (dust ? 0.4 : 1.0) * age_s * drift;
    const double height = dust ? 0.4 + 0.05 * age_s : 0.6 + 1.05 * std::pow(age_s, 0.92);
    const double radius = dust ? 0.7 + 0.12 * age_s : 0.55 + 0.2 * age_s;
    const double tone = random.uniform(0.7, 1.3);
    const Eigen::Vector3d albedo =
        tone * (dust ? Eigen::Vector3d(0.36, 0.31, 0.25) : Eigen::Vector3d(0.10, 0.10, 0.105));
    Puff puff;
    puff.place = {static_cast<float>(at.x()), static_cast<float>(at.y()),
                  static_cast<float>(height), static_cast<float>(radius)};
    puff.look = {static_cast<float>(albedo.x()), static_cast<float>(albedo.y()),
                 static_cast<float>(albedo.z()),
                 static_cast<float>((dust ? 0.35 : 0.75) * strength)};
    puff.depth_m = static_cast<float>(camera.project({at.x(), at.y(), height}).depth_m);
    if (puff.depth_m > puff.place[3]) puffs_.push_back(puff);
  }
}

void SmokePass::draw(const Scene& scene, const camera::Camera& camera) {
  if (environment_.smoke <= 0 || scene.dangers.empty()) return;
  puffs_.clear();
  for (std::size_t i = 0; i < scene.dangers.size(); ++i) {
    add_puffs(scene.dangers[i].cast<double>(), i, scene.time_s, camera);
  }
  std::stable_sort(puffs_.begin(), puffs_.end(),
                   [](const Puff& a, const Puff& b) { return a.depth_m > b.depth_m; });
  if (puffs_.empty()) return;
  glNamedBufferData(instances_.name(), static_cast<GLsizeiptr>(puffs_.size() * sizeof(Puff)),
                    puffs_.data(), GL_STREAM_DRAW);
  const ColourOnly guard;
  glBindVertexArray(array_.name());
  glUseProgram(program_.name());
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(puffs_.size()));
}

}  // namespace throng::render
