// Pascal VOC: an XML per image; corners are whole pixels, counted from 1, both inside.
#include <fmt/format.h>

#include <map>
#include <string>
#include <vector>

#include "base/text/markup.h"
#include "formats/export/makers.h"

namespace throng::formats {

namespace {

constexpr double kTruncated = 0.005;

std::string object_xml(const std::string& name, const Person& person) {
  const Box& box = person.box;
  return fmt::format(
      "  <object>\n    <name>{}</name>\n    <pose>Unspecified</pose>\n    "
      "<truncated>{}</truncated>\n"
      "    <occluded>{}</occluded>\n    <difficult>{}</difficult>\n    <bndbox>\n"
      "      <xmin>{:.0f}</xmin>\n      <ymin>{:.0f}</ymin>\n      <xmax>{:.0f}</xmax>\n"
      "      <ymax>{:.0f}</ymax>\n    </bndbox>\n  </object>\n",
      escaped_markup(name), person.truncation >= kTruncated ? 1 : 0,
      person.visibility < 1 - kTruncated ? 1 : 0, person.is_ignored ? 1 : 0, box.x + 1, box.y + 1,
      box.x + box.width, box.y + box.height);
}

class VocExporter : public Exporter {
 public:
  VocExporter(const DatasetInfo& info, Output output)
      : info_(info), output_(std::move(output)), names_(info.class_names()) {
    for (const Split split : info.splits()) {
      sets_.try_emplace(split,
                        output_.open(fmt::format("ImageSets/Main/{}.txt", to_string(split))));
    }
  }

  void add(const Image& image) override {
    const std::string stem = image.stem();
    output_.link("JPEGImages/" + stem + ".jpg", info_.root / image.file);
    std::string xml = fmt::format(
        "<annotation>\n  <folder>JPEGImages</folder>\n  <filename>{}.jpg</filename>\n"
        "  <source>\n    <database>{}</database>\n  </source>\n"
        "  <size>\n    <width>{}</width>\n    <height>{}</height>\n    <depth>3</depth>\n  "
        "</size>\n"
        "  <segmented>0</segmented>\n",
        stem, escaped_markup(info_.name), image.width, image.height);
    for (const Person& person : image.people) xml += object_xml(names_[person.category], person);
    for (const Person& object : image.objects) xml += object_xml(names_[object.category], object);
    output_.write("Annotations/" + stem + ".xml", xml + "</annotation>\n");
    sets_.at(image.split).write(stem + "\n");
  }

  void finish() override {
    for (auto& [split, set] : sets_) set.close();
  }

 private:
  const DatasetInfo& info_;
  Output output_;
  std::vector<std::string> names_;  ///< of classes
  std::map<Split, OutputStream> sets_;
};

}  // namespace

ExporterPointer make_voc(const DatasetInfo& info, Output output) {
  return std::make_unique<VocExporter>(info, std::move(output));
}

}  // namespace throng::formats
