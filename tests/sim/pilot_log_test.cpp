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

TEST(PilotLog, DirectionsOfTheGimbalAreOptional) {
  const std::vector<PilotSample> written{{0, {1, 2, 3}, 0, true},
                                         {1, {1, 2, 3}, 0, true, {{-45.5, 20.25}}}};
  const std::string csv = pilot_log_csv(written);
  EXPECT_EQ(csv.substr(0, csv.find('\n')),
            "time_s,x_m,y_m,z_m,yaw_deg,beacon,gimbal_pitch_deg,gimbal_yaw_deg");
  const auto read = parse_pilot_log(csv, "log.csv");
  EXPECT_FALSE(read.at(0).gimbal);
  EXPECT_EQ(read.at(1).gimbal, written[1].gimbal);
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
  const std::string head =
      "time_s,x_m,y_m,z_m,yaw_deg,beacon,gimbal_pitch_deg,gimbal_yaw_deg\n0,0,0,9,0,1,";
  EXPECT_EQ(message_for(head + "-90,180\n1,0,0,9,0,1,,\n"), "accepted");
  EXPECT_THAT(message_for(head + "-91,0\n"), HasSubstr("found -91 degrees, expected -90 to 30"));
  EXPECT_THAT(message_for(head + "0,181\n"), HasSubstr("expected -180 to 180 degrees"));
  EXPECT_THAT(message_for(head + "-45,\n"), HasSubstr("a number"));
  EXPECT_THAT(message_for(head + "-45\n"), HasSubstr("found 7 values, expected 8 values"));
}

}  // namespace
}  // namespace throng::sim
