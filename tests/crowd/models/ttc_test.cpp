// The model `ttc`: its law against a gradient taken numerically, and how two people pass each
// other.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "base/compute/random.h"
#include "base/error.h"
#include "crowd/state/model.h"
#include "tests/crowd/crowd_files.h"
#include "tests/crowd/model_scenes.h"

namespace throng::crowd {
namespace {

using Eigen::Vector2d;

constexpr double kStrength = 1.5;
constexpr double kHorizonS = 3;
constexpr double kRelaxationS = 0.3;
constexpr double kTouchM = 0.4;

/// The interaction energy of two discs, in double precision: strength t^-2 exp(-t / horizon) for
/// the time t until they touch, 0 if they never do (Karamouzas, Skinner and Guy 2014).
double energy(const Vector2d& offset, const Vector2d& relative) {
  const double a = relative.squaredNorm();
  const double b = -offset.dot(relative);
  const double root_sq = b * b - a * (offset.squaredNorm() - kTouchM * kTouchM);
  if (a <= 0 || b <= 0 || root_sq <= 0) return 0;
  const double t = (b - std::sqrt(root_sq)) / a;
  return kStrength * std::exp(-t / kHorizonS) / (t * t);
}

Vector2d acceleration(const Vector2d& offset, const Vector2d& relative) {
  constexpr double kStep = 1e-6;  // m
  const auto slope = [&](const Vector2d& along) {
    return (energy(offset + kStep * along, relative) - energy(offset - kStep * along, relative)) /
           (2 * kStep);
  };
  return {-slope({1, 0}), -slope({0, 1})};
}

/// Two who walk towards each other along x, `aside` apart in y.
Simulation meeting(double aside, double dt_s, const std::string& constants) {
  const auto person = [](double x, double y, const char* state) {
    return fmt::format(
        R"(<AgentGroup><ProfileSelector type="const" name="p"/><StateSelector type="const" name="{}"/>
<Generator type="explicit"><Agent p_x="{}" p_y="{}"/></Generator></AgentGroup>)",
        state, x, y);
  };
  const std::string scene = fmt::format(
      R"(<Experiment version="2.0"><SpatialQuery type="kd-tree"/><Common time_step="{}"/>
<TimeToCollision {}/><AgentProfile name="p"><Common r="0.2" pref_speed="1.34" max_speed="2.5" max_accel="1000"
neighbor_dist="20" obstacleSet="1"/></AgentProfile>{}{}</Experiment>)",
      dt_s, constants, person(-6, 0, "East"), person(6, aside, "West"));
  const std::string behavior = R"(<BFSM>
<GoalSet id="0"><Goal id="0" type="point" x="1000" y="0"/><Goal id="1" type="point" x="-1000" y="0"/></GoalSet>
<State name="East" final="0"><GoalSelector type="explicit" goal_set="0" goal="0"/><VelComponent type="goal"/></State>
<State name="West" final="0"><GoalSelector type="explicit" goal_set="0" goal="1"/><VelComponent type="goal"/></State>
</BFSM>)";
  return test::load(scene, behavior, {.model = "ttc"});
}

TEST(Ttc, AcceleratesByTheGradientOfTheEnergy) {
  constexpr double kDt = 0.02;  // the model's own step: nothing is averaged
  Simulation crowd = meeting(0.15, kDt, R"(keep_right="0" caution="0" clearance="0" strength="1.5"
horizon="3" relaxation="0.3")");
  double compared = 0;
  int steps = 0;
  while (crowd.positions()[1].x() - crowd.positions()[0].x() > 0.8F) {
    const Vector2d offset = (crowd.positions()[0] - crowd.positions()[1]).cast<double>();
    const Vector2d velocity = crowd.velocities()[0].cast<double>();
    const Vector2d relative = velocity - crowd.velocities()[1].cast<double>();
    const Vector2d wanted = crowd.preferred_velocity(0).cast<double>();
    crowd.step();
    const Vector2d force = acceleration(offset, relative);
    Vector2d expected = velocity + kDt * ((wanted - velocity) / kRelaxationS + force);
    const double limit = std::max({1.34, velocity.norm()});
    if (expected.norm() > limit) expected *= limit / expected.norm();
    // If the discs would nearly pass each other, the gradient grows without limit, and the model
    // smooths it.
    const double speed_sq = relative.squaredNorm();
    const double toward = -offset.dot(relative);
    const double root_sq = toward * toward - speed_sq * (offset.squaredNorm() - kTouchM * kTouchM);
    if (std::abs(root_sq) < 0.01 * speed_sq) continue;
    ASSERT_LT((crowd.velocities()[0].cast<double>() - expected).norm(),
              2e-4 + 0.02 * kDt * force.norm())
        << crowd.time_s();
    compared = std::max(compared, force.norm());
    ++steps;
  }
  EXPECT_GT(steps, 20);
  EXPECT_GT(compared, 0.3) << "they came near enough to avoid each other";
}

