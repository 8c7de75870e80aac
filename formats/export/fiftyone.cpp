// FiftyOne's own layout for detections (fiftyone.types.FiftyOneImageDetectionDataset): data/ and
// labels.json, per split.
#include <fmt/format.h>

#include <map>
#include <string>

#include "formats/export/makers.h"

namespace throng::formats {

using nlohmann::json;

namespace {

json make_detection(const Person& person, const Image& image) {
  const Box& box = person.box;
  json attributes = {{"track_id", person.track_id},
                     {"visibility", person.visibility},
                     {"truncation", person.truncation},
                     {"state", person.state}};
  return {{"label", person.category},
          {"bounding_box",
           {box.x / image.width, box.y / image.height, box.width / image.width,
            box.height / image.height}},
          {"attributes", std::move(attributes)}};
}

class FiftyOneExporter : public Exporter {
 public:
  FiftyOneExporter(const DatasetInfo& info, Output output)
      : info_(info), output_(std::move(output)) {
    for (const Split split : info.splits()) {
      OutputStream& labels =
          labels_.try_emplace(split, output_.open(fmt::format("{}/labels.json", to_string(split))))
              .first->second;
      labels.write(fmt::format("{{\"classes\": {}, \"labels\": {{", json(info.categories).dump()));
    }
  }

  void add(const Image& image) override {
    output_.link(fmt::format("{}/data/{}.jpg", to_string(image.split), image.stem()),
                 info_.root / image.file);
    json detections = json::array();
    for (const Person& person : image.people) {
      if (!person.is_ignored) detections.push_back(make_detection(person, image));
    }
    labels_.at(image.split)
        .write(fmt::format("{}\n{}: {}", counts_[image.split]++ > 0 ? "," : "",
                           json(image.stem()).dump(), detections.dump()));
  }

  void finish() override {
    for (auto& [split, labels] : labels_) {
      labels.write("\n}}\n");
      labels.close();
    }
  }

 private:
  const DatasetInfo& info_;
  Output output_;
  std::map<Split, OutputStream> labels_;
  std::map<Split, int> counts_;
};

}  // namespace

ExporterPointer make_fiftyone(const DatasetInfo& info, Output output) {
  return std::make_unique<FiftyOneExporter>(info, std::move(output));
}

}  // namespace throng::formats
