// Motion in images through distorting lenses.
#include <gtest/gtest.h>

#include "base/compute/random.h"
#include "render/lens/lens.h"
#include "tests/render/stage.h"

namespace throng::render {
namespace {

using camera::Camera;
using camera::Distortion;
using Eigen::Vector2d;

Camera seen_through(const Distortion& distortion, Camera camera) {
  camera.intrinsics.distortion = distortion;
  return camera;
}

class LensFlow : public testing::TestWithParam<Distortion> {
 protected:
  LensFlow()
      : stage_(open_ground({block(2, 4, -1, 1, 3)}), {},
               {.quality = Quality::draft, .normals = true, .flow = true}),
        lens_(stage_.renderer(), stage_.people()) {}

  Stage stage_;
  Lens lens_;
};

TEST_P(LensFlow, OfStillThingsIsWhereTheModelSeesThemNext) {
  NeighborFrame next;
  next.camera = seen_through(GetParam(), camera_at({-9, 1, 6.5}, 8, -28));
  const Frame frame =
      lens_.draw({}, seen_through(GetParam(), camera_at({-10, 0, 7}, 0, -25)), &next);
  int measured = 0;
  double error = 0;
  for (int y = 3; y < frame.height(); y += 9) {
    for (int x = 3; x < frame.width(); x += 9) {
      const std::size_t i = pixel_index(frame, x, y);
      if (std::isinf(frame.depth_m[i]) || std::isnan(frame.flow[2 * i])) continue;
      const Camera::Projection seen =
          next.camera.project(frame.camera.unproject(Vector2d(x, y), frame.depth_m[i]));
      if (!seen.visible) continue;
      const Vector2d off = seen.pixel - Vector2d(x + frame.flow[2 * i], y + frame.flow[2 * i + 1]);
      // Depth is that of the nearest pixel of the wide image, up to 0.7 pixels away.
      EXPECT_LT(off.norm(), 0.8) << x << ' ' << y;
      error += off.norm();
      ++measured;
    }
  }
  ASSERT_GT(measured, 400);
  EXPECT_LT(error / measured, 0.12);
}

TEST_P(LensFlow, CarriesEachPersonsMaskToTheNextFrame) {
  Scene now;
  NeighborFrame next;
  for (std::uint32_t i = 0; i < 12; ++i) {
    Random random(5, Stream::crowd_generator, i);
    const Vector2d at(2.5 * (i / 4) - 2, 2.2 * (i % 4) - 3.3);
    const double yaw_rad = random.uniform(-3, 3);
    const double phase = random.uniform();
    const Vector2d step(0.13 * std::cos(yaw_rad), 0.13 * std::sin(yaw_rad));
    now.people.push_back(stepping(stage_, i, at, yaw_rad, phase));
    next.scene.people.push_back(stepping(stage_, i, at + step, yaw_rad + 0.05, phase + 0.1));
  }
  const Camera camera = seen_through(GetParam(), camera_at({-9, 0, 5}, 0, -35, 960, 720));
  next.camera = seen_through(GetParam(), camera_at({-8.7, 0.2, 5.1}, 1.5, -34, 960, 720));
  const Frame here = lens_.draw(now, camera, &next);
  const Frame there = lens_.draw(next.scene, next.camera);
  int measured = 0;
  for (const PersonInstance& person : now.people) {
    const auto is_whole = [&](const Frame& frame) {
      return instance_mask(frame, id_of_agent(person.agent)).pixels ==
             find_person(frame, person.agent).amodal_area_px;
    };
    if (!is_whole(here) || !is_whole(there)) continue;
    // Single pixels of soles, which touch the ground, decide the last percent.
    EXPECT_GE(carried_overlap(here, there, person.agent), 0.88) << "agent " << person.agent;
    ++measured;
  }
  EXPECT_GE(measured, 5);
}

INSTANTIATE_TEST_SUITE_P(Lenses, LensFlow,
                         testing::Values(Distortion(Distortion::Model::brown_conrady,
                                                    {-0.28, 0.08, 0.001, -0.0005, -0.01}),
                                         Distortion(Distortion::Model::brown_conrady, {0.12, 0.02}),
                                         Distortion(Distortion::Model::fisheye,
                                                    {-0.04, 0.003, -0.002, 0.0004})));

}  // namespace
}  // namespace throng::render
