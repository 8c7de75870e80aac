#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "base/error.h"
#include "places/scenarios/blueprint/load_scenario.h"
#include "sim/run.h"
#include "tests/places/scenarios/square.h"
#include "tests/world/temporary_folder.h"
#include "world/stand_departures.h"
#include "world/trace.h"

namespace throng::sim {
namespace {

using Eigen::Vector2d;
using nlohmann::json;
using throng::testing::TemporaryFolder;
using world::AgentRole;

/// A stand of 20 m beside some people who wait.
json blueprint(int count, double leave_at_s = -1) {
  json square = throng::testing::square();
  square["people"] = {{"lines", {{{"from", {10, 12}}, {"to", {12, 12}}, {"count", 3}}}}};
  json spectators = {{"count", count}, {"seed", 4}};
  if (leave_at_s >= 0) spectators["leave_at_s"] = leave_at_s;
  square["stands"] = {{{"id", "main"},
                       {"from", {-10, -8}},
                       {"to", {10, -8}},
                       {"rows", 6},
                       {"front_height_m", 0.5},
                       {"spectators", spectators}}};
  return square;
}

world::Scenario load_square(const json& square) {
  const TemporaryFolder folder;
  return scenarios::load_scenario(folder.write("s.blueprint.json", square.dump()), "s");
}

world::Trace simulate_trace(const world::Scenario& scenario, double duration_s,
                            std::uint64_t seed = 7) {
  RunSpec spec;
  spec.seed = seed;
  spec.duration_s = duration_s;
  const TemporaryFolder folder;
  simulate(scenario, spec, folder.path() / "run.h5");
  return world::read_trace(folder.path() / "run.h5");
}

std::string state_at(const world::Trace& trace, std::size_t step, std::size_t agent) {
  return trace.header.state_names[trace.state[trace.at(step, agent)]];
}

TEST(Spectators, FollowTheCrowdAndSitOnTheirSeats) {
  const world::Scenario scenario = load_square(blueprint(60));
  const world::Trace trace = simulate_trace(scenario, 3);
  ASSERT_EQ(trace.agents(), 3U + 60);
  const auto& roles = trace.header.role;
  EXPECT_EQ(std::count(roles.begin(), roles.begin() + 3, AgentRole::person), 3);
  EXPECT_EQ(std::count(roles.begin() + 3, roles.end(), AgentRole::spectator), 60);
  const std::vector<world::Seat> seats = world::seats(scenario.stands[0]);
  const std::vector<std::size_t> taken = world::taken_seats(scenario.stands[0], seats);
  int sitting = 0;
  for (std::size_t i = 0; i < taken.size(); ++i) {
    const Vector2d place = trace.position[trace.at(0, 3 + i)].cast<double>();
    const bool sits = state_at(trace, 0, 3 + i) == "sitting";
    sitting += sits ? 1 : 0;
    // People who stand are 0.3 m ahead of the seat, toward the field.
    const Vector2d expected = seats[taken[i]].position + Vector2d(0, sits ? 0 : 0.3);
    EXPECT_LT((place - expected).norm(), 1e-4) << i;
    EXPECT_NEAR(trace.yaw_rad[trace.at(0, 3 + i)], EIGEN_PI / 2, 0.15);
    EXPECT_TRUE(trace.present(0, 3 + i));
  }
  EXPECT_GE(sitting, 48);
  EXPECT_LT(sitting, 60);
}

TEST(Spectators, GetUpAndCheerTogetherNowAndThen) {
  const world::Trace trace = simulate_trace(load_square(blueprint(190)), 32);
  std::size_t peak_step = 0;
  int most = 0;
  double first_s = -1;
  for (std::size_t step = 0; step < trace.steps(); ++step) {
    int up = 0;
    for (std::size_t agent = 3; agent < trace.agents(); ++agent) {
      up += state_at(trace, step, agent) != "sitting" ? 1 : 0;
    }
    if (up > most) {
      most = up;
      peak_step = step;
    }
    if (up > 100 && first_s < 0) first_s = trace.time_s[step];
  }
  EXPECT_GE(first_s, 5);
  EXPECT_LE(first_s, 15 + 1.5);
  EXPECT_NEAR(most, 0.72 * 190, 30);
  int cheering = 0;
  for (std::size_t agent = 3; agent < trace.agents(); ++agent) {
    cheering += state_at(trace, peak_step, agent) == "cheering" ? 1 : 0;
  }
  EXPECT_NEAR(cheering, 0.49 * 190, 30);
  // They move with the posture, and no faster than people get up.
  for (std::size_t step = 1; step < trace.steps(); ++step) {
    for (std::size_t agent = 3; agent < trace.agents(); ++agent) {
      const float moved =
          (trace.position[trace.at(step, agent)] - trace.position[trace.at(step - 1, agent)])
              .norm();
      ASSERT_LT(moved, 0.07F);
    }
  }
}

TEST(Spectators, FollowTheSeedAndChangeNobodyElse) {
  const world::Scenario with = load_square(blueprint(60));
  const world::Trace trace = simulate_trace(with, 20);
  EXPECT_EQ(simulate_trace(with, 20).state, trace.state);
  EXPECT_NE(simulate_trace(with, 20, 8).state, trace.state);
  json square = blueprint(60);
  square["stands"][0].erase("spectators");
  const world::Trace without = simulate_trace(load_square(square), 20);
  ASSERT_EQ(without.agents(), 3U);
  for (std::size_t step = 0; step < trace.steps(); ++step) {
    for (std::size_t agent = 0; agent < 3; ++agent) {
      ASSERT_EQ(trace.position[trace.at(step, agent)], without.position[without.at(step, agent)]);
      ASSERT_EQ(trace.yaw_rad[trace.at(step, agent)], without.yaw_rad[without.at(step, agent)]);
    }
  }
}

TEST(Sitters, SitForTheWholeRunWithoutAnyStand) {
  json square = blueprint(0);
  square.erase("stands");
  square["props"] = {{{"kind", "bench"}, {"position", {-8, 8}}, {"yaw_deg", 180}},
                     {{"kind", "beer_table"}, {"position", {-3, 8}}}};
  const world::Trace without = simulate_trace(load_square(square), 20);
  square["sitters"] = {{"share", 1}, {"seed", 2}};
  const world::Scenario scenario = load_square(square);
  const world::Trace trace = simulate_trace(scenario, 20);
  ASSERT_EQ(without.agents(), 3U);
  ASSERT_EQ(scenario.sitters.size(), 9U);
  ASSERT_EQ(trace.agents(), 3U + 9);
  EXPECT_GT(trace.header.group[3],
            *std::max_element(without.header.group.begin(), without.header.group.end()));
  for (std::size_t i = 0; i < 9; ++i) {
    const world::Sitter& sitter = scenario.sitters[i];
    EXPECT_EQ(trace.header.role[3 + i], AgentRole::spectator);
    // Neighbors are a group, numbered after the crowd's.
    EXPECT_EQ(trace.header.group[3 + i] - trace.header.group[3], static_cast<int>(sitter.prop));
    for (std::size_t step = 0; step < trace.steps(); ++step) {
      const std::size_t at = trace.at(step, 3 + i);
      ASSERT_TRUE(trace.present(step, 3 + i));
      ASSERT_EQ(state_at(trace, step, 3 + i), "sitting");
      ASSERT_LT((trace.position[at].cast<double>() - sitter.position).norm(), 1e-4);
      ASSERT_GT(std::cos(static_cast<double>(trace.yaw_rad[at]) - sitter.yaw_rad), 0.98);
      ASSERT_EQ(trace.velocity[at].norm(), 0);
    }
  }
  for (std::size_t step = 0; step < trace.steps(); ++step) {
    for (std::size_t agent = 0; agent < 3; ++agent) {
      ASSERT_EQ(trace.position[trace.at(step, agent)], without.position[without.at(step, agent)]);
    }
  }
}

TEST(Departures, ComeToTheFeetOneAfterTheOther) {
  const world::Stand stand = load_square(blueprint(100, 5)).stands[0];
  const std::vector<world::Departure> all = world::departures(stand);
  ASSERT_EQ(all.size(), 100U);
  const std::vector<world::Seat> seats = world::seats(stand);
  const std::vector<std::size_t> taken = world::taken_seats(stand, seats);
  const std::vector<world::Aisle> aisles = world::aisles(stand);
  std::set<std::size_t> gone;
  std::map<std::size_t, double> last_s;
  for (const world::Departure& departure : all) {
    gone.insert(departure.spectator);
    const world::Seat& seat = seats[taken[departure.spectator]];
    const world::WayDown way(stand, seat, aisles[departure.aisle]);
    EXPECT_GE(departure.rises_s, 5 + 1 - 1e-9);
    EXPECT_NEAR(departure.at_foot_s - departure.rises_s, way.duration_s(), 1e-9);
    const auto [before, is_first] = last_s.try_emplace(departure.aisle, departure.at_foot_s);
    if (!is_first) {
      EXPECT_GE(departure.at_foot_s - before->second, 0.9 - 1e-9);
      before->second = departure.at_foot_s;
    }
    EXPECT_TRUE(way.at(0).position.isApprox(seat.position));
    EXPECT_NEAR(way.at(1e6).position.y(), -8 + 0.6, 1e-9);
    for (double time_s = 1.2; time_s < way.duration_s(); time_s += 0.25) {
      EXPECT_LE(way.at(time_s).velocity.norm(), 0.71);
    }
  }
  EXPECT_EQ(gone.size(), 100U);
}

TEST(Spectators, LeaveAsTheSamePeople) {
  const world::Scenario scenario = load_square(blueprint(60, 12));  // as some cheer
  const world::Trace trace = simulate_trace(scenario, 80);
  ASSERT_EQ(trace.agents(), 63U);
  const std::vector<world::Departure> all = world::departures(scenario.stands[0]);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::size_t agent = 3 + i;
    EXPECT_EQ(trace.header.role[agent], AgentRole::person);
    EXPECT_TRUE(trace.present(0, agent));
    std::size_t step = 0;
    const auto at_foot = static_cast<std::size_t>(all[i].at_foot_s / 0.1);
    // On the stand until the foot, without jumps.
    while (step + 1 < trace.steps() && trace.time_s[step] < all[i].at_foot_s - 0.05) {
      ASSERT_TRUE(trace.present(step, agent));
      ASSERT_THAT(world::kStandStates, ::testing::Contains(state_at(trace, step, agent)));
      ASSERT_EQ(trace.exit_intent[trace.at(step, agent)], -1);
      ++step;
      ASSERT_LT((trace.position[trace.at(step, agent)] - trace.position[trace.at(step - 1, agent)])
                    .norm(),
                step + 2 < at_foot ? 0.1F : 0.3F);  // at last the crowd takes a step of its own
    }
    const std::size_t later = std::min(step + 20, trace.steps() - 1);
    EXPECT_THAT(world::kStandStates,
                ::testing::Not(::testing::Contains(state_at(trace, later, agent))))
        << agent << " at " << trace.time_s[later];
  }
  const auto escapes =
      std::count_if(trace.events.begin(), trace.events.end(), [](const world::TraceEvent& event) {
        return std::holds_alternative<world::AgentEscaped>(event.kind);
      });
  EXPECT_GT(escapes, 40);
}

TEST(Spectators, NeedFreeGroundToLeave) {
  json square = blueprint(30, 2);
  square["buildings"].push_back({{"id", "kiosk"},
                                 {"footprint", {{-11, -7.8}, {11, -7.8}, {11, -6}, {-11, -6}}},
                                 {"height_m", 3}});
  try {
    load_square(square);
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().front().where, "/stands/0");
  }
}

}  // namespace
}  // namespace throng::sim
