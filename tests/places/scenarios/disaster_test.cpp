// Properties of every disaster, on a small square with two doors.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>

#include "crowd/simulation.h"
#include "places/scenarios/blueprint/blocked.h"
#include "places/scenarios/blueprint/blueprint.h"
#include "places/scenarios/blueprint/people.h"
#include "places/scenarios/check/survey.h"
#include "tests/places/scenarios/square.h"
#include "tests/world/temporary_folder.h"
#include "world/fields/read_scenario.h"

namespace throng::scenarios {
namespace {

using nlohmann::json;
using throng::testing::TemporaryFolder;

constexpr double kStartS = 4;

/// A made scenario and what its blueprint says of its people.
struct Made {
  world::Scenario scenario;
  People people;
};

Made build_and_run(const json& blueprint) {
  const TemporaryFolder folder;
  Made made;
  made.scenario = world::load_scenario(
      make_scenario(blueprint, "square.blueprint.json", folder.path(), "sq"), "sq");
  std::vector<Problem> problems;
  const std::string source = "square.blueprint.json";
  made.people = read_people(blueprint, made.scenario, {"", source, problems});
  EXPECT_TRUE(problems.empty());
  return made;
}

/// The crowd of a blueprint; its files are gone when it has been loaded.
crowd::Simulation load_blueprint_crowd(const json& blueprint) {
  const TemporaryFolder folder;
  const world::Scenario scenario = world::load_scenario(
      make_scenario(blueprint, "square.blueprint.json", folder.path(), "sq"), "sq");
  crowd::LoadOptions options;
  options.model = "weidmann";
  return {scenario.scene_file, scenario.behavior_file, options};
}

/// Which states those are in who have noticed something and are on their feet.
std::vector<bool> states_named(const crowd::Simulation& crowd, const std::set<std::string>& names) {
  std::vector<bool> named;
  for (const std::string& name : crowd.state_names()) named.push_back(names.contains(name));
  return named;
}

json disaster(const std::string& kind) {
  return {{"kind", kind},    {"position", {8, 3}},      {"start_s", kStartS},
          {"radius_m", 2.5}, {"growth_mps", 0.8},       {"max_radius_m", 12.4},
          {"noticed_m", 12}, {"notice_growth_mps", 0.5}};
}

class AnyDisaster : public ::testing::TestWithParam<const char*> {
 protected:
  json blueprint_ = [] {
    json blueprint = throng::testing::square();
    blueprint["disasters"] = json::array({disaster(GetParam())});
    return blueprint;
  }();
};

TEST_P(AnyDisaster, ChangesNothingBeforeItStarts) {
  json later = blueprint_;
  later["disasters"][0]["start_s"] = 10'000;
  crowd::Simulation crowd = load_blueprint_crowd(blueprint_);
  crowd::Simulation without = load_blueprint_crowd(later);
  while (crowd.time_s() < kStartS - 1e-6) {
    crowd.step();
    without.step();
    ASSERT_TRUE(std::equal(crowd.positions().begin(), crowd.positions().end(),
                           without.positions().begin(), without.positions().end()))
        << crowd.time_s();
  }
}

/// Looks at those who flee, after each step.
class Fleeing {
 public:
  explicit Fleeing(const Made& made)
      : east_(made.scenario.exits[0]),
        west_(made.scenario.exits[1]),
        discs_(blocked_discs(made.people)) {}

  void look(const crowd::Simulation& crowd, const std::vector<bool>& flees, double before_s) {
    outside_.resize(discs_.size(), std::vector<bool>(crowd.agent_count()));
    last_.resize(crowd.agent_count(), crowd.positions()[0]);
    for (std::size_t i = 0; i < crowd.agent_count(); ++i) {
      const Eigen::Vector2f from = std::exchange(last_[i], crowd.positions()[i]);
      if (crowd.present()[i] == 0 || !flees[crowd.states()[i]]) continue;
      ++looks;
      keeps_out(i, last_[i].cast<double>(), before_s);
      if (passes(west_, from, last_[i])) ++by_west;
      if (!passes(east_, from, last_[i])) continue;
      ++by_east;
      // People in the doorway when it is reached still get out.
      constexpr double kGraceS = 1.5;
      EXPECT_LT(before_s, east_.closes_at_s + kGraceS) << "agent " << i;
    }
  }

