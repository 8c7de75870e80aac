#include "skinning/person.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"

namespace throng::skinning {

const std::vector<Suit> kSuits = {
    {"male_casualsuit02", true, true, true, true, false},
    {"male_casualsuit03", true, true, true, true, false},
    {"male_casualsuit04", true, true, true, true, false},
    {"male_casualsuit05", true, true, true, true, false},
    {"male_casualsuit06", true, true, true, true, false},
    {"male_elegantsuit01", true, false, true, false, true},
    {"male_worksuit01", true, false, true, false, true},
    {"female_casualsuit01", false, true, false, true, false},
    {"female_casualsuit02", false, true, false, true, false},
    {"female_elegantsuit01", false, true, false, true, false},
    {"female_sportsuit01", false, false, false, true, false},
};

namespace {

constexpr std::size_t kAfrican = 0;
constexpr std::size_t kAsian = 1;
constexpr std::size_t kCaucasian = 2;

template <typename T>
T pick(Random& random, const std::vector<T>& choices) {
  return choices[random.below(static_cast<std::uint32_t>(choices.size()))];
}

// Mean stature of children by age, both sexes (WHO growth reference, median, rounded).
double child_height_m(double age_years) { return std::min(1.15 + 0.058 * (age_years - 6), 1.70); }

void sample_body(PersonSpec& person, int index, Random& random) {
  constexpr int kPeoplePerChild = 8;
  const bool child = index % kPeoplePerChild == 5;
  person.male = (index + index / kPeoplePerChild) % 2 == 0;
  person.age_years = child ? random.uniform(7, 14) : random.uniform(18, 75);
  if (child) {
    person.height_m = child_height_m(person.age_years) * random.normal(1, 0.03);
  } else {
    const double height = person.male ? random.normal(1.76, 0.07) : random.normal(1.63, 0.065);
    person.height_m = person.male ? std::clamp(height, 1.55, 1.97) : std::clamp(height, 1.45, 1.84);
  }
  BodyShape& shape = person.shape;
  shape.male = person.male ? random.uniform(0.85, 1) : random.uniform(0, 0.15);
  shape.age = slider_of_age(person.age_years);
  shape.weight = std::clamp(random.normal(child ? 0.5 : 0.58, 0.14), 0.25, 0.95);
  shape.muscle = std::clamp(random.normal(person.male ? 0.55 : 0.45, 0.12), 0.2, 0.85);
  shape.proportions = random.uniform(0.4, 0.75);
  shape.breast_size = std::clamp(random.normal(0.5, 0.13), 0.2, 0.85);
  shape.breast_firmness = std::clamp(0.75 - 0.005 * person.age_years, 0.3, 0.7);
}

// Who has which skin: the ancestry that dominates picks the texture, the rest mixes into the form.
std::size_t sample_ancestry(PersonSpec& person, Random& random) {
  const double draw = random.uniform();
  std::size_t main = kAfrican;
  if (draw < 0.5) {
    main = kCaucasian;
  } else if (draw < 0.76) {
    main = kAsian;
  }
  const double share = random.uniform(0.75, 1);
  person.shape.ancestry.fill((1 - share) / 2);
  person.shape.ancestry[main] = share;
  std::string_view stage = "middleage";
  if (person.age_years < 35) stage = "young";
  if (person.age_years > 58) stage = "old";
  constexpr std::array<std::string_view, 3> kNames = {"african", "asian", "caucasian"};
  person.skin = fmt::format("{}_{}_{}", stage, kNames[main], person.male ? "male" : "female");
  return main;
}

void sample_hair(PersonSpec& person, std::size_t ancestry, Random& random) {
  const bool curly = ancestry == kAfrican;
  if (person.male) {
    person.hair = curly ? pick<std::string>(random, {"afro01", "short04", "short02", ""})
                        : pick<std::string>(random, {"short02", "short03", "short04", "short01"});
    if (person.age_years > 50 && random.uniform() < 0.25) person.hair.clear();
  } else {
    person.hair = curly ? pick<std::string>(random, {"afro01", "ponytail01", "bob02"})
                        : pick<std::string>(random, {"bob02", "ponytail01", "long01", "long01"});
  }
  person.eyebrows = fmt::format("eyebrow{:03}", 1 + random.below(12));
  constexpr Rgb kGrey = {190, 188, 184};
  constexpr Rgb kWhite = {226, 224, 220};
  const std::vector<Rgb> dark = {{34, 28, 25}, {42, 33, 28}, {54, 42, 34}};
  const std::vector<Rgb> light = {{52, 39, 31},   {84, 60, 42},    {112, 82, 56}, {64, 46, 36},
                                  {150, 116, 76}, {192, 160, 110}, {122, 66, 40}, {96, 72, 52}};
  auto& colours = person.tints[static_cast<std::size_t>(Tint::hair)];
  if (person.age_years > 62) {
    colours = {kGrey, kWhite, {150, 148, 146}};
  } else if (person.age_years > 50) {
    colours = {kGrey, {120, 114, 108}, {72, 64, 58}};
  } else {
    colours = ancestry == kCaucasian ? light : dark;
  }
  const bool brown_eyes = ancestry != kCaucasian || random.uniform() < 0.4;
  person.eyes = brown_eyes ? "brown_eye"
                           : pick<std::string>(
                                 random, {"blue_eye", "green_eye", "grey_eye", "brownlight_eye"});
}

void sample_clothes(PersonSpec& person, Random& random) {
  const bool child = person.age_years < 16;
  std::vector<const Suit*> tops;
  for (const Suit& suit : kSuits) {
    const bool formal = suit.name == "male_elegantsuit01" || suit.name == "female_elegantsuit01";
    const bool fits = person.male ? suit.top_for_men : suit.top_for_women;
    const bool odd_at_this_age = (child && (formal || suit.overall)) ||
                                 (person.age_years > 40 && suit.name == "female_casualsuit02");
    if (fits && !odd_at_this_age) tops.push_back(&suit);
  }
  const Suit* top = pick(random, tops);
  // Few people wear suits or overalls, and most women wear what is cut for them: those who drew
  // otherwise may draw once more.
  if ((top->overall || (!person.male && top->top_for_men)) && random.uniform() < 0.6) {
    top = pick(random, tops);
  }
  person.top = top->name;
  const bool together = top->overall || (!top->top_for_men && random.uniform() < 0.4);
  if (together) {
    person.bottom = top->name;
  } else {
    // A short upper part needs trousers that reach up to it: those of the men's suits all do.
    const bool short_top = top->top_for_men;
    std::vector<const Suit*> bottoms;
    for (const Suit& suit : kSuits) {
      const bool fits = person.male ? suit.bottom_for_men : suit.bottom_for_women;
      const bool reaches = !short_top || suit.bottom_for_men;
      const bool odd_at_this_age = (child && suit.name == "female_elegantsuit01") ||
                                   (person.age_years > 40 && suit.name == "female_casualsuit02");
      if (fits && reaches && !odd_at_this_age && !suit.overall) bottoms.push_back(&suit);
    }
    person.bottom = pick(random, bottoms)->name;
  }
  const bool formal =
      person.top.find("elegant") != std::string::npos || person.bottom == "female_elegantsuit01";
  person.shoes = formal ? pick<std::string>(random, {"shoes03", "shoes04", "shoes01"})
                        : pick<std::string>(random, {"shoes01", "shoes02", "shoes03", "shoes04",
                                                     "shoes05", "shoes06"});
  person.tints[static_cast<std::size_t>(Tint::top)] = {
      {240, 240, 236}, {225, 222, 214}, {60, 66, 78},   {38, 40, 46},    {44, 58, 96},
      {92, 120, 168},  {160, 182, 210}, {138, 44, 46},  {184, 84, 72},   {70, 92, 68},
      {118, 130, 96},  {196, 172, 134}, {128, 106, 84}, {150, 152, 156}, {94, 74, 104},
      {214, 184, 92},  {212, 150, 152}, {74, 134, 136}, {104, 104, 108}, {226, 204, 182}};
  const bool skirt = person.bottom == "female_elegantsuit01";
  person.tints[static_cast<std::size_t>(Tint::bottom)] =
      skirt ? std::vector<Rgb>{{52, 54, 60},
                               {96, 98, 104},
                               {110, 60, 62},
                               {64, 76, 104},
                               {150, 132, 108}}
            : std::vector<Rgb>{{72, 92, 132},   {52, 66, 98},    {104, 126, 164}, {44, 48, 58},
                               {58, 58, 62},    {176, 158, 126}, {128, 118, 102}, {96, 100, 84},
                               {134, 136, 140}, {84, 70, 58},    {36, 38, 44},    {62, 80, 116}};
  person.tints[static_cast<std::size_t>(Tint::shoes)] = {
      {44, 42, 42}, {58, 46, 40}, {118, 78, 52}, {150, 104, 66}, {36, 36, 38}, {92, 88, 86}};
}

}  // namespace

PersonSpec sample_person(std::uint64_t seed, int index) {
  Random random(seed, Stream::population, static_cast<std::uint64_t>(index));
  PersonSpec person;
  person.name = fmt::format("person_{:03}", index);
  sample_body(person, index, random);
  const std::size_t ancestry = sample_ancestry(person, random);
  sample_hair(person, ancestry, random);
  sample_clothes(person, random);
  return person;
}

}  // namespace throng::skinning
