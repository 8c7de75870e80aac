// Motion blur and rolling shutter, against positions at the time at which rows are exposed.
#include "render/lens/exposure.h"

#include <gtest/gtest.h>

#include "tests/render/stage.h"

namespace throng::render {
namespace {

/// Somebody who walks across the image at 2 m/s, from 6 m above, and a camera that may fly.
class Street {
 public:
  Street() : stage_(open_ground()), lens_(stage_.renderer(), stage_.people()) {}

  MomentAt walking(double speed_mps, double flight_mps = 0) const {
    return [this, speed_mps, flight_mps](double time_s) {
      const auto scene = std::make_shared<Scene>();
      scene->index = 4;
      scene->time_s = time_s;
      scene->people = {stage_.standing(3, 0, speed_mps * time_s)};
      ShutterMoment moment;
      moment.scene = scene;
      moment.camera = camera_at({-4, flight_mps * time_s, 3}, 0, -35, 320, 240, 60);
      return moment;
    };
  }

  Exposed expose(const MomentAt& moment_at, const camera::Exposure& exposure, double time_s = 0) {
    return render::expose(lens_, moment_at, time_s, exposure);
  }
  Frame still(const MomentAt& moment_at, double time_s) {
    const ShutterMoment moment = moment_at(time_s);
    return lens_.draw(*moment.scene, moment.camera);
  }

