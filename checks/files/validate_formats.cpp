#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/files/untrusted_folders.h"
#include "checks/findings.h"

namespace throng::checks {

namespace fs = std::filesystem;

namespace {

/// Texts have six decimals of the image's size, or three of a pixel.
constexpr double kTextSlackPx = 0.01;

/// The numbers of a line, separated by commas or spaces; what is no number ends them.
std::vector<double> numbers_in(const std::string& line) {
  std::vector<double> numbers;
  const char* at = line.c_str();
  while (*at != '\0') {
    char* end = nullptr;
    numbers.push_back(std::strtod(at, &end));
    if (end == at) return {};
    at = end;
    while (*at == ',' || *at == ' ') ++at;
  }
  return numbers;
}

bool are_close(const std::vector<double>& found, const std::vector<double>& expected) {
  return found.size() >= expected.size() &&
         std::equal(expected.begin(), expected.end(), found.begin(),
                    [](double a, double b) { return std::abs(a - b) <= kTextSlackPx; });
}

/// Path of a file in any split.
fs::path in_a_split(const fs::path& before, const fs::path& after) {
  for (const std::string_view split : formats::kSplitNames) {
    if (fs::is_regular_file(before / split / after)) return before / split / after;
  }
  return before / formats::kSplitNames.front() / after;
}

/// x, y, width and height of a line of YOLO, in pixels; others are no box.
std::vector<double> yolo_box(const std::vector<double>& line, const formats::Image& image) {
  if (line.size() < 5) return {};
  const double width = line[3] * image.width;
  const double height = line[4] * image.height;
  return {line[1] * image.width - width / 2, line[2] * image.height - height / 2, width, height};
}

}  // namespace

void FormatCheck::add(const formats::DatasetInfo& info, const formats::Image& image,
                      Findings& findings) {
  for (const std::string& format : info.formats) {
    const fs::path folder = info.root / "formats" / format;
    if (format == "yolo-detect" || format == "yolo-pose") {
      check_yolo(info, image, folder, format == "yolo-detect", findings);
    } else if (format == "visdrone-det") {
      const fs::path file = in_a_split(folder, fs::path("annotations") / (image.stem() + ".txt"));
      std::ifstream text = open_stream(file);
      compare(file.lexically_relative(info.root).string(), image, text,
              label_values(info, format, image), findings);
      if (std::string line; std::getline(text, line)) {
        findings.add("formats", file.lexically_relative(info.root).string(), "",
                     "more lines than the image has people");
      }
    } else if (format == "visdrone-mot" || format == "mot") {
      const fs::path rest = format == "mot" ? fs::path(image.sequence()) / "gt/gt.txt"
                                            : fs::path("annotations") / (image.sequence() + ".txt");
      const fs::path file = in_a_split(folder, rest);
      const std::string name = file.lexically_relative(info.root).string();
      auto [text, is_new] = texts_.try_emplace(name);
      if (is_new) text->second = open_stream(file);
      compare(name, image, text->second, label_values(info, format, image), findings);
    }
  }
}

void FormatCheck::finish(Findings& findings) {
  for (auto& [name, text] : texts_) {
    if (std::string line; std::getline(text, line)) {
      findings.add("formats", name, "", "more lines than its images have people: " + line);
    }
  }
}

std::vector<std::vector<double>> FormatCheck::label_values(const formats::DatasetInfo& info,
                                                           const std::string& format,
                                                           const formats::Image& image) {
  std::vector<std::vector<double>> lines;
  const auto frame = static_cast<double>(image.frame + 1);
  const auto add = [&](const formats::Person& person, const formats::Box& box) {
    const auto id = static_cast<double>(person.number_in_run());
    const double counts = person.is_ignored ? 0 : 1;
    if (format == "mot") {
      lines.push_back(
          {frame, id, box.x + 1, box.y + 1, box.width, box.height, counts, 1, person.visibility});
    } else {
      lines.push_back({box.x, box.y, box.width, box.height, counts});
      if (format == "visdrone-mot") lines.back().insert(lines.back().begin(), {frame, id});
    }
  };
  for (const formats::Person& person : image.people)
    add(person, format == "mot" ? person.amodal : person.box);
  if (format != "mot") {
    for (const formats::Person& object : image.objects) {
      if (info.surface_material(object) == world::SemanticClass::drone) continue;
      add(object, object.box);
    }
    return lines;
  }
  for (const formats::HiddenPerson& person : image.hidden) {
    const formats::Box& box = person.amodal;
    lines.push_back({frame, static_cast<double>(person.number_in_run()), box.x + 1, box.y + 1,
                     box.width, box.height, person.is_ignored ? 0.0 : 1, 1, 0});
  }
  return lines;
}

void FormatCheck::compare(const std::string& file, const formats::Image& image, std::istream& text,
                          const std::vector<std::vector<double>>& expected, Findings& findings) {
  for (std::size_t i = 0; i < expected.size(); ++i) {
    std::string line;
    if (!std::getline(text, line)) {
      findings.add("formats", file, fmt::format("image {}", image.id),
                   "fewer lines than there are people, or no such file");
      return;
    }
    if (are_close(numbers_in(line), expected[i])) continue;
    findings.add("formats", file, fmt::format("image {}", image.id),
                 "not what the COCO file says: " + line);
    return;
  }
}

void FormatCheck::check_yolo(const formats::DatasetInfo& info, const formats::Image& image,
                             const fs::path& folder, bool with_objects, Findings& findings) {
  const fs::path file = in_a_split(folder / "labels", image.stem() + ".txt");
  const std::string name = file.lexically_relative(info.root).string();
  std::vector<std::vector<double>> lines;
  std::ifstream text = open_stream(file);
  for (std::string line; std::getline(text, line);) {
    lines.push_back(yolo_box(numbers_in(line), image));
  }
  std::vector<std::vector<double>> expected;
  for (const formats::Person& person : image.people) {
    const formats::Box& box = person.box;
    if (!person.is_ignored) expected.push_back({box.x, box.y, box.width, box.height});
  }
  if (with_objects) {
    for (const formats::Person& object : image.objects) {
      const formats::Box& box = object.box;
      if (!object.is_ignored) expected.push_back({box.x, box.y, box.width, box.height});
    }
  }
  const std::string record = fmt::format("image {}", image.id);
  if (lines.size() != expected.size()) {
    findings.add("formats", name, record,
                 fmt::format("{} lines, but {} people and objects are labeled", lines.size(),
                             expected.size()));
    return;
  }
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (are_close(lines[i], expected[i])) continue;
    findings.add("formats", name, record, fmt::format("line {} is not its bbox", i + 1));
  }
}

}  // namespace throng::checks
