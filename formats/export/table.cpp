// One CSV of all people in all frames, for tables and statistics. Debian 12 has no library that
// writes Parquet; readers of CSV convert in a line.
#include <fmt/format.h>

#include <iterator>
#include <string>
#include <utility>

#include "formats/export/makers.h"
#include "formats/files/csv_field.h"

namespace throng::formats {

using nlohmann::json;

namespace {

class TableExporter : public Exporter {
 public:
  explicit TableExporter(Output output)
      : output_(std::move(output)), csv_(output_.open("people.csv")) {
    csv_.write(
        "run,camera,frame,time_s,split,image_id,annotation_id,track_id,x,y,width,height,amodal_x,"
        "amodal_y,amodal_width,amodal_height,visibility,truncation,height_px,head_x,head_y,"
        "ground_x_m,ground_y_m,velocity_x_mps,velocity_y_mps,heading_rad,ignored,state,behaviour,"
        "exit,group,sex,age_years,age_band,stature_m,carries\n");
  }

  void add(const Image& image) override {
    text_.clear();
    for (const Person& person : image.people) append(image, person);
    csv_.write(text_);
  }

  void finish() override { csv_.close(); }

 private:
  void append(const Image& image, const Person& person) {
    const auto out = std::back_inserter(text_);
    const Box& box = person.box;
    const Box& amodal = person.amodal;
    fmt::format_to(out, "{},{},{},{},{},{},{},{},", image.run, image.camera, image.frame,
                   image.time_s, to_string(image.split), image.id, person.id, person.track_id);
    fmt::format_to(out, "{},{},{},{},{},{},{},{},{},{},{},", box.x, box.y, box.width, box.height,
                   amodal.x, amodal.y, amodal.width, amodal.height, person.visibility,
                   person.truncation, amodal.height);
    if (person.head) {
      fmt::format_to(out, "{},{}", person.head->x(), person.head->y());
    } else {
      text_ += ",";
    }
    fmt::format_to(out, ",{},{},{},{},{},{}", person.position.x(), person.position.y(),
                   person.velocity.x(), person.velocity.y(), person.heading_rad,
                   person.is_ignored ? 1 : 0);
    for (const char* key : {"state", "behaviour", "exit"}) add_field(person.record, key);
    add_field(*person.track, "group");
    static const json kNone = json::object();
    const auto attributes = person.track->find("attributes");
    for (const char* key : {"sex", "age_years", "age_band", "stature_m", "carries"}) {
      add_field(attributes == person.track->end() ? kNone : *attributes, key);
    }
    text_ += "\n";
  }

  void add_field(const json& record, const char* key) {
    text_.push_back(',');
    text_ += csv_field(record, key);
  }

  Output output_;
  OutputStream csv_;
  std::string text_;
};

}  // namespace

ExporterPointer make_table(const DatasetInfo& /*info*/, Output output) {
  return std::make_unique<TableExporter>(std::move(output));
}

}  // namespace throng::formats
