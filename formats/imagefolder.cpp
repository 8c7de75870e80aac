// Hugging Face's ImageFolder: images and a metadata.jsonl beside them, equal keys on each line.
#include <fmt/format.h>

#include <map>
#include <string>

#include "formats/makers.h"

namespace throng::formats {

using nlohmann::json;

namespace {

class ImageFolderExporter : public Exporter {
 public:
  ImageFolderExporter(const DatasetInfo& info, Output output)
      : info_(info), output_(std::move(output)) {
    for (const Split split : info.splits()) {
      lines_.try_emplace(split, output_.open(fmt::format("{}/metadata.jsonl", folder_of(split))));
    }
  }

  void add(const Image& image) override {
    const std::string name = image.stem() + ".jpg";
    output_.link(fmt::format("{}/{}", folder_of(image.split), name), info_.root / image.file);
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
  }

  void finish() override {
    for (auto& [split, lines] : lines_) lines.close();
  }

 private:
  /// The loader's own names of splits.
  static std::string_view folder_of(Split split) {
    return split == Split::val ? "validation" : name_of(split);
  }

  const DatasetInfo& info_;
  Output output_;
  std::map<Split, OutputStream> lines_;
};

}  // namespace

ExporterPointer make_imagefolder(const DatasetInfo& info, Output output) {
  return std::make_unique<ImageFolderExporter>(info, std::move(output));
}

}  // namespace throng::formats
