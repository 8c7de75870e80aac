#include "skinning/import/description.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/files/files.h"
#include "base/json/field_table.h"
#include "base/json/json_describe.h"
#include "base/json/json_text.h"
#include "base/schemas/schemas.h"

namespace throng::skinning {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr const char* kClipExample = R"(an object such as {"name": "Walk", "speed_mps": 1.4})";

using fields::at;
using fields::FieldLocation;

/// A path in a description counts from its folder.
fs::path path_in(const FieldLocation& place, const json& value) {
  const auto given = value.get<std::string>();
  return given.empty() ? fs::path() : fs::path(place.source).parent_path() / given;
}

fields::Values any_text() { return fields::raw({{"type", "string"}}, "a string"); }

fields::Values needed_text() {
  return fields::raw({{"type", "string"}, {"minLength", 1}}, "a string that is not empty");
}

/// Numbers of a range, with what they mean.
fields::Values quantity(double low, double high, const char* meaning) {
  fields::Values values = fields::numbers(low, high);
  values.expected = fmt::format("{:g} to {:g} ({})", low, high, meaning);
  return values;
}

/// Fields of a clip. One on the spot has no speed.
fields::FieldTable<ClipDescription> clip_fields(std::optional<fields::Values> speed_mps) {
  fields::FieldTable<ClipDescription> table;
  table.add("name", "", "", any_text(), at(&ClipDescription::name), "");
  table.add_read("file", any_text(),
                 [](ClipDescription& clip, const json& value, const FieldLocation& place) {
                   clip.file = path_in(place, value);
                 });
  if (speed_mps) {
    table.add("speed_mps", "", "m/s", std::move(*speed_mps), at(&ClipDescription::speed_mps), "")
        .required();
  } else {
    table.add_read("speed_mps", fields::numbers(0, 12),
                   [](ClipDescription&, const json&, const FieldLocation&) {});
  }
  return table;
}

using ClipMember = std::optional<ClipDescription> CharacterDescription::*;

void add_clip(fields::FieldTable<CharacterDescription>& table, const char* path, ClipMember clip,
              std::optional<fields::Values> speed_mps) {
  table.add_read(
      path, fields::raw({{"type", "object"}}, kClipExample),
      [clip, clips = clip_fields(std::move(speed_mps))](
          CharacterDescription& character, const json& value, const FieldLocation& place) {
        clips.read_checked(value, (character.*clip).emplace(), place);
      });
}

void set_name(CharacterDescription& character, const json& value, const FieldLocation& place) {
  constexpr std::size_t kMaxNameLength = 40;
  value.get_to(character.name);
  const bool sound = std::all_of(character.name.begin(), character.name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-';
  });
  if (sound && character.name.size() <= kMaxNameLength) return;
  place.problems.push_back({place.source, place.pointer, "\"" + character.name + "\"",
                            "at most 40 letters, digits, - and _"});
}

void set_bones(CharacterDescription& character, const json& value, const FieldLocation& place) {
  for (const auto& [ours, theirs] : value.items()) {
    if (theirs.is_string()) {
      character.bones[ours] = theirs.get<std::string>();
    } else {
      place.problems.push_back({place.source, place.below(ours).pointer, describe(theirs),
                                "the name of a bone of the model"});
    }
  }
}

fields::FieldTable<CharacterDescription> make_description_fields() {
  using Character = CharacterDescription;
  constexpr const char* kSpeed = "meters per second at the described height";
  fields::FieldTable<Character> table;
  table.add_read("name", needed_text(), set_name).required();
  table
      .add_read("model", needed_text(),
                [](Character& character, const json& value, const FieldLocation& place) {
                  character.model = path_in(place, value);
                })
      .required();
  table
      .add("height_m", "", "m",
           quantity(0.5, 2.5,
                    "in meters, from the soles to the top of the head; the model may have any "
                    "unit, it is scaled to this height"),
           at(&Character::height_m), "")
      .required();
  table.add("license", "", "", needed_text(), at(&Character::license), "")
      .required()
      .renamed_from("licence");
  table.add("author", "", "", any_text(), at(&Character::author), "");
  table.add("wears", "", "", any_text(), at(&Character::wears), "");
  fields::Values sexes = fields::one_of_words(std::array{"male", "female"});
  sexes.expected = "\"male\" or \"female\"";
  table.add_read("sex", std::move(sexes),
                 [](Character& character, const json& value, const FieldLocation& /*place*/) {
                   character.male = value == "male";
                 });
  table.add("age_years", "", "years", quantity(1, 110, "years"), at(&Character::age_years), "");
  table.add_read("bones",
                 fields::raw({{"type", "object"}}, R"(an object such as {"left_thigh": "Leg1.L"})"),
                 set_bones);
  table.group("clips", "", "").values.expected =
      R"(an object such as {"walk": {"name": "Walk", "speed_mps": 1.4}})";
  add_clip(table, "clips/idle", &Character::idle, std::nullopt);
  add_clip(table, "clips/walk", &Character::walk, quantity(0.2, 3, kSpeed));
  add_clip(table, "clips/run", &Character::run, quantity(1, 12, kSpeed));
  return table;
}

}  // namespace

CharacterDescription read_description(const fs::path& file) {
  if (!fs::is_regular_file(file)) {
    throw InputError({file.string(), "", "no such file", "the description of a character"});
  }
  const std::string source = file.string();
  json document = parse_json_or_discard(read_file(file));
  if (!document.is_object()) {
    throw InputError({source, "", document.is_discarded() ? "no JSON" : "no object",
                      R"(an object such as {"name": "guide", "model": "guide.glb", )"
                      R"("height_m": 1.75, "license": "CC0-1.0"})"});
  }
  document.erase("$schema");
  static const fields::FieldTable<CharacterDescription> table = make_description_fields();
  CharacterDescription description;
  description.file = file;
  std::vector<Problem> problems;
  table.read_checked(document, description, {"", source, problems});
  schemas::add_schema_problems(schemas::Kind::character, document, source, problems);
  if (!problems.empty()) throw InputError(std::move(problems));
  return description;
}

}  // namespace throng::skinning
