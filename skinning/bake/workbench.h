// Work folder of a library while it is built: finished characters survive a kill.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "skinning/population_files.h"
#include "skinning/wardrobe/person.h"

namespace throng::skinning {

inline constexpr const char* kNoticeFile = "NOTICE.txt";

/// One finished person.
struct BakedPerson {
  std::string glb;
  Character character;  ///< without its levels, which are in the GLB
  std::string motion;   ///< its share of palettes.bin
};

/// The folder `<output>.part`, held by one build at a time.
class Workbench {
 public:
  /// Takes over what an earlier build with the same hash left, and throws away what one with
  /// another hash did. Throws EnvironmentError when another build is at it or the folder cannot be
  /// written.
  Workbench(std::filesystem::path output, const std::string& content_hash);
  ~Workbench();
  Workbench(const Workbench&) = delete;
  Workbench& operator=(const Workbench&) = delete;

  /// Whether this person is finished.
  bool has(const std::string& name) const;
  /// Thread-safe for different persons.
  void keep(const BakedPerson& person) const;
  void keep_notice(const std::string& text) const;

  /// Puts everybody together into the output folder, all at once, and clears the bench.
  void finish(const std::vector<PersonSpec>& people, PopulationIndex index);

 private:
  std::filesystem::path file(const std::string& name, const char* extension) const;

  std::filesystem::path output_;
  std::filesystem::path folder_;
  int lock_ = -1;
};

}  // namespace throng::skinning
