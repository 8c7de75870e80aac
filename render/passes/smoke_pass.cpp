#include "render/passes/smoke_pass.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/compute/random.h"
#include "render/frame/view.h"
#include "render/gl/color_only.h"
#include "render/gl/shaders.h"
#include "render/scenery/lighting.h"

namespace throng::render {

namespace {

constexpr std::uint64_t kSmoke = std::uint64_t{1} << 43;  // apart from other uses of the stream
constexpr std::uint64_t kPuffs = 130;                     // of one danger
constexpr std::uint64_t kUsualDust = 40;                  // of them
constexpr double kLifeS = 15;
constexpr std::uint64_t kFlames = std::uint64_t{1} << 45;
constexpr float kShines = 2;  // added to the opacity of what does; also in shaders/smoke.frag.glsl
const Eigen::Vector3d kSoot(0.10, 0.10, 0.105);
const Eigen::Vector3d kDustAlbedo(0.36, 0.31, 0.25);

/// Air in which smoke drifts: the wind, but never still. A strong wind tears smoke apart, which
/// this many puffs cannot show: it is taken as kMaxDriftMps.
Eigen::Vector2d drift_mps(const Environment& environment) {
  constexpr double kMinDriftMps = 0.45;
  constexpr double kMaxDriftMps = 2.5;
  const double speed_mps = environment.wind_mps.norm();
  if (speed_mps > kMinDriftMps) {
    return environment.wind_mps * (std::min(speed_mps, kMaxDriftMps) / speed_mps);
  }
  Random wind(environment.seed, Stream::environment, kSmoke);
  const double heading = wind.uniform(0, 2 * std::numbers::pi);
  return kMinDriftMps * Eigen::Vector2d(std::cos(heading), std::sin(heading));
}

}  // namespace

SmokePass::SmokePass(const Environment& environment, std::vector<world::Disaster> disasters,
                     const ProbeGrid& air)
    : air_(air),
      environment_(environment),
      disasters_(std::move(disasters)),
      instances_(make_buffer()),
      array_(make_vertex_array()),
      program_(make_program({embedded::shader_view, embedded::shader_smoke_vert},
                            {light_words(environment, disasters_), embedded::shader_light,
                             embedded::shader_noise, embedded::shader_smoke_frag})),
      opacity_(make_program(
          {embedded::shader_view, embedded::shader_smoke_vert},
          {"#define OPACITY\n", light_words(environment, disasters_), embedded::shader_light,
           embedded::shader_noise, embedded::shader_smoke_frag})) {
  describe_vertices(array_, 0, instances_, sizeof(Puff), 1,
                    {{0, 4, GL_FLOAT, false, offsetof(Puff, place)},
                     {1, 4, GL_FLOAT, false, offsetof(Puff, look)},
                     {2, 1, GL_FLOAT, false, offsetof(Puff, kind)},
                     {3, 3, GL_FLOAT, false, offsetof(Puff, above)},
                     {4, 3, GL_FLOAT, false, offsetof(Puff, below)}});
}

SmokePass::Source SmokePass::smoke_source(const world::Disaster& disaster, double time_s) {
  Source source{
      disaster.position, time_s - disaster.start_s, disaster.reach_m(time_s), 1, kUsualDust, kSoot,
      kDustAlbedo};
  switch (disaster.kind) {
    case world::DisasterKind::gas:
      source.rise = 0.15;
      source.dust = 78;
      source.smoke_albedo = {0.42, 0.45, 0.20};
      source.dust_albedo = {0.46, 0.48, 0.24};
      source.matter = HazardMatter::gas;
      break;
    case world::DisasterKind::collapse:
      source.rise = 0.4;
      source.dust = 91;
      source.smoke_albedo = {0.40, 0.37, 0.33};
      source.dust_albedo = {0.42, 0.38, 0.33};
      break;
    case world::DisasterKind::explosion:
    case world::DisasterKind::fire:
    case world::DisasterKind::attacker:
      break;
  }
  return source;
}

// Every puff rises, widens and thins out over kLifeS, and then starts again.
void SmokePass::add_puffs(const Source& source, std::size_t number, double time_s,
                          const camera::Camera& camera) {
  const Eigen::Vector2d drift = drift_mps(environment_);
  for (std::uint64_t i = 0; i < kPuffs; ++i) {
    Random random(environment_.seed, Stream::environment, kSmoke + 1 + kPuffs * number + i);
    const double whole = time_s / kLifeS + random.uniform();
    const double age_s = kLifeS * (whole - std::floor(whole));
    if (age_s > source.age_s) continue;
    const double angle = random.uniform(0, 2 * std::numbers::pi);
    const Eigen::Vector2d side(std::cos(angle), std::sin(angle));
    const double strength = environment_.smoke * std::min(age_s / 1.5, 1.0) *
                            std::pow(1 - age_s / kLifeS, 1.3) * random.uniform(0.5, 1);
    const bool dust = i < source.dust;
    const double spread = random.uniform(0.2, 1);
    const double wide = std::sqrt(spread) * source.reach_m;
    const Eigen::Vector2d at = source.place + wide * side +
                               side * (dust ? 0.6 + 0.35 * age_s : 0.3 + 0.1 * age_s) * spread +
                               (dust ? 0.4 : 1.0) * age_s * drift;
    const double height =
        dust ? 0.4 + 0.05 * age_s : 0.6 + source.rise * 1.05 * std::pow(age_s, 0.92);
    const double radius =
        (dust ? 0.7 + 0.12 * age_s : 0.55 + 0.2 * age_s) * (1 + 0.12 * source.reach_m);
    const double tone = random.uniform(0.7, 1.3);
    const Eigen::Vector3d albedo = tone * (dust ? source.dust_albedo : source.smoke_albedo);
    Puff puff;
    puff.place = {static_cast<float>(at.x()), static_cast<float>(at.y()),
                  static_cast<float>(height), static_cast<float>(radius)};
    puff.look = {static_cast<float>(albedo.x()), static_cast<float>(albedo.y()),
                 static_cast<float>(albedo.z()),
                 static_cast<float>((dust ? 0.35 : 0.75) * strength)};
    puff.kind = static_cast<float>(source.matter);
    puff.depth_m = static_cast<float>(camera.project({at.x(), at.y(), height}).depth_m);
    if (puff.depth_m > puff.place[3]) puffs_.push_back(puff);
  }
}

void SmokePass::add_flames(const world::Disaster& disaster, std::size_t number, double time_s,
                           const camera::Camera& camera) {
  constexpr std::uint64_t kMaxTongues = 110;
  constexpr double kFlameS = 0.9;
  const double burning = burning_share(disaster, time_s);
  if (burning <= 0) return;
  const double reach_m = 0.6 * disaster.reach_m(time_s);
  const Eigen::Vector2d lean_mps = 0.5 * drift_mps(environment_);
  for (std::uint64_t i = 0; i < kMaxTongues; ++i) {
    Random random(environment_.seed, Stream::environment, kFlames + kMaxTongues * number + i);
    const double whole = time_s / kFlameS + random.uniform();
    const double share = whole - std::floor(whole);
    const double angle = random.uniform(0, 2 * std::numbers::pi);
    const double out = std::sqrt(random.uniform());
    const double out_m = reach_m * out * (1 - 0.4 * share);
    // Tongues in the middle are the tallest; each grows, rises a little and goes out.
    const double size_m = (0.35 + 0.3 * reach_m) * (1.15 - 0.6 * out) * random.uniform(0.7, 1.2);
    const double radius_m = size_m * (0.7 + 0.5 * share);
    const double height_m = radius_m * 1.6 + (0.4 + 0.5 * reach_m) * (1.1 - out) * share;
    const Eigen::Vector2d at = disaster.position +
                               out_m * Eigen::Vector2d(std::cos(angle), std::sin(angle)) +
                               lean_mps * (kFlameS * share);
    Puff puff;
    puff.place = {static_cast<float>(at.x()), static_cast<float>(at.y()),
                  static_cast<float>(height_m), static_cast<float>(radius_m)};
    const double shows = std::min({1.0, 6 * share, 3 * (1 - share)});
    puff.look = {static_cast<float>(1.0 - 0.55 * share * out), 0, 0,
                 kShines + static_cast<float>(0.9 * burning * environment_.smoke * shows)};
    puff.kind = static_cast<float>(HazardMatter::fire);
    puff.depth_m = static_cast<float>(camera.project({at.x(), at.y(), height_m}).depth_m);
    if (puff.depth_m > puff.place[3]) puffs_.push_back(puff);
  }
}

void SmokePass::upload(const Scene& scene, const camera::Camera& camera) {
  puffs_.clear();
  if (environment_.smoke <= 0) return;
  for (std::size_t i = 0; i < disasters_.size(); ++i) {
    if (disasters_[i].kind == world::DisasterKind::attacker) continue;
    add_puffs(smoke_source(disasters_[i], scene.time_s), i, scene.time_s, camera);
    add_flames(disasters_[i], i, scene.time_s, camera);
  }
  for (std::size_t i = 0; disasters_.empty() && i < scene.dangers.size(); ++i) {
    add_puffs({scene.dangers[i].cast<double>(), kLifeS, 0, 1, kUsualDust, kSoot, kDustAlbedo}, i,
              scene.time_s, camera);
  }
  std::stable_sort(puffs_.begin(), puffs_.end(),
                   [](const Puff& a, const Puff& b) { return a.depth_m > b.depth_m; });
  if (puffs_.empty()) return;
  for (Puff& puff : puffs_) {
    const LightField light = air_.at(Eigen::Vector3f(puff.place.data()));
    const Eigen::Array3f above = light.received(Eigen::Vector3f::UnitZ());
    const Eigen::Array3f below = light.received(-Eigen::Vector3f::UnitZ());
    std::copy_n(above.data(), 3, puff.above.data());
    std::copy_n(below.data(), 3, puff.below.data());
  }
  glNamedBufferData(instances_.name(), static_cast<GLsizeiptr>(puffs_.size() * sizeof(Puff)),
                    puffs_.data(), GL_STREAM_DRAW);
}

void SmokePass::draw_discs(const Program& program) const {
  glBindVertexArray(array_.name());
  glUseProgram(program.name());
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(puffs_.size()));
}

void SmokePass::draw(const Scene& scene, const camera::Camera& camera) {
  upload(scene, camera);
  if (puffs_.empty()) return;
  const ColorOnly guard;
  draw_discs(program_);
}

void SmokePass::draw_opacity(const Scene& scene, const camera::Camera& camera) {
  upload(scene, camera);
  if (puffs_.empty()) return;
  const ColorOnly guard;
  // Transmittances of puffs multiply.
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_COLOR);
  draw_discs(opacity_);
}

}  // namespace throng::render
