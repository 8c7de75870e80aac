// The work folder of a library during a build, which keeps finished characters if the build is
// killed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "skinning/population_files.h"
#include "skinning/wardrobe/person.h"

namespace throng::skinning {

inline constexpr const char* kNoticeFile = "NOTICE.txt";

/// A finished character.
struct BakedPerson {
  std::string glb;
  Character character;  ///< without its levels, which are in the GLB
  std::string motion;   ///< its share of palettes.bin
};

/// The folder `<output>.part`, held by one build at a time.
class Workbench {
 public:
  /// Reuses the characters of an earlier build with the same hash, and deletes those of a build
  /// with another hash. Throws EnvironmentError if another build uses the folder or it cannot be
  /// written.
  Workbench(std::filesystem::path output, const std::string& content_hash);
  ~Workbench();
  Workbench(const Workbench&) = delete;
  Workbench& operator=(const Workbench&) = delete;

  /// Whether this character is finished.
  bool has(const std::string& name) const;
  /// Stores a finished character. Thread-safe for different characters.
  void keep(const BakedPerson& person) const;
  void keep_notice(const std::string& text) const;

  /// Moves all characters to the output folder, atomically, and removes the work folder.
  void finish(const std::vector<PersonSpec>& people, PopulationIndex index);

 private:
  std::filesystem::path file(const std::string& name, const char* extension) const;

  std::filesystem::path output_;
  std::filesystem::path folder_;
  int lock_ = -1;
};

}  // namespace throng::skinning
