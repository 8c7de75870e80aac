// Properties of every pedestrian model, and those particular to some.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "crowd/models/ellipse.h"
#include "crowd/state/model.h"
#include "tests/crowd/crowd_files.h"
#include "tests/crowd/model_scenes.h"

namespace throng::crowd {
namespace {

class AnyModel : public testing::TestWithParam<std::string> {
 protected:
  static bool minds_others() { return GetParam() != "dummy"; }
};

TEST_P(AnyModel, WalksFortyMetersInTheTimeOfRimea1) {
  Simulation crowd =
      test::load(test::model_scene(test::agent_at(0, 0), R"(pref_speed="1.33")"),
                 test::to_point_behavior(40, 0), {.model = GetParam(), .sub_steps = 4});
  while (!crowd.all_final() && crowd.time_s() < 60) crowd.step();
  EXPECT_GE(crowd.time_s(), 26);
  EXPECT_LE(crowd.time_s(), 34);
}

TEST_P(AnyModel, WalksAroundAStandingPerson) {
  if (!minds_others()) GTEST_SKIP() << "a dummy minds nobody";
  Simulation crowd =
      test::load(test::model_scene(test::agent_at(0, 0), R"(pref_speed="1.33")",
                                   test::standing_group(test::agent_at(5, 0.15))),
                 test::to_point_behavior(10, 0), {.model = GetParam(), .sub_steps = 4});
  float nearest = 10;
  while (crowd.positions()[0].x() < 9 && crowd.time_s() < 60) {
    crowd.step();
    nearest = std::min(nearest, (crowd.positions()[0] - crowd.positions()[1]).norm());
  }
  EXPECT_LT(crowd.time_s(), 60);
  EXPECT_GT(nearest, 0.3F);  // of radii that sum up to 0.4 m
}

TEST_P(AnyModel, KeepsOutOfWalls) {
  if (!minds_others()) GTEST_SKIP() << "a dummy minds nothing";
  Simulation crowd =
      test::load(test::model_scene(test::agent_at(0, 0.3), "", test::box(3, -4, 4, 4)),
                 test::to_point_behavior(10, 0), {.model = GetParam(), .sub_steps = 4});
  float furthest = 0;
  for (int i = 0; i < 150; ++i) {
    crowd.step();
    furthest = std::max(furthest, crowd.positions()[0].x());
  }
  EXPECT_GT(furthest, 1);
  EXPECT_LT(furthest, 3);
}

/// Sixty in a box, two in each place, some at its corners, all to the middle.
std::string dense_scene() {
  std::string agents;
  for (int i = 0; i < 30; ++i) {
    const std::string place = test::agent_at(0.5 * (i % 6), 0.5 * (i / 6));
    agents += place + place;
  }
  return test::model_scene(
      agents, "",
      test::box(-1, -2, 3.5, -0.2) + test::box(-1, 2.2, 3.5, 4) + test::box(1.3, 0.8, 1.7, 1.2));
}

TEST_P(AnyModel, StaysFiniteForMinutesWhereItIsTooDense) {
  for (const Compat compat : {Compat::none, Compat::menge}) {
    Simulation crowd = test::load(dense_scene(), test::to_point_behavior(1.25, 1.5),
                                  {.model = GetParam(), .compat = compat});
    for (int i = 0; i < 1800; ++i) crowd.step();
    for (std::size_t i = 0; i < crowd.agent_count(); ++i) {
      ASSERT_TRUE(crowd.positions()[i].allFinite()) << "agent " << i;
      ASSERT_TRUE(std::isfinite(crowd.yaws_rad()[i])) << "agent " << i;
    }
  }
}

TEST_P(AnyModel, PartsTwoAtOnePosition) {
  if (!minds_others()) GTEST_SKIP() << "a dummy minds nobody";
  Simulation crowd =
      test::load(test::model_scene(test::agent_at(0, 0) + test::agent_at(0, 0)),
                 test::to_point_behavior(6, 0), {.model = GetParam(), .sub_steps = 4});
  for (int i = 0; i < 30; ++i) crowd.step();
  EXPECT_GT((crowd.positions()[0] - crowd.positions()[1]).norm(), 0.05F);
}

TEST_P(AnyModel, ThreadsDoNotChangeASingleBit) {
  const auto run = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    Simulation crowd =
        test::load(test::model_crowd_scene(400), test::mirror_behavior(), {.model = GetParam()});
    for (int i = 0; i < 100; ++i) crowd.step();
    return std::vector<Eigen::Vector2f>(crowd.positions().begin(), crowd.positions().end());
  };
  const std::vector<Eigen::Vector2f> one = run(1);
  EXPECT_TRUE(one == run(2));
  EXPECT_TRUE(one == run(16));
}

INSTANTIATE_TEST_SUITE_P(Models, AnyModel,
                         testing::Values("orca", "weidmann", "ttc", "pedvo", "johannson",
                                         "karamouzas", "zanlungo", "gcf", "dummy"));

TEST(Models, JohanssonIsFoundByEitherName) {
  EXPECT_EQ(&find_model("johansson"), &find_model("johannson"));
}

TEST(Models, AnUnknownModelIsRefusedWithTheNames) {
  try {
    find_model("orka");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("pedvo"), std::string::npos);
  }
}

