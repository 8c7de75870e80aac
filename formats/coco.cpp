// COCO instances and keypoints: the dataset's own records, one file for each split, with the
// filters' ignore regions as iscrowd.
#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "annotate/keypoints.h"
#include "annotate/spec/license.h"
#include "formats/makers.h"
#include "formats/mask.h"

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
    std::ifstream all(path_, std::ios::binary);
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
    const json head = {
        {"description", info.name}, {"version", "1"}, {"contributor", info.generator}};
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

json categories_of(const DatasetInfo& info, bool keypoints) {
  json categories = json::array();
  for (std::size_t i = 0; i < info.categories.size(); ++i) {
    json& category = categories.emplace_back(
        json{{"id", i + 1}, {"name", info.categories[i]}, {"supercategory", "person"}});
    if (!keypoints) continue;
    category["keypoints"] = skinning::kKeypointNames;
    category["skeleton"] = annotate::kSkeleton;
  }
  if (info.sees_drones && !keypoints) {
    categories.push_back(
        {{"id", info.categories.size() + 1}, {"name", kDroneClass}, {"supercategory", "vehicle"}});
  }
  return categories;
}

class CocoExporter : public Exporter {
 public:
  CocoExporter(const DatasetInfo& info, Output output, bool keypoints)
      : root_(info.root),
        output_(std::move(output)),
        keypoints_(keypoints),
        drone_category_(info.categories.size()) {
    const std::string kind = keypoints ? "person_keypoints" : "instances";
    for (const Split split : info.splits()) {
      CocoFile& file = files_
                           .try_emplace(split, output_,
                                        fmt::format("annotations/{}_{}.json", kind, name_of(split)))
                           .first->second;
      file.begin(info, categories_of(info, keypoints));
    }
  }

  void add(const Image& image) override {
    CocoFile& file = files_.at(image.split);
    const std::string name = image.stem() + ".jpg";
    output_.link(fs::path(name_of(image.split)) / name, root_ / image.file);
    json record = image.record;
    record["file_name"] = name;
    file.add_image(record);
    for (const Person& person : image.people) add(image, person, person.category, file);
    if (keypoints_) return;
    for (const Person& drone : image.drones) add(image, drone, drone_category_, file);
  }

  void finish() override {
    for (auto& [split, file] : files_) file.finish();
  }

 private:
  void add(const Image& image, const Person& object, std::size_t category, CocoFile& file) const {
    json record = object.record;
    record["category_id"] = category + 1;
    if (object.is_ignored) {
      record["iscrowd"] = 1;
      // COCO has run lengths of regions as plain numbers.
      record["segmentation"]["counts"] =
          runs_of(object.mask, static_cast<std::uint64_t>(image.width) *
                                   static_cast<std::uint64_t>(image.height));
    }
    if (!keypoints_) {
      for (const char* key : {"keypoints", "num_keypoints", "keypoints_3d"}) record.erase(key);
    }
    file.add_annotation(record);
    file.add_track(*object.track, image.run);
  }

  fs::path root_;
  Output output_;
  bool keypoints_;
  std::size_t drone_category_;
  std::map<Split, CocoFile> files_;
};

}  // namespace

ExporterPointer make_coco(const DatasetInfo& info, Output output) {
  return std::make_unique<CocoExporter>(info, std::move(output), false);
}

ExporterPointer make_coco_keypoints(const DatasetInfo& info, Output output) {
  return std::make_unique<CocoExporter>(info, std::move(output), true);
}

}  // namespace throng::formats
