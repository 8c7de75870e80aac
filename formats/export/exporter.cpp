#include "formats/export/exporter.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <utility>

#include "base/error.h"
#include "base/text/suggest.h"

namespace throng::formats {

using annotate::GroundTruth;

bool Format::needs_images() const {
  return annotate::needs_images(annotate::ground_truth_kind(needs));
}

std::vector<const Format*> choose_formats(const std::vector<std::string>& names,
                                          const std::vector<std::string>& annotations,
                                          const std::string& where) {
  std::vector<const Format*> chosen;
  std::vector<Problem> problems;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string place = fmt::format("{}/{}", where, i);
    const Format* format = find_format(names[i]);
    if (format == nullptr) {
      std::vector<std::string_view> known;
      known.reserve(all_formats().size());
      for (const Format& other : all_formats()) known.push_back(other.name);
      problems.push_back(unknown_name("", place, "format", names[i], known));
      continue;
    }
    if (std::find(chosen.begin(), chosen.end(), format) != chosen.end()) {
      problems.push_back({"", place, names[i] + " once more", "each format once"});
    }
    std::set<GroundTruth> needs = {format->needs};
    if (format->needs_images()) needs.insert({GroundTruth::coco, format->needs_also});
    for (const GroundTruth need : needs) {
      if (annotate::holds(annotations, need)) continue;
      problems.push_back({"", place, names[i],
                          fmt::format("\"{}\" among outputs.annotations, which {} is made of",
                                      annotate::ground_truth_kind(need).name, names[i])});
    }
    chosen.push_back(format);
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return chosen;
}

std::vector<Problem> split_warnings(const DatasetInfo& info,
                                    const std::vector<const Format*>& formats) {
  const std::vector<Split> used = info.splits();
  std::vector<std::string_view> empty;
  for (const Split split : {Split::train, Split::val}) {
    if (std::find(used.begin(), used.end(), split) == used.end()) empty.push_back(to_string(split));
  }
  std::vector<Problem> warnings;
  if (empty.empty()) return warnings;
  for (const Format* format : formats) {
    if (!format->name.starts_with("yolo-")) continue;
    warnings.push_back(
        {"", std::string(format->name) + "/data.yaml",
         fmt::format("no run in the split {}, which it does not name", fmt::join(empty, " or ")),
         "runs in train and in val, which Ultralytics wants for training"});
  }
  return warnings;
}

std::vector<Problem> export_dataset(const DatasetInfo& info,
                                    const std::vector<const Format*>& formats,
                                    const std::filesystem::path& output, Exporter* also) {
  std::vector<std::unique_ptr<Exporter>> exporters;
  exporters.reserve(formats.size());
  for (const Format* format : formats) {
    exporters.push_back(format->make(info, Output(output / format->name)));
  }
  if (info.has(GroundTruth::coco)) {
    DatasetReader reader(info);
    Image image;
    while (reader.next(image)) {
      for (const auto& exporter : exporters) exporter->add(image);
      if (also != nullptr) also->add(image);
    }
  }
  std::vector<Problem> warnings;
  for (const auto& exporter : exporters) {
    exporter->finish();
    for (Problem& warning : exporter->warnings()) warnings.push_back(std::move(warning));
  }
  if (also != nullptr) also->finish();
  return warnings;
}

}  // namespace throng::formats
