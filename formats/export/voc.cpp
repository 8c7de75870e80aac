// Pascal VOC: an XML per image; corners are whole pixels, counted from 1, both inside.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/text/markup.h"
#include "formats/export/makers.h"

namespace throng::formats {

namespace {

constexpr double kTruncated = 0.005;

/// First and last pixel of a span, counted from 1. Readers take `last - first` for the length and
/// stop at 0: one pixel is widened to two, within the image.
std::pair<long, long> voc_span(double first, double length, int size) {
  long low = std::lround(first) + 1;
  long high = std::lround(first + length);
  if (high <= low) {
    high = std::min<long>(low + 1, size);
    low = high - 1;
  }
  return {low, high};
}

std::string object_xml(const std::string& name, const Person& person, const Image& image) {
  const auto [left, right] = voc_span(person.box.x, person.box.width, image.width);
  const auto [top, bottom] = voc_span(person.box.y, person.box.height, image.height);
  return fmt::format(
      "  <object>\n    <name>{}</name>\n    <pose>Unspecified</pose>\n    "
      "<truncated>{}</truncated>\n"
      "    <occluded>{}</occluded>\n    <difficult>{}</difficult>\n    <bndbox>\n"
      "      <xmin>{}</xmin>\n      <ymin>{}</ymin>\n      <xmax>{}</xmax>\n"
      "      <ymax>{}</ymax>\n    </bndbox>\n  </object>\n",
      escaped_markup(name), person.truncation >= kTruncated ? 1 : 0,
      person.visibility < 1 - kTruncated ? 1 : 0, person.is_ignored ? 1 : 0, left, top, right,
      bottom);
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
    for (const Person& person : image.people)
      xml += object_xml(names_[person.category], person, image);
    for (const Person& object : image.objects)
      xml += object_xml(names_[object.category], object, image);
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
