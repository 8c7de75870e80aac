#include "sim/vehicle/hold_warnings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace throng::sim {
namespace {

using ::testing::HasSubstr;

TEST(HoldWarnings, NameEachKindOnceForEachDrone) {
  HoldWarnings hold;
  hold.record({1, world::AgentEscaped{4, 0}});
  hold.record({2, world::NearMiss{0, world::Partner::person, 4, 0.5, {}}});
  hold.record({12.3, world::BlownAway{1, 7.25}});
  hold.record({40, world::BlownAway{1, 9}});
  hold.record({41, world::BlownAway{0, 6}});
  hold.record({42, world::Collision{0, world::Partner::person, 3, 4.5, 6}});
  ASSERT_EQ(hold.warnings().size(), 3U);
  EXPECT_EQ(hold.warnings()[0].where, "/drones/1");
  EXPECT_THAT(hold.warnings()[0].text(), HasSubstr("blown 7.2 m off its set-point"));
  EXPECT_THAT(hold.warnings()[0].text(), HasSubstr("blown_away after 12.3 s"));
  EXPECT_EQ(hold.warnings()[1].where, "/drones/0");
  EXPECT_THAT(hold.warnings()[2].text(), HasSubstr("hit a person at 4.5 m/s"));
}

}  // namespace
}  // namespace throng::sim
