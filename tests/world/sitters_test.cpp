// Seats of props, and who sits on them.
#include "world/clutter/sitters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/geometry/polygon.h"
#include "tests/places/scenarios/square.h"
#include "world/fields/read_scenario.h"
#include "world/stand_seats.h"

namespace throng::world {
namespace {

using Eigen::Vector2d;

Prop prop_at(PropKind kind, const Vector2d& position, double yaw_rad = 0, double scale = 1) {
  Prop prop;
  prop.kind = kind;
  prop.position = position;
  prop.yaw_rad = yaw_rad;
  prop.scale = scale;
  return prop;
}

/// Rows of benches and picnic tables, as many seats as 3 * 20 + 4 * 20.
Scenario rest_area() {
  Scenario scenario;
  for (int i = 0; i < 20; ++i) {
    scenario.props.push_back(prop_at(PropKind::bench, {4.0 * i, 0}, 0.1 * i));
    scenario.props.push_back(prop_at(PropKind::picnic_table, {4.0 * i, 6}, -0.2 * i));
    scenario.props.push_back(prop_at(PropKind::lamp_post, {4.0 * i, 12}));
  }
  return scenario;
}

std::set<std::pair<double, double>> places(const Scenario& scenario) {
  std::set<std::pair<double, double>> all;
  for (const Sitter& sitter : scenario.sitters) {
    all.emplace(sitter.position.x(), sitter.position.y());
  }
  return all;
}

Scenario seated(Scenario scenario, double share, std::uint64_t seed) {
  seat_people({share, seed}, scenario);
  return scenario;
}

TEST(PropSeats, FaceTablesAndTurnTheirBacksToBacks) {
  int kinds = 0;
  for (std::size_t i = 0; i < kPropKinds; ++i) {
    const auto kind = static_cast<PropKind>(i);
    const auto seats = prop_seats(kind);
    if (seats.empty()) continue;
    ++kinds;
    const PropType& type = prop_type(kind);
    for (const PropSeat& seat : seats) {
      EXPECT_TRUE((seat.position.array().abs() < type.half_size.array()).all()) << type.name;
      EXPECT_NEAR(seat.height_m, kSeatHeightM, 0.05) << type.name;
      const Vector2d knees =
          seat.position + 0.45 * Vector2d(std::cos(seat.yaw_rad), std::sin(seat.yaw_rad));
      const bool is_table = type.semantic_class == SemanticClass::table;
      if (is_table) {
        EXPECT_LT(knees.norm(), seat.position.norm()) << type.name;
      } else {
        EXPECT_LT(knees.y(), 0.05) << type.name << "'s back is at +y";
      }
      for (const PropSeat& other : seats) {
        if (&other == &seat) continue;
        EXPECT_GE((other.position - seat.position).norm(), 0.5) << type.name;
      }
    }
  }
  EXPECT_GE(kinds, 6);
}

TEST(Sitters, AreTheShareOfTheSeats) {
  const std::size_t seats = free_seats(rest_area()).size();
  EXPECT_EQ(seats, 140U);
  for (const double share : {0.0, 0.25, 0.5, 1.0}) {
    EXPECT_EQ(seated(rest_area(), share, 3).sitters.size(), std::lround(share * 140)) << share;
  }
}

TEST(Sitters, FollowTheSeedAndStayAtALargerShare) {
  const auto half = places(seated(rest_area(), 0.5, 3));
  EXPECT_EQ(half.size(), 70U);
  EXPECT_EQ(half, places(seated(rest_area(), 0.5, 3)));
  EXPECT_NE(half, places(seated(rest_area(), 0.5, 4)));
  const auto more = places(seated(rest_area(), 0.7, 3));
  EXPECT_TRUE(std::includes(more.begin(), more.end(), half.begin(), half.end()));
}

TEST(Sitters, SitBesideEachOther) {
  int beside = 0;
  int pairs = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Scenario scenario = seated(rest_area(), 0.5, seed);
    std::map<std::size_t, int> on_prop;
    for (const Sitter& sitter : scenario.sitters) ++on_prop[sitter.prop];
    for (const auto& [prop, count] : on_prop) {
      const int seats = scenario.props[prop].kind == PropKind::bench ? 3 : 4;
      beside += count * (count - 1);
      pairs += count * (seats - 1);
    }
  }
  // Half of the neighbors of somebody who sits would sit if all seats were chosen one by one.
  EXPECT_GT(static_cast<double>(beside) / pairs, 0.6);
}

TEST(Sitters, AreWhereThePropIsTurnedAndScaledTo) {
  Scenario scenario;
  scenario.props = {prop_at(PropKind::bench, {10, 5}, EIGEN_PI / 2, 1.1)};
  const Scenario full = seated(scenario, 1, 0);
  ASSERT_EQ(full.sitters.size(), 3U);
  // Its back at y = 0.24 is turned to -x, so that they face +x.
  for (const Sitter& sitter : full.sitters) {
    EXPECT_NEAR(std::cos(sitter.yaw_rad), 1, 1e-9);
    EXPECT_NEAR(sitter.position.x(), 10 - 1.1 * 0.05, 1e-9);
    EXPECT_NEAR(sitter.floor_m, 1.1 * 0.455 - kSeatHeightM, 1e-9);
  }
  scenario.props[0].scale = 2;  // nobody's feet reach the ground
  EXPECT_TRUE(free_seats(scenario).empty());
}

TEST(Sitters, AreInNoWallAndInNoOtherProp) {
  Scenario scenario;
  scenario.props = {prop_at(PropKind::bench, {0, 0})};
  EXPECT_EQ(free_seats(scenario).size(), 3U);
  // Their knees reach to y = -0.4.
  scenario.buildings = {{"wall", {{-5, -1.5}, {5, -1.5}, {5, -0.5}, {-5, -0.5}}}};
  EXPECT_TRUE(free_seats(scenario).empty());
  scenario.buildings[0].footprint = {{-5, -2}, {5, -2}, {5, -1}, {-5, -1}};
  EXPECT_EQ(free_seats(scenario).size(), 3U);
  scenario.props.push_back(prop_at(PropKind::bin, {0.75, -0.6}));
  EXPECT_EQ(free_seats(scenario).size(), 2U);
}

TEST(Sitters, KeepTheirPropsWhereOthersAreThinnedOut) {
  Scenario scenario = seated(rest_area(), 0.5, 3);  // all of its props are scattered
  const auto before = places(scenario);
  std::set<std::size_t> taken;
  for (const Sitter& sitter : scenario.sitters) taken.insert(sitter.prop);
  thin_out(scenario, 0, 1);
  EXPECT_EQ(scenario.props.size(), taken.size());
  EXPECT_EQ(places(scenario), before);
  for (const Sitter& sitter : scenario.sitters) {
    EXPECT_LT((scenario.props.at(sitter.prop).position - sitter.position).norm(), 1.2);
  }
}

/// The square with a bench and these sitters.
nlohmann::json with_bench(const nlohmann::json& sitters) {
  nlohmann::json square = throng::testing::square();
  square.erase("people");
  square["props"] = {{{"kind", "bench"}, {"position", {5, 5}}}};
  square["clutter"] = {{"seed", 1}, {"kinds", {"bench"}}};
  if (!sitters.is_null()) square["sitters"] = sitters;
  return square;
}

TEST(SittersField, SeatsPeopleOnAllPropsButOnlyIfItIsThere) {
  EXPECT_TRUE(parse_scenario(with_bench(nullptr), "s", "s").sitters.empty());
  const Scenario full = parse_scenario(with_bench({{"share", 1}}), "s", "s");
  EXPECT_EQ(full.sitters.size(), free_seats(full).size());
  EXPECT_GE(full.sitters.size(), 3U);
  EXPECT_NE(full.document.find("sitters"), std::string::npos);
}

TEST(SittersField, ReportsWhatIsWrong) {
  const auto refused_at = [](const nlohmann::json& sitters) -> std::string {
    try {
      parse_scenario(with_bench(sitters), "s", "s");
    } catch (const InputError& error) {
      return error.problems().front().where;
    }
    return "nothing";
  };
  EXPECT_EQ(refused_at({{"share", 0.5}, {"seed", 3}}), "nothing");
  EXPECT_EQ(refused_at({{"share", 1.5}}), "/sitters/share");
  EXPECT_EQ(refused_at({{"share", "half"}}), "/sitters/share");
  EXPECT_EQ(refused_at({{"seed", 1}}), "/sitters/share");
  EXPECT_EQ(refused_at({{"share", 0.5}, {"seeds", 3}}), "/sitters/seeds");
}

}  // namespace
}  // namespace throng::world
