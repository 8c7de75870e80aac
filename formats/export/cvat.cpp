// CVAT for images 1.1: one XML of all images, boxes with attributes.
#include <fmt/format.h>

#include <iterator>
#include <string>

#include "base/text/markup.h"
#include "formats/export/cvat_labels.h"
#include "formats/export/makers.h"

namespace throng::formats {

namespace {

class CvatExporter : public Exporter {
 public:
  CvatExporter(const DatasetInfo& info, Output output)
      : info_(info), output_(std::move(output)), xml_(output_.open("annotations.xml")) {
    xml_.write(fmt::format(
        "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<annotations>\n"
        "  <version>1.1</version>\n  <meta>\n    <task>\n      <name>{}</name>\n"
        "{}    </task>\n  </meta>\n",
        escaped_markup(info.name), cvat_labels(info, {"track_id", "visibility", "state"})));
  }

  void add(const Image& image) override {
    const std::string name = fmt::format("{}/{}.jpg", to_string(image.split), image.stem());
    output_.link("images/" + name, info_.root / image.file);
    std::string text =
        fmt::format("  <image id=\"{}\" name=\"{}\" subset=\"{}\" width=\"{}\" height=\"{}\">\n",
                    number_++, name, to_string(image.split), image.width, image.height);
    for (const Person& person : image.people) {
      if (!person.is_ignored) append(text, person);
    }
    xml_.write(text + "  </image>\n");
  }

  void finish() override {
    xml_.write("</annotations>\n");
    xml_.close();
  }

 private:
  void append(std::string& text, const Person& person) const {
    const Box& box = person.box;
    fmt::format_to(
        std::back_inserter(text),
        "    <box label=\"{}\" source=\"file\" occluded=\"{}\" xtl=\"{:.2f}\" ytl=\"{:.2f}\" "
        "xbr=\"{:.2f}\" ybr=\"{:.2f}\" z_order=\"0\">\n"
        "      <attribute name=\"track_id\">{}</attribute>\n"
        "      <attribute name=\"visibility\">{:.4f}</attribute>\n"
        "      <attribute name=\"state\">{}</attribute>\n    </box>\n",
        escaped_markup(info_.categories[person.category]),
        person.visibility < 1 - kCvatOccluded ? 1 : 0, box.x, box.y, box.x + box.width,
        box.y + box.height, person.track_id, person.visibility, escaped_markup(person.state));
  }

  const DatasetInfo& info_;
  Output output_;
  OutputStream xml_;
  std::int64_t number_ = 0;
};

}  // namespace

std::string cvat_labels(const DatasetInfo& info, const std::vector<std::string_view>& attributes) {
  std::string labels = "      <labels>\n";
  for (const std::string& name : info.categories) {
    labels += fmt::format("      <label>\n        <name>{}</name>\n        <attributes>\n",
                          escaped_markup(name));
    for (const std::string_view attribute : attributes) {
      labels += fmt::format(
          "          <attribute>\n            <name>{}</name>\n            "
          "<mutable>True</mutable>\n"
          "            <input_type>text</input_type>\n          </attribute>\n",
          attribute);
    }
    labels += "        </attributes>\n      </label>\n";
  }
  return labels + "      </labels>\n";
}

ExporterPointer make_cvat(const DatasetInfo& info, Output output) {
  return std::make_unique<CvatExporter>(info, std::move(output));
}

}  // namespace throng::formats
