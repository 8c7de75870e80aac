// Generated places that are in memory only.
#include "places/scenarios/blueprint/generated.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "base/error.h"
#include "crowd/simulation.h"
#include "places/scenarios/blueprint/blueprint.h"
#include "places/scenarios/check/check.h"
#include "tests/world/temporary_folder.h"
#include "world/fields/read_scenario.h"
#include "world/scenario_crowd.h"

namespace throng::scenarios {
namespace {

using throng::testing::TemporaryFolder;

GeneratorSpec spec_from_seed(std::uint64_t seed) {
  GeneratorSpec spec;
  spec.kind = "plaza";
  spec.seed = seed;
  return spec;
}

TEST(GeneratedInMemory, AreTheScenariosOfTheirFiles) {
  const TemporaryFolder folder;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const world::Scenario made = load_generated(spec_from_seed(seed));
    const world::Scenario read =
        world::load_scenario(make_scenario(generate_blueprint(spec_from_seed(seed)), "generated",
                                           folder.path(), "place"),
                             "place");
    EXPECT_TRUE(made.scene_file.empty());
    ASSERT_TRUE(made.has_crowd());
    const crowd::CrowdDescription in_memory = world::build_crowd(made);
    EXPECT_EQ(in_memory.scene.root, world::build_crowd(read).scene.root);
    EXPECT_EQ(in_memory.behavior.root, world::build_crowd(read).behavior.root);
    EXPECT_EQ(made.name, read.name);
    EXPECT_EQ(made.buildings.size(), read.buildings.size());
    EXPECT_EQ(made.props.size(), read.props.size());
    ASSERT_EQ(made.exits.size(), read.exits.size());
    for (std::size_t i = 0; i < made.exits.size(); ++i) {
      EXPECT_EQ(made.exits[i].from, read.exits[i].from);
      EXPECT_EQ(made.exits[i].goals, read.exits[i].goals);
    }
    crowd::Simulation one(in_memory.scene, in_memory.behavior, {.seed = seed});
    crowd::Simulation other(read.scene_file, read.behavior_file, {.seed = seed});
    for (int i = 0; i < 20; ++i) {
      one.step();
      other.step();
    }
    EXPECT_TRUE(std::equal(one.positions().begin(), one.positions().end(),
                           other.positions().begin(), other.positions().end()));
  }
}

TEST(GeneratedInMemory, NeedNoDisk) {
  const char* const usual = std::getenv("TMPDIR");
  const std::string kept = usual != nullptr ? usual : "";
  ::setenv("TMPDIR", "/nonexistent", 1);
  world::Scenario place;
  EXPECT_NO_THROW(place = load_generated(spec_from_seed(11)));
  if (usual != nullptr) {
    ::setenv("TMPDIR", kept.c_str(), 1);
  } else {
    ::unsetenv("TMPDIR");
  }
  EXPECT_TRUE(check(place, "generated").empty());
}

TEST(GeneratedInMemory, LeaveNothingBesideTheFilesOfAScenario) {
  const TemporaryFolder folder;
  make_scenario(generate_blueprint(spec_from_seed(5)), "generated", folder.path(), "place");
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    names.insert(entry.path().filename());
  }
  EXPECT_EQ(names, (std::set<std::string>{"place.json", "place_behavior.xml", "place_scene.xml"}));
}

TEST(BlueprintProblems, NameTheBlueprintOnly) {
  nlohmann::json blueprint = generate_blueprint(spec_from_seed(1));
  blueprint["inside"]["max"] = "here";
  try {
    build_scenario(blueprint, "mine.blueprint.json", "mine");
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    for (const Problem& problem : error.problems())
      EXPECT_EQ(problem.source, "mine.blueprint.json");
  }
}

TEST(Generated, PeopleWithoutRoomAreAFaultOfTheSpec) {
  GeneratorSpec spec;
  spec.size_m = 30;
  spec.people = 5000;
  try {
    load_generated(spec);
    ADD_FAILURE() << "nothing was refused";
  } catch (const InputError& error) {
    ASSERT_EQ(error.problems().size(), 1U);
    EXPECT_EQ(error.problems()[0].where, "/people");
    EXPECT_EQ(error.problems()[0].source, "");
    EXPECT_EQ(error.problems()[0].found, "5000");
  }
}

}  // namespace
}  // namespace throng::scenarios
