#include "skinning/population_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>

#include "base/error.h"
#include "base/files/files.h"
#include "base/files/hash.h"
#include "base/json/json_text.h"
#include "skinning/glb.h"
#include "skinning/items.h"
#include "skinning/packed.h"
#include "skinning/skeleton.h"

namespace throng::skinning {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr const char* kRemedy = " (run `throng people build` to build the character library)";

std::string encode_hex(const Rgb& color) {
  return fmt::format("#{:02x}{:02x}{:02x}", color[0], color[1], color[2]);
}

Rgb parse_color(const std::string& hex) {
  if (hex.size() != 7 || hex.front() != '#') throw std::out_of_range("colour");
  Rgb color{};
  const auto digit = [&](std::size_t at) -> int {
    const char c = hex[at];
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    throw std::out_of_range("colour");
  };
  for (std::size_t channel = 0; channel < 3; ++channel) {
    color[channel] =
        static_cast<std::uint8_t>(16 * digit(1 + 2 * channel) + digit(2 + 2 * channel));
  }
  return color;
}

Carry carry_named(const std::string& name) {
  const auto found = std::find(kCarryNames.begin(), kCarryNames.end(), name);
  if (found == kCarryNames.end()) throw std::out_of_range("carried item");
  return static_cast<Carry>(found - kCarryNames.begin());
}

Character parse_character(const json& entry) {
  Character character;
  character.name = entry.at("name").get<std::string>();
  character.stature_m = entry.at("stature_m").get<float>();
  character.legs_stature_m = entry.value("legs_stature_m", 0.0F);
  character.age_years = entry.at("age_years").get<float>();
  character.male = entry.at("male").get<bool>();
  character.wears = entry.at("wears").get<std::string>();
  character.carries = carry_named(entry.at("carries").get<std::string>());
  for (std::size_t tint = 0; tint < kTintCount; ++tint) {
    const std::string name(kTintNames[tint]);
    if (!entry.at("tints").contains(name)) continue;
    for (const json& color : entry.at("tints").at(name)) {
      character.tints[tint].push_back(parse_color(color.get<std::string>()));
    }
  }
  return character;
}

json character_json(const Character& character) {
  json tints = json::object();
  for (std::size_t tint = 0; tint < kTintCount; ++tint) {
    for (const Rgb& color : character.tints[tint]) {
      tints[std::string(kTintNames[tint])].push_back(encode_hex(color));
    }
  }
  json entry = {{"name", character.name},
                {"stature_m", character.stature_m},
                {"age_years", character.age_years},
                {"male", character.male},
                {"wears", character.wears},
                {"carries", kCarryNames[static_cast<std::size_t>(character.carries)]},
                {"tints", tints}};
  if (character.legs_stature_m > 0) entry["legs_stature_m"] = character.legs_stature_m;
  return entry;
}

PopulationIndex parse_index(const json& document) {
  PopulationIndex index;
  index.content_hash = document.at("content_hash").get<std::string>();
  index.license = document.at("licence").get<std::string>();
  index.texture_size = document.at("texture_size").get<int>();
  index.textures = document.value("textures", std::int64_t{0});
  for (const json& entry : document.at("characters")) {
    index.characters.push_back(parse_character(entry));
  }
  for (const json& entry : document.at("clips")) {
    Clip clip;
    clip.name = entry.at("name").get<std::string>();
    clip.speed_mps = entry.at("speed_mps").get<float>();
    clip.first = index.palettes_per_character;
    clip.frames = entry.at("frames").get<std::uint32_t>();
    clip.stride = entry.at("stride").get<float>();
    clip.middle = entry.at("middle").get<float>();
    clip.cyclic = entry.at("cyclic").get<bool>();
    if (!(clip.stride >= 0 && clip.stride < 10)) throw std::out_of_range("stride");
    if (!(clip.middle >= 0 && clip.middle < 1)) throw std::out_of_range("middle");
    if (clip.frames == 0 || clip.frames > 100'000) throw std::out_of_range("frames");
    index.palettes_per_character += clip.frames;
    index.clips.push_back(std::move(clip));
  }
  return index;
}

}  // namespace

std::string encode_character(const Character& character) {
  return character_json(character).dump();
}

Character read_character(const fs::path& path) {
  try {
    return parse_character(parse_json(read_file(path), path.string()));
  } catch (const json::exception& error) {
    throw InputError({path.string(), "", error.what(), "a baked character"});
  } catch (const std::out_of_range& error) {
    throw InputError({path.string(), "", error.what(), "a baked character"});
  }
}

std::string encode_index(const PopulationIndex& index) {
  json document = {{"format", kPopulationFormat}, {"content_hash", index.content_hash},
                   {"licence", index.license},    {"texture_size", index.texture_size},
                   {"textures", index.textures},  {"characters", json::array()},
                   {"clips", json::array()}};
  for (const Character& character : index.characters) {
    document["characters"].push_back(character_json(character));
  }
  for (const Clip& clip : index.clips) {
    document["clips"].push_back({{"name", clip.name},
                                 {"speed_mps", clip.speed_mps},
                                 {"frames", clip.frames},
                                 {"stride", clip.stride},
                                 {"middle", clip.middle},
                                 {"cyclic", clip.cyclic}});
  }
  return document.dump(1) + "\n";
}

std::int64_t count_textures(const fs::path& folder, const std::vector<Character>& characters) {
  std::set<std::string> hashes;
  for (const Character& character : characters) {
    for (const std::string& png : read_glb(folder / (character.name + kMeshExtension)).images) {
      hashes.insert(sha256_hex(png));
    }
  }
  return static_cast<std::int64_t>(hashes.size());
}

PopulationIndex read_index(const fs::path& folder) {
  const fs::path path = folder / kIndexFile;
  if (!fs::is_regular_file(path)) {
    throw InputError(
        {path.string(), "", "no such file", std::string("a character library") + kRemedy});
  }
  const json document = parse_json_or_discard(read_file(path));
  if (!document.is_object() || !document.contains("format")) {
    throw InputError(
        {path.string(), "", "no index of people", std::string("a character library") + kRemedy});
  }
  if (document["format"] != kPopulationFormat) {
    throw InputError({path.string(), "/format", document["format"].dump(),
                      fmt::format("{}{}", kPopulationFormat, kRemedy)});
  }
  PopulationIndex index;
  std::string problem;
  try {
    index = parse_index(document);
  } catch (const json::exception& error) {
    problem = error.what();
  } catch (const std::out_of_range& error) {
    problem = fmt::format("a {} out of range", error.what());
  }
  if (problem.empty() && (index.characters.empty() || index.clips.empty())) {
    problem = "no characters or no clips";
  }
  if (!problem.empty()) {
    throw InputError({path.string(), "", problem, std::string("an index of people") + kRemedy});
  }
  return index;
}

void check_texture_size(int pixels) {
  if (pixels < 32 || pixels > 2048) {
    throw InputError({"", "people: texture size", std::to_string(pixels), "32 to 2048"});
  }
}

void check_replaceable(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error) || fs::is_empty(folder, error)) return;
  if (fs::is_directory(folder, error) && fs::exists(folder / kIndexFile, error)) return;
  throw InputError({folder.string(), "", "something else than a character library",
                    "a folder that is new, empty or holds a character library"});
}

Palettes read_palettes(const fs::path& folder, const std::vector<Joints>& characters,
                       std::size_t per_character) {
  const fs::path path = folder / kPalettesFile;
  const std::string bytes = fs::is_regular_file(path) ? read_file(path) : std::string();
  const std::size_t share = per_character * kPackedBytes;
  if (bytes.size() != characters.size() * share) {
    throw InputError({path.string(), "", fmt::format("{} bytes", bytes.size()),
                      fmt::format("{} bytes of poses{}", characters.size() * share, kRemedy)});
  }
  Palettes palettes;
  palettes.reserve(characters.size() * per_character);
  for (std::size_t i = 0; i < characters.size(); ++i) {
    try {
      palettes.append(unpack(characters[i], std::string_view(bytes).substr(i * share, share)));
    } catch (const std::out_of_range& error) {
      throw InputError({path.string(), fmt::format("character {}", i),
                        fmt::format("a {} out of range", error.what()),
                        std::string("poses") + kRemedy});
    }
  }
  return palettes;
}

}  // namespace throng::skinning