/// Two head for each other; returns how far aside each of them got.
std::pair<float, float> aside(const std::string& first_extra, const std::string& second_extra,
                              const std::string& pedvo = "") {
  Simulation crowd =
      test::load(test::two_profiles_scene(first_extra, second_extra, pedvo,
                                          test::agent_at(-3, 0.02), test::agent_at(3, -0.02)),
                 test::mirror_behavior(), {.model = "pedvo"});
  std::pair<float, float> max_offset_m;
  for (int i = 0; i < 60; ++i) {
    crowd.step();
    max_offset_m.first = std::max(max_offset_m.first, std::abs(crowd.positions()[0].y()));
    max_offset_m.second = std::max(max_offset_m.second, std::abs(crowd.positions()[1].y()));
  }
  return max_offset_m;
}

TEST(PedVo, YieldsToAgentsWithRightOfWay) {
  const auto [first, second] = aside(R"(priority="1")", "");
  EXPECT_LT(first, 0.1F);
  EXPECT_GT(second, 0.3F);
}

TEST(PedVo, ABiasForTurningTurnsMore) {
  EXPECT_GT(aside("", "", R"(turningBias="3")").first, aside("", "", R"(turningBias="0.5")").first);
}

TEST(PedVo, StridesNeedRoomOnlyIfDensityAware) {
  const auto speed = [](const std::string& pedvo) {
    Simulation crowd =
        test::load(test::column_scene(pedvo), test::eastward_behavior(""), {.model = "pedvo"});
    for (int i = 0; i < 20; ++i) crowd.step();
    return crowd.velocities()[5].norm();
  };
  EXPECT_LT(speed(""), 1);
  EXPECT_NEAR(speed(R"(density_aware="0")"), 1.34F, 0.01F);
}

TEST(FundamentalDiagram, SlowsWhereItIsCrowded) {
  const auto speed = [](const std::string& modifier) {
    Simulation crowd =
        test::load(test::column_scene(""), test::eastward_behavior(modifier), {.model = "dummy"});
    for (int i = 0; i < 20; ++i) crowd.step();
    return crowd.velocities()[5].norm();
  };
  EXPECT_NEAR(speed(""), 1.34F, 0.01F);
  const float slow =
      speed(R"(<VelModifier type="fundamental_diagram" factor_dist="c" factor_value="1.57"
                buffer_dist="c" buffer_value="0.9"/>)");
  EXPECT_LT(slow, 1);
  // Longer strides are wanted by who is tall.
  EXPECT_GT(speed(R"(<VelModifier type="fundamental_diagram" factor_dist="u" factor_min="2"
                      factor_max="2.1" buffer_dist="c" buffer_value="0.9"/>)"),
            slow);
}

TEST(Gcf, AProfileMayUseEitherNameOfAParameter) {
  std::string scene = test::model_scene(test::agent_at(0, 0));
  scene.insert(scene.find("</AgentProfile>"),
               R"(<GCF><Property name="facing_min" dist="c" value="0.3"/></GCF>)");
  EXPECT_NO_THROW(test::load(scene, test::to_point_behavior(1, 0), {.model = "gcf"}));
}

TEST(Ellipse, TouchesWhereTheAxesSay) {
  const Ellipse along_x{0.5F, 0.2F, {1, 0}};
  const Ellipse along_y{0.4F, 0.3F, {0, 1}};
  EXPECT_NEAR(contact_distance(along_x, along_y, {1, 0}), 0.5F + 0.3F, 1e-4F);
  EXPECT_NEAR(contact_distance(along_x, along_y, {0, -1}), 0.2F + 0.4F, 1e-4F);
  const Ellipse circle{0.3F, 0.3F, {0.6F, 0.8F}};
  EXPECT_NEAR(contact_distance(circle, circle, {0.8F, 0.6F}), 0.6F, 1e-4F);
  EXPECT_NEAR(contact_distance(along_x, {0, 1}), 0.2F, 1e-6F);
  EXPECT_NEAR(contact_distance(along_x, {std::sqrt(0.5F), std::sqrt(0.5F)}),
              std::sqrt(0.5F * (0.25F + 0.04F)), 1e-6F);
}

TEST(Ellipse, EqualOnesTouchAtTwiceTheirOwnExtent) {
  // By symmetry the point of contact is in the middle.
  const Ellipse ellipse{0.6F, 0.2F, {1, 0}};
  for (int i = 0; i < 16; ++i) {
    const float angle = 0.4F * static_cast<float>(i);
    const Eigen::Vector2f u(std::cos(angle), std::sin(angle));
    const float extent = 1 / std::sqrt(u.x() * u.x() / 0.36F + u.y() * u.y() / 0.04F);
    EXPECT_NEAR(contact_distance(ellipse, ellipse, u), 2 * extent, 1e-3F);
  }
}

}  // namespace
}  // namespace throng::crowd
