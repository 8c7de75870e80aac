// Differences between a camera's frames.
#include "jobs/pipeline/frames/frame_draw.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace throng::jobs {
namespace {

constexpr int kFrames = 4000;

camera::CameraSpec shaken(double yaw_deg, double pitch_deg, double ev) {
  camera::CameraSpec camera;
  camera.per_frame = {yaw_deg, pitch_deg, ev};
  return camera;
}

TEST(FrameDraw, NothingIsDrawnUnlessAskedFor) {
  const camera::CameraSpec camera;
  const camera::FrameOffsets draw = draw_of_frame(camera, 7, 1, 12);
  EXPECT_EQ(draw.yaw_deg, 0);
  EXPECT_EQ(draw.pitch_deg, 0);
  EXPECT_EQ(draw.ev, 0);
  EXPECT_TRUE(to_json(camera, draw).empty());
}

TEST(FrameDraw, SpreadsAsMuchAsItShould) {
  const camera::CameraSpec camera = shaken(6, 3, 0.4);
  double yaw = 0;
  double pitch = 0;
  double ev = 0;
  double both = 0;
  for (int frame = 0; frame < kFrames; ++frame) {
    const camera::FrameOffsets draw = draw_of_frame(camera, 7, 0, frame);
    yaw += draw.yaw_deg * draw.yaw_deg;
    pitch += draw.pitch_deg * draw.pitch_deg;
    ev += draw.ev * draw.ev;
    both += draw.yaw_deg * draw.pitch_deg;
  }
  EXPECT_NEAR(std::sqrt(yaw / kFrames), 6, 0.3);
  EXPECT_NEAR(std::sqrt(pitch / kFrames), 3, 0.15);
  EXPECT_NEAR(std::sqrt(ev / kFrames), 0.4, 0.02);
  EXPECT_NEAR(both / kFrames, 0, 1) << "independent";
}

TEST(FrameDraw, DependsOnRunDroneAndFrameAlone) {
  const camera::CameraSpec camera = shaken(6, 3, 0.4);
  const camera::FrameOffsets draw = draw_of_frame(camera, 7, 1, 12);
  EXPECT_EQ(draw.yaw_deg, draw_of_frame(camera, 7, 1, 12).yaw_deg);
  EXPECT_NE(draw.yaw_deg, draw_of_frame(camera, 8, 1, 12).yaw_deg);
  EXPECT_NE(draw.yaw_deg, draw_of_frame(camera, 7, 0, 12).yaw_deg);
  EXPECT_NE(draw.yaw_deg, draw_of_frame(camera, 7, 1, 13).yaw_deg);
  EXPECT_EQ(draw.ev, draw_of_frame(shaken(0, 0, 0.4), 7, 1, 12).ev) << "fields are independent";
}

TEST(FrameDraw, IsAddedAndRecorded) {
  camera::CameraSpec camera = shaken(6, 40, 0.4);
  camera.pitch_deg = -80;
  for (int frame = 0; frame < 200; ++frame) {
    const camera::FrameOffsets draw = draw_of_frame(camera, 7, 0, frame);
    const camera::CameraSpec seen = camera_of_frame(camera, draw);
    EXPECT_GE(seen.pitch_deg, -90);
    EXPECT_LE(seen.pitch_deg, 90);
    const nlohmann::json drawn = to_json(camera, draw);
    EXPECT_EQ(drawn.size(), 3U);
    EXPECT_EQ(camera.yaw_deg + drawn.at("frame.yaw_deg").get<double>(), seen.yaw_deg);
    EXPECT_EQ(camera.pitch_deg + drawn.at("frame.pitch_deg").get<double>(), seen.pitch_deg);
    EXPECT_EQ(camera.sensor.ev + drawn.at("frame.ev").get<double>(), seen.sensor.ev);
  }
}

}  // namespace
}  // namespace throng::jobs
