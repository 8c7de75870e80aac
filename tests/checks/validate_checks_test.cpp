// Checks of images, surfaces and motion on scenes that are known exactly: sound ones pass, and
// each damage is named. Whole datasets are damaged in tests/cli/test_validate_damages.py.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/error.h"
#include "base/files/files.h"
#include "camera/camera.h"
#include "checks/flight_checks.h"
#include "checks/ground_truth_checks.h"
#include "checks/median.h"
#include "checks/shares.h"
#include "checks/shot.h"
#include "formats/files/csv_table.h"
#include "world/semantic_class.h"

namespace throng::checks {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 120;
constexpr std::uint32_t kWall = formats::kFirstBuilding + 2;

/// A camera above the ground that looks at a wall at y = 12 m, from a place along x.
Shot scene(double x_m, std::int64_t frame = 0) {
  Shot shot;
  shot.image.id = frame + 1;
  shot.image.file = "images/run000/d1/00000" + std::to_string(frame) + ".jpg";
  shot.image.run = "run000";
  shot.image.camera = "d1";
  shot.image.frame = frame;
  shot.image.time_s = 0.5 * static_cast<double>(frame);
  shot.image.width = kWidth;
  shot.image.height = kHeight;
  shot.camera.intrinsics = camera::intrinsics_from_hfov(kWidth, kHeight, 1.2);
  shot.camera.pose = camera::pose_looking({x_m, 0, 6}, 0.5 * EIGEN_PI, -0.45);
  shot.image.camera_matrix = shot.camera.intrinsics.matrix();
  shot.image.R = shot.camera.pose.R;
  shot.image.t = shot.camera.pose.t;
  shot.image.record = {
      {"environment", {{"sun_elevation_deg", 40}, {"visibility_m", 3500}, {"weather", "clear"}}}};
  Pixels& pixels = shot.pixels;
  pixels.width = kWidth;
  pixels.height = kHeight;
  const Eigen::Vector3d center = shot.camera.pose.center();
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const Eigen::Vector3d ray = shot.camera.unproject({x, y}, 1) - center;
      const double to_ground = ray.z() < 0 ? -center.z() / ray.z() : 1e9;
      const double to_wall = ray.y() > 0 ? (12 - center.y()) / ray.y() : 1e9;
      const bool is_wall = to_wall < to_ground && std::abs(center.x() + ray.x() * to_wall) < 4;
      const bool is_sky = !is_wall && to_ground > 60;
      const double z = is_wall ? to_wall : is_sky ? 0 : to_ground;
      pixels.ids.push_back(is_wall ? kWall : is_sky ? 0 : formats::kGround);
      pixels.depth_cm.push_back(static_cast<std::uint16_t>(std::lround(100 * z)));
      for (const int n : {128, is_wall ? 1 : 128, is_wall || is_sky ? 128 : 255}) {
        pixels.normals.push_back(static_cast<std::uint16_t>(is_sky ? 0 : n));
      }
      // Texture on both, and different tones.
      const int tone = (is_wall ? 150 : is_sky ? 220 : 70) + (x * 7 + y * 13) % 9;
      for (int c = 0; c < 3; ++c) pixels.rgb.push_back(static_cast<std::uint8_t>(tone - 5 * c));
    }
  }
  return shot;
}

/// The flow of what stands still, as the renderer has it.
void set_flow(Shot& shot, const Shot& next, double factor = 1) {
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const std::size_t pixel = shot.pixels.at(x, y);
      const bool is_sky = shot.pixels.ids[pixel] == 0;
      const double z = is_sky ? 1e7 : shot.pixels.depth_m(pixel);
      const auto seen = next.camera.project(shot.camera.unproject({x, y}, z));
      const Eigen::Vector2d flow = factor * (seen.pixel - Eigen::Vector2d(x, y));
      shot.pixels.flow.push_back(static_cast<std::uint16_t>(std::lround(flow.x() * 64 + 32768)));
      shot.pixels.flow.push_back(static_cast<std::uint16_t>(std::lround(flow.y() * 64 + 32768)));
      shot.pixels.flow.push_back(1);
    }
  }
}

