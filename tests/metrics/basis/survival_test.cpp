#include "metrics/basis/survival.h"

#include <gtest/gtest.h>

namespace throng::metrics {
namespace {

TEST(TimeByWhich, IsTheOrderedTimeWhenEverybodyWasWatchedToTheEnd) {
  std::vector<Watched> people;
  std::vector<double> times_s;
  for (int i = 1; i <= 20; ++i) {
    people.push_back({static_cast<double>(21 - i), true});
    times_s.push_back(i);
  }
  for (const int percent : {1, 25, 50, 75, 80, 90, 95, 99, 100}) {
    const double expected = (percent * 20 + 99) / 100;
    EXPECT_EQ(time_by_which(people, percent), expected) << percent;
    EXPECT_EQ(time_by_which(times_s, 20, percent), expected) << percent;
  }
}

TEST(TimeByWhich, IsUnknownWhereTooFewWereWatchedForLongEnough) {
  const std::vector<double> times_s = {1, 2, 3};
  EXPECT_EQ(time_by_which(times_s, 4, 75), 3);
  EXPECT_FALSE(time_by_which(times_s, 4, 76));
  EXPECT_FALSE(time_by_which(std::vector<double>{}, 0, 50));
  EXPECT_FALSE(time_by_which(std::vector<Watched>{}, 50));
}

// The worked example of the remission times under 6-MP (Freireich et al. 1963): the estimate is
// 0.857 after 6 weeks, 0.807 after 7, 0.753 after 10, 0.690 after 13, 0.627 after 16, 0.538 after
// 22 and 0.448 after 23.
TEST(TimeByWhich, AgreesWithAPublishedProductLimitEstimate) {
  std::vector<Watched> people;
  for (const double weeks : {6, 6, 6, 7, 10, 13, 16, 22, 23}) people.push_back({weeks, true});
  for (const double weeks : {6, 9, 10, 11, 17, 19, 20, 25, 32, 32, 34, 35}) {
    people.push_back({weeks, false});
  }
  EXPECT_EQ(time_by_which(people, 14), 6);
  EXPECT_EQ(time_by_which(people, 15), 7);
  EXPECT_EQ(time_by_which(people, 19), 7);
  EXPECT_EQ(time_by_which(people, 20), 10);
  EXPECT_EQ(time_by_which(people, 25), 13);
  EXPECT_EQ(time_by_which(people, 37), 16);
  EXPECT_EQ(time_by_which(people, 46), 22);
  EXPECT_EQ(time_by_which(people, 50), 23);
  EXPECT_FALSE(time_by_which(people, 56));
}

// Half of them are not watched any more when the others are through: as if they had gone on as
// those.
TEST(TimeByWhich, PeopleWatchedBrieflyCountAsTheOthers) {
  std::vector<Watched> people;
  for (int i = 1; i <= 10; ++i) {
    people.push_back({10.0 + i, true});
    people.push_back({5, false});
  }
  EXPECT_EQ(time_by_which(people, 50), 15);
  EXPECT_EQ(time_by_which(people, 100), 20);
}

TEST(RestrictedMean, IsTheMeanOfTheCutTimesWhereAllWereWatched) {
  const std::vector<Watched> people = {{3, true}, {8, true}, {12, true}, {20, false}, {20, false}};
  EXPECT_DOUBLE_EQ(*restricted_mean_s(people, 10), (3 + 8 + 10 + 10 + 10) / 5.0);
  EXPECT_DOUBLE_EQ(*restricted_mean_s(people, 20), (3 + 8 + 12 + 20 + 20) / 5.0);
  EXPECT_DOUBLE_EQ(*restricted_mean_s(people, 2), 2);
  EXPECT_FALSE(restricted_mean_s(people, 21)) << "nobody knows";
  EXPECT_FALSE(restricted_mean_s({}, 5));
  EXPECT_DOUBLE_EQ(*restricted_mean_s({{3, true}, {5, true}}, 100), 4) << "all are out";
}

// Closed form: survival 1 until 6 weeks and the steps of the published estimate from there on.
TEST(RestrictedMean, IsTheAreaBelowAPublishedEstimate) {
  std::vector<Watched> people;
  for (const double weeks : {6, 6, 6, 7, 10, 13, 16, 22, 23}) people.push_back({weeks, true});
  for (const double weeks : {6, 9, 10, 11, 17, 19, 20, 25, 32, 32, 34, 35}) {
    people.push_back({weeks, false});
  }
  const double expected = 6 + 0.857143 * 1 + 0.806723 * 3 + 0.752941 * 3 + 0.690196 * 3 +
                          0.627451 * 6 + 0.537815 * 1 + 0.448179 * 12;
  EXPECT_NEAR(*restricted_mean_s(people, 35), expected, 1e-4);
}

}  // namespace
}  // namespace throng::metrics
