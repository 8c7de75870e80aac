// Label Studio: tasks with finished annotations (tasks.json) and the project's labeling interface
// (config.xml). Images are served from the folder by Label Studio's local storage.
#include <fmt/format.h>

#include <string>

#include "base/text/markup.h"
#include "formats/export/makers.h"

namespace throng::formats {

using nlohmann::json;

namespace {

constexpr double kPercent = 100;

json make_rectangle(const Person& person, const Image& image, const std::string& label) {
  const Box& box = person.box;
  return {{"id", fmt::format("p{}", person.id)},
          {"type", "rectanglelabels"},
          {"from_name", "label"},
          {"to_name", "image"},
          {"original_width", image.width},
          {"original_height", image.height},
          {"image_rotation", 0},
          {"meta", {{"text", {fmt::format("track {}, {}", person.track_id, person.state)}}}},
          {"value",
           {{"x", kPercent * box.x / image.width},
            {"y", kPercent * box.y / image.height},
            {"width", kPercent * box.width / image.width},
            {"height", kPercent * box.height / image.height},
            {"rotation", 0},
            {"rectanglelabels", {label}}}}};
}

class LabelStudioExporter : public Exporter {
 public:
  LabelStudioExporter(const DatasetInfo& info, Output output)
      : info_(info), output_(std::move(output)), tasks_(output_.open("tasks.json")) {
    tasks_.write("[");
    std::string labels;
    for (const std::string& name : info.categories) {
      labels += fmt::format("    <Label value=\"{}\"/>\n", escaped_markup(name));
    }
    output_.write("config.xml",
                  fmt::format("<View>\n  <Image name=\"image\" value=\"$image\" zoom=\"true\"/>\n"
                              "  <RectangleLabels name=\"label\" toName=\"image\">\n{}"
                              "  </RectangleLabels>\n</View>\n",
                              labels));
  }

  void add(const Image& image) override {
    const std::string name = fmt::format("images/{}/{}.jpg", to_string(image.split), image.stem());
    output_.link(name, info_.root / image.file);
    json result = json::array();
    for (const Person& person : image.people) {
      if (person.is_ignored) continue;
      result.push_back(make_rectangle(person, image, info_.categories[person.category]));
    }
    const json task = {{"data",
                        {{"image", "/data/local-files/?d=" + name},
                         {"split", to_string(image.split)},
                         {"run", image.run},
                         {"camera", image.camera},
                         {"frame", image.frame}}},
                       {"annotations", {{{"result", std::move(result)}}}}};
    tasks_.write((is_first_ ? "\n" : ",\n") + task.dump());
    is_first_ = false;
  }

  void finish() override {
    tasks_.write("\n]\n");
    tasks_.close();
  }

 private:
  const DatasetInfo& info_;
  Output output_;
  OutputStream tasks_;
  bool is_first_ = true;
};

}  // namespace

ExporterPointer make_label_studio(const DatasetInfo& info, Output output) {
  return std::make_unique<LabelStudioExporter>(info, std::move(output));
}

}  // namespace throng::formats