  int looks = 0;
  int by_east = 0;
  int by_west = 0;

 private:
  /// People well outside of a disc stay outside, except for a body's radius by which a crowd
  /// may press somebody in. People within or at its edge when it comes walk out.
  void keeps_out(std::size_t agent, const Eigen::Vector2d& at, double before_s) {
    constexpr double kPressedM = 0.2;
    constexpr double kWellM = 1.5;
    for (std::size_t d = 0; d < discs_.size(); ++d) {
      if (before_s < discs_[d].from_s) continue;
      const double away_m = (at - discs_[d].middle).norm() - discs_[d].radius_m;
      EXPECT_FALSE(outside_[d][agent] && away_m < -kPressedM)
          << "agent " << agent << ", disc " << d << ", " << before_s << " s, " << away_m << " m";
      if (away_m > kWellM) outside_[d][agent] = true;
    }
  }

  static bool passes(const world::Exit& exit, const Eigen::Vector2f& from,
                     const Eigen::Vector2f& to) {
    const auto beyond = [&](const Eigen::Vector2f& p) {
      return (p.cast<double>() - exit.middle()).dot(exit.outward) > 0;
    };
    return beyond(to) && !beyond(from) &&
           (to.cast<double>() - exit.middle()).norm() < exit.width_m();
  }

