#include "places/scenarios/blueprint/generate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "places/scenarios/blueprint/blueprint.h"
#include "places/scenarios/check/check.h"
#include "places/scenarios/check/survey.h"
#include "tests/world/temporary_folder.h"
#include "world/fields/read_scenario.h"

namespace throng::scenarios {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using throng::testing::TemporaryFolder;

class Generated : public ::testing::TestWithParam<const char*> {
 protected:
  GeneratorSpec spec_from_seed(std::uint64_t seed) {
    GeneratorSpec spec;
    spec.kind = GetParam();
    spec.seed = seed;
    return spec;
  }
  void expect_valid(const GeneratorSpec& spec) {
    const auto file = make_scenario(generate_blueprint(spec), "generated", folder.path(), "place");
    for (const Finding& finding : check_files(file)) {
      ADD_FAILURE() << to_json(spec).dump() << "\n" << finding.text();
    }
  }

  TemporaryFolder folder;
};

TEST_P(Generated, IsValidWhateverTheSeed) {
  // All of 1 000 seeds per kind: bench/generated_scenarios.sh 1000.
  for (std::uint64_t seed = 1; seed <= 8; ++seed) expect_valid(spec_from_seed(seed));
}

TEST_P(Generated, HasRoomForEverybodyWhateverTheRunsSeed) {
  GeneratorSpec spec = spec_from_seed(1);
  spec.clutter = 1;
  spec.people = 400;
  const auto file = make_scenario(generate_blueprint(spec), "generated", folder.path(), "place");
  const world::Scenario place = world::load_scenario(file, "place");
  for (std::uint64_t run = 1; run <= 4; ++run) {
    crowd::LoadOptions options;
    options.seed = run;
    const crowd::Simulation crowd(place.scene_file, place.behavior_file, options);
    EXPECT_GE(crowd.positions().size(), 400U);
  }
}

TEST_P(Generated, IsValidWhateverItIsToBeLike) {
  for (const double share : {0.0, 1.0}) {
    for (const int exits : {2, 8}) {
      GeneratorSpec spec = spec_from_seed(5);
      spec.building_density = share;
      spec.clutter = share;
      spec.exits = exits;
      spec.size_m = share > 0 ? 200 : 60;
      expect_valid(spec);
    }
  }
}

TEST_P(Generated, DiffersFromSeedToSeed) {
  std::set<std::string> walls;
  std::set<std::size_t> exits;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const json place = generate_blueprint(spec_from_seed(seed));
    walls.insert(place["buildings"].dump());
    exits.insert(place["exits"].size());
  }
  EXPECT_EQ(walls.size(), 20U);
  EXPECT_GE(exits.size(), 3U) << "numbers of exits";
  EXPECT_EQ(generate_blueprint(spec_from_seed(7)), generate_blueprint(spec_from_seed(7)));
}

TEST_P(Generated, HasTheRequestedParts) {
  GeneratorSpec spec = spec_from_seed(3);
  spec.size_m = 90;
  spec.exits = 4;
  spec.exit_width_m = 3;
  spec.demand_per_minute = 45;
  spec.people = 77;
  const json place = generate_blueprint(spec);
  EXPECT_EQ(place["exits"].size(), 4U);
  for (const json& source : place["people"]["sources"]) EXPECT_EQ(source["per_minute"], 45);
  EXPECT_EQ(place["people"]["sources"].size(), 4U) << "people come in by every exit";
  const auto file = make_scenario(place, "generated", folder.path(), "place");
  const world::Scenario scenario = world::load_scenario(file, "place");
  for (const world::Exit& exit : scenario.exits) EXPECT_NEAR(exit.width_m(), 3, 0.02);
  const LoadedCrowd loaded = load_scenario_crowd(scenario);
  std::size_t there = 0;
  for (std::size_t i = 0; i < loaded.count(); ++i) {
    if (loaded.crowd.agents.awaited[i] == 0) ++there;
  }
  EXPECT_EQ(there, 77U);
}

TEST_P(Generated, HasMoreBuildingsWhereTheyAreDenser) {
  const auto built_m2 = [&](double density) {
    GeneratorSpec spec = spec_from_seed(11);
    spec.building_density = density;
    const auto file = make_scenario(generate_blueprint(spec), "generated", folder.path(), "place");
    double area = 0;
    for (const world::Building& building : world::load_scenario(file, "place").buildings) {
      const Eigen::Vector2d size = building.footprint[2] - building.footprint[0];
      area += size.x() * size.y();
    }
    return area;
  };
  EXPECT_GT(built_m2(1), 1.2 * built_m2(0));
}

