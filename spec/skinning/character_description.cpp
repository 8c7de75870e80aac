#include "spec/skinning/character_description.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/files/files.h"
#include "base/json/field_table.h"
#include "base/json/json_describe.h"
#include "base/json/json_text.h"

namespace throng::skinning {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr std::size_t kMaxNameLength = 40;
constexpr const char* kClipExample = R"(an object such as {"name": "Walk", "speed_mps": 1.4})";

using fields::at;
using fields::FieldLocation;
using Character = CharacterDescription;

/// A path in a description counts from its folder.
fs::path path_in(const FieldLocation& place, const json& value) {
  const auto given = value.get<std::string>();
  return given.empty() ? fs::path() : fs::path(place.source).parent_path() / given;
}

fields::Values any_text() { return fields::raw({{"type", "string"}}, "a string"); }

fields::Values needed_text() {
  return fields::raw({{"type", "string"}, {"minLength", 1}}, "a string that is not empty");
}

/// Numbers of a range, with their meaning.
fields::Values quantity(double low, double high, const char* meaning) {
  fields::Values values = fields::numbers(low, high);
  values.expected = fmt::format("{:g} to {:g} ({})", low, high, meaning);
  return values;
}

/// Fields of a clip. One on the spot has no speed.
fields::FieldTable<ClipDescription> clip_fields(std::optional<fields::Values> speed_mps) {
  constexpr const char* kSpeed = "Speed at which the motion gets on, at the described height.";
  fields::FieldTable<ClipDescription> table;
  table.add("name", "", "", any_text(), at(&ClipDescription::name),
            "Name of the animation; it may be left out where the file has but one.");
  table.add_read(
      "file", any_text(),
      [](ClipDescription& clip, const json& value, const FieldLocation& place) {
        clip.file = path_in(place, value);
      },
      "File with the same kind of rig; default: the model's.");
  if (speed_mps) {
    table
        .add("speed_mps", "", "m/s", std::move(*speed_mps), at(&ClipDescription::speed_mps), kSpeed)
        .required();
  } else {
    table.add_ignored("speed_mps", fields::numbers(0, 12), kSpeed);
  }
  return table;
}

using ClipMember = std::optional<ClipDescription> Character::*;

void add_clip(fields::FieldTable<Character>& table, const char* path, ClipMember clip,
              std::optional<fields::Values> speed_mps, const char* help) {
  const auto clips = clip_fields(std::move(speed_mps));
  fields::Values values = fields::object_with(clips.schema());
  values.expected = kClipExample;
  table.add_read(
      path, std::move(values),
      [clip, clips](Character& character, const json& value, const FieldLocation& place) {
        clips.read_checked(value, (character.*clip).emplace(), place);
      },
      help);
}

void set_bones(Character& character, const json& value, const FieldLocation& place) {
  for (const auto& [ours, theirs] : value.items()) {
    if (theirs.is_string()) {
      character.bones[ours] = theirs.get<std::string>();
    } else {
      place.below(ours).reject(describe(theirs), "the name of a bone of the model");
    }
  }
}

void add_person(fields::FieldTable<Character>& table) {
  table
      .add("license", "", "", needed_text(), at(&Character::license),
           "License, as an SPDX expression; it goes into NOTICE.txt.")
      .required()
      .renamed_from("licence");
  table.add("author", "", "", any_text(), at(&Character::author), "Author, whom NOTICE.txt names.");
  fields::Values sexes = fields::one_of_words(std::array{"male", "female"});
  sexes.expected = "\"male\" or \"female\"";
  table.add_read(
      "sex", std::move(sexes),
      [](Character& character, const json& value, const FieldLocation& /*place*/) {
        character.male = value == "male";
      },
      "Sex; default: male.");
  table
      .add("age_years", "", "years", quantity(1, 110, "years"), at(&Character::age_years),
           "Age, which shortens strides and makes people stoop; default: 35.")
      .without_default();
  table.add("wears", "", "", any_text(), at(&Character::wears), "Clothes in words.");
}

fields::FieldTable<Character> make_fields() {
  constexpr const char* kSpeed = "meters per second at the described height";
  fields::FieldTable<Character> table;
  table.add_schema_name();
  table
      .add("name", "", "", fields::names(kMaxNameLength), at(&Character::name),
           "Name in the library, and of the GLB file in its folder.")
      .required();
  table
      .add_read(
          "model", needed_text(),
          [](Character& character, const json& value, const FieldLocation& place) {
            character.model = path_in(place, value);
          },
          "File, from this file's folder on: glTF, FBX or DAE.")
      .required();
  table
      .add("height_m", "", "m",
           quantity(0.5, 2.5,
                    "in meters, from the soles to the top of the head; the model may have any "
                    "unit, it is scaled to this height"),
           at(&Character::height_m),
           "Height from the soles to the top, as the mesh is. The model is scaled to it, so its "
           "unit does not matter.")
      .required();
  add_person(table);
  table.add_read(
      "bones",
      fields::raw({{"type", "object"}, {"additionalProperties", {{"type", "string"}}}},
                  R"(an object such as {"left_thigh": "Leg1.L"})"),
      set_bones,
      "Names of the model's bones by throng's names, where the model's own do not say it.");
  table.group("clips", "", "Animations.").without_default().values.expected =
      R"(an object such as {"walk": {"name": "Walk", "speed_mps": 1.4}})";
  add_clip(table, "clips/idle", &Character::idle, std::nullopt, "Standing.");
  add_clip(table, "clips/walk", &Character::walk, quantity(0.2, 3, kSpeed), "Walking.");
  add_clip(table, "clips/run", &Character::run, quantity(1, 12, kSpeed), "Running.");
  return table;
}

const fields::FieldTable<Character>& character_fields() {
  static const fields::FieldTable<Character> table = make_fields();
  return table;
}

}  // namespace

CharacterDescription read_description(const fs::path& file) {
  if (!fs::is_regular_file(file)) {
    throw InputError({file.string(), "", "no such file", "the description of a character"});
  }
  const std::string source = file.string();
  const json document = parse_json_or_discard(read_file(file));
  if (!document.is_object()) {
    throw InputError({source, "", document.is_discarded() ? "no JSON" : "no object",
                      R"(an object such as {"name": "guide", "model": "guide.glb", )"
                      R"("height_m": 1.75, "license": "CC0-1.0"})"});
  }
  CharacterDescription description;
  description.file = file;
  std::vector<Problem> problems;
  character_fields().read_checked(document, description, {"", source, problems});
  if (!problems.empty()) throw InputError(std::move(problems));
  return description;
}

nlohmann::ordered_json character_schema() {
  return fields::document_schema(
      "throng character", "A rigged character that throng people import takes (docs/people.md).",
      character_fields().schema());
}

}  // namespace throng::skinning
