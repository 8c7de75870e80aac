// Description of an imported character: a small JSON file beside the model.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace throng::skinning {

struct ClipDescription {
  std::string name;            ///< of the animation; empty for the only one
  std::filesystem::path file;  ///< with the animation; the model's own when empty
  double speed_mps = 0;        ///< at the described height; 0 on the spot
};

struct CharacterDescription {
  std::filesystem::path file;  ///< the description itself
  std::string name;            ///< also of the baked file: letters, digits, - and _
  std::filesystem::path model;
  double height_m = 1.75;  ///< from the soles to the top, 0.5 to 2.5
  std::string license;     ///< SPDX expression
  std::string author;
  std::string wears;
  bool male = true;
  double age_years = 35;
  std::map<std::string, std::string> bones;  ///< ours to theirs
  std::optional<ClipDescription> idle;
  std::optional<ClipDescription> walk;
  std::optional<ClipDescription> run;
};

/// Reads and checks a description; paths in it count from its folder. Throws InputError with
/// everything that is wrong, each with its JSON pointer.
CharacterDescription read_description(const std::filesystem::path& file);

}  // namespace throng::skinning
