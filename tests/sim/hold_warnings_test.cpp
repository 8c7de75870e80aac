#include "sim/recording/hold_warnings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace throng::sim {
namespace {

using ::testing::HasSubstr;

TEST(HoldWarnings, NameEachKindOnceForEachDrone) {
  HoldWarnings hold;
  hold.record({1, "agent_escaped", 4, -1, 0});
  hold.record({2, "near_miss", 4, 0, 0.5, "person"});
  hold.record({12.3, "blown_away", -1, 1, 7.25});
  hold.record({40, "blown_away", -1, 1, 9});
  hold.record({41, "blown_away", -1, 0, 6});
  hold.record({42, "collision", 3, 0, 4.5, "person", -1, 6});
  ASSERT_EQ(hold.warnings().size(), 3U);
  EXPECT_EQ(hold.warnings()[0].where, "/drones/1");
  EXPECT_THAT(hold.warnings()[0].text(), HasSubstr("blown 7.2 m off its place"));
  EXPECT_THAT(hold.warnings()[0].text(), HasSubstr("blown_away after 12.3 s"));
  EXPECT_EQ(hold.warnings()[1].where, "/drones/0");
  EXPECT_THAT(hold.warnings()[2].text(), HasSubstr("hit a person at 4.5 m/s"));
}

}  // namespace
}  // namespace throng::sim
