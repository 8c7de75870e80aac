#include "sim/recording/pilot_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"

namespace throng::sim {
namespace {

using ::testing::HasSubstr;

const std::string kHead = "time_s,x_m,y_m,z_m,yaw_deg,beacon\n";

TEST(PilotLog, IsReadAsItWasWritten) {
  const std::vector<PilotSample> written{{0, {1, 2, 3}, 0.5, true},
                                         {0.1, {1.25, -2, 3}, -1, false}};
  const auto read = parse_pilot_log(pilot_log_csv(written), "log.csv");
  ASSERT_EQ(read.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_DOUBLE_EQ(read[i].time_s, written[i].time_s);
    EXPECT_LT((read[i].position - written[i].position).norm(), 1e-5);
    EXPECT_NEAR(read[i].yaw_rad, written[i].yaw_rad, 1e-7);
    EXPECT_EQ(read[i].beacon, written[i].beacon);
  }
}

std::string message_for(const std::string& csv) {
  try {
    parse_pilot_log(csv, "log.csv");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(PilotLog, MistakesAreNamedByLine) {
  EXPECT_THAT(message_for(""), HasSubstr("no set-point"));
  EXPECT_THAT(message_for(kHead), HasSubstr("no set-point"));
  EXPECT_THAT(message_for("t,x\n"), HasSubstr("line 1"));
  EXPECT_THAT(message_for(kHead + "0,0,0,9,0,1\n1,0,0,9,0,1\n0.5,0,0,9,0,1\n"),
              HasSubstr("log.csv: line 4: found 0.5 s after 1 s, expected a later time"));
  EXPECT_THAT(message_for(kHead + "0,0,0,9,0\n"), HasSubstr("6 values"));
  EXPECT_THAT(message_for(kHead + "0,0,0,9,0,1,2\n"), HasSubstr("6 values"));
  EXPECT_THAT(message_for(kHead + "0,0,up,9,0,1\n"), HasSubstr("found \"up\", expected a number"));
  EXPECT_THAT(message_for(kHead + "0,0,nan,9,0,1\n"), HasSubstr("a number"));
  EXPECT_THAT(message_for(kHead + "0,0,0,9,0,0.5\n"), HasSubstr("0 or 1"));
  EXPECT_EQ(message_for(kHead + "0,0,0,9,0,1\r\n\n"), "accepted");
}

}  // namespace
}  // namespace throng::sim
