// COCO instances and keypoints: the dataset's own records, one file for each split, with the
// filters' ignore regions as iscrowd.
#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "annotate/people/keypoints.h"
#include "base/files/untrusted_folders.h"
#include "formats/dataset/joints.h"
#include "formats/dataset/mask.h"
#include "formats/export/makers.h"
#include "spec/annotate/ground_truth.h"
#include "spec/annotate/license.h"

namespace throng::formats {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

/// An array of records that are written aside until those before it are complete.
class Aside {
 public:
  explicit Aside(fs::path path) : path_(std::move(path)), stream_(path_) {}

  void add(const json& record) {
    stream_.write(count_++ == 0 ? "\n" : ",\n");
    stream_.write(record.dump());
  }
  void move_to(OutputStream& output) {
    stream_.close();
    std::ifstream all = open_stream(path_);
    std::string block(1 << 20, '\0');
    while (all.read(block.data(), static_cast<std::streamsize>(block.size())) || all.gcount() > 0) {
      output.write(std::string_view(block).substr(0, static_cast<std::size_t>(all.gcount())));
    }
    all.close();
    fs::remove(path_);
  }

 private:
  fs::path path_;
  OutputStream stream_;
  std::size_t count_ = 0;
};

class CocoFile {
 public:
  CocoFile(const Output& output, const std::string& path)
      : final_(output.open(path)),
        tracks_(output.folder() / (path + ".tracks")),
        annotations_(output.folder() / (path + ".annotations")) {}

  void begin(const DatasetInfo& info, const json& categories) {
    const json head = {{"description", info.name},
                       {"version", annotate::kLabelVersion},
                       {"contributor", info.generator}};
    final_.write(fmt::format("{{\"info\":{},\n\"licenses\":{},\n\"categories\":{},\n\"images\":[",
                             head.dump(), annotate::kCocoLicenses, categories.dump()));
  }
  void add_image(const json& record) {
    final_.write(images_++ == 0 ? "\n" : ",\n");
    final_.write(record.dump());
  }
  void add_annotation(const json& record) { annotations_.add(record); }

  /// Images come by run: a track is in those of one run only.
  void add_track(const json& track, const std::string& run) {
    if (run != run_) tracks_of_run_.clear();
    run_ = run;
    if (!track.empty() && tracks_of_run_.insert(track.at("id").get<std::int64_t>()).second) {
      tracks_.add(track);
    }
  }

  void finish() {
    final_.write("\n],\n\"tracks\":[");
    tracks_.move_to(final_);
    final_.write("\n],\n\"annotations\":[");
    annotations_.move_to(final_);
    final_.write("\n]}\n");
    final_.close();
  }

