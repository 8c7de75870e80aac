// Experiments that are recognized by the names of their files.
#include "validation/experiments/archive.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/geometry/polygon.h"

namespace throng::validation {
namespace {

TEST(Archive, KnowsItsNames) {
  for (const char* name : {"uo-050-180-180.txt", "uo-300-300-200.txt.gz", "040_c_56_h-.txt",
                           "030_c_56_h0.txt.gz", "150_q_56_h0.csv", "020_c_12_h+.txt",
                           "bi_corr_400_b_03.txt", "bi_corr_400_a_1.csv", "uni_corr_500_01.txt.gz",
                           "single_file_n56_cam1.csv.gz", "single_file_n14.txt", "00_n56.txt"}) {
    const auto experiment = archived_experiment(std::filesystem::path("folder") / name);
    ASSERT_TRUE(experiment) << name;
    EXPECT_TRUE(std::string(name).starts_with(experiment->name + ".")) << experiment->name;
    EXPECT_EQ(experiment->recording.has_value() + experiment->single_file.has_value(), 1) << name;
    EXPECT_FALSE(experiment->loop) << name;
  }
}

TEST(Archive, KnowsNoOthers) {
  for (const char* name :
       {"README.md", "experiments.json", "uo-050-180.txt", "uo-000-180-180.txt",
        "uo-050-000-180.txt", "uo-0500-180-180.txt", "xuo-050-180-180.txt", "040_c_56_h.txt",
        "040_c_00_h-.txt", "bi_corr_000_b.txt", "bi_corr_40_b.txt", "single_file_n0.txt",
        "single_file_n99999999999999999999.txt", "single_file_n5x.txt", "notes_n5.txt", ""}) {
    EXPECT_FALSE(archived_experiment(name)) << name;
  }
}

TEST(Archive, MeasuresOnTheGround) {
  for (const char* name :
       {"uo-050-180-180.txt", "uo-180-180-095.txt", "uo-300-300-250.txt", "uo-180-180-300.txt",
        "040_c_56_h-.txt", "020_c_12_h0.txt", "bi_corr_400_b_03.txt", "uni_corr_500_01.txt"}) {
    const auto experiment = archived_experiment(name);
    ASSERT_TRUE(experiment && experiment->recording) << name;
    const Recording& recording = *experiment->recording;
    EXPECT_TRUE(geometry::is_simple(recording.walkable)) << name;
    const auto outside_m = [&](const Eigen::Vector2d& p) {
      return geometry::signed_distance_to(recording.walkable, p);
    };
    EXPECT_LE(outside_m(recording.area.center()), 0) << name;
    EXPECT_LE(outside_m(recording.line.from), 1e-9) << name;
    EXPECT_LE(outside_m(recording.line.to), 1e-9) << name;
    for (const auto& goal : recording.goals) {
      EXPECT_LE(outside_m(goal.min()), 0) << name;
      EXPECT_LE(outside_m(goal.max()), 0) << name;
    }
  }
}

/// The opening of Hermes' corridor and the units of its files (README of the recordings).
TEST(Archive, HasTheWidthsOfTheNames) {
  const auto hermes = archived_experiment("uo-180-240-095.txt");
  ASSERT_TRUE(hermes && hermes->recording);
  EXPECT_NEAR(hermes->recording->line.length_m(), 0.95, 1e-9);
  EXPECT_NEAR(hermes->recording->area.sizes().x(), 2.4, 1e-9);
  EXPECT_EQ(hermes->recording->format.unit_m, 0.01);
  EXPECT_EQ(hermes->recording->format.frames_per_s, 16);
  const auto two_way = archived_experiment("bi_corr_360_x.txt");
  EXPECT_NEAR(two_way->recording->line.length_m(), 3.6, 1e-9);
  EXPECT_EQ(two_way->recording->goals.size(), 2U);
  EXPECT_EQ(archived_experiment("single_file_n22_cam2.txt")->single_file->people, 22U);
}

TEST(Archive, HasADiagram) {
  const Experiment diagram = hermes_diagram();
  ASSERT_TRUE(diagram.loop);
  double before = 0;
  for (const DensitySpeed& point : diagram.loop->recorded) {
    EXPECT_GT(point.density, before);
    EXPECT_LT(point.density * point.speed_mps, 1.7) << "the published maximum is 1.6 /(m s)";
    before = point.density;
  }
}

}  // namespace
}  // namespace throng::validation
