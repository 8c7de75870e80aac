#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/files/resources.h"
#include "places/scenarios/blueprint/blueprint.h"
#include "places/scenarios/blueprint/load_scenario.h"
#include "places/scenarios/check/check.h"
#include "tests/world/temporary_folder.h"
#include "world/alarm.h"
#include "world/fields/read_scenario.h"
#include "world/scenario_crowd.h"

namespace throng::scenarios {
namespace {

namespace fs = std::filesystem;
using throng::testing::TemporaryFolder;

std::vector<fs::path> blueprints() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(source_folder() / "scenarios")) {
    if (entry.path().filename().string().ends_with(".blueprint.json"))
      files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

TEST(Library, HasEightPlacesEachWithAnEmergency) {
  std::size_t places = 0;
  for (const fs::path& blueprint : blueprints()) {
    if (blueprint.filename() != "everyday.blueprint.json") continue;
    ++places;
    EXPECT_TRUE(fs::exists(blueprint.parent_path() / "emergency.blueprint.json")) << blueprint;
  }
  EXPECT_EQ(places, 8U);
}

TEST(Library, FilesMadeFromABlueprintAreTheSameScenario) {
  for (const fs::path& blueprint : blueprints()) {
    const TemporaryFolder folder;
    const std::string id = world::id_from_file(blueprint);
    const world::Scenario loaded = load_scenario(blueprint, id);
    for (const world::PlacedMesh& mesh : loaded.meshes) {
      fs::copy(mesh.file, folder.path(), fs::copy_options::skip_existing);
    }
    const world::Scenario made =
        world::load_scenario(make_scenario(blueprint, folder.path(), id), id);
    EXPECT_EQ(loaded.document, made.document) << blueprint;
    const crowd::CrowdDescription in_memory = world::build_crowd(loaded);
    const crowd::CrowdDescription in_files = world::build_crowd(made);
    EXPECT_EQ(in_memory.scene.root, in_files.scene.root) << blueprint;
    EXPECT_EQ(in_memory.behavior.root, in_files.behavior.root) << blueprint;
  }
}

TEST(Library, HasNoFaults) {
  for (const fs::path& blueprint : blueprints()) {
    for (const Finding& finding : check_files(blueprint)) ADD_FAILURE() << finding.text();
  }
}

TEST(Library, AlarmsAreThoseOfTheFiles) {
  const std::filesystem::path folder = source_folder() / "scenarios";
  const auto alarm = [&](const char* id) { return world::find_alarm(find_scenario(folder, id)); };
  EXPECT_EQ(alarm("station/emergency").at_s, 6);
  EXPECT_EQ(alarm("station/emergency").aware_states,
            (std::vector<std::string>{"Flee", "Follow", "React"}));
  EXPECT_EQ(alarm("city_square/nearest_exit").at_s, 18);
  EXPECT_EQ(alarm("city_square/nearest_exit").aware_states,
            (std::vector<std::string>{"Follow", "RunToExit1", "RunToExit2", "RunToGoodExit"}));
  EXPECT_EQ(alarm("city_square/huang2016/nearest_exit").at_s, 0);
  EXPECT_FALSE(alarm("station/everyday").at_s);
  for (const std::string& id : world::list_scenarios(folder)) {
    const bool everyday = id.find("everyday") != std::string::npos;
    const world::Alarm found = alarm(id.c_str());
    EXPECT_EQ(found.at_s.has_value(), !everyday) << id;
    if (everyday) continue;
    EXPECT_FALSE(found.aware_states.empty()) << id;
  }
}

}  // namespace
}  // namespace throng::scenarios