TEST_P(Generated, KeepsObjectsOffThePathsToTheExits) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const json place = generate_blueprint(spec_from_seed(seed));
    const auto file = make_scenario(place, "generated", folder.path(), "place");
    const world::Scenario scenario = world::load_scenario(file, "place");
    std::size_t around = 0;
    for (const world::Building& building : scenario.buildings) {
      if (!building.id.starts_with("over_the_road")) continue;
      ++around;
      for (const auto& corner : building.footprint) EXPECT_FALSE(scenario.inside.contains(corner));
    }
    std::size_t cars = 0;
    for (const world::Prop& prop : scenario.props) {
      if (prop.kind != world::PropKind::car) continue;
      ++cars;
      EXPECT_FALSE(scenario.inside.contains(prop.position));
    }
    EXPECT_GT(around + cars, 0U) << "a place in the middle of nowhere";
  }
}

TEST_P(Generated, IsPlantedAndPavedInSeveralMaterials) {
  std::set<std::string> materials;
  std::set<std::string> kinds;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    GeneratorSpec spec = spec_from_seed(seed);
    spec.clutter = 1;
    spec.building_density = 0.3;
    const json place = generate_blueprint(spec);
    EXPECT_EQ(place["ground"]["material"], "grass") << "no pavement where nobody walks";
    for (const json& area : place["ground"]["areas"]) materials.insert(area["material"]);
    for (const json& prop : place["props"]) kinds.insert(prop["kind"]);
    for (const json& scatter : place["scatter"]) {
      for (const json& kind : scatter["kinds"]) kinds.insert(kind);
    }
  }
  EXPECT_GE(materials.size(), 3U);
  EXPECT_TRUE(kinds.contains("planter"));
  EXPECT_TRUE(kinds.contains("bush") || spec_from_seed(1).kind == "street");
}

INSTANTIATE_TEST_SUITE_P(Kinds, Generated, ::testing::Values("plaza", "street", "campus", "block"),
                         [](const auto& each) { return std::string(each.param); });

TEST(PlaceSpecs, AreReadBackAsTheyAreWritten) {
  std::vector<Problem> problems;
  const json given = json::parse(
      R"({"kind": "street", "seed": 9, "size_m": 100, "exits": 4, "exit_width_m": 3.5,
          "building_density": 0.25, "clutter": 0.75, "demand_per_minute": 12, "people": 300})");
  const GeneratorSpec spec = read_generator_spec(given, "/scenario/generate", problems);
  EXPECT_TRUE(problems.empty());
  EXPECT_EQ(to_json(spec), given);
  GeneratorSpec other = spec;
  other.clutter = 0.5;
  EXPECT_NE(generated_name(spec), generated_name(other));
  EXPECT_THAT(generated_name(spec), HasSubstr("street_9_"));
}

TEST(PlaceSpecs, NameEveryMistake) {
  std::vector<Problem> problems;
  read_generator_spec(json::parse(R"({"kind": "moon", "exits": 1, "clutter": 2, "colour": "red"})"),
                      "/scenario/generate", problems);
  std::set<std::string> where;
  for (const Problem& problem : problems) where.insert(problem.where);
  EXPECT_EQ(where,
            (std::set<std::string>{"/scenario/generate/kind", "/scenario/generate/exits",
                                   "/scenario/generate/clutter", "/scenario/generate/colour"}));
}

TEST(PlaceSpecs, MistakesNameTheExpectedValue) {
  const auto problems_of = [](const char* text) {
    std::vector<Problem> problems;
    read_generator_spec(json::parse(text), "/scenario/generate", problems);
    std::string texts;
    for (const Problem& problem : problems) texts += problem.text() + "\n";
    return texts;
  };
  EXPECT_EQ(problems_of(R"({"kind": "moon"})"),
            "/scenario/generate/kind: found \"moon\", expected plaza, street, campus or block\n");
  EXPECT_THAT(problems_of(R"({})"), HasSubstr("/scenario/generate/kind: found nothing, expected"));
  EXPECT_EQ(problems_of(R"({"kind": "plaza", "size_m": 20})"),
            "/scenario/generate/size_m: found 20, expected a number from 30 to 200\n");
  EXPECT_EQ(problems_of(R"({"kind": "plaza", "exits": 2.5})"),
            "/scenario/generate/exits: found 2.5, expected an integer from 2 to 8\n");
  EXPECT_EQ(problems_of(R"({"kind": "plaza", "cluter": 0.5})"),
            "/scenario/generate/cluter: unknown field \"cluter\"; did you mean \"clutter\"?\n");
  EXPECT_EQ(problems_of("7"), "/scenario/generate: found 7, expected an object\n");
}

}  // namespace
}  // namespace throng::scenarios
