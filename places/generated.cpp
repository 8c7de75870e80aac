#include "places/generated.h"

#include <fmt/core.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>

#include "base/error.h"
#include "places/blueprint.h"

namespace throng::places {

namespace fs = std::filesystem;

namespace {

/// The folder of this process' places, removed with it.
class Scratch {
 public:
  Scratch() {
    std::string name = (fs::temp_directory_path() / "throng.places.XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) {
      throw EnvironmentError(fmt::format("cannot make a folder like {}", name));
    }
    path_ = name;
  }
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  /// The scenario file of a spec, made when it is asked for the first time.
  fs::path file_of(const PlaceSpec& spec) {
    const std::scoped_lock lock(mutex_);
    const std::string id = id_of(spec);
    const auto known = files_.find(id);
    if (known != files_.end()) return known->second;
    return files_[id] = make_scenario(generate_place(spec), id, path_, id);
  }

 private:
  std::mutex mutex_;
  fs::path path_;
  std::map<std::string, fs::path> files_;
};

}  // namespace

world::Scenario load_generated(const PlaceSpec& spec) {
  static Scratch scratch;
  return world::load_scenario(scratch.file_of(spec), "generated/" + id_of(spec));
}

}  // namespace throng::places
