#include "skinning/wardrobe/person.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/compute/random.h"

namespace throng::skinning {

namespace {

constexpr double kAdultFrom = 18;  // years
constexpr double kMaxAge = 85;     // years

enum class Ancestry : std::uint8_t { african, asian, caucasian };

struct AgeRange {
  double share;
  double from_years;
  double to_years;
};
constexpr std::array kAges = {AgeRange{0.12, 6, kAdultFrom}, AgeRange{0.42, kAdultFrom, 40},
                              AgeRange{0.32, 40, 65}, AgeRange{0.14, 65, kMaxAge}};

// Shares in [0, 1) for age, sex and ancestry that spread evenly over the people (a Kronecker
// sequence), from a start that depends on the seed.
std::array<double, 3> spread_point(std::uint64_t seed, int index) {
  constexpr std::array<double, 3> kSteps = {std::numbers::sqrt2 - 1, 0.5, std::numbers::phi - 1};
  constexpr std::uint64_t kStart = std::uint64_t{1} << 40;  // apart from the people's own indices
  Random random(seed, Stream::population, kStart);
  std::array<double, 3> point{};
  for (std::size_t i = 0; i < point.size(); ++i) {
    const double at = random.uniform() + kSteps[i] * index;
    point[i] = at - std::floor(at);
  }
  return point;
}

double age_at(double share) {
  for (const AgeRange& range : kAges) {
    if (share < range.share) {
      return range.from_years + (range.to_years - range.from_years) * share / range.share;
    }
    share -= range.share;
  }
  return kMaxAge;
}

double sample_height(bool male, double age_years, Random& random) {
  constexpr double kMaxDeviation = 2.8;  // standard deviations
  const double deviation = std::clamp(random.normal(0, 1), -kMaxDeviation, kMaxDeviation);
  if (age_years < kAdultFrom) {
    constexpr double kChildSpread = 0.045;  // of the median
    return child_height_m(male, age_years) * (1 + kChildSpread * deviation);
  }
  const AdultHeights adults = adult_heights(male);
  return adults.mean_m + adults.sd_m * deviation - height_lost_m(male, age_years);
}

void sample_shape(PersonSpec& person, Random& random) {
  const bool child = person.age_years < kAdultFrom;
  BodyShape& shape = person.shape;
  shape.male = person.male ? random.uniform(0.85, 1) : random.uniform(0, 0.15);
  shape.age = slider_of_age(person.age_years);
  shape.weight = std::clamp(random.normal(child ? 0.5 : 0.56, 0.14), 0.22, 0.85);
  if (!child && random.uniform() < 0.1) shape.weight = random.uniform(0.8, 1.0);
  const double strength = child ? 0.42 : person.male ? 0.56 : 0.46;
  const double age_loss = 0.003 * std::max(0.0, person.age_years - 45);
  shape.muscle = std::clamp(random.normal(strength - age_loss, 0.12), 0.15, 0.9);
  shape.proportions = random.uniform(0.35, 0.75);
  shape.breast_size = std::clamp(random.normal(child ? 0.4 : 0.5, 0.13), 0.2, 0.85);
  shape.breast_firmness = std::clamp(0.75 - 0.005 * person.age_years, 0.3, 0.7);
}

// Choice of the skin: the dominant ancestry selects the texture, the others blend into the shape.
Ancestry sample_ancestry(PersonSpec& person, double share_of_all, Random& random) {
  Ancestry main = Ancestry::african;
  if (share_of_all < 0.48) {
    main = Ancestry::caucasian;
  } else if (share_of_all < 0.74) {
    main = Ancestry::asian;
  }
  const double share = random.uniform(0.75, 1);
  person.shape.ancestry.fill((1 - share) / 2);
  person.shape.ancestry[static_cast<std::size_t>(main)] = share;
  std::string_view stage = "middleage";
  if (person.age_years < 35) stage = "young";
  if (person.age_years > 58) stage = "old";
  constexpr std::array<std::string_view, 3> kNames = {"african", "asian", "caucasian"};
  person.skin = fmt::format("{}_{}_{}", stage, kNames[static_cast<std::size_t>(main)],
                            person.male ? "male" : "female");
  return main;
}

void sample_face(PersonSpec& person, Ancestry ancestry, Random& random) {
  constexpr int kEyebrows = 12;
  person.eyebrows = fmt::format("eyebrow{:03}", 1 + random.below(kEyebrows));
  constexpr std::array kEyes = {"blue_eye", "green_eye", "grey_eye", "brownlight_eye"};
  const bool brown = ancestry != Ancestry::caucasian || random.uniform() < 0.4;
  person.eyes = brown ? "brown_eye" : kEyes[random.below(kEyes.size())];
}

}  // namespace

AdultHeights adult_heights(bool male) {
  return male ? AdultHeights{1.76, 0.07} : AdultHeights{1.63, 0.065};
}

double child_height_m(bool male, double age_years) {
  constexpr std::array<double, 13> kBoysCm = {116.0, 121.7, 127.3, 132.6, 137.8, 143.1, 149.1,
                                              156.0, 163.2, 169.0, 172.9, 175.2, 176.1};
  constexpr std::array<double, 13> kGirlsCm = {115.1, 120.8, 126.6, 132.5, 138.6, 145.0, 151.2,
                                               156.4, 159.8, 161.7, 162.5, 162.9, 163.1};
  const std::array<double, 13>& median_cm = male ? kBoysCm : kGirlsCm;
  const double at = std::clamp(age_years - 6, 0.0, static_cast<double>(median_cm.size() - 1));
  const auto before = std::min(static_cast<std::size_t>(at), median_cm.size() - 2);
  const double share = at - static_cast<double>(before);
  return 0.01 * ((1 - share) * median_cm[before] + share * median_cm[before + 1]);
}

double height_lost_m(bool male, double age_years) {
  const double years = std::max(0.0, age_years - 40);
  return (male ? 0.03 : 0.05) * years * years / (30 * 30);
}

PersonSpec sample_person(std::uint64_t seed, int index, bool with_attribution) {
  Random random(seed, Stream::population, static_cast<std::uint64_t>(index));
  const auto [age_share, sex_share, ancestry_share] = spread_point(seed, index);
  PersonSpec person;
  person.name = fmt::format("person_{:03}", index);
  person.male = sex_share < 0.5;
  person.age_years = age_at(age_share);
  person.height_m = sample_height(person.male, person.age_years, random);
  sample_shape(person, random);
  const Ancestry ancestry = sample_ancestry(person, ancestry_share, random);
  sample_face(person, ancestry, random);
  person.outfit = sample_outfit({person.male, person.age_years, ancestry == Ancestry::african,
                                 ancestry != Ancestry::caucasian},
                                with_attribution, random);
  return person;
}

}  // namespace throng::skinning
