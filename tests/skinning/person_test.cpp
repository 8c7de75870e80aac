#include "skinning/person.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace throng::skinning {
namespace {

TEST(Person, DependsOnSeedAndIndexOnly) {
  const PersonSpec a = sample_person(3, 17);
  const PersonSpec b = sample_person(3, 17);
  EXPECT_EQ(a.height_m, b.height_m);
  EXPECT_EQ(a.top, b.top);
  EXPECT_EQ(a.skin, b.skin);
  EXPECT_NE(a.height_m, sample_person(4, 17).height_m);
}

TEST(Person, AdultHeightsFollowThePublishedDistributions) {
  double sum[2] = {0, 0};
  double squares[2] = {0, 0};
  int count[2] = {0, 0};
  for (int i = 0; i < 4000; ++i) {
    const PersonSpec person = sample_person(1, i);
    if (person.age_years < 18) continue;
    const int sex = person.male ? 1 : 0;
    sum[sex] += person.height_m;
    squares[sex] += person.height_m * person.height_m;
    ++count[sex];
  }
  const double mean[2] = {sum[0] / count[0], sum[1] / count[1]};
  EXPECT_NEAR(mean[1], 1.76, 0.01);
  EXPECT_NEAR(mean[0], 1.63, 0.01);
  EXPECT_NEAR(std::sqrt(squares[1] / count[1] - mean[1] * mean[1]), 0.07, 0.007);
  EXPECT_NEAR(std::sqrt(squares[0] / count[0] - mean[0] * mean[0]), 0.065, 0.007);
}

TEST(Person, TheDefaultPopulationHasBothSexesAndAChild) {
  int men = 0;
  int children = 0;
  for (int i = 0; i < 12; ++i) {
    const PersonSpec person = sample_person(1, i);
    men += person.male ? 1 : 0;
    children += person.age_years < 16 ? 1 : 0;
    EXPECT_GE(person.age_years, 6);
    EXPECT_LE(person.age_years, 85);
  }
  EXPECT_GE(men, 4);
  EXPECT_LE(men, 8);
  EXPECT_GE(children, 1);
}

TEST(Person, OverallsAreWornWhole) {
  for (int i = 0; i < 500; ++i) {
    const PersonSpec person = sample_person(2, i);
    for (const Suit& suit : kSuits) {
      if (suit.overall) {
        EXPECT_EQ(person.top == suit.name, person.bottom == suit.name) << i;
      }
    }
  }
}

TEST(Person, ClothesMixWidely) {
  std::set<std::pair<std::string, std::string>> outfits;
  for (int i = 0; i < 200; ++i) {
    const PersonSpec person = sample_person(5, i);
    outfits.emplace(person.top, person.bottom);
  }
  EXPECT_GE(outfits.size(), 30U);
}

}  // namespace
}  // namespace throng::skinning
