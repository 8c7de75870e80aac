#include "skinning/wardrobe/person.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>

#include "skinning/wardrobe/cloth.h"
#include "skinning/wardrobe/garments.h"

namespace throng::skinning {
namespace {

constexpr int kMany = 2000;

std::vector<PersonSpec> sample_many(std::uint64_t seed, bool with_attribution = false) {
  std::vector<PersonSpec> people;
  for (int i = 0; i < kMany; ++i) people.push_back(sample_person(seed, i, with_attribution));
  return people;
}

std::vector<double> list_heights(const std::vector<PersonSpec>& people,
                                 const std::function<bool(const PersonSpec&)>& wanted) {
  std::vector<double> heights;
  for (const PersonSpec& person : people) {
    if (wanted(person)) heights.push_back(person.height_m);
  }
  return heights;
}

double compute_mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double standard_deviation(const std::vector<double>& values) {
  const double mean = compute_mean(values);
  double sum = 0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

// Largest distance between the sample's distribution and a normal one (Kolmogorov, Smirnov).
double distance_from_normal(std::vector<double> values, double mean, double deviation) {
  std::sort(values.begin(), values.end());
  double distance = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double expected = 0.5 * std::erfc(-(values[i] - mean) / deviation / std::numbers::sqrt2);
    const auto count = static_cast<double>(values.size());
    distance = std::max({distance, std::abs(expected - static_cast<double>(i) / count),
                         std::abs(expected - static_cast<double>(i + 1) / count)});
  }
  return distance;
}

TEST(Person, DependsOnSeedAndIndexOnly) {
  const PersonSpec a = sample_person(3, 17);
  const PersonSpec b = sample_person(3, 17);
  EXPECT_EQ(a.height_m, b.height_m);
  EXPECT_EQ(a.outfit.top, b.outfit.top);
  EXPECT_EQ(a.outfit.tints, b.outfit.tints);
  EXPECT_EQ(a.skin, b.skin);
  EXPECT_NE(a.height_m, sample_person(4, 17).height_m);
}

TEST(Person, AdultHeightsFollowThePublishedDistributions) {
  const std::vector<PersonSpec> people = sample_many(1);
  for (const bool male : {true, false}) {
    const double mean = male ? 1.76 : 1.63;
    const double deviation = male ? 0.07 : 0.065;
    const std::vector<double> heights = list_heights(people, [&](const PersonSpec& person) {
      return person.male == male && person.age_years >= 18 && person.age_years < 40;
    });
    ASSERT_GT(heights.size(), 300U);
    EXPECT_NEAR(compute_mean(heights), mean, 0.01);
    EXPECT_NEAR(standard_deviation(heights), deviation, 0.006);
    // 1.63 / sqrt(n) is exceeded by one sample of a hundred.
    EXPECT_LT(distance_from_normal(heights, mean, deviation),
              1.63 / std::sqrt(static_cast<double>(heights.size())));
  }
}

TEST(Person, OldPeopleAreALittleShorter) {
  const std::vector<PersonSpec> people = sample_many(2);
  for (const bool male : {true, false}) {
    const double old = compute_mean(list_heights(people, [&](const PersonSpec& person) {
      return person.male == male && person.age_years >= 65;
    }));
    const double lost = (male ? 1.76 : 1.63) - old;
    EXPECT_GT(lost, 0.02);
    EXPECT_LT(lost, 0.09);
  }
}

TEST(Person, ChildrenGrow) {
  const std::vector<PersonSpec> people = sample_many(3);
  double before = 1.0;
  for (int age = 6; age < 18; age += 3) {
    const std::vector<double> heights = list_heights(people, [&](const PersonSpec& person) {
      return person.age_years >= age && person.age_years < age + 3;
    });
    ASSERT_GT(heights.size(), 20U) << age;
    const double mean = compute_mean(heights);
    EXPECT_GT(mean, before) << age;
    EXPECT_NEAR(mean, 0.5 * (child_height_m(true, age + 1.5) + child_height_m(false, age + 1.5)),
                0.03)
        << age;
    before = mean;
  }
}

TEST(Person, AgesFollowTheStatedShares) {
  const std::vector<PersonSpec> people = sample_many(4);
  const auto share = [&](double from, double to) {
    return static_cast<double>(std::count_if(people.begin(), people.end(),
                                             [&](const PersonSpec& person) {
                                               return person.age_years >= from &&
                                                      person.age_years < to;
                                             })) /
           kMany;
  };
  EXPECT_NEAR(share(6, 18), 0.12, 0.01);
  EXPECT_NEAR(share(18, 40), 0.42, 0.01);
  EXPECT_NEAR(share(40, 65), 0.32, 0.01);
  EXPECT_NEAR(share(65, 85.001), 0.14, 0.01);
  EXPECT_NEAR(share(6, 85.001), 1, 1e-9);
}

TEST(Person, ASmallPopulationHasEverybody) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    int men = 0;
    int children = 0;
    int old = 0;
    for (int i = 0; i < 24; ++i) {
      const PersonSpec person = sample_person(seed, i);
      men += person.male ? 1 : 0;
      children += person.age_years < 18 ? 1 : 0;
      old += person.age_years >= 65 ? 1 : 0;
    }
    EXPECT_GE(men, 10) << seed;
    EXPECT_LE(men, 14) << seed;
    EXPECT_GE(children, 2) << seed;
    EXPECT_GE(old, 2) << seed;
  }
}

