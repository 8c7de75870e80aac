// A folder with one small scenario, for jobs to name.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "base/files/files.h"

namespace throng::jobs {

/// A new empty folder, gone with its contents at the end; a test may have several.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "throng-test-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Writes the scenario "yard" (two people, one exit, drone "d1" that moves goal 99/0) into the
/// folder.
inline void write_yard(const std::filesystem::path& folder) {
  write_file_atomically(folder / "yard_scene.xml", R"(<Experiment version="2.0">
    <SpatialQuery type="kd-tree"/>
    <Common time_step="0.1"/>
    <AgentProfile name="a"><Common/><ORCA tau="3" tauObst="0.5"/></AgentProfile>
    <AgentGroup>
      <ProfileSelector type="const" name="a"/>
      <StateSelector type="const" name="Stand"/>
      <Generator type="explicit"><Agent p_x="0" p_y="0"/><Agent p_x="2" p_y="0"/></Generator>
    </AgentGroup>
  </Experiment>)");
  write_file_atomically(folder / "yard_behavior.xml", R"(<BFSM>
    <GoalSet id="99"><Goal id="0" type="point" x="0" y="0"/></GoalSet>
    <State name="Stand" final="1"/>
  </BFSM>)");
  write_file_atomically(folder / "yard.json", R"({
    "name": "Yard",
    "crowd": {"scene": "yard_scene.xml", "behavior": "yard_behavior.xml"},
    "ground": {"min": [-20, -20], "max": [20, 20], "material": "grass"},
    "inside": {"min": [-10, -10], "max": [10, 10]},
    "exits": [{"id": "gate", "from": [10, -1], "to": [10, 1], "goals": [[0, 0]]}],
    "drones": [{"id": "d1", "start": [0, 0, 12], "moves_goal": [99, 0]}]
  })");
}

}  // namespace throng::jobs
