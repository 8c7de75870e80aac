#include "sim/run.h"
#include "base/files/resources.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.h"
#include "base/files/hash.h"
#include "places/scenarios/blueprint/load_scenario.h"
#include "spec/skinning/styling.h"
#include "tests/places/scenarios/square.h"
#include "tests/world/temporary_folder.h"
#include "world/trace.h"

namespace throng::sim {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::ElementsAreArray;
using throng::testing::TemporaryFolder;
using world::AgentRole;

constexpr int kPeopleInSquare = 260;

const world::Scenario& city_square() {
  static const world::Scenario scenario =
      scenarios::find_scenario(source_folder() / "scenarios", "city_square/nearest_exit");
  return scenario;
}

RunSpec short_run() {
  RunSpec spec;
  spec.seed = 7;
  spec.duration_s = 4;
  DroneMission mission;
  mission.id = "d1";
  mission.policy = "waypoints";
  mission.waypoints = {{4, -10, 25}, {4, 0, 20}};
  spec.drones = {mission};
  return spec;
}

world::Trace simulate_trace(const RunSpec& spec) {
  const TemporaryFolder folder;
  simulate(city_square(), spec, folder.path() / "run.h5");
  return world::read_trace(folder.path() / "run.h5");
}

TEST(Run, SpeaksOfABlueprintNotOfItsCrowd) {
  nlohmann::json square = throng::testing::square();
  square["people"] = {{"lines", {{{"from", {10, 22}}, {"to", {12, 22}}, {"count", 3}}}}};
  const TemporaryFolder folder;
  const fs::path file = folder.write("square.blueprint.json", square.dump());
  const world::Scenario scenario = scenarios::load_scenario(file, "square");
  RunSpec spec;
  spec.duration_s = 0.5;
  for (const Problem& warning : simulate(scenario, spec, folder.path() / "run.h5")) {
    EXPECT_EQ(warning.text().find("built in code"), std::string::npos) << warning.text();
  }
  spec.drones = {short_run().drones[0]};
  spec.drones[0].moves_goal = world::GoalRef{7, 7};
  try {
    simulate(scenario, spec, folder.path() / "run.h5");
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    const Problem& problem = error.problems().front();
    EXPECT_EQ(problem.where, "/drones/0/moves_goal");
    EXPECT_EQ(problem.expected.find("behavior file"), std::string::npos) << problem.expected;
  }
}

TEST(Run, SaysWhichModelMovedThePeople) {
  RunSpec spec = short_run();
  spec.duration_s = 0.2;
  EXPECT_EQ(simulate_trace(spec).header.crowd,
            (world::CrowdOrigin{"orca", "none", false, "best", 1, false, 20}));
  spec.crowd.model = "helbing";
  spec.crowd.compat = crowd::Compat::menge;
  spec.crowd.separation = crowd::BodySeparation::hard;
  spec.crowd.compliance = 0.5;
  spec.crowd.physical = {true, 35};
  EXPECT_EQ(simulate_trace(spec).header.crowd,
            (world::CrowdOrigin{"helbing", "menge", true, "best", 0.5, true, 35}));
}

TEST(Run, RecordsTheWholeDurationOfCrowdAndDrone) {
  const RunSpec spec = short_run();
  const world::Trace trace = simulate_trace(spec);
  EXPECT_EQ(trace.header.scenario_id, "city_square/nearest_exit");
  EXPECT_EQ(trace.header.seed, 7U);
  EXPECT_THAT(trace.header.drone_ids, ElementsAre("d1"));
  EXPECT_THAT(trace.header.exit_ids, ElementsAre("exit1", "exit2", "exit3", "exit4", "exit5"));
  ASSERT_EQ(trace.agents(), kPeopleInSquare + 1U);
  EXPECT_EQ(std::count(trace.header.role.begin(), trace.header.role.end(), AgentRole::person),
            kPeopleInSquare);
  EXPECT_EQ(trace.header.role[260], AgentRole::disaster);

  EXPECT_EQ(trace.time_s.front(), 0);
  EXPECT_NEAR(trace.duration_s(), spec.duration_s, 1e-9);
  const auto& drone = trace.drones.at(0);
  EXPECT_EQ(drone.front().time_s, 0);
  EXPECT_EQ(drone.front().position, city_square().drones[0].position);
  EXPECT_NEAR(drone.back().time_s, spec.duration_s, 1e-9);
  for (std::size_t i = 1; i < drone.size(); ++i) {
    EXPECT_NEAR(drone[i].time_s - drone[i - 1].time_s, 1 / 60.0, 1e-6);
  }
}

TEST(Run, DoesNotEndEarlyWhenTheDurationIsNoMultipleOfTheStep) {
  RunSpec spec = short_run();
  spec.duration_s = 0.35;
  EXPECT_GE(simulate_trace(spec).duration_s(), 0.35);
}

TEST(Run, SameSpecGivesTheSameBytesOnAnyNumberOfThreads) {
  const TemporaryFolder folder;
  std::set<std::string> hashes;
  for (const std::size_t threads : {1, 1, 2, 8}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    simulate(city_square(), short_run(), folder.path() / "run.h5");
    hashes.insert(sha256_hex_of_file(folder.path() / "run.h5"));
  }
  EXPECT_EQ(hashes.size(), 1U);
}

/// The events of a run of a shipped scenario, and its header.
struct RecordingObserver : public RunObserver {
  void begin(const world::TraceHeader& recorded) override { header = recorded; }
  void step(const world::CrowdStep& step) override { steps.push_back(step); }
  void event(const world::TraceEvent& event) override { events.push_back(event); }

