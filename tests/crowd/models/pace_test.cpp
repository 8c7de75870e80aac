// How people of the model `weidmann` slow down where it is crowded ahead.
#include "crowd/models/pace.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "crowd/spatial/grid.h"
#include "tests/crowd/crowd_files.h"

namespace throng::crowd {
namespace {

/// Agent 0 at the origin, heading for +x, among others.
class PaceOf {
 public:
  explicit PaceOf(const std::vector<Eigen::Vector2f>& others, float max_neighbors = 10) {
    Agents& agents = crowd_.agents;
    agents.resize(1 + others.size(), 0);
    for (std::size_t i = 0; i < agents.count(); ++i) {
      agents.position[i] = i == 0 ? Eigen::Vector2f(0, 0) : others[i - 1];
      agents.preferred_direction[i] = {1, 0};
      agents.present[i] = 1;
      agents[Property::neighbor_dist][i] = 5;
      agents[Property::max_neighbors][i] = max_neighbors;
    }
    grid_.build(agents);
    crowd_.obstacles.build();
  }

  float density(InstructionSet set = best_instruction_set()) { return look(set).along; }
  /// Has somebody's way be along -x.
  void turn_round(std::size_t other) { crowd_.agents.preferred_direction[other] = {-1, 0}; }
  SpeedRegulation regulation() {
    const Pace::Ahead ahead = look(best_instruction_set());
    return pace_.regulation(batch_.view(0), ahead);
  }
  float share() { return regulation().share; }

 private:
  Pace::Ahead look(InstructionSet set) {
    Neighborhood neighborhood(crowd_);
    neighborhood.prepare(crowd_, grid_);
    std::size_t slot = 0;
    while (grid_.id(slot) != 0) ++slot;
    const AgentView around = neighborhood.look(crowd_, grid_, slot);
    std::vector<Eigen::Vector2f> directions;
    for (std::size_t i = 0; i < grid_.size(); ++i) {
      directions.push_back(crowd_.agents.preferred_direction[grid_.id(i)]);
    }
    LaneBatch agents(around.neighbors.size());
    agents.add(slot, around.neighbors);
    agents.fill();
    batch_.set(0, pace_.view(crowd_, grid_, around));
    PaceBatch::kernel(set)(grid_, directions, agents, batch_);
    return batch_.ahead(0);
  }