TEST(Person, SomeAreHeavyAndSomeAreThin) {
  int heavy = 0;
  int thin = 0;
  for (const PersonSpec& person : sample_many(5)) {
    heavy += person.shape.weight > 0.8 ? 1 : 0;
    thin += person.shape.weight < 0.4 ? 1 : 0;
  }
  EXPECT_GT(heavy, kMany / 20);
  EXPECT_LT(heavy, kMany / 5);
  EXPECT_GT(thin, kMany / 20);
  EXPECT_LT(thin, kMany / 5);
}

TEST(Outfit, FitsTogether) {
  for (const bool with_attribution : {false, true}) {
    for (const PersonSpec& person : sample_many(6, with_attribution)) {
      const Outfit& outfit = person.outfit;
      EXPECT_FALSE(describe_outfit(outfit).empty());
      EXPECT_FALSE(outfit.shoes.empty());
      if (outfit.bottom.empty()) {
        EXPECT_EQ(garment(outfit.top, Slot::dress).slot, Slot::dress) << person.name;
        EXPECT_FALSE(person.male);
        continue;
      }
      if (outfit.one_piece) continue;
      const GarmentInfo& top = garment(outfit.top, Slot::top);
      const GarmentInfo& bottom = garment(outfit.bottom, Slot::bottom);
      if (top.high) {
        EXPECT_TRUE(bottom.high) << person.name << ": " << top.name << ", " << bottom.name;
      }
      for (const GarmentInfo* worn : {&top, &bottom}) {
        EXPECT_TRUE(person.male ? worn->wearers.men : worn->wearers.women) << worn->name;
        if (person.age_years < 16) {
          EXPECT_TRUE(worn->wearers.children) << worn->name;
        }
      }
    }
  }
}

TEST(Outfit, IsFreeOfAttributionUnlessAsked) {
  bool any = false;
  for (const bool with_attribution : {false, true}) {
    for (const PersonSpec& person : sample_many(7, with_attribution)) {
      const Outfit& outfit = person.outfit;
      for (const std::string& name :
           {outfit.top, outfit.bottom, outfit.shoes, outfit.hair, outfit.hat, person.eyebrows}) {
        if (name.empty()) continue;
        const bool free = find_license(name) == License::cc0;
        if (!with_attribution) {
          EXPECT_TRUE(free) << name;
        }
        any = any || !free;
      }
    }
  }
  EXPECT_TRUE(any);
}