  world::TraceHeader header;
  std::vector<world::CrowdStep> steps;
  std::vector<world::TraceEvent> events;
};

void watch(const world::Scenario& scenario, double duration_s, RecordingObserver& recorded) {
  RunSpec spec;
  spec.duration_s = duration_s;
  simulate(scenario, spec, recorded);
}

TEST(Run, AnAttackerIsDrawnWalksAndEscapesInNoFigure) {
  world::Scenario street =
      scenarios::find_scenario(source_folder() / "scenarios", "shopping_street/emergency");
  // So small that he is outside of it as soon as he walks.
  street.inside.bounds = {{4, -1}, {6, 1}};
  RecordingObserver recorded;
  watch(street, 6, recorded);
  ASSERT_EQ(recorded.header.role.at(0), AgentRole::attacker);
  EXPECT_EQ(std::count(recorded.header.role.begin(), recorded.header.role.end(), AgentRole::person),
            static_cast<std::ptrdiff_t>(recorded.header.role.size()) - 1);
  EXPECT_EQ(recorded.steps.back().flags.at(0) & world::kPresent, world::kPresent);
  EXPECT_FALSE(street.inside.contains(recorded.steps.back().position.at(0).cast<double>()));
  int others = 0;
  for (const world::TraceEvent& event : recorded.events) {
    const auto* escaped = std::get_if<world::AgentEscaped>(&event.kind);
    if (escaped == nullptr) continue;
    EXPECT_NE(escaped->agent, 0);
    ++others;
  }
  EXPECT_GT(others, 0);
}

TEST(Run, TellsWhenADisasterReachesADoor) {
  world::Scenario square = city_square();
  square.exits[1].closes_at_s = 1.25;
  square.exits[2].open = false;
  square.exits[3].closes_at_s = 2;
  RecordingObserver recorded;
  watch(square, 3, recorded);
  std::vector<std::pair<double, std::int32_t>> closed;
  for (const world::TraceEvent& event : recorded.events) {
    const auto* exit = std::get_if<world::ExitClosed>(&event.kind);
    if (exit != nullptr) closed.emplace_back(event.time_s, exit->exit);
  }
  ASSERT_EQ(closed.size(), 2U);
  EXPECT_NEAR(closed[0].first, 1.3, 0.06) << "the first step from then on";
  EXPECT_EQ(closed[0].second, 1);
  EXPECT_NEAR(closed[1].first, 2, 1e-9);
  EXPECT_EQ(closed[1].second, 3);
}

TEST(Run, AnotherSeedGivesAnotherRun) {
  RunSpec spec = short_run();
  const world::Trace one = simulate_trace(spec);
  spec.seed = 8;
  EXPECT_NE(one.position, simulate_trace(spec).position);
}

TEST(Run, FewerPeopleAreDrawnFromAll) {
  const auto people_of = [](const world::Trace& trace) {
    std::set<std::size_t> people;
    for (std::size_t i = 0; i < trace.agents(); ++i) {
      if (trace.header.role[i] == AgentRole::person) people.insert(i);
    }
    return people;
  };
  RunSpec spec = short_run();
  spec.duration_s = 0.1;
  spec.people = 60;
  const auto sixty = people_of(simulate_trace(spec));
  EXPECT_EQ(sixty.size(), 60U);
  spec.people = 20;
  const auto twenty = people_of(simulate_trace(spec));
  EXPECT_EQ(twenty.size(), 20U);
  EXPECT_TRUE(std::includes(sixty.begin(), sixty.end(), twenty.begin(), twenty.end()));
  spec.seed = 8;
  EXPECT_NE(people_of(simulate_trace(spec)), twenty);
  spec.people = 0;
  EXPECT_TRUE(people_of(simulate_trace(spec)).empty());
}

// A hundred people and half a minute: the news spreads and people run.
class Evacuation : public ::testing::Test {
 protected:
  static RunSpec spec() {
    RunSpec spec;
    spec.seed = 3;
    spec.duration_s = 50;
    spec.people = 100;
    DroneMission mission;
    mission.id = "d1";
    spec.drones = {mission};
    return spec;
  }
  static const world::Trace& trace() {
    static const world::Trace recorded = simulate_trace(spec());
    return recorded;
  }
};

TEST_F(Evacuation, PeopleGetAwayAndEachOnce) {
  std::set<int> escaped;
  for (const world::TraceEvent& event : trace().events) {
    const auto* escape = std::get_if<world::AgentEscaped>(&event.kind);
    if (escape == nullptr) continue;
    EXPECT_TRUE(escaped.insert(escape->agent).second);
    const auto agent = static_cast<std::size_t>(escape->agent);
    EXPECT_EQ(trace().header.role[agent], AgentRole::person);
    const auto step = static_cast<std::size_t>(std::lround(event.time_s / trace().header.dt_s));
    const auto inside = [&](std::size_t at) {
      return city_square().inside.contains(trace().position[trace().at(at, agent)].cast<double>());
    };
    EXPECT_FALSE(inside(step));
    EXPECT_TRUE(step == 0 || inside(step - 1));
  }
  EXPECT_GT(escaped.size(), 20U);
}

TEST_F(Evacuation, RunningToAnExitIsIntentUntilSafety) {
  const auto state = [&](std::size_t at) -> const std::string& {
    return trace().header.state_names[trace().state[at]];
  };
  std::size_t arrived = 0;
  for (std::size_t at = trace().agents(); at < trace().state.size(); ++at) {
    const std::size_t before = at - trace().agents();
    if (state(at) == "RunToExit1" || state(at) == "RunToGoodExit") {
      EXPECT_GE(trace().exit_intent[at], 0) << at;
    }
    if (state(at) == "RunToSafety" && state(before) == "RunToGoodExit") {
      ++arrived;
      EXPECT_EQ(trace().exit_intent[at], trace().exit_intent[before]) << at;
    }
  }
  EXPECT_GT(arrived, 20U);
  // Nobody has heard of anything yet.
  for (std::size_t i = 0; i < trace().agents(); ++i) EXPECT_EQ(trace().exit_intent[i], -1);
}

TEST_F(Evacuation, NobodyTeleports) {
  constexpr double kMaxSpeedMps = 2.5;
  for (std::size_t step = 1; step < trace().steps(); ++step) {
    for (std::size_t i = 0; i < trace().agents(); ++i) {
      if (trace().header.role[i] != AgentRole::person) continue;
      const float moved_m =
          (trace().position[trace().at(step, i)] - trace().position[trace().at(step - 1, i)])
              .norm();
      ASSERT_LT(moved_m, kMaxSpeedMps * trace().header.dt_s) << "agent " << i << " step " << step;
    }
  }
}

TEST_F(Evacuation, HoveringDroneStaysAtTheScenariosStart) {
  for (const world::DroneSample& sample : trace().drones[0]) {
    EXPECT_LT((sample.position - city_square().drones[0].position).norm(), 1e-3);
  }
}

// The drone hovers before exit 4, where many run past it.
TEST(Run, PeopleFollowTheDroneWhoseGoalTheyAreGiven) {
  RunSpec spec;
  spec.duration_s = 40;
  spec.people = 60;
  spec.drones.emplace_back();
  spec.drones[0].id = "d1";
  spec.drones[0].start = Eigen::Vector3d(-8, 0, 5);
  spec.drones[0].guidance.beacon = true;
  const world::Trace with = simulate_trace(spec);
  spec.drones[0].moves_goal = world::GoalRef{99, 0};
  EXPECT_EQ(with.position, simulate_trace(spec).position);  // the scenario's own choice for d1
  spec.drones[0].id = "other";                              // of which the scenario knows nothing
  spec.drones[0].moves_goal.reset();
  EXPECT_NE(with.position, simulate_trace(spec).position);
}

TEST(Run, ReportsProgressToTheEnd) {
  const TemporaryFolder folder;
  std::vector<double> done;
  simulate(city_square(), short_run(), folder.path() / "run.h5",
           [&](double done_s, double total_s) {
             EXPECT_EQ(total_s, 4);
             done.push_back(done_s);
           });
  EXPECT_TRUE(std::is_sorted(done.begin(), done.end()));
  EXPECT_EQ(done.back(), 4);
}

TEST(Run, LeavesNothingWhenCancelled) {
  const TemporaryFolder folder;
  std::stop_source source;
  EXPECT_THROW(simulate(
                   city_square(), short_run(), folder.path() / "run.h5",
                   [&](double done_s, double) {
                     if (done_s > 1) source.request_stop();
                   },
                   source.get_token()),
               Cancelled);
  EXPECT_EQ(folder.entries(), 0U);
}

TEST(Run, SaysAllThatIsWrongBeforeItStarts) {
  const TemporaryFolder folder;
  RunSpec spec = short_run();
  spec.people = kPeopleInSquare + 1;
  spec.drones[0].airframe = "zeppelin";
  spec.drones[0].moves_goal = world::GoalRef{99, 7};
  spec.physics_dt_s = 0.1;
  spec.duration_s = NAN;
  std::vector<std::string> places;
  try {
    simulate(city_square(), spec, folder.path() / "run.h5");
  } catch (const InputError& error) {
    for (const Problem& problem : error.problems()) places.push_back(problem.where);
  }
  EXPECT_THAT(places, ElementsAre("/capture/to_s", "/physics_dt_s", "/drones/0/airframe",
                                  "/crowd/agents", "/drones/0/moves_goal"));
  EXPECT_EQ(folder.entries(), 0U);
}

TEST(Run, ADisasterThatIsNoAgentIsTheScenariosFault) {
  const TemporaryFolder folder;
  world::Scenario scenario = city_square();
  scenario.disaster_agents = {9999};
  EXPECT_THROW(simulate(scenario, short_run(), folder.path() / "run.h5"), InputError);
}

TEST(Run, NobodyWalksThroughTheThingsThatStandInTheSquare) {
  RunSpec spec = short_run();
  spec.duration_s = 60;
  const world::Trace trace = simulate_trace(spec);
  ASSERT_FALSE(city_square().props.empty());
  for (std::size_t step = 0; step < trace.steps(); ++step) {
    for (std::size_t agent = 0; agent < trace.agents(); ++agent) {
      if (trace.header.role[agent] != AgentRole::person || !trace.present(step, agent)) continue;
      const Eigen::Vector2d at = trace.position[trace.at(step, agent)].cast<double>();
      for (std::size_t i = 0; i < city_square().props.size(); ++i) {
        ASSERT_GT(world::distance_to(city_square().props[i], at), 0.1)
            << "prop " << i << ", agent " << agent << " at " << at.transpose();
      }
    }
  }
}

/// Whether the square with nothing but a bench is refused, and the message.
std::pair<bool, std::vector<Problem>> verdict_on_bench(const Eigen::Vector2d& position,
                                                       std::size_t placed) {
  world::Scenario scenario = city_square();
  world::Prop bench;
  bench.kind = world::PropKind::bench;
  bench.position = position;
  scenario.props = {bench};
  scenario.placed_props = placed;
  const TemporaryFolder folder;
  try {
    std::vector<Problem> warnings = simulate(scenario, short_run(), folder.path() / "run.h5");
    std::erase_if(warnings, [](const Problem& problem) {
      return !problem.where.starts_with("/props") && !problem.where.starts_with("/scatter");
    });
    return {false, warnings};
  } catch (const InputError& error) {
    EXPECT_TRUE(fs::is_empty(folder.path())) << "nothing is half there";
    return {true, error.problems()};
  }
}

TEST(Run, PropsOnPeopleAreNamedWithThePeople) {
  const world::Trace trace = simulate_trace(short_run());
  const auto place_of = [&](double time_s) -> Eigen::Vector2d {
    const auto step = static_cast<std::size_t>(std::lround(time_s / trace.header.dt_s));
    return trace.position[trace.at(step, 5)].cast<double>();
  };
  const auto [refused, reasons] = verdict_on_bench(place_of(0), 1);
  EXPECT_TRUE(refused) << "somebody stands there when the run begins";
  ASSERT_EQ(reasons.size(), 1U);
  EXPECT_EQ(reasons[0].where, "/props/0/position");
  EXPECT_THAT(reasons[0].found, ::testing::HasSubstr("a bench at"));
  EXPECT_THAT(reasons[0].found, ::testing::HasSubstr("agent 5 is at"));

  const Eigen::Vector2d on_the_way(0, 300);
  EXPECT_TRUE(verdict_on_bench(on_the_way, 1).second.empty()) << "nobody comes there";
}

TEST(Run, WalkingThroughAPropIsAWarning) {
  // A place that nobody stands at in the beginning and somebody comes to later.
  const world::Trace trace = simulate_trace(short_run());
  for (std::size_t agent = 0; agent < kPeopleInSquare; ++agent) {
    const Eigen::Vector2d place = trace.position[trace.at(trace.steps() - 1, agent)].cast<double>();
    double nearest = 100;
    for (std::size_t other = 0; other < kPeopleInSquare; ++other) {
      const Eigen::Vector2d start = trace.position[trace.at(0, other)].cast<double>();
      nearest = std::min(nearest, (start - place).norm());
    }
    if (nearest < 1) continue;
    const auto [refused, warnings] = verdict_on_bench(place, 0);
    EXPECT_FALSE(refused);
    ASSERT_EQ(warnings.size(), 1U) << "one for each thing";
    EXPECT_EQ(warnings[0].where, "/scatter");
    return;
  }
  FAIL() << "everybody stays where somebody was";
}

/// A drone that plows through the people of the square.
RunSpec low_flight(bool physical) {
  RunSpec spec = short_run();
  spec.duration_s = 8;
  spec.crowd.physical = {physical, 1};
  spec.drones[0].start = {-4, 12, 1.3};
  spec.drones[0].waypoints = {{-4, -12, 1.3}};
  spec.drones[0].speed_mps = 6;
  return spec;
}

TEST(Run, PhysicalPeopleFallWhenADroneHitsThemHard) {
  const world::Trace hard = simulate_trace(low_flight(false));
  const world::Trace physical = simulate_trace(low_flight(true));
  const auto count = [](const world::Trace& trace, std::string_view type) {
    return std::count_if(trace.events.begin(), trace.events.end(),
                         [&](const auto& event) { return world::to_string(event.kind) == type; });
  };
  ASSERT_GT(count(hard, "collision"), 0);
  EXPECT_EQ(count(hard, "fall"), 0);
  ASSERT_GT(count(physical, "fall"), 0);
  for (const world::TraceEvent& event : physical.events) {
    const auto* fall = std::get_if<world::PersonFall>(&event.kind);
    if (fall == nullptr) continue;
    EXPECT_TRUE(fall->struck);
    EXPECT_GE(fall->impulse_ns, 1);
    const auto agent = static_cast<std::size_t>(fall->agent);
    const auto step = static_cast<std::size_t>(std::lround(event.time_s / physical.header.dt_s));
    EXPECT_EQ(physical.flags[physical.at(step - 1, agent)] & world::kFallen, 0);
    for (std::size_t later = step; later < physical.steps(); ++later) {
      ASSERT_NE(physical.flags[physical.at(later, agent)] & world::kFallen, 0);
      ASSERT_EQ(physical.position[physical.at(later, agent)],
                physical.position[physical.at(step, agent)]);
    }
  }
}

TEST(LoadPeople, AreThoseWhoRunAndHaveNoPathsYet) {
  for (const char* id : {"city_square/nearest_exit", "shopping_street/emergency"}) {
    const auto scenario = scenarios::find_scenario(source_folder() / "scenarios", id);
    const crowd::Simulation people = load_people(scenario, 7, {});
    crowd::Simulation running = load_people(scenario, 7, {});
    running.prepare_to_step();
    EXPECT_THAT(people.positions(), ElementsAreArray(running.positions())) << id;
    EXPECT_THAT(people.present(), ElementsAreArray(running.present())) << id;
    EXPECT_THAT(people.desired_speeds_mps(), ElementsAreArray(running.desired_speeds_mps())) << id;
    EXPECT_EQ(people.state_names(), running.state_names());
    const auto is_undirected = [](float yaw_rad) { return yaw_rad == 0; };
    EXPECT_TRUE(std::ranges::all_of(people.yaws_rad(), is_undirected)) << id;
  }
}

TEST(LoadPeople, LeadersTakeUpMoreRoomAndAreSlower) {
  const auto scenario =
      scenarios::find_scenario(source_folder() / "scenarios", "shopping_street/everyday");
  const crowd::Simulation alone = load_people(scenario, 7, {});
  CrowdSpec spec;
  spec.leading = 0.3;
  const crowd::Simulation people = load_people(scenario, 7, spec);
  std::size_t leading = 0;
  for (std::uint32_t agent = 0; agent < people.agent_count(); ++agent) {
    const bool leads = skinning::is_leading(7, agent, 0.3);
    EXPECT_EQ(people.radii_m()[agent], leads ? 0.4F : alone.radii_m()[agent]);
    EXPECT_FLOAT_EQ(people.desired_speeds_mps()[agent],
                    (leads ? 0.9F : 1.0F) * alone.desired_speeds_mps()[agent]);
    leading += leads ? 1 : 0;
  }
  EXPECT_GT(leading, people.agent_count() / 5);
}

}  // namespace
}  // namespace throng::sim