TEST(Ttc, OncomingPeopleAvoidEachOtherEarlyAndGently) {
  for (const double aside : {0.1, 0.3}) {
    Simulation crowd = meeting(aside, 0.1, "");
    double begun_s = -1;
    double hardest = 0;
    Eigen::Vector2f before = crowd.velocities()[0];
    double nearest = 100;
    while (crowd.positions()[0].x() < crowd.positions()[1].x()) {
      crowd.step();
      const Eigen::Vector2f now = crowd.velocities()[0];
      if (crowd.time_s() > 2)
        hardest = std::max(hardest, static_cast<double>((now - before).norm()) / 0.1);
      before = now;
      if (begun_s < 0 && std::abs(now.y()) > 0.03F) begun_s = crowd.time_s();
      nearest = std::min(nearest,
                         static_cast<double>((crowd.positions()[0] - crowd.positions()[1]).norm()));
    }
    EXPECT_GT(crowd.time_s() - begun_s, 1.2) << aside;
    EXPECT_LT(hardest, 1.5) << aside;
    EXPECT_GT(nearest, 0.4) << aside;
  }
}

/// 300 people in a corridor of 4 m with walls, some of them against the others.
Crowd busy_corridor(InstructionSet set) {
  Crowd crowd;
  crowd.instruction_set = set;
  crowd.model_constants = chosen_constants(find_model("ttc"), ConstantsChoice::best, 1);
  Agents& agents = crowd.agents;
  agents.resize(301, 0);
  for (std::size_t i = 0; i < agents.count(); ++i) {
    Random random(5, Stream::crowd_generator, i);
    const auto x = 0.5F * static_cast<float>(i / 8);
    const auto y = 0.25F + 0.5F * static_cast<float>(i % 8);
    agents.position[i] = {x + static_cast<float>(random.uniform(0, 0.1)), y};
    const float way = i % 3 == 0 ? -1.0F : 1.0F;
    agents.preferred_direction[i] = {way, 0};
    agents.preferred_speed[i] = 1.3F;
    agents[Property::pref_speed][i] = 1.3F;
    agents[Property::radius][i] = 0.17F;
    agents[Property::max_neighbors][i] = 10;
    agents[Property::max_speed][i] = 2.5F;
    agents[Property::neighbor_dist][i] = 8;
    agents.obstacle_mask[i] = 1;
    agents.velocity[i] = {way * static_cast<float>(random.uniform(0, 1.3)), 0};
    agents.present[i] = 1;
  }
  using Corners = std::vector<Eigen::Vector2f>;
  crowd.obstacles.add_polygon(Corners{{-5, -1}, {40, -1}, {40, 0}, {-5, 0}}, 1);
  crowd.obstacles.add_polygon(Corners{{-5, 4}, {40, 4}, {40, 5}, {-5, 5}}, 1);
  crowd.obstacles.build();
  return crowd;
}

std::vector<Eigen::Vector2f> velocities(const Crowd& crowd) {
  Grid grid(crowd.instruction_set);
  grid.build(crowd.agents);
  std::vector<Eigen::Vector2f> result(crowd.agents.count(), Eigen::Vector2f::Zero());
  find_model("ttc").make(crowd)->step(crowd, grid, result);
  return result;
}

TEST(Ttc, EveryInstructionSetGivesTheSameBits) {
  const auto baseline = velocities(busy_corridor(InstructionSet::baseline));
  EXPECT_EQ(baseline, velocities(busy_corridor(best_instruction_set())));
  EXPECT_NE(baseline, std::vector<Eigen::Vector2f>(301, Eigen::Vector2f::Zero()));
}