 private:
  Stage stage_;
  Lens lens_;
};

TEST(Exposure, NothingThatMovesCostsOneDraw) {
  Street street;
  const Exposed exposed = street.expose(street.walking(0), {0.02, 0.03});
  EXPECT_EQ(exposed.samples, 1);
  EXPECT_EQ(exposed.strips, 1);
  const Frame still = street.still(street.walking(0), 0);
  EXPECT_EQ(exposed.frame.rgb, still.rgb);
  EXPECT_EQ(exposed.frame.id, still.id);
  EXPECT_EQ(exposed.frame.index, 4);
}

TEST(Exposure, AnInstantIsAStillImage) {
  Street street;
  const Exposed exposed = street.expose(street.walking(3, 5), {});
  EXPECT_EQ(exposed.samples, 1);
  EXPECT_EQ(exposed.strips, 1);
  EXPECT_EQ(exposed.frame.rgb, street.still(street.walking(3, 5), 0).rgb);
  EXPECT_EQ(exposed.frame.people[0].blur_px, 0);
}

TEST(Exposure, LightIsTheMeanOverTheExposure) {
  Street street;
  const MomentAt walk = street.walking(3);
  const camera::Exposure exposure{0.04, 0};
  const Exposed blurred = street.expose(walk, exposure);
  ASSERT_GT(blurred.samples, 2);
  EXPECT_EQ(blurred.samples % 2, 1);
  EXPECT_NEAR(blurred.blur_px, 0.12 / 5.0 * 277, 1);  // 12 cm, 5 m away
  EXPECT_NEAR(blurred.frame.people[0].blur_px, 0.12 / 5.0 * 277, 1);
  // Ids are sharp: those of the middle.
  const Frame still = street.still(walk, 0);
  EXPECT_EQ(blurred.frame.id, still.id);
  EXPECT_EQ(blurred.frame.depth_m, still.depth_m);
  EXPECT_EQ(blurred.frame.people[0].amodal_area_px, still.people[0].amodal_area_px);
  EXPECT_NE(blurred.frame.rgb, still.rgb);
  // Pixels that the person always or never covers hardly change; edges do.
  const Frame early = street.still(walk, -0.02);
  const Frame late = street.still(walk, 0.02);
  double inside = 0;
  double outside = 0;
  int inside_pixels = 0;
  int outside_pixels = 0;
  for (std::size_t i = 0; i < still.id.size(); ++i) {
    const int change = std::abs(blurred.frame.rgb[3 * i] - still.rgb[3 * i]);
    const bool was = is_agent(early.id[i]);
    const bool will_be = is_agent(late.id[i]);
    if (was != will_be) {
      inside += change;
      ++inside_pixels;
    } else if (!was && !is_agent(still.id[i])) {
      outside += change;
      ++outside_pixels;
    }
  }
  EXPECT_GT(inside / inside_pixels, 4 * outside / outside_pixels);
}

TEST(Exposure, MoreTimeBlursMore) {
  Street street;
  const MomentAt flight = street.walking(0, 6);
  double before = 1e9;
  for (const double exposure_s : {0.002, 0.01, 0.03}) {
    const Frame frame = street.expose(flight, {exposure_s, 0}).frame;
    double detail = 0;
    for (std::size_t i = 3; i < frame.rgb.size(); ++i) {
      detail += std::abs(frame.rgb[i] - frame.rgb[i - 3]);
    }
    EXPECT_LT(detail, before);
    before = detail;
  }
}

TEST(Exposure, EachRowShowsItsOwnTime) {
  Street street;
  const MomentAt flight = street.walking(0, 8);
  const double readout_s = 0.05;
  const Exposed rolling = street.expose(flight, {0, readout_s});
  ASSERT_GT(rolling.strips, 8);
  const Frame& frame = rolling.frame;
  ASSERT_EQ(frame.id.size(), 320U * 240);
  ASSERT_EQ(frame.rgb.size(), frame.id.size() * 3);
  const Mask mask = instance_mask(frame, id_of_agent(3));
  // Row by row, the person's left edge is where an image of that row's time has it.
  double worst = 0;
  int rows = 0;
  for (int y = 0; y < 240; y += 7) {
    const Frame still = street.still(flight, readout_s * (y + 0.5 - 120) / 240);
    const auto left_edge = [&](const Frame& image) {
      for (int x = 0; x < 320; ++x) {
        if (image.id[pixel_index(image, x, y)] == id_of_agent(3)) return x;
      }
      return -1;
    };
    const int rolled = left_edge(frame);
    const int expected = left_edge(still);
    if (rolled < 0 || expected < 0) continue;
    worst = std::max<double>(worst, std::abs(rolled - expected));
    ++rows;
  }
  EXPECT_GT(rows, 5);
  EXPECT_LE(worst, 2) << "half a strip's motion and a pixel";
  // Ground truth is that of the rolled image.
  const PersonInView& person = find_person(frame, 3);
  EXPECT_NEAR(person.amodal_box.min().x(), mask.box.min().x(), 1.5);
  EXPECT_NEAR(person.amodal_box.max().x(), mask.box.max().x(), 1.5);
  EXPECT_NEAR(person.amodal_box.min().y(), mask.box.min().y(), 1.5);
  EXPECT_NEAR(person.amodal_box.max().y(), mask.box.max().y(), 1.5);
  EXPECT_EQ(person.amodal_area_px, mask.pixels);
  ASSERT_TRUE(person.head_px);
  const Eigen::Vector2i head = person.head_px->array().floor().cast<int>();
  EXPECT_EQ(frame.id[pixel_index(frame, head.x(), head.y())], id_of_agent(3));
  // The image leans: another one than all rows at once.
  EXPECT_NE(frame.id, street.still(flight, 0).id);
}

/// The same camera with half an image more on each side.
camera::Camera with_surroundings(camera::Camera camera) {
  camera::Intrinsics& k = camera.intrinsics;
  k.cx_px += k.width / 2;
  k.cy_px += k.height / 2;
  k.width *= 2;
  k.height *= 2;
  return camera;
}

TEST(Exposure, MeasuresAllOfPeopleWhomABorderCuts) {
  Street street;
  int cut = 0;
  // The person stands across each of the borders, upright and, with the camera on its side, lying.
  for (const double roll_deg : {0.0, 50.0}) {
    for (int step = 0; step < 14; ++step) {
      const double around = 2 * EIGEN_PI * step / 14;
      const double yaw_deg = 31 * std::cos(around);
      const double pitch_deg = -28 + 27 * std::sin(around);
      const auto flight = [&](bool is_wide) {
        return [&, is_wide](double time_s) {
          ShutterMoment moment = street.walking(0)(time_s);
          moment.camera = camera_at({-4, 3 * time_s, 3}, yaw_deg, pitch_deg, 320, 240, 60);
          camera::Pose& pose = moment.camera.pose;
          const Eigen::Matrix3d roll =
              Eigen::AngleAxisd(roll_deg * kDegree, Eigen::Vector3d::UnitZ()).toRotationMatrix();
          pose.R = roll * pose.R;
          pose.t = roll * pose.t;
          if (is_wide) moment.camera = with_surroundings(moment.camera);
          return moment;
        };
      };
      // Rows of both images are read at the same times.
      const Frame frame = street.expose(flight(false), {0, 0.05}).frame;
      const Frame wide = street.expose(flight(true), {0, 0.1}).frame;
      ASSERT_EQ(wide.people.size(), 1U);
      const Eigen::AlignedBox2d whole =
          wide.people[0].amodal_box.translated(Eigen::Vector2d(-160, -120));
      // Strips have other heights, and what is above or below the image has the time of its nearest
      // row: the image moves by up to 0.05 px a row.
      const double beyond_px = std::max({-whole.min().y(), whole.max().y() - 240, 0.0});
      const double slack_px = 1.5 + 0.05 * beyond_px;
      const Eigen::AlignedBox2d image(Eigen::Vector2d(0, 0), Eigen::Vector2d(320, 240));
      if (frame.people.empty()) {
        EXPECT_LT(whole.intersection(image).sizes().minCoeff(), slack_px);
        continue;
      }
      const PersonInView& person = frame.people[0];
      EXPECT_LT((person.amodal_box.min() - whole.min()).cwiseAbs().maxCoeff(), slack_px) << step;
      EXPECT_LT((person.amodal_box.max() - whole.max()).cwiseAbs().maxCoeff(), slack_px) << step;
      const auto area_px = static_cast<double>(wide.people[0].amodal_area_px);
      EXPECT_NEAR(static_cast<double>(person.amodal_area_px), area_px,
                  3 + (0.03 + 0.001 * beyond_px) * area_px)
          << step;
      for (std::size_t i = 0; i < person.keypoints_px->size(); ++i) {
        const Eigen::Vector2f off = (*person.keypoints_px)[i].head<2>() -
                                    (*wide.people[0].keypoints_px)[i].head<2>() +
                                    Eigen::Vector2f(160, 120);
        // Keypoints above or below the image have the time of the nearest row.
        const float y = (*person.keypoints_px)[i].y();
        if (y >= 0 && y <= 240) {
          EXPECT_LT(off.norm(), slack_px) << step;
        }
      }
      cut += image.contains(whole) ? 0 : 1;
    }
  }
  EXPECT_GT(cut, 16);
}

TEST(Exposure, BothAtOnceThroughALens) {
  Street street;
  const MomentAt flight = [inner = street.walking(2, 6)](double time_s) {
    ShutterMoment moment = inner(time_s);
    moment.camera.intrinsics.distortion.emplace(camera::Distortion::Model::brown_conrady,
                                                camera::Distortion::Coefficients{-0.2, 0.04});
    return moment;
  };
  const Exposed exposed = street.expose(flight, {0.01, 0.02});
  EXPECT_GT(exposed.samples, 2);
  EXPECT_GT(exposed.strips, 2);
  EXPECT_EQ(exposed.frame.id.size(), 320U * 240);
  const Mask mask = instance_mask(exposed.frame, id_of_agent(3));
  EXPECT_GT(mask.pixels, 500U);
  EXPECT_EQ(find_person(exposed.frame, 3).amodal_area_px, mask.pixels);
}

}  // namespace
}  // namespace throng::render