/// The rules that a check finds broken.
std::vector<std::string> broken_rules(const std::function<void(Findings&)>& check) {
  Validation validation;
  Findings findings(validation);
  check(findings);
  std::vector<std::string> rules;
  for (const Finding& finding : validation.findings) {
    EXPECT_FALSE(finding.file.empty());
    EXPECT_FALSE(finding.what.empty());
    rules.push_back(finding.rule);
  }
  return rules;
}

bool has(const std::vector<std::string>& rules, const std::string& rule) {
  return std::find(rules.begin(), rules.end(), rule) != rules.end();
}

std::vector<std::string> alignment_findings(const std::vector<Shot>& shots) {
  return broken_rules([&](Findings& findings) {
    AlignmentCheck check;
    for (const Shot& shot : shots) check.add(shot);
    check.finish(findings);
  });
}

/// The scene with houses side by side in place of the wall, light and dark ones.
Shot houses(double x_m, std::int64_t frame = 0) {
  Shot shot = scene(x_m, frame);
  for (std::size_t i = 0; i < shot.pixels.count(); ++i) {
    if (shot.pixels.ids[i] != kWall) continue;
    constexpr std::size_t kHousePx = 9;
    const std::size_t house = i % kWidth / kHousePx;
    shot.pixels.ids[i] = formats::kFirstBuilding + static_cast<std::uint32_t>(house);
    for (std::size_t c = 0; house % 2 == 0 && c < 3; ++c) shot.pixels.rgb[3 * i + c] -= 40;
  }
  return shot;
}

TEST(ValidateChecks, OutlinesAreWhereTheImageHasEdges) {
  EXPECT_TRUE(alignment_findings({houses(0), houses(1, 1)}).empty());
  const auto damaged = [](const std::function<std::size_t(int, int)>& from) {
    const Shot sound = houses(1);
    Shot shot = sound;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        std::copy_n(&sound.pixels.rgb[3 * from(x, y)], 3,
                    &shot.pixels.rgb[3 * sound.pixels.at(x, y)]);
      }
    }
    return has(alignment_findings({shot}), "image-is-labels");
  };
  const Pixels size = scene(0).pixels;
  EXPECT_TRUE(damaged([&](int x, int y) { return size.at(std::max(0, x - 3), y); }));
  EXPECT_TRUE(damaged([&](int x, int y) { return size.at((x + kWidth / 2) % kWidth, y); }));
  EXPECT_TRUE(damaged([&](int /*x*/, int /*y*/) { return std::size_t{0}; }));
}

TEST(ValidateChecks, TheOutlineOfASingleThingCannotTell) {
  Shot shot = scene(0);
  std::fill(shot.pixels.rgb.begin(), shot.pixels.rgb.end(), std::uint8_t{150});
  EXPECT_TRUE(alignment_findings({shot}).empty());
}

TEST(ValidateChecks, ADarkImageAloneCannotTell) {
  Shot shot = houses(0);
  shot.image.record["environment"]["sun_elevation_deg"] = -20;
  std::fill(shot.pixels.rgb.begin(), shot.pixels.rgb.end(), std::uint8_t{3});
  EXPECT_TRUE(alignment_findings({shot}).empty());
  EXPECT_FALSE(alignment_findings({houses(0), houses(1, 1), houses(2, 2), shot}).empty());
}

TEST(ValidateChecks, StillPixelsFlowAsDepthAndCamerasSay) {
  const auto rules = [](double factor) {
    Shot before = scene(0);
    const Shot after = scene(0.8, 1);
    set_flow(before, after, factor);
    return broken_rules([&](Findings& findings) { check_flow_between(before, after, findings); });
  };
  EXPECT_TRUE(rules(1).empty());
  for (const double factor : {0.0, -1.0, 1.05}) EXPECT_TRUE(has(rules(factor), "flow-of-still"));
}

