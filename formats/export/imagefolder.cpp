// Hugging Face's ImageFolder: images and a metadata.jsonl beside them, equal keys on each line, and
// the card of a dataset of their Hub.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <string>

#include "base/text/markup.h"
#include "base/text/words.h"
#include "formats/export/makers.h"
#include "spec/annotate/license.h"

namespace throng::formats {

using nlohmann::json;

namespace {

/// The Hub's classes of a dataset's size.
std::string_view size_category(std::int64_t images) {
  constexpr std::int64_t kThousand = 1000;
  if (images < kThousand) return "n<1K";
  if (images < 10 * kThousand) return "1K<n<10K";
  return images < 100 * kThousand ? "10K<n<100K" : "100K<n<1M";
}

class ImageFolderExporter : public Exporter {
 public:
  ImageFolderExporter(const DatasetInfo& info, Output output)
      : info_(info), output_(std::move(output)) {
    for (const Split split : info.splits()) {
      lines_.try_emplace(split,
                         output_.open(fmt::format("{}/metadata.jsonl", split_folder(split))));
    }
  }

  void add(const Image& image) override {
    const std::string name = image.stem() + ".jpg";
    output_.link(fmt::format("{}/{}", split_folder(image.split), name), info_.root / image.file);
    json objects = {{"bbox", json::array()},
                    {"categories", json::array()},
                    {"area", json::array()},
                    {"track_id", json::array()},
                    {"visibility", json::array()}};
    for (const Person& person : image.people) {
      if (person.is_ignored) continue;
      const Box& box = person.box;
      objects["bbox"].push_back({box.x, box.y, box.width, box.height});
      objects["categories"].push_back(person.category);
      objects["area"].push_back(person.area);
      objects["track_id"].push_back(person.track_id);
      objects["visibility"].push_back(person.visibility);
    }
    const json line = {
        {"file_name", name},      {"image_id", image.id},   {"width", image.width},
        {"height", image.height}, {"run", image.run},       {"camera", image.camera},
        {"frame", image.frame},   {"time_s", image.time_s}, {"objects", std::move(objects)}};
    lines_.at(image.split).write(line.dump() + "\n");
    ++images_;
  }

  void finish() override {
    for (auto& [split, lines] : lines_) lines.close();
    output_.write("README.md", card());
  }

 private:
  std::string card() const {
    const std::string license = lower_case(annotate::kImageLicense);
    std::string classes;
    for (std::size_t i = 0; i < info_.categories.size(); ++i) {
      classes += fmt::format("| {} | {} |\n", i, info_.categories[i]);
    }
    return fmt::format(
        "---\nlicense: {}\npretty_name: {}\ntask_categories:\n- object-detection\n"
        "tags:\n- synthetic\n- aerial\n- crowd\n- drone\nsize_categories:\n- {}\n---\n\n# {}\n\n"
        "{} synthetic images of crowds seen from drones, made by {}. `objects.bbox` is x, y, "
        "width, "
        "height in pixels; `objects.categories`:\n\n| number | class |\n|---|---|\n{}\n"
        "```python\nfrom datasets import load_dataset\n\n"
        "dataset = load_dataset(\"imagefolder\", data_dir=\".\")\n```\n",
        license, json(info_.name).dump(), size_category(images_), escaped_markdown(info_.name),
        images_, escaped_markdown(info_.generator), classes);
  }

  /// The loader's own names of splits.
  static std::string_view split_folder(Split split) {
    return split == Split::val ? "validation" : to_string(split);
  }

  const DatasetInfo& info_;
  Output output_;
  std::map<Split, OutputStream> lines_;
  std::int64_t images_ = 0;
};

}  // namespace

ExporterPointer make_imagefolder(const DatasetInfo& info, Output output) {
  return std::make_unique<ImageFolderExporter>(info, std::move(output));
}

}  // namespace throng::formats
