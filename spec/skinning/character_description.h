// The description of an imported character, a JSON file beside the model.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace throng::skinning {

/// The animation for a standard clip.
struct ClipDescription {
  std::string name;            ///< name of the animation; "": the only one
  std::filesystem::path file;  ///< file with the animation; empty: the model's file
  double speed_mps = 0;        ///< speed at the described height; 0: on the spot
};

/// The content of a description.
struct CharacterDescription {
  std::filesystem::path file;  ///< the description itself
  std::string name;            ///< name, also of files: letters, digits, - and _
  std::filesystem::path model;
  double height_m = 1.75;  ///< from soles to crown, 0.5 to 2.5
  std::string license;     ///< SPDX expression
  std::string author;
  std::string wears;
  bool male = true;
  double age_years = 35;
  std::map<std::string, std::string> bones;  ///< throng's bone names to the model's
  std::optional<ClipDescription> idle;
  std::optional<ClipDescription> walk;
  std::optional<ClipDescription> run;
};

/// Reads and checks a description; its paths are relative to its folder. Throws InputError with all
/// problems and their JSON pointers.
CharacterDescription read_description(const std::filesystem::path& file);

/// The JSON Schema of a description.
nlohmann::ordered_json character_schema();

}  // namespace throng::skinning