TEST(Ttc, NeighborsInTheBatchDoNotMatter) {
  // The last agents of the grid are computed in a batch that is not full.
  Crowd crowd = busy_corridor(best_instruction_set());
  const auto all = velocities(crowd);
  // People far away change the batches, but nobody's surroundings.
  for (std::size_t i = 0; i < 3; ++i) crowd.agents.position[i] += Eigen::Vector2f(0, 500);
  const auto fewer = velocities(crowd);
  for (std::size_t i = 200; i < 301; ++i) EXPECT_EQ(all[i], fewer[i]) << i;
}

TEST(Constants, OfThePosteriorFollowTheSeed) {
  const ModelEntry& ttc = find_model("ttc");
  const auto best = chosen_constants(ttc, ConstantsChoice::best, 1);
  const auto first = chosen_constants(ttc, ConstantsChoice::posterior, 1);
  EXPECT_EQ(first, chosen_constants(ttc, ConstantsChoice::posterior, 1));
  EXPECT_NE(first, best);
  std::set<std::vector<float>> draws;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    draws.insert(chosen_constants(ttc, ConstantsChoice::posterior, seed));
  }
  EXPECT_GT(draws.size(), 20U) << "many different draws";
  for (const auto& draw : draws) {
    for (std::size_t i = 0; i < draw.size(); ++i) {
      EXPECT_GE(draw[i], ttc.constants[i].min) << ttc.constants[i].name;
      EXPECT_LE(draw[i], ttc.constants[i].max) << ttc.constants[i].name;
      EXPECT_NEAR(draw[i], best[i], 0.5F * best[i]) << ttc.constants[i].name;
    }
  }
}

TEST(Constants, OfModelsThatWereNotFittedAreRefused) {
  EXPECT_THROW(chosen_constants(find_model("orca"), ConstantsChoice::posterior, 1), InputError);
  EXPECT_THROW(chosen_constants(find_model("helbing"), ConstantsChoice::conservative, 1),
               InputError);
  EXPECT_NO_THROW(chosen_constants(find_model("orca"), ConstantsChoice::best, 1));
}

/// A polygon of `sides` around the origin; a side, not a corner, faces the x axis if `turned`.
std::string column(int sides, double radius_m, bool turned) {
  std::string vertices;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * M_PI * (i + (turned ? 0.5 : 0)) / sides;
    vertices += fmt::format(R"(<Vertex p_x="{}" p_y="{}"/>)", radius_m * std::cos(angle),
                            radius_m * std::sin(angle));
  }
  return R"(<ObstacleSet type="explicit" class="1"><Obstacle closed="1">)" + vertices +
         "</Obstacle></ObstacleSet>";
}

// The way leads through the middle of a column; which side one takes depends on the seed.
TEST(Ttc, PeoplePassAColumnThatIsExactlyInTheirWay) {
  std::set<bool> sides_taken;
  for (const int sides : {4, 8, 12, 16, 32}) {
    for (const double radius_m : {0.3, 0.6, 1.0, 2.0}) {
      for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        Simulation crowd = test::load(
            test::model_scene(test::agent_at(-5, 0), "", column(sides, radius_m, seed % 2 == 1)),
            test::to_point_behavior(6, 0), {.seed = seed, .model = "ttc"});
        double y_at_column = 0;
        for (int i = 0; i < 180; ++i) {
          crowd.step();
          if (crowd.positions()[0].x() < 0) y_at_column = crowd.positions()[0].y();
        }
        EXPECT_GT(crowd.positions()[0].x(), 5.5)
            << sides << " sides, " << radius_m << " m, seed " << seed;
        sides_taken.insert(y_at_column > 0);
      }
    }
  }
  EXPECT_EQ(sides_taken.size(), 2U) << "always the same side";
}

TEST(Ttc, BodiesAreKeptApartUnlessTheUserSaysOtherwise) {
  const auto mode = [](const LoadOptions& options) {
    return test::load(test::model_crowd_scene(4), test::to_point_behavior(5, 4), options)
        .options()
        .separation;
  };
  EXPECT_EQ(mode({.model = "ttc"}), BodySeparation::hard);
  EXPECT_EQ(mode({.model = "ttc", .separation = BodySeparation::soft}), BodySeparation::soft);
  EXPECT_EQ(mode({.model = "ttc", .compat = Compat::menge}), BodySeparation::soft);
  EXPECT_EQ(mode({.model = "orca"}), BodySeparation::soft);
}

}  // namespace
}  // namespace throng::crowd
