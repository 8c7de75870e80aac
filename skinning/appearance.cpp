#include "skinning/appearance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "base/compute/random.h"
#include "base/error.h"

namespace throng::skinning {

namespace {

constexpr std::uint64_t kOrders = std::uint64_t{1} << 40;  // apart from the agents' own indices
constexpr std::uint64_t kColors = std::uint64_t{1} << 41;
constexpr std::uint64_t kCasts = std::uint64_t{1} << 43;

void shuffle(std::vector<std::uint32_t>& order, std::size_t begin, std::size_t end,
             Random& random) {
  for (std::size_t i = end; i > begin + 1; --i) {
    std::swap(order[i - 1], order[begin + random.below(static_cast<std::uint32_t>(i - begin))]);
  }
}

// Agents come in blocks in which everybody occurs once. The people are dealt into two halves for
// the whole run, and each block has the one half in an order of its own before the other: between
// two agents with the same character there is always at least the other half.
std::uint32_t draw_index(std::uint64_t seed, std::uint32_t agent, std::uint32_t count) {
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0);
  Random dealing(seed, Stream::appearance, kOrders);
  shuffle(order, 0, count, dealing);
  Random ordering(seed, Stream::appearance, kOrders + 1 + agent / count);
  const std::size_t half = (count + 1) / 2;
  shuffle(order, 0, half, ordering);
  shuffle(order, half, count, ordering);
  return order[agent % count];
}

// A place in the row of people that is dealt out again and again: a character, and how often it
// stands further ahead in the row.
struct CharacterCopy {
  std::uint32_t character;
  std::uint32_t copy;
};

// A kind of what agents have with them.
enum class With : std::uint8_t { no_umbrella, umbrella, led };

// Characters of the ages with what they may have: all of them, or a share in an order of the run's
// own.
std::vector<std::uint32_t> take_part(const Population& population, With with, Spot spot,
                                     std::uint64_t seed, const Styling& styling) {
  std::vector<std::uint32_t> taken;
  for (std::uint32_t i = 0; i < population.characters.size(); ++i) {
    const Character& character = population.characters[i];
    const float age = character.age_years;
    if (age < styling.youngest_years || age > styling.oldest_years) continue;
    const With has = character.carries == Carry::umbrella ? With::umbrella
                     : is_led(character.carries)          ? With::led
                                                          : With::no_umbrella;
    const bool leans = character.carries == Carry::walking_stick;
    if (has == with && !(leans && spot == Spot::stand)) taken.push_back(i);
  }
  const auto kept = static_cast<std::size_t>(
      std::ceil(styling.variety * static_cast<double>(taken.size()) - 1e-9));
  if (kept >= taken.size()) return taken;
  Random choosing(seed, Stream::appearance, kCasts);
  shuffle(taken, 0, taken.size(), choosing);
  taken.resize(std::max<std::size_t>(kept, 1));
  return taken;
}

[[noreturn]] void refuse_ages(const Population& population, const Styling& styling) {
  const auto [youngest, oldest] = std::minmax_element(
      population.characters.begin(), population.characters.end(),
      [](const Character& a, const Character& b) { return a.age_years < b.age_years; });
  throw InputError(
      {"", "/appearance",
       fmt::format("nobody from {:g} to {:g} years", styling.youngest_years, styling.oldest_years),
       fmt::format("a range that includes some characters, whose ages are from {:.0f} to {:.0f}",
                   youngest->age_years, oldest->age_years)});
}

// Everybody without an umbrella once, and so many with one, again and again from the front, as make
// up their share. If all characters have umbrellas, all come with them; if all lead something, too.
std::vector<CharacterCopy> choose_cast(const Population& population, std::uint64_t seed,
                                       const Styling& styling, Spot spot, bool leads) {
  const std::vector<std::uint32_t> dry = take_part(population, With::umbrella, spot, seed, styling);
  std::vector<std::uint32_t> bare = take_part(population, With::no_umbrella, spot, seed, styling);
  const bool nobody_else = dry.empty() && bare.empty();
  std::vector<CharacterCopy> leading;
  if (leads || nobody_else) {
    for (const std::uint32_t character :
         take_part(population, With::led, Spot::ground, seed, styling)) {
      leading.push_back({character, 0});
    }
  }
  if (!leading.empty()) return leading;
  if (nobody_else && spot == Spot::stand) {
    return choose_cast(population, seed, styling, Spot::ground, leads);
  }
  if (nobody_else) refuse_ages(population, styling);
  const bool all_dry = !dry.empty() && (bare.empty() || styling.umbrellas >= 1);
  if (all_dry) bare.clear();
  const std::size_t under =
      all_dry ? dry.size()
      : dry.empty()
          ? 0
          : static_cast<std::size_t>(std::lround(static_cast<double>(bare.size()) *
                                                 styling.umbrellas / (1 - styling.umbrellas)));
  std::vector<CharacterCopy> cast;
  cast.reserve(bare.size() + under);
  for (const std::uint32_t character : bare) cast.push_back({character, 0});
  for (std::size_t i = 0; i < under; ++i) {
    cast.push_back({dry[i % dry.size()], static_cast<std::uint32_t>(i / dry.size())});
  }
  return cast;
}

// Selects the color of a character in a block: the next one each time, from a start of its own, and
// the kinds of items drift against each other, so that equal outfits are far apart.
std::size_t color_number(std::uint64_t seed, std::uint32_t character, std::size_t tint,
                         std::uint32_t block, std::size_t colors) {
  Random random(seed, Stream::appearance, kColors + kTintCount * character + tint);
  const std::uint64_t start = random.below(static_cast<std::uint32_t>(colors));
  return (start + block + tint * (block / colors)) % colors;
}

// The same color in slightly different cloth.
Rgb varied(const Rgb& color, Random& random) {
  const double light = random.uniform(0.86, 1.1);
  Rgb result{};
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const double value = color[channel] * light * random.uniform(0.95, 1.05);
    result[channel] = static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L));
  }
  return result;
}