  world::Exit east_;
  world::Exit west_;
  std::vector<BlockedDisc> discs_;
  std::vector<std::vector<bool>> outside_;  // per disc and agent, since the disc is there
  std::vector<Eigen::Vector2f> last_;
};

TEST_P(AnyDisaster, NobodyFleesIntoBlockedGroundOrThroughACoveredDoor) {
  const Made made = build_and_run(blueprint_);
  const bool blocks = std::string(GetParam()) != "attacker";
  ASSERT_EQ(blocked_discs(made.people).size(), blocks ? 6U : 0U);
  ASSERT_EQ(std::isfinite(made.scenario.exits[0].closes_at_s), blocks);
  crowd::Simulation crowd = load_blueprint_crowd(blueprint_);
  const std::vector<bool> flees = states_named(crowd, {"Flee", "Follow"});
  Fleeing fleeing(made);
  while (crowd.time_s() < 36) {
    const double now_s = crowd.time_s();
    crowd.step();
    fleeing.look(crowd, flees, now_s);
  }
  EXPECT_GT(fleeing.looks, 1000) << "people flee for many steps";
  EXPECT_GT(fleeing.by_east + fleeing.by_west, 40);
  EXPECT_GT(fleeing.by_west, 10);
}

TEST_P(AnyDisaster, PeopleWhoHaveNotNoticedCarryOn) {
  json& here = blueprint_["disasters"][0];
  here["position"] = {13, 13};
  here["noticed_m"] = 6;
  here["notice_growth_mps"] = 0;
  here["growth_mps"] = 0;
  here["panic"] = false;
  crowd::Simulation crowd = load_blueprint_crowd(blueprint_);
  const std::vector<bool> alarmed =
      states_named(crowd, {"React", "Flee", "Follow", "Casualty", "Attack", "Search", "Danger"});
  const bool walks = std::string(GetParam()) == "attacker";
  std::vector<bool> near(crowd.agent_count());
  std::vector<Eigen::Vector2f> start(crowd.positions().begin(), crowd.positions().end());
  std::vector<float> max_distance_m(crowd.agent_count());
  std::size_t unaware = 0;
  while (crowd.time_s() < 20) {
    // The avoided agent's own radius counts too; it is agent 0.
    const float reach_m = 6 + crowd.radii_m()[0];
    for (std::size_t i = 1; i < near.size(); ++i) {
      const float away_m = (crowd.positions()[i] - crowd.positions()[0]).norm();
      near[i] = near[i] || (crowd.time_s() > kStartS - 1e-6 && away_m < reach_m);
    }
    crowd.step();
    for (std::size_t i = 1; i < near.size(); ++i) {
      if (crowd.present()[i] == 0 || near[i]) continue;
      ASSERT_FALSE(alarmed[crowd.states()[i]]) << "agent " << i << " at " << crowd.time_s();
      max_distance_m[i] = std::max(max_distance_m[i], (crowd.positions()[i] - start[i]).norm());
    }
  }
  for (std::size_t i = 1; i < near.size(); ++i) unaware += near[i] ? 0 : 1;
  EXPECT_GT(unaware, walks ? 20U : 80U);
  EXPECT_GT(
      std::count_if(max_distance_m.begin(), max_distance_m.end(), [](float m) { return m > 5; }),
      20)
      << "they stroll and cross";
}

INSTANTIATE_TEST_SUITE_P(All, AnyDisaster,
                         ::testing::Values("explosion", "fire", "attacker", "collapse", "gas"),
                         [](const auto& each) { return std::string(each.param); });

/// Casualties, step by step.
struct Hurt {
  double time_s;
  std::size_t agent;
  double away_m;  ///< from the disaster
};

std::vector<Hurt> hurt_by(const json& what, double until_s) {
  json blueprint = throng::testing::square();
  blueprint["disasters"] = json::array({what});
  crowd::Simulation crowd = load_blueprint_crowd(blueprint);
  const std::vector<bool> casualty = states_named(crowd, {"Casualty"});
  std::vector<bool> lies(crowd.agent_count());
  std::vector<Hurt> hurt;
  while (crowd.time_s() < until_s) {
    const double now_s = crowd.time_s();
    crowd.step();
    for (std::size_t i = 1; i < lies.size(); ++i) {
      if (lies[i] || !casualty[crowd.states()[i]]) continue;
      lies[i] = true;
      hurt.push_back({now_s, i, (crowd.positions()[i] - crowd.positions()[0]).norm()});
    }
  }
  return hurt;
}

/// Nobody notices it: people walk on through it.
json unnoticed(const std::string& kind) {
  json what = disaster(kind);
  what["noticed_m"] = 0;
  what["notice_growth_mps"] = 0;
  what["blocked_m"] = 0;
  return what;
}

TEST(FireAndGas, HurtNobodyUnlessTheBlueprintSaysSo) {
  EXPECT_TRUE(hurt_by(unnoticed("fire"), 30).empty());
  EXPECT_TRUE(hurt_by(unnoticed("gas"), 30).empty());
}

TEST(FireAndGas, FlamesHurtWhomTheyReachAsTheySpreadAndAsLongAsTheyBurn) {
  json fire = unnoticed("fire");
  fire["hurts_m"] = 2.5;
  fire["max_radius_m"] = 6;
  const std::vector<Hurt> hurt = hurt_by(fire, 40);
  ASSERT_GT(hurt.size(), 10U);
  for (const Hurt& one : hurt) {
    EXPECT_GE(one.time_s, kStartS - 1e-6);
    const double reach_m = std::min(2.5 + 0.8 * (one.time_s - kStartS), 6.0);
    EXPECT_LT(one.away_m, reach_m + 0.3) << one.time_s;
  }
  const auto within = [&](double from_s, double to_s) {
    return std::count_if(hurt.begin(), hurt.end(), [&](const Hurt& one) {
      return one.time_s >= from_s && one.time_s < to_s;
    });
  };
  EXPECT_GT(within(kStartS - 0.01, kStartS + 0.2), 0) << "who is there when it begins";
  EXPECT_GT(within(kStartS + 1, kStartS + 4.3), 0) << "while it spreads";
  EXPECT_GT(within(kStartS + 5, 40), 0) << "who walks into it later";
}

TEST(FireAndGas, GasHurtsPeopleAfterALongExposure) {
  json gas = unnoticed("gas");
  gas["hurts_m"] = 4;
  gas["hurts_after_s"] = 5;
  const std::vector<Hurt> hurt = hurt_by(gas, 40);
  ASSERT_GT(hurt.size(), 10U);
  for (const Hurt& one : hurt) EXPECT_GE(one.time_s, kStartS + 5 - 0.11);
  gas["hurts_after_s"] = 0;
  const std::vector<Hurt> at_once = hurt_by(gas, 40);
  EXPECT_NEAR(at_once.front().time_s, kStartS, 0.11);
  gas.erase("hurts_after_s");
  EXPECT_TRUE(hurt_by(gas, kStartS + 25).empty()) << "a minute, if the blueprint does not say";
}

TEST(TwoDisasters, ALaterOneChangesNothingBeforeItStarts) {
  // People flee from the first one; the second one's place is free until it starts.
  json blueprint = throng::testing::square();
  json fire = disaster("fire");
  fire["position"] = {0, 14};
  fire["growth_mps"] = 0;
  fire["notice_growth_mps"] = 5;
  json collapse = disaster("collapse");
  collapse["position"] = {19, 0};
  collapse["start_s"] = 16;
  collapse["growth_mps"] = 0;
  blueprint["disasters"] = {fire, collapse};
  const Made made = build_and_run(blueprint);
  EXPECT_TRUE(made.scenario.exits[0].open);
  EXPECT_DOUBLE_EQ(made.scenario.exits[0].closes_at_s, 16);
  EXPECT_EQ(made.scenario.exits[0].goals.size(), 2U) << "people flee by it at first";
  json never = blueprint;
  never["disasters"][1]["start_s"] = 10'000;
  crowd::Simulation crowd = load_blueprint_crowd(blueprint);
  crowd::Simulation without = load_blueprint_crowd(never);
  const auto places = [](const crowd::Simulation& of) {
    return std::vector<Eigen::Vector2f>(of.positions().begin(), of.positions().end());
  };
  while (crowd.time_s() < 16 - 1e-6) {
    crowd.step();
    without.step();
    ASSERT_EQ(places(crowd), places(without)) << crowd.time_s();
  }
  while (crowd.time_s() < 20) {
    crowd.step();
    without.step();
  }
  EXPECT_NE(places(crowd), places(without));
}

TEST(ADisaster, BlocksTheWholeOfItsDiscAndLittleMore) {
  constexpr double kBlockedM = 12;
  constexpr double kBodyM = 0.2;  // middles of people are at least so far from an obstacle
  json blueprint = throng::testing::square();
  json fire = disaster("fire");
  fire["position"] = {0, 0};
  fire["growth_mps"] = 0;
  fire["blocked_m"] = kBlockedM;
  blueprint["disasters"] = json::array({fire});
  const TemporaryFolder folder;
  const LoadedCrowd loaded = load_scenario_crowd(world::load_scenario(
      make_scenario(blueprint, "square.blueprint.json", folder.path(), "sq"), "sq"));
  const auto is_blocked = [&](double radius_m, double angle_rad) {
    const Eigen::Vector2d at(radius_m * std::cos(angle_rad), radius_m * std::sin(angle_rad));
    return loaded.crowd.obstacles.is_solid(at.cast<float>(), kFirstClass);
  };
  for (int i = 0; i < 64; ++i) {
    const double angle_rad = EIGEN_PI * i / 32;
    EXPECT_TRUE(is_blocked(kBlockedM - kBodyM, angle_rad)) << angle_rad;
    EXPECT_FALSE(is_blocked(1.1 * kBlockedM, angle_rad)) << angle_rad;
  }
}

TEST(ADisaster, ShutsADoorWhenItsDiscReachesIt) {
  json blueprint = throng::testing::square();
  json gas = disaster("gas");
  gas["position"] = {12, 0};
  gas["radius_m"] = 2;
  gas["growth_mps"] = 0.5;
  gas["max_radius_m"] = 14;
  blueprint["disasters"] = json::array({gas});
  const Made made = build_and_run(blueprint);
  // The door is 8 m away: the first disc of more than that has 10 m, which the gas has 16 s later.
  EXPECT_DOUBLE_EQ(made.scenario.exits[0].closes_at_s, kStartS + 16);
  EXPECT_TRUE(std::isinf(made.scenario.exits[1].closes_at_s));
  blueprint["disasters"][0]["blocked_m"] = 9;
  EXPECT_DOUBLE_EQ(build_and_run(blueprint).scenario.exits[0].closes_at_s, kStartS);
  blueprint["disasters"][0]["start_s"] = 0;
  EXPECT_FALSE(build_and_run(blueprint).scenario.exits[0].open);
}

}  // namespace
}  // namespace throng::scenarios
