// A crowd sampled from few characters shows no twins side by side.
#include "skinning/appearance.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>

#include "base/error.h"
#include "skinning/wardrobe/person.h"

namespace throng::skinning {
namespace {

constexpr std::uint32_t kAgents = 2000;

// The people of a baked population as far as their colors go.
Population make_people(int count) {
  Population population;
  for (int i = 0; i < count; ++i) {
    Character character;
    character.tints = sample_person(1, i).outfit.tints;
    population.characters.push_back(std::move(character));
  }
  return population;
}

std::vector<Appearance> sample_appearances(const Population& population, std::uint64_t seed) {
  std::vector<Appearance> crowd;
  for (std::uint32_t agent = 0; agent < kAgents; ++agent) {
    crowd.push_back(sample_appearance(population, seed, agent));
  }
  return crowd;
}

bool alike(const Rgb& a, const Rgb& b) {
  int difference = 0;
  for (std::size_t i = 0; i < 3; ++i) difference = std::max(difference, std::abs(a[i] - b[i]));
  return difference < 24;
}

bool dressed_alike(const Appearance& a, const Appearance& b) {
  return alike(a.tint[static_cast<std::size_t>(Tint::top)],
               b.tint[static_cast<std::size_t>(Tint::top)]) &&
         alike(a.tint[static_cast<std::size_t>(Tint::bottom)],
               b.tint[static_cast<std::size_t>(Tint::bottom)]);
}

TEST(Twins, EqualBodiesAreFarApartInId) {
  for (const int count : {24, 96, 97}) {
    const Population population = make_people(count);
    std::map<std::uint32_t, std::uint32_t> last;
    for (std::uint32_t agent = 0; agent < kAgents; ++agent) {
      const std::uint32_t character = sample_appearance(population, 5, agent).character;
      if (last.contains(character)) {
        EXPECT_GE(agent - last[character], static_cast<std::uint32_t>(count) / 2);
      }
      last[character] = agent;
    }
  }
}

TEST(Twins, EverybodyIsUsedEquallyOften) {
  const Population population = make_people(96);
  std::map<std::uint32_t, int> used;
  for (const Appearance& appearance : sample_appearances(population, 7))
    ++used[appearance.character];
  ASSERT_EQ(used.size(), 96U);
  for (const auto& [unused, times] : used) {
    EXPECT_GE(times, 20);
    EXPECT_LE(times, 21);
  }
}

// Crowds start in rectangular grids row by row, so that neighbors are one row apart in id.
TEST(Twins, NoneStandSideBySideInAGrid) {
  const Population population = make_people(96);
  int pairs = 0;
  int same_body = 0;
  int twins = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const std::vector<Appearance> crowd = sample_appearances(population, seed);
    for (std::uint32_t width = 10; width <= 200; ++width) {
      for (std::uint32_t agent = 0; agent < kAgents; ++agent) {
        for (const std::uint32_t step : {1U, width - 1, width, width + 1}) {
          if (agent + step >= kAgents) continue;
          const Appearance& a = crowd[agent];
          const Appearance& b = crowd[agent + step];
          ++pairs;
          same_body += a.character == b.character ? 1 : 0;
          twins += a.character == b.character && dressed_alike(a, b) ? 1 : 0;
        }
      }
    }
  }
  RecordProperty("same_body_per_million", static_cast<int>(1e6 * same_body / pairs));
  RecordProperty("twins_per_million", static_cast<int>(1e6 * twins / pairs));
  // By chance one neighbor of 96 would have the same body.
  EXPECT_LT(same_body, pairs / 96);
  EXPECT_LT(twins, pairs / 5000);
}

TEST(Twins, ABodyRarelyWearsTheSameColorsAgain) {
  const Population population = make_people(96);
  const std::vector<Appearance> crowd = sample_appearances(population, 11);
  std::map<std::uint32_t, std::vector<const Appearance*>> by_body;
  for (const Appearance& appearance : crowd) by_body[appearance.character].push_back(&appearance);
  int repeats = 0;
  int next_repeats = 0;
  for (const auto& [unused, wearers] : by_body) {
    for (std::size_t i = 1; i < wearers.size(); ++i) {
      next_repeats += dressed_alike(*wearers[i], *wearers[i - 1]) ? 1 : 0;
      for (std::size_t j = 0; j < i; ++j) {
        if (!dressed_alike(*wearers[i], *wearers[j])) continue;
        ++repeats;
        break;
      }
    }
  }
  RecordProperty("repeats", repeats);
  RecordProperty("next_repeats", next_repeats);
  EXPECT_LT(next_repeats, static_cast<int>(kAgents) / 40);
  EXPECT_LT(repeats, static_cast<int>(kAgents) / 3);
}

Population people_of_ages(int count) {
  Population population = make_people(count);
  for (std::size_t i = 0; i < population.characters.size(); ++i) {
    population.characters[i].age_years = static_cast<float>(5 + 3 * i);
  }
  return population;
}

TEST(Cast, OnlyPeopleOfTheAgesTakePart) {
  const Population population = people_of_ages(24);
  Styling styling;
  styling.youngest_years = 18;
  styling.oldest_years = 40;
  std::map<std::uint32_t, int> seen;
  for (std::uint32_t agent = 0; agent < kAgents; ++agent) {
    const std::uint32_t character = sample_appearance(population, 5, agent, styling).character;
    EXPECT_GE(population.characters[character].age_years, 18);
    EXPECT_LE(population.characters[character].age_years, 40);
    ++seen[character];
  }
  EXPECT_EQ(seen.size(), 7U) << "20, 23, ... 38 years";
}

TEST(Cast, AShareIsChosenByTheRun) {
  const Population population = people_of_ages(24);
  Styling styling;
  styling.variety = 0.25;
  const auto cast_of_run = [&](std::uint64_t seed) {
    std::map<std::uint32_t, int> seen;
    for (std::uint32_t agent = 0; agent < kAgents; ++agent) {
      ++seen[sample_appearance(population, seed, agent, styling).character];
    }
    return seen;
  };
  EXPECT_EQ(cast_of_run(1).size(), 6U);
  EXPECT_EQ(cast_of_run(1), cast_of_run(1));
  EXPECT_NE(cast_of_run(1), cast_of_run(2));
  styling.variety = 0.001;
  EXPECT_EQ(cast_of_run(1).size(), 1U) << "never nobody";
}

TEST(Cast, NobodyOfTheAgesIsAMistakeOfTheInput) {
  const Population population = people_of_ages(3);
  Styling styling;
  styling.oldest_years = 4;
  try {
    sample_appearance(population, 1, 0, styling);
    FAIL() << "nobody is so young";
  } catch (const InputError& error) {
    ASSERT_EQ(error.problems().size(), 1U);
    EXPECT_EQ(error.problems().front().where, "/appearance");
    EXPECT_NE(error.problems().front().expected.find("from 5 to 11"), std::string::npos);
  }
}

// Every sixth of them under an umbrella.
Population people_with_umbrellas(int count) {
  Population population = make_people(count);
  for (std::size_t i = 0; i < population.characters.size(); i += 6) {
    population.characters[i].carries = Carry::umbrella;
    population.characters[i].tints = population.characters[0].tints;
  }
  return population;
}

double share_under_umbrellas(const Population& population, double wanted) {
  Styling styling;
  styling.umbrellas = wanted;
  int under = 0;
  for (std::uint32_t agent = 0; agent < kAgents; ++agent) {
    const std::uint32_t character = sample_appearance(population, 9, agent, styling).character;
    under += population.characters[character].carries == Carry::umbrella ? 1 : 0;
  }
  return static_cast<double>(under) / kAgents;
}

TEST(Umbrellas, AreUpForTheShareThatIsAskedFor) {
  const Population population = people_with_umbrellas(24);
  for (const double share : {0.0, 0.1, 0.4, 0.8, 1.0}) {
    EXPECT_NEAR(share_under_umbrellas(population, share), share, 0.03);
  }
}

TEST(Umbrellas, StayShutWhereNobodyHasOneAndUpWhereAllHave) {
  EXPECT_EQ(share_under_umbrellas(make_people(24), 0.5), 0);
  Population population = make_people(4);
  for (Character& character : population.characters) character.carries = Carry::umbrella;
  EXPECT_EQ(share_under_umbrellas(population, 0), 1);
}

TEST(Leading, IsForThoseForWhomTheCrowdMakesRoom) {
  Population population = make_people(24);
  population.characters[3].carries = Carry::pram;
  population.characters[9].carries = Carry::bicycle;
  population.characters[11].carries = Carry::walking_stick;
  Styling styling;
  const auto carries = [&](std::uint32_t agent, Spot spot) {
    return population.characters[sample_appearance(population, 9, agent, styling, spot).character]
        .carries;
  };
  int leading = 0;
  int leaning = 0;
  for (std::uint32_t agent = 0; agent < kAgents; ++agent) {
    styling.leading = 0;
    ASSERT_FALSE(is_led(carries(agent, Spot::ground)));
    leaning += carries(agent, Spot::ground) == Carry::walking_stick ? 1 : 0;
    styling.leading = 0.2;
    ASSERT_EQ(is_led(carries(agent, Spot::ground)), is_leading(9, agent, 0.2));
    leading += is_leading(9, agent, 0.2) ? 1 : 0;
    ASSERT_EQ(carries(agent, Spot::stand), Carry::nothing);
  }
  EXPECT_NEAR(static_cast<double>(leading) / kAgents, 0.2, 0.04);
  EXPECT_GT(leaning, 0);
}

}  // namespace
}  // namespace throng::skinning