TEST(ValidateChecks, TheSkyHasNoDepth) {
  Shot shot = scene(0);
  shot.image.record["camera"] = {{"model", "fisheye"}};  // the ground is not looked at
  const auto rules = [&] {
    return broken_rules(
        [&](Findings& findings) { check_depth({}, shot.image, shot.pixels, findings); });
  };
  EXPECT_TRUE(rules().empty());
  const auto sky = std::find(shot.pixels.ids.begin(), shot.pixels.ids.end(), 0U);
  ASSERT_NE(sky, shot.pixels.ids.end());
  shot.pixels.depth_cm.at(static_cast<std::size_t>(sky - shot.pixels.ids.begin())) = 10000;
  EXPECT_TRUE(has(rules(), "depth"));
}

TEST(ValidateChecks, SurfacesAreUprightOrNotByTheirClass) {
  using world::SemanticClass;
  Shot shot = scene(0);
  const auto rules = [&](SemanticClass of_wall, SemanticClass of_ground) {
    shot.pixels.semantic.clear();
    for (const std::uint32_t id : shot.pixels.ids) {
      const SemanticClass surface = id == kWall ? of_wall
                                    : id == 0   ? SemanticClass::sky
                                                : of_ground;
      shot.pixels.semantic.push_back(static_cast<std::uint16_t>(surface));
    }
    return broken_rules([&](Findings& findings) { check_surface_classes(shot, findings); });
  };
  EXPECT_TRUE(rules(SemanticClass::building, SemanticClass::road).empty());
  EXPECT_TRUE(has(rules(SemanticClass::roof, SemanticClass::road), "semantic"));
  EXPECT_TRUE(has(rules(SemanticClass::door, SemanticClass::building), "semantic"));
}

TEST(ValidateChecks, FewSamplesSayNothing) {
  EXPECT_FALSE(is_above_share(39, 39, 0.03));
  EXPECT_TRUE(is_above_share(40, 40, 0.03));
  EXPECT_FALSE(is_above_share(30, 500, 0.03));  // 15 are expected at most, and 23 more by chance
  EXPECT_TRUE(is_above_share(40, 500, 0.03));
  EXPECT_TRUE(std::isinf(median_error({1, 2, 3})));
  EXPECT_LT(median_error({1, 1.1, 0.9, 1, 1.05, 0.95, 1, 1.1, 0.9, 1}), 0.15);
}

TEST(ValidateChecks, DepthIsOneInAllImages) {
  const auto rules = [](double factor) {
    const Shot before = scene(0);
    Shot after = scene(0.8, 1);
    for (std::size_t i = 0; i < after.pixels.count(); ++i) {
      if (after.pixels.ids[i] != kWall) continue;
      after.pixels.depth_cm[i] = static_cast<std::uint16_t>(after.pixels.depth_cm[i] * factor);
    }
    return broken_rules([&](Findings& findings) {
      check_still_surfaces(before, after, findings);
      check_buildings(after, findings);
    });
  };
  EXPECT_TRUE(rules(1).empty());
  for (const double factor : {0.95, 1.05}) {
    EXPECT_TRUE(has(rules(factor), "depth-agrees"));
    EXPECT_TRUE(has(rules(factor), "depth-of-buildings"));
  }
}

TEST(ValidateChecks, NormalsAreThoseOfTheSurface) {
  const auto rules = [](const std::function<void(std::uint16_t*)>& damage) {
    Shot shot = scene(0);
    for (std::size_t i = 0; i < shot.pixels.normals.size(); i += 3) {
      if (shot.pixels.ids[i / 3] == kWall) damage(&shot.pixels.normals[i]);
    }
    return broken_rules([&](Findings& findings) { check_normals(shot, findings); });
  };
  EXPECT_TRUE(rules([](std::uint16_t* /*n*/) {}).empty());
  EXPECT_TRUE(has(rules([](std::uint16_t* n) { n[1] = 255; }), "normals-face-camera"));
  EXPECT_TRUE(has(rules([](std::uint16_t* n) { std::swap(n[1], n[2]); }), "normals-are-surface"));
}