 private:
  OutputStream final_;
  Aside tracks_;
  Aside annotations_;
  std::size_t images_ = 0;
  std::string run_;
  std::set<std::int64_t> tracks_of_run_;
};

json coco_categories(const DatasetInfo& info, bool keypoints) {
  json categories = json::array();
  for (std::size_t i = 0; i < info.categories.size(); ++i) {
    json& category = categories.emplace_back(
        json{{"id", i + 1}, {"name", info.categories[i]}, {"supercategory", "person"}});
    if (!keypoints) continue;
    category["keypoints"] = skinning::kKeypointNames;
    category["skeleton"] = annotate::kSkeleton;
  }
  if (keypoints) return categories;
  for (const annotate::ObjectCategory& category : info.object_categories) {
    categories.push_back(
        {{"id", categories.size() + 1}, {"name", category.name}, {"supercategory", "vehicle"}});
  }
  return categories;
}

/// Which of COCO's kinds of files is written.
enum class CocoKind : std::uint8_t { instances, keypoints, whole_bodies };

std::string coco_file_name(CocoKind kind, Split split) {
  switch (kind) {
    case CocoKind::instances:
      break;
    case CocoKind::keypoints:
      return fmt::format("annotations/person_keypoints_{}.json", to_string(split));
    case CocoKind::whole_bodies:
      return fmt::format("annotations/coco_wholebody_{}_v1.0.json", to_string(split));
  }
  return fmt::format("annotations/instances_{}.json", to_string(split));
}

/// COCO-WholeBody's members (Jin et al. 2020): six points of the feet; faces and hands have none.
void add_whole_body(json& record) {
  using skinning::Joint;
  constexpr std::array kFeet = {Joint::left_big_toe,  Joint::left_small_toe,  Joint::left_heel,
                                Joint::right_big_toe, Joint::right_small_toe, Joint::right_heel};
  const std::vector<JointInImage> joints = read_joints(record);
  json feet = json::array();
  bool are_valid = false;
  for (const Joint joint : kFeet) {
    const JointInImage& at = joints.at(index_from(joint));
    const int visibility = at.coco_visibility();
    feet.insert(feet.end(), {at.place.x(), at.place.y(), visibility});
    are_valid = are_valid || visibility > 0;
  }
  record["foot_kpts"] = std::move(feet);
  record["foot_valid"] = are_valid;
  for (const auto& [part, points] : {std::pair{"face", 68}, {"lefthand", 21}, {"righthand", 21}}) {
    record[std::string(part) + "_box"] = json::array({0, 0, 0, 0});
    record[std::string(part) + "_kpts"] = std::vector<int>(3UL * static_cast<std::size_t>(points));
    record[std::string(part) + "_valid"] = false;
  }
}

class CocoExporter : public Exporter {
 public:
  CocoExporter(const DatasetInfo& info, Output output, CocoKind kind)
      : root_(info.root), output_(std::move(output)), kind_(kind) {
    for (const Split split : info.splits()) {
      CocoFile& file =
          files_.try_emplace(split, output_, coco_file_name(kind, split)).first->second;
      file.begin(info, coco_categories(info, kind != CocoKind::instances));
    }
  }

  void add(const Image& image) override {
    CocoFile& file = files_.at(image.split);
    const std::string name = image.stem() + ".jpg";
    output_.link(fs::path(to_string(image.split)) / name, root_ / image.file);
    json record = image.record;
    record["file_name"] = name;
    file.add_image(record);
    for (const Person& person : image.people) add(image, person, file);
    if (kind_ != CocoKind::instances) return;
    for (const Person& object : image.objects) add(image, object, file);
  }

  void finish() override {
    for (auto& [split, file] : files_) file.finish();
  }

 private:
  void add(const Image& image, const Person& object, CocoFile& file) const {
    json record = object.record;
    record["category_id"] = object.category + 1;
    if (object.is_ignored) {
      record["iscrowd"] = 1;
      // COCO has run lengths of regions as plain numbers.
      record["segmentation"]["counts"] =
          decode_runs(object.mask, static_cast<std::uint64_t>(image.width) *
                                       static_cast<std::uint64_t>(image.height));
    }
    if (kind_ == CocoKind::whole_bodies) add_whole_body(record);
    if (kind_ == CocoKind::instances) {
      for (const char* key : {"keypoints", "num_keypoints", "keypoints_3d"}) record.erase(key);
    }
    file.add_annotation(record);
    file.add_track(*object.track, image.run);
  }

  fs::path root_;
  Output output_;
  CocoKind kind_;
  std::map<Split, CocoFile> files_;
};

}  // namespace

ExporterPointer make_coco(const DatasetInfo& info, Output output) {
  return std::make_unique<CocoExporter>(info, std::move(output), CocoKind::instances);
}

ExporterPointer make_coco_keypoints(const DatasetInfo& info, Output output) {
  return std::make_unique<CocoExporter>(info, std::move(output), CocoKind::keypoints);
}

ExporterPointer make_coco_wholebody(const DatasetInfo& info, Output output) {
  return std::make_unique<CocoExporter>(info, std::move(output), CocoKind::whole_bodies);
}

}  // namespace throng::formats
