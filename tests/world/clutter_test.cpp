#include "world/clutter/clutter.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <set>
#include <tuple>
#include <vector>

#include "base/geometry/polygon.h"
#include "world/scenario.h"

namespace throng::world {
namespace {

/// A court between four houses with a door to the south, a road around it and a lawn.
Scenario court() {
  Scenario scenario;
  scenario.ground = {{-60, -60}, {60, 60}};
  scenario.ground_material = "pavers";
  scenario.inside.bounds = {{-30, -30}, {30, 30}};
  scenario.buildings = {{"west", {{-20, -20}, {-12, -20}, {-12, 20}, {-20, 20}}},
                        {"east", {{12, -20}, {20, -20}, {20, 20}, {12, 20}}},
                        {"north", {{-12, 12}, {12, 12}, {12, 20}, {-12, 20}}},
                        {"outside", {{-58, -50}, {-48, -50}, {-48, -10}, {-58, -10}}},
                        {"south_west", {{-12, -20}, {-2, -20}, {-2, -12}, {-12, -12}}},
                        {"south_east", {{2, -20}, {12, -20}, {12, -12}, {2, -12}}}};
  Exit exit;
  exit.from = {-2, -16};
  exit.to = {2, -16};
  exit.outward = {0, -1};
  scenario.exits = {exit};
  scenario.areas = {{{{-60, 32}, {60, 32}, {60, 40}, {-60, 40}}, "asphalt"},
                    {{{-50, 42}, {50, 42}, {50, 58}, {-50, 58}}, "grass"}};
  scenario.markings = {{"crossing", {0, 32}, {0, 40}, 4}};
  Prop fountain;
  fountain.kind = PropKind::fountain;
  fountain.position = {-40, 0};
  scenario.props = {fountain};
  scenario.placed_props = 1;
  return scenario;
}

Scenario with_clutter(const Clutter& clutter) {
  Scenario scenario = court();
  strew(clutter, scenario);
  return scenario;
}

std::set<std::tuple<PropKind, double, double, std::uint32_t>> list_props(const Scenario& scenario) {
  std::set<std::tuple<PropKind, double, double, std::uint32_t>> props;
  for (const Prop& prop : scenario.props) {
    props.emplace(prop.kind, prop.position.x(), prop.position.y(), prop.look);
  }
  return props;
}

TEST(Clutter, IsTheSameForTheSameSeedOnly) {
  const Scenario first = with_clutter({.seed = 4, .density = 0.8});
  EXPECT_GT(first.strewn_props, 60U);
  EXPECT_EQ(first.props.size(), first.strewn_props + 1);
  EXPECT_EQ(first.props.front().kind, PropKind::fountain);
  EXPECT_EQ(list_props(first), list_props(with_clutter({.seed = 4, .density = 0.8})));
  EXPECT_NE(list_props(first), list_props(with_clutter({.seed = 5, .density = 0.8})));
  EXPECT_LT(with_clutter({.seed = 4, .density = 0.2}).strewn_props, first.strewn_props);
  EXPECT_EQ(with_clutter({.seed = 4, .density = 0}).strewn_props, 0U);
}

TEST(Clutter, HasManyKindsOrThoseThatAreWanted) {
  std::set<PropKind> kinds;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    for (const Prop& prop : with_clutter({.seed = seed, .density = 1}).props)
      kinds.insert(prop.kind);
  }
  EXPECT_GT(kinds.size(), 30U);
  const Scenario cars = with_clutter({.seed = 1, .density = 1, .kinds = {PropKind::car}});
  EXPECT_GT(cars.strewn_props, 5U);
  for (std::size_t i = 1; i < cars.props.size(); ++i) EXPECT_EQ(cars.props[i].kind, PropKind::car);
  EXPECT_FALSE(is_strewn(PropKind::train));
}

TEST(Clutter, StandsWhereNobodyWalks) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const Scenario scenario = with_clutter({.seed = seed, .density = 1});
    for (std::size_t i = 1; i < scenario.props.size(); ++i) {
      const Prop& prop = scenario.props[i];
      const auto corners = prop_footprint(prop);
      SCOPED_TRACE(prop_type(prop.kind).name);
      for (const Building& building : scenario.buildings) {
        EXPECT_FALSE(geometry::touch(building.footprint, corners));
      }
      for (const Eigen::Vector2d& corner : corners) {
        EXPECT_TRUE(scenario.ground.contains(corner));
        EXPECT_FALSE(scenario.inside.contains(corner));
        const bool is_before_door =
            std::abs(corner.x()) < 4 && corner.y() < -13.2 && corner.y() > -44;
        EXPECT_FALSE(is_before_door);
      }
      EXPECT_GT(distance_to(scenario.props.front(), prop.position), 0.6);
      if (prop.kind == PropKind::car) {
        EXPECT_GT(std::abs(prop.position.x()), 2 + 2.15) << "on the crossing";
        EXPECT_GT(std::abs(prop.position.y() - 36), 1.5) << "in the middle of the road";
      }
      for (std::size_t k = 1; k < i; ++k) {
        EXPECT_FALSE(geometry::touch(prop_footprint(scenario.props[k]), corners));
      }
    }
  }
}

TEST(Clutter, LeavesPitchesEmpty) {
  Scenario scenario = court();
  scenario.markings.push_back({"line", {-40, 50}, {40, 50}, 0.1});
  strew({.seed = 4, .density = 1}, scenario);
  const std::vector<Eigen::Vector2d>& lawn = scenario.areas[1].corners;
  for (const Prop& prop : scenario.props) {
    EXPECT_GT(geometry::signed_distance_to(lawn, prop.position), 0);
  }
}

TEST(Clutter, ThinsOutWithScatteredProps) {
  Scenario scenario = with_clutter({.seed = 4, .density = 0.8});
  const std::size_t before = scenario.strewn_props;
  thin_out(scenario, 0.5, 7);
  EXPECT_LT(scenario.strewn_props, before);
  EXPECT_EQ(scenario.props.size(), scenario.strewn_props + 1);
}

}  // namespace
}  // namespace throng::world
