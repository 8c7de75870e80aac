#include "skinning/import/description.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "base/deprecation.h"
#include "base/error.h"
#include "base/files.h"
#include "base/json_text.h"
#include "base/suggest.h"

namespace throng::skinning {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

struct Range {
  double low;
  double high;
};

class DescriptionReader {
 public:
  explicit DescriptionReader(const fs::path& file) : file_(file) {}

  CharacterDescription read() {
    json document = parse_json_or_discard(read_file(file_));
    if (!document.is_object()) {
      throw InputError({file_.string(), "", document.is_discarded() ? "no JSON" : "no object",
                        R"(an object such as {"name": "guide", "model": "guide.glb", )"
                        R"("height_m": 1.75, "license": "CC0-1.0"})"});
    }
    rename(document, "licence", "license");
    CharacterDescription description;
    description.file = file_;
    known(document, "",
          {"name", "model", "height_m", "license", "author", "wears", "sex", "age_years", "bones",
           "clips"});
    description.name = text(document, "", "name", true);
    check_name(description.name);
    description.model = path(text(document, "", "model", true));
    description.height_m =
        number(document, "", "height_m", {0.5, 2.5},
               "in meters, from the soles to the top of the head; the model may have "
               "any unit, it is scaled to this height")
            .value_or(description.height_m);
    description.license = text(document, "", "license", true);
    description.author = text(document, "", "author", false);
    description.wears = text(document, "", "wears", false);
    read_sex(document, description);
    if (document.contains("age_years")) {
      description.age_years =
          number(document, "", "age_years", {1, 110}, "years").value_or(description.age_years);
    }
    read_bones(document, description);
    read_clips(document, description);
    if (!problems_.empty()) throw InputError(problems_);
    return description;
  }

 private:
  /// Replaces a deprecated name; if both are given, the old one stays as an unknown field.
  void rename(json& document, const char* deprecated, const char* name) const {
    if (!document.contains(deprecated) || document.contains(name)) return;
    warn_deprecated(file_.string(), std::string("/") + deprecated, name);
    document[name] = document[deprecated];
    document.erase(deprecated);
  }

  void add_problem(const std::string& where, const std::string& found,
                   const std::string& expected) {
    problems_.push_back({file_.string(), where, found, expected});
  }

  fs::path path(const std::string& given) const {
    return given.empty() ? fs::path() : file_.parent_path() / given;
  }

  void known(const json& object, const std::string& where, const std::vector<std::string>& keys) {
    for (const auto& [key, value] : object.items()) {
      if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
      problems_.push_back(unknown_name(file_.string(), where + "/" + key, "field", key,
                                       std::vector<std::string_view>(keys.begin(), keys.end())));
    }
  }

  std::string text(const json& object, const std::string& where, const char* key, bool needed) {
    const std::string place = where + "/" + key;
    if (!object.contains(key)) {
      if (needed) add_problem(place, "nothing", "a string");
      return {};
    }
    if (!object[key].is_string() || (needed && object[key].get<std::string>().empty())) {
      add_problem(place, object[key].dump(), "a string that is not empty");
      return {};
    }
    return object[key].get<std::string>();
  }

  std::optional<double> number(const json& object, const std::string& where, const char* key,
                               Range range, const char* meaning) {
    const std::string expected = fmt::format("{:g} to {:g} ({})", range.low, range.high, meaning);
    if (!object.contains(key)) {
      add_problem(where + "/" + key, "nothing", expected);
      return {};
    }
    const json& value = object[key];
    if (value.is_number() && value >= range.low && value <= range.high) return value.get<double>();
    add_problem(where + "/" + key, value.dump(), expected);
    return {};
  }

  void check_name(const std::string& name) {
    constexpr std::size_t kMaxNameLength = 40;
    const bool sound = std::all_of(name.begin(), name.end(), [](unsigned char c) {
      return std::isalnum(c) != 0 || c == '_' || c == '-';
    });
    if (!sound || name.size() > kMaxNameLength) {
      add_problem("/name", "\"" + name + "\"", "at most 40 letters, digits, - and _");
    }
  }

  void read_sex(const json& document, CharacterDescription& description) {
    if (!document.contains("sex")) return;
    const json& sex = document["sex"];
    if (sex != "male" && sex != "female") add_problem("/sex", sex.dump(), "\"male\" or \"female\"");
    description.male = sex == "male";
  }

  void read_bones(const json& document, CharacterDescription& description) {
    if (!document.contains("bones")) return;
    if (!document["bones"].is_object()) {
      add_problem("/bones", document["bones"].dump(),
                  R"(an object such as {"left_thigh": "Leg1.L"})");
      return;
    }
    for (const auto& [ours, theirs] : document["bones"].items()) {
      if (theirs.is_string()) {
        description.bones[ours] = theirs.get<std::string>();
      } else {
        add_problem("/bones/" + ours, theirs.dump(), "the name of a bone of the model");
      }
    }
  }

  void read_clips(const json& document, CharacterDescription& description) {
    if (!document.contains("clips")) return;
    const json& clips = document["clips"];
    if (!clips.is_object()) {
      add_problem("/clips", clips.dump(),
                  R"(an object such as {"walk": {"name": "Walk", "speed_mps": 1.4}})");
      return;
    }
    known(clips, "/clips", {"idle", "walk", "run"});
    description.idle = read_clip(clips, "idle", {});
    description.walk = read_clip(clips, "walk", Range{0.2, 3});
    description.run = read_clip(clips, "run", Range{1, 12});
  }

  std::optional<ClipDescription> read_clip(const json& clips, const char* key,
                                           std::optional<Range> speed_mps) {
    if (!clips.contains(key)) return {};
    const json& clip = clips[key];
    const std::string where = std::string("/clips/") + key;
    if (!clip.is_object()) {
      add_problem(where, clip.dump(), R"(an object such as {"name": "Walk", "speed_mps": 1.4})");
      return {};
    }
    known(clip, where, {"name", "file", "speed_mps"});
    ClipDescription read;
    read.name = text(clip, where, "name", false);
    read.file = path(text(clip, where, "file", false));
    if (speed_mps) {
      read.speed_mps =
          number(clip, where, "speed_mps", *speed_mps, "meters per second at the described height")
              .value_or(1);
    }
    return read;
  }

  fs::path file_;
  std::vector<Problem> problems_;
};

}  // namespace

CharacterDescription read_description(const fs::path& file) {
  if (!fs::is_regular_file(file)) {
    throw InputError({file.string(), "", "no such file", "the description of a character"});
  }
  return DescriptionReader(file).read();
}

}  // namespace throng::skinning