Rgb dyed(const Rgb& color, const Styling& styling) {
  // Gray of the same luma (ITU-R BT.601).
  const double gray = 0.299 * color[0] + 0.587 * color[1] + 0.114 * color[2];
  Rgb result{};
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const double value = styling.brightness * (gray + styling.saturation * (color[channel] - gray));
    result[channel] = static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L));
  }
  return result;
}

// A character as the agent shows it, in its colors of this block.
Appearance shown(const Population& population, std::uint32_t number, std::uint64_t run_seed,
                 std::uint32_t agent, std::uint32_t block, const Styling& styling) {
  Appearance appearance;
  appearance.character = number;
  Random random(run_seed, Stream::appearance, agent);
  appearance.phase_offset = static_cast<float>(random.uniform());
  appearance.cadence = static_cast<float>(random.uniform(0.95, 1.05));
  appearance.amplitude = static_cast<float>(random.uniform(0.92, 1.08));
  const Character& character = population.characters[number];
  for (std::size_t tint = 0; tint < kTintCount; ++tint) {
    const std::vector<Rgb>& colors = character.tints[tint];
    appearance.tint[tint] = {255, 255, 255};
    if (colors.empty()) continue;
    const std::size_t color = color_number(run_seed, number, tint, block, colors.size());
    appearance.tint[tint] = varied(colors[color], random);
    if (tint != static_cast<std::size_t>(Tint::hair)) {
      appearance.tint[tint] = dyed(appearance.tint[tint], styling);
    }
  }
  return appearance;
}

}  // namespace

Appearance sample_appearance(const Population& population, std::uint64_t run_seed,
                             std::uint32_t agent, const Styling& styling, Spot spot) {
  check(!population.characters.empty(), "a population has characters");
  const bool leads = spot == Spot::ground && is_leading(run_seed, agent, styling.leading);
  const std::vector<CharacterCopy> cast = choose_cast(population, run_seed, styling, spot, leads);
  const auto count = static_cast<std::uint32_t>(cast.size());
  const CharacterCopy& shows = cast[draw_index(run_seed, agent, count)];
  return shown(population, shows.character, run_seed, agent, agent / count + shows.copy, styling);
}

Appearance appearance_as(const Population& population, std::uint32_t character,
                         std::uint64_t run_seed) {
  check(character < population.characters.size(), "the population has the character");
  return shown(population, character, run_seed, character, 0, {});
}

}  // namespace throng::skinning