  Crowd crowd_;
  Grid grid_;
  Pace pace_{PaceSpec{}};
  PaceBatch batch_;
};

std::vector<Eigen::Vector2f> crowd_on_lattice(float spacing) {
  std::vector<Eigen::Vector2f> places;
  for (int i = -12; i <= 12; ++i) {
    for (int k = -12; k <= 12; ++k) {
      const float shift = k % 2 == 0 ? 0 : 0.5F;  // rows apart, as in a crowd
      if (i != 0 || k != 0)
        places.emplace_back(spacing * (static_cast<float>(i) + shift),
                            spacing * static_cast<float>(k));
    }
  }
  return places;
}

TEST(Pace, IsFreeWhereNobodyIsAhead) {
  EXPECT_EQ(PaceOf({}).share(), 1);
  EXPECT_EQ(PaceOf({{-0.5F, 0}, {-1, 0.3F}, {0, 0.6F}}).share(), 1) << "behind and beside";
  EXPECT_EQ(PaceOf({{1.75F, 0}}).share(), 1) << "out of reach";
}

TEST(Pace, FallsWithNearness) {
  EXPECT_LT(PaceOf({{1, 0}}).share(), 1);
  EXPECT_LT(PaceOf({{0.5F, 0}}).share(), PaceOf({{1, 0}}).share());
  EXPECT_LT(PaceOf({{1, 0}}).share(), PaceOf({{0.5F, 0.866F}}).share()) << "aside counts less";
}

TEST(Pace, MeasuresTheDensityOfACrowd) {
  for (const float spacing : {1.0F, 0.7F, 0.5F}) {
    const float density = 1 / (spacing * spacing);
    EXPECT_NEAR(PaceOf(crowd_on_lattice(spacing), 60).density(), density, 0.25F * density);
    EXPECT_NEAR(PaceOf(crowd_on_lattice(spacing)).density(), density, 0.35F * density)
        << "also where only ten others are minded";
  }
}

TEST(Pace, EveryInstructionSetGivesTheSameBits) {
  for (const float spacing : {0.4F, 0.8F}) {
    PaceOf crowd(crowd_on_lattice(spacing), 60);
    EXPECT_EQ(crowd.density(InstructionSet::baseline), crowd.density());
  }
}

TEST(Pace, LeavesALittleInAJam) {
  const float share = PaceOf(crowd_on_lattice(0.3F), 60).share();
  EXPECT_EQ(share, PaceSpec{}.min_speed_share);
  EXPECT_GT(share, 0);
}

TEST(Pace, KeepsRightOfOncomingPeopleAndLooksFartherAhead) {
  PaceOf meeting({{1, 0}});
  const SpeedRegulation behind = meeting.regulation();
  EXPECT_EQ(behind.direction.y(), 0);
  EXPECT_LT(behind.horizon_share, 1);
  meeting.turn_round(1);
  const SpeedRegulation regulation = meeting.regulation();
  EXPECT_EQ(regulation.share, 1) << "nobody goes the same way";
  EXPECT_EQ(regulation.horizon_share, 1);
  EXPECT_LT(regulation.direction.y(), -0.1F);
  EXPECT_NEAR(regulation.direction.norm(), 1, 1e-6);
  EXPECT_GE(regulation.direction.x(), std::cos(1.0F) - 1e-3F);
}

TEST(Pace, KeepsItsHeadwayInSingleFileOnly) {
  // Two in file, 0.8 m apart; the free speed is 1.3 m/s.
  const auto second_speed = [](double corridor_m) {
    const double half = corridor_m / 2;
    const auto wall = [](double low, double high) {
      return fmt::format(
          R"(<Obstacle closed="1"><Vertex p_x="-5" p_y="{0}"/><Vertex p_x="9" p_y="{0}"/><Vertex p_x="9" p_y="{1}"/><Vertex p_x="-5" p_y="{1}"/></Obstacle>)",
          low, high);
    };
    Simulation crowd = test::load(
        test::scene_with(test::agent_at(0.8, 0) + test::agent_at(0, 0), R"(pref_speed="1.3")",
                         "Start",
                         R"(<ObstacleSet type="explicit" class="1">)" + wall(-half - 1, -half) +
                             wall(half, half + 1) + "</ObstacleSet>"),
        R"(<BFSM><State name="Start" final="0"><VelComponent type="const_dir" x="1" y="0"/></State></BFSM>)",
        {.model = "weidmann"});
    for (int i = 0; i < 3; ++i) crowd.step();
    return crowd.velocities()[1].x();
  };
  EXPECT_LT(second_speed(0.8), second_speed(1.6) - 0.1F);
  EXPECT_EQ(second_speed(1.6), second_speed(3));
}

TEST(Pace, HoldsForTheModelOnly) {
  // Two in file; the one behind would run into the other's density.
  const auto second_speed = [](const std::string& model) {
    Simulation crowd = test::load(
        test::scene_with(test::agent_at(0.8, 0) + test::agent_at(0, 0), R"(pref_speed="1.3")"),
        R"(<BFSM><State name="Start" final="0"><VelComponent type="const_dir" x="1" y="0"/></State></BFSM>)",
        {.model = model});
    for (int i = 0; i < 8; ++i) crowd.step();  // as fast as max_accel lets them be
    return crowd.velocities()[1].x();
  };
  EXPECT_LT(second_speed("weidmann"), second_speed("orca") - 0.02F);
}

}  // namespace
}  // namespace throng::crowd
