// A folder with one small scenario, for jobs to name.
#pragma once

#include <filesystem>
#include <string>

#include "base/files.h"

namespace throng::jobs {

/// A new empty folder, gone with its contents at the end of the test.
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

/// Writes the scenario "yard" (one exit, drone "d1" that moves goal 99/0) into the folder.
inline void write_yard(const std::filesystem::path& folder) {
  write_file_atomically(folder / "yard_scene.xml", "<Experiment/>");
  write_file_atomically(folder / "yard_behavior.xml", "<BFSM/>");
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
