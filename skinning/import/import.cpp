#include "skinning/import/import.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.h"
#include "base/files/files.h"
#include "base/files/hash.h"
#include "skinning/animate/clips.h"
#include "skinning/import/import_character.h"
#include "skinning/packed.h"
#include "skinning/population_files.h"

namespace throng::skinning {

namespace fs = std::filesystem;

namespace {

// The people whom others are put among.
struct Base {
  PopulationIndex index;
  std::string notice;
};

bool same_clips(const std::vector<Clip>& a, const std::vector<Clip>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Clip& x, const Clip& y) {
    return x.name == y.name && x.frames == y.frames && x.cyclic == y.cyclic &&
           std::abs(x.stride - y.stride) < 1e-4F && std::abs(x.middle - y.middle) < 1e-4F;
  });
}

Base load_base(const ImportOptions& options) {
  Base base;
  if (options.with.empty()) {
    base.index.texture_size = options.texture_size;
    base.index.clips = standard_clips();
    return base;
  }
  base.index = read_index(options.with);
  if (!same_clips(base.index.clips, standard_clips())) {
    throw InputError({options.with.string(), "/clips", "other clips than this program's",
                      "people of this version (run `throng people build`)"});
  }
  const fs::path notice = options.with / kNoticeFile;
  if (fs::is_regular_file(notice)) base.notice = read_file(notice);
  return base;
}

std::vector<CharacterDescription> read_descriptions(const std::vector<fs::path>& files,
                                                    const PopulationIndex& base) {
  std::set<std::string> names;
  for (const Character& entry : base.characters) names.insert(entry.name);
  std::vector<CharacterDescription> described;
  for (const fs::path& file : files) {
    described.push_back(read_description(file));
    if (!names.insert(described.back().name).second) {
      throw InputError({file.string(), "/name", "\"" + described.back().name + "\"",
                        "a name that nobody else in the folder has"});
    }
  }
  return described;
}

std::string collect_notices(const std::vector<CharacterDescription>& described) {
  std::string text = "Characters that were imported into these people:\n";
  for (const CharacterDescription& entry : described) {
    text += fmt::format("  - {}: {}, {}, from {}\n", entry.name, entry.license,
                        entry.author.empty() ? "author not named" : entry.author,
                        entry.model.filename().string());
  }
  return text;
}

std::string joined_license(std::string license,
                           const std::vector<CharacterDescription>& described) {
  std::set<std::string> named = {license};
  for (const CharacterDescription& entry : described) {
    if (!named.insert(entry.license).second) continue;
    if (!license.empty()) license += " AND ";
    const bool compound = entry.license.find(' ') != std::string::npos;
    license += compound ? "(" + entry.license + ")" : entry.license;
  }
  return license;
}

}  // namespace

void import_characters(const std::vector<fs::path>& descriptions, const fs::path& output_folder,
                       const ImportOptions& options, const BuildProgress& progress) {
  if (descriptions.empty()) {
    throw InputError({"", "people import", "no description", "at least one"});
  }
  check_texture_size(options.texture_size);
  check_replaceable(output_folder);
  Base base = load_base(options);
  const auto described = read_descriptions(descriptions, base.index);
  StagingFolder staging(output_folder);
  StagedFile palettes(staging.path() / kPalettesFile);
  std::string content = base.index.content_hash;
  if (!options.with.empty()) {
    for (const Character& entry : base.index.characters) {
      copy_new_file(options.with / (entry.name + kMeshExtension),
                    staging.path() / (entry.name + kMeshExtension));
    }
    palettes.write(read_file(options.with / kPalettesFile));
  }
  const auto count = static_cast<int>(described.size());
  for (int i = 0; i < count; ++i) {
    if (progress) progress(i, count);
    const BakedPerson baked =
        import_character(described[static_cast<std::size_t>(i)], base.index.texture_size);
    write_file_atomically(staging.path() / (baked.character.name + kMeshExtension), baked.glb);
    palettes.write(baked.motion);
    content += sha256_hex(baked.glb + baked.motion + encode_character(baked.character));
    base.index.characters.push_back(baked.character);
  }
  palettes.commit();
  base.index.textures = count_textures(staging.path(), base.index.characters);
  base.index.content_hash = sha256_hex(content);
  base.index.license = joined_license(base.index.license, described);
  if (!base.notice.empty()) base.notice += "\n";
  write_file_atomically(staging.path() / kNoticeFile, base.notice + collect_notices(described));
  write_file_atomically(staging.path() / kIndexFile, encode_index(base.index));
  staging.commit_replacing();
  if (progress) progress(count, count);
}

}  // namespace throng::skinning