/// Twelve walkers who go straight on.
Shot walkers(double speed_factor, std::int64_t frame, double turn_rad = 0) {
  Shot shot = scene(0, frame);
  for (int i = 0; i < 12; ++i) {
    formats::Person person;
    person.id = 100 * frame + i;
    person.track_id = i + 1;
    person.heading_rad = 0.5 * i;
    const Eigen::Vector2d true_velocity(1.4 * std::cos(0.5 * i), 1.4 * std::sin(0.5 * i));
    person.position.head<2>() =
        Eigen::Vector2d(i, 5) + 0.5 * static_cast<double>(frame) * true_velocity;
    person.velocity = Eigen::Rotation2Dd(turn_rad) * (speed_factor * true_velocity);
    shot.image.people.push_back(person);
  }
  return shot;
}

TEST(ValidateChecks, PeopleMoveAsTheirVelocitySays) {
  const auto rules = [](double factor, double turn_rad) {
    return broken_rules([&](Findings& findings) {
      const Shot now = walkers(factor, 1, turn_rad);
      check_motion(walkers(factor, 0, turn_rad), now, findings);
      check_facing_motion(now, findings);
    });
  };
  EXPECT_TRUE(rules(1, 0).empty());
  EXPECT_TRUE(has(rules(1.05, 0), "velocity-is-motion"));
  EXPECT_TRUE(has(rules(-1, 0), "heading-is-motion"));
  EXPECT_TRUE(has(rules(1, 0.5 * EIGEN_PI), "heading-is-motion"));
}

TEST(ValidateChecks, ReadingsAreWithinTheSensorsErrors) {
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  const double latitude_rad = 45 * EIGEN_PI / 180;
  const Eigen::Vector3d field =
      30 * Eigen::Vector3d(0, std::cos(latitude_rad), -2 * std::sin(latitude_rad));
  const Eigen::Vector3d weight(0, 0, 9.81);
  const SensorSample sound{
      zero, zero, Eigen::Quaterniond::Identity(), zero, weight, zero, weight, field, 101'325, 0,
      zero, zero};
  EXPECT_EQ(implausible_reading(sound, sim::SensorNoise{}, 45, 0.02, 0.3), "");
  SensorSample swapped = sound;
  std::swap(swapped.gyro, swapped.accelerometer);
  EXPECT_NE(implausible_reading(swapped, sim::SensorNoise{}, 45, 0.02, 0.3), "");
  SensorSample turned = sound;
  turned.magnetometer = {field.y(), field.x(), field.z()};
  EXPECT_NE(implausible_reading(turned, sim::SensorNoise{}, 45, 0.02, 0.3), "");
  SensorSample far = sound;
  far.gps_position.x() = 60;
  EXPECT_NE(implausible_reading(far, sim::SensorNoise{}, 45, 0.02, 0.3), "");
}

TEST(ValidateChecks, TablesWithQuotesAndLinesThatAreCutOff) {
  const auto path = std::filesystem::path(::testing::TempDir()) / "table.csv";
  write_file_atomically(path, "a,b\n\"x,\"\"y\",2.5\n");
  const formats::CsvTable table = formats::read_csv(path);
  ASSERT_EQ(table.rows.size(), 1U);
  EXPECT_EQ(table.rows[0][0], "x,\"y");
  EXPECT_EQ(formats::parse_number(table.rows[0][table.find("b")]), 2.5);
  EXPECT_TRUE(std::isnan(formats::parse_number(table.rows[0][0])));
  write_file_atomically(path, "a,b\n1\n");
  EXPECT_THROW(formats::read_csv(path), InputError);
  EXPECT_THROW(formats::read_csv(path.string() + ".none"), InputError);
}

}  // namespace
}  // namespace throng::checks
