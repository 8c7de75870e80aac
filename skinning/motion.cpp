#include "skinning/motion.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>

#include "base/error.h"
#include "base/random.h"
#include "skinning/gait.h"

namespace throng::skinning {

namespace {

constexpr double kGravity = 9.81;  // m/s^2

// The characters of agents block * count .. in an order of their own, so that within a block
// nobody has a twin.
std::uint32_t shuffled_character(std::uint64_t seed, std::uint32_t block, std::uint32_t slot,
                                 std::uint32_t count) {
  constexpr std::uint64_t kBlocks = std::uint64_t{1} << 40;  // apart from the agents' own indices
  Random random(seed, Stream::appearance, kBlocks + block);
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0);
  for (std::uint32_t i = count - 1; i > 0; --i) std::swap(order[i], order[random.below(i + 1)]);
  return order[slot];
}

std::uint32_t character_of(std::uint64_t seed, std::uint32_t agent, std::uint32_t count) {
  const std::uint32_t block = agent / count;
  const std::uint32_t slot = agent % count;
  const std::uint32_t character = shuffled_character(seed, block, slot, count);
  if (block == 0 || slot > 1 || count < 3) return character;
  // Where two blocks meet, the first two of the later one change places if the first would repeat
  // the last of the earlier one.
  const std::uint32_t first = shuffled_character(seed, block, 0, count);
  const std::uint32_t before = shuffled_character(seed, block - 1, count - 1, count);
  return first == before ? shuffled_character(seed, block, 1 - slot, count) : character;
}

// The same colour in slightly different cloth.
Rgb varied(const Rgb& colour, Random& random) {
  const double light = random.uniform(0.9, 1.08);
  Rgb result{};
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const double value = colour[channel] * light * random.uniform(0.97, 1.03);
    result[channel] = static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L));
  }
  return result;
}

const Clip& clip_at(const Population& population, double speed_mps) {
  const Clip* best = &population.clips.front();
  double best_distance = std::numeric_limits<double>::max();
  const bool stands = speed_mps < kStandingSpeed;
  const bool runs = speed_mps >= kRunningSpeed;
  for (const Clip& clip : population.clips) {
    const bool fits = stands ? clip.name == "idle" : clip.name == (runs ? "run" : "walk");
    const double distance = std::abs(clip.speed_mps - speed_mps);
    if (fits && distance < best_distance) {
      best = &clip;
      best_distance = distance;
    }
  }
  return *best;
}

}  // namespace

Appearance appearance_of(const Population& population, std::uint64_t run_seed,
                         std::uint32_t agent) {
  check(!population.characters.empty(), "a population has characters");
  Appearance appearance;
  appearance.character =
      character_of(run_seed, agent, static_cast<std::uint32_t>(population.characters.size()));
  Random random(run_seed, Stream::appearance, agent);
  appearance.phase_offset = static_cast<float>(random.uniform());
  appearance.cadence = static_cast<float>(random.uniform(0.97, 1.03));
  const Character& character = population.characters[appearance.character];
  for (std::size_t tint = 0; tint < kTintCount; ++tint) {
    const std::vector<Rgb>& colours = character.tints[tint];
    appearance.tint[tint] = {255, 255, 255};
    if (colours.empty()) continue;
    const Rgb& colour = colours[random.below(static_cast<std::uint32_t>(colours.size()))];
    appearance.tint[tint] = varied(colour, random);
  }
  return appearance;
}

double stride_length_m(double speed_mps, double stature_m) {
  const double relative_speed = speed_mps / std::sqrt(kGravity * stature_m);
  const double walk = 0.42 + 1.22 * relative_speed;
  const double run = 0.30 + 1.29 * relative_speed;
  const double t = std::clamp((speed_mps - 1.8) / (2.3 - 1.8), 0.0, 1.0);
  const double blend = t * t * (3 - 2 * t);
  return stature_m * (walk + blend * (run - walk));
}

void integrate_phase(std::span<const float> speed_mps, double dt_s, double stature_m,
                     const Appearance& appearance, std::span<double> phase) {
  check(speed_mps.size() == phase.size(), "a phase for each speed");
  const auto rate_hz = [&](float speed) {
    return appearance.cadence * speed / stride_length_m(speed, stature_m);
  };
  double strides = appearance.phase_offset;
  for (std::size_t step = 0; step < phase.size(); ++step) {
    if (step > 0) {
      strides += 0.5 * dt_s * (rate_hz(speed_mps[step - 1]) + rate_hz(speed_mps[step]));
    }
    phase[step] = strides;
  }
}

PoseBlend pose_at(const Population& population, double phase, double speed_mps, double time_s) {
  check(!population.clips.empty(), "a population has clips");
  const Clip& clip = clip_at(population, speed_mps);
  const bool stands = clip.name == "idle";
  const double turns = stands ? phase + time_s / kIdlePeriod : phase;
  const double at = (turns - std::floor(turns)) * clip.frames;
  const auto frame = std::min(static_cast<std::uint32_t>(at), clip.frames - 1);
  return {clip.first + frame, clip.first + (frame + 1) % clip.frames,
          static_cast<float>(at - frame)};
}

}  // namespace throng::skinning
