#include "skinning/appearance.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "base/error.h"
#include "base/random.h"

namespace throng::skinning {

namespace {

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

}  // namespace throng::skinning
