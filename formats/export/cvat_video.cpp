// CVAT for video 1.1: a task for each sequence, its images and an XML of tracks. CVAT wants each
// track whole, so the boxes of one run are kept in memory.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "base/text/markup.h"
#include "formats/export/cvat_labels.h"
#include "formats/export/makers.h"

namespace throng::formats {

namespace {

/// A person in an image.
struct TrackBox {
  std::int64_t frame = 0;
  Box box;
  double visibility = 1;
  std::string state;
};

struct Track {
  std::size_t category = 0;
  std::vector<TrackBox> boxes;
};

struct Task {
  std::string name;
  std::string folder;
  std::int64_t frames = 0;
  int width = 0;
  int height = 0;
  std::map<std::int64_t, Track> tracks;  ///< by track_id
};

void append_box(std::string& text, const TrackBox& shown, std::int64_t frame, bool is_outside) {
  const Box& box = shown.box;
  fmt::format_to(
      std::back_inserter(text),
      "    <box frame=\"{}\" keyframe=\"1\" outside=\"{}\" occluded=\"{}\" xtl=\"{:.2f}\" "
      "ytl=\"{:.2f}\" xbr=\"{:.2f}\" ybr=\"{:.2f}\" z_order=\"0\">\n"
      "      <attribute name=\"visibility\">{:.4f}</attribute>\n"
      "      <attribute name=\"state\">{}</attribute>\n    </box>\n",
      frame, is_outside ? 1 : 0, shown.visibility < 1 - kCvatOccluded ? 1 : 0, box.x, box.y,
      box.x + box.width, box.y + box.height, shown.visibility, escaped_markup(shown.state));
}

std::string track_text(std::int64_t id, const Track& track, std::int64_t frames,
                       const DatasetInfo& info) {
  std::string text = fmt::format("  <track id=\"{}\" label=\"{}\" source=\"file\">\n", id,
                                 escaped_markup(info.categories[track.category]));
  for (std::size_t i = 0; i < track.boxes.size(); ++i) {
    const TrackBox& box = track.boxes[i];
    append_box(text, box, box.frame, false);
    // Outside of the track while the person is not seen; else CVAT would go on showing the box.
    const std::int64_t next = i + 1 < track.boxes.size() ? track.boxes[i + 1].frame : frames;
    if (next > box.frame + 1) append_box(text, box, box.frame + 1, true);
  }
  return text + "  </track>\n";
}

class CvatVideoExporter : public Exporter {
 public:
  CvatVideoExporter(const DatasetInfo& info, Output output)
      : info_(info), output_(std::move(output)) {}

  void add(const Image& image) override {
    if (image.run != run_) write_tasks();
    run_ = image.run;
    Task& task = tasks_[image.camera];
    if (task.frames == 0) {
      task = {image.sequence(),
              fmt::format("{}/{}", to_string(image.split), image.sequence()),
              0,
              image.width,
              image.height,
              {}};
    }
    output_.link(fmt::format("{}/images/frame_{:06}.jpg", task.folder, image.frame),
                 info_.root / image.file);
    task.frames = std::max(task.frames, image.frame + 1);
    for (const Person& person : image.people) {
      if (person.is_ignored) continue;
      Track& track = task.tracks[person.track_id];
      track.category = person.category;
      track.boxes.push_back({image.frame, person.box, person.visibility, person.state});
    }
  }

  void finish() override { write_tasks(); }

 private:
  void write_tasks() {
    for (const auto& [camera, task] : tasks_) write_task(task);
    tasks_.clear();
  }

  void write_task(const Task& task) const {
    OutputStream xml = output_.open(task.folder + "/annotations.xml");
    xml.write(fmt::format(
        "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<annotations>\n"
        "  <version>1.1</version>\n  <meta>\n    <task>\n      <name>{}</name>\n"
        "      <size>{}</size>\n      <mode>interpolation</mode>\n      "
        "<start_frame>0</start_frame>\n"
        "      <stop_frame>{}</stop_frame>\n{}      <original_size>\n        <width>{}</width>\n"
        "        <height>{}</height>\n      </original_size>\n    </task>\n  </meta>\n",
        escaped_markup(info_.name + ", " + task.name), task.frames, task.frames - 1,
        cvat_labels(info_, {"visibility", "state"}), task.width, task.height));
    for (const auto& [id, track] : task.tracks) {
      xml.write(track_text(id, track, task.frames, info_));
    }
    xml.write("</annotations>\n");
    xml.close();
  }

  const DatasetInfo& info_;
  Output output_;
  std::string run_;
  std::map<std::string, Task> tasks_;  ///< of the run, by camera
};

}  // namespace

ExporterPointer make_cvat_video(const DatasetInfo& info, Output output) {
  return std::make_unique<CvatVideoExporter>(info, std::move(output));
}

}  // namespace throng::formats