TEST(Outfit, MixesWidely) {
  std::set<std::tuple<std::string, std::string, Hem, Cloth>> outfits;
  std::set<Carry> carried;
  int hats = 0;
  for (int i = 0; i < 200; ++i) {
    const Outfit outfit = sample_person(5, i).outfit;
    outfits.emplace(outfit.top, outfit.bottom, outfit.hem, outfit.top_cloth);
    carried.insert(outfit.carries);
    hats += outfit.hat.empty() ? 0 : 1;
  }
  EXPECT_GE(outfits.size(), 80U);
  EXPECT_EQ(carried.size(), kCarryCount);
  EXPECT_GE(hats, 5);
  EXPECT_LE(hats, 60);
}

// Jackets, coats, sportswear and the rest: each on some of 400 people.
TEST(Outfit, HasManyKindsOfClothes) {
  std::set<Cloth> tops;
  std::set<std::string> hats;
  int coats = 0;
  int scarves = 0;
  int beards = 0;
  for (int i = 0; i < 400; ++i) {
    const PersonSpec person = sample_person(11, i);
    const Outfit& outfit = person.outfit;
    tops.insert(outfit.top_cloth);
    hats.insert(outfit.hat);
    coats += outfit.coat > 0 ? 1 : 0;
    scarves += outfit.scarf ? 1 : 0;
    beards += outfit.beard.empty() ? 0 : 1;
    EXPECT_TRUE(outfit.beard.empty() || person.male) << person.name;
    const std::string wears = describe_outfit(outfit);
    EXPECT_EQ(wears.starts_with("coat"), outfit.coat > 0) << wears;
    EXPECT_FALSE(outfit.coat > 0 && outfit.bottom == kSkirt) << wears;
  }
  EXPECT_GE(tops.size(), 15U);
  EXPECT_GE(hats.size(), 5U);
  EXPECT_GT(coats, 20);
  EXPECT_GT(scarves, 10);
  EXPECT_GT(beards, 30);
}

// Cloth of one color that is as dark as dyes and folds get still reflects light.
TEST(Outfit, BlackHasDetail) {
  constexpr double kDarkestVariation = 0.86 * 0.95;
  constexpr double kMinY = 6 / 903.3;  // CIE L = 6
  const auto linear = [](double srgb) { return std::pow((srgb + 0.055) / 1.055, 2.4); };
  for (const PersonSpec& person : sample_many(12)) {
    for (const Rgb& color : person.outfit.tints[static_cast<std::size_t>(Tint::top)]) {
      const auto channel = [&](std::size_t i) {
        return linear(color[i] / 255.0 * kDarkestVariation) * linear(kMinFold * kMedianShade / 255);
      };
      const double y = 0.2126 * channel(0) + 0.7152 * channel(1) + 0.0722 * channel(2);
      EXPECT_GT(y, kMinY) << int{color[0]} << " " << int{color[1]} << " " << int{color[2]};
    }
  }
}

TEST(Outfit, HasColorsForColoredGarments) {
  for (const PersonSpec& person : sample_many(8)) {
    const auto& tints = person.outfit.tints;
    for (const Tint tint : {Tint::top, Tint::bottom, Tint::hair, Tint::shoes}) {
      EXPECT_GE(tints[static_cast<std::size_t>(tint)].size(), 5U);
    }
    EXPECT_EQ(tints[static_cast<std::size_t>(Tint::item)].empty(),
              person.outfit.carries == Carry::nothing);
    EXPECT_TRUE(tints[static_cast<std::size_t>(Tint::none)].empty());
  }
}

// Clothes come in subdued colors: hardly anybody is dressed in saturated cyan or pink.
TEST(Outfit, ColorsAreThoseOfClothes) {
  int vivid = 0;
  int all = 0;
  for (const PersonSpec& person : sample_many(9)) {
    for (const Tint tint : {Tint::top, Tint::bottom}) {
      for (const Rgb& color : person.outfit.tints[static_cast<std::size_t>(tint)]) {
        const auto [low, high] = std::minmax_element(color.begin(), color.end());
        vivid += *high > 150 && *high - *low > 110 ? 1 : 0;
        ++all;
      }
    }
  }
  EXPECT_LT(vivid, all / 25);
}

}  // namespace
}  // namespace throng::skinning
