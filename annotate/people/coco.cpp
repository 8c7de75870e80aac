#include "annotate/people/coco.h"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>

#include "annotate/people/coco_records.h"
#include "annotate/people/keypoints.h"
#include "base/error.h"
#include "base/files/files.h"
#include "base/json/json_text.h"
#include "base/resource_exhaustion.h"
#include "spec/annotate/ground_truth.h"
#include "spec/annotate/license.h"

namespace throng::annotate {

namespace fs = std::filesystem;

namespace {

constexpr const char* kImagesFile = "images.jsonl";
constexpr const char* kTracksFile = "tracks.jsonl";
constexpr const char* kAnnotationsFile = "annotations.jsonl";
constexpr const char* kShardFile = "coco_shard.json";

// A file that is written front to back.
class Output {
 public:
  explicit Output(fs::path path) : path_(std::move(path)), stream_(path_, std::ios::binary) {
    require_good();
  }
  void write(std::string_view text) {
    stream_.write(text.data(), static_cast<std::streamsize>(text.size()));
    require_good();
  }
  void close() {
    stream_.close();
    require_good();
  }

 private:
  void require_good() const {
    if (stream_) return;
    throw_write_error(path_, errno);
  }

  fs::path path_;
  std::ofstream stream_;
};

struct ShardCounts {
  std::size_t images = 0;
  std::size_t annotations = 0;
  std::size_t tracks = 0;
};

void write_counts(const fs::path& folder, const ShardCounts& counts) {
  const nlohmann::json json = {
      {"images", counts.images}, {"annotations", counts.annotations}, {"tracks", counts.tracks}};
  write_file_atomically(folder / kShardFile, json.dump() + "\n");
}

ShardCounts read_counts(const fs::path& folder) {
  const fs::path path = folder / kShardFile;
  if (!fs::exists(path)) {
    throw EnvironmentError(
        fmt::format("shard {} is unfinished: it has no {}", folder.string(), kShardFile));
  }
  try {
    const nlohmann::json json = parse_own_json(read_file(path), path.string());
    return {json.at("images").get<std::size_t>(), json.at("annotations").get<std::size_t>(),
            json.at("tracks").get<std::size_t>()};
  } catch (const nlohmann::json::exception& error) {
    throw EnvironmentError(fmt::format("{} is damaged: {}", path.string(), error.what()));
  }
}

// Reads the lines of a shard's file, which must be whole JSON objects, as many as were written.
class ShardLines {
 public:
  ShardLines(fs::path path, std::size_t expected)
      : path_(std::move(path)), expected_(expected), stream_(path_, std::ios::binary) {
    if (!stream_) throw EnvironmentError(fmt::format("cannot read {}", path_.string()));
  }

  bool next(std::string& line) {
    if (!std::getline(stream_, line)) {
      if (number_ != expected_) fail(number_ + 1, "the file ends early");
      return false;
    }
    ++number_;
    if (stream_.eof()) fail(number_, "the line is cut off");
    if (number_ > expected_) fail(number_, "the file goes on");
    if (line.empty() || line.front() != '{' || !is_own_json(line)) {
      fail(number_, "the line is no JSON object");
    }
    return true;
  }

 private:
  [[noreturn]] void fail(std::size_t number, std::string_view what) const {
    throw EnvironmentError(fmt::format("{}: line {}: {}; {} lines were written", path_.string(),
                                       number, what, expected_));
  }

  fs::path path_;
  std::size_t expected_;
  std::ifstream stream_;
  std::size_t number_ = 0;
};

// Writes every track once, by id, however many shards have it. Shards come by run, so that no more
// is remembered than one run's people.
void merge_tracks(Output& output, const std::vector<fs::path>& folders,
                  const std::vector<ShardCounts>& counts) {
  std::map<std::int64_t, std::string> of_run;
  std::string_view separator = "\n";
  const auto flush = [&] {
    for (const auto& [id, record] : of_run) {
      output.write(separator);
      output.write(record);
      separator = ",\n";
    }
    of_run.clear();
  };
  std::string line;
  for (std::size_t i = 0; i < folders.size(); ++i) {
    ShardLines lines(folders[i] / kTracksFile, counts[i].tracks);
    while (lines.next(line)) {
      const auto id = parse_own_json(line, kTracksFile).at("id").get<std::int64_t>();
      if (!of_run.empty() && of_run.begin()->first / kTrackIdsPerRun != id / kTrackIdsPerRun) {
        check(of_run.rbegin()->first < id, "shards are merged by run");
        flush();
      }
      of_run.try_emplace(id, line);
    }
  }
  flush();
}

// Appends one file of every shard as the elements of a JSON array.
void merge_array(Output& output, const std::vector<fs::path>& folders,
                 const std::vector<ShardCounts>& counts, const char* file,
                 std::size_t ShardCounts::*count) {
  std::string line;
  std::string_view separator = "\n";
  for (std::size_t i = 0; i < folders.size(); ++i) {
    ShardLines lines(folders[i] / file, counts[i].*count);
    while (lines.next(line)) {
      output.write(separator);
      output.write(line);
      separator = ",\n";
    }
  }
}

}  // namespace

class CocoShardWriter::Files {
 public:
  explicit Files(fs::path folder)
      : folder_(std::move(folder)),
        images_(folder_ / kImagesFile),
        annotations_(folder_ / kAnnotationsFile) {}

  void add(const CocoImage& image, const FrameLabels& labels) {
    text_.clear();
    append_image_record(text_, image, labels);
    images_.write(text_);
    text_.clear();
    for (const PersonLabel& label : labels.people) append_annotation_record(text_, image, label);
    for (const ObjectLabel& label : labels.objects) append_object_record(text_, image, label);
    annotations_.write(text_);
    auto after = tracks_.begin();
    for (const PersonLabel& label : labels.people) after = add_track(image, label.agent, after);
    for (const ObjectLabel& label : labels.objects) add_object(image, label.object);
    ++counts_.images;
    counts_.annotations += labels.people.size() + labels.objects.size();
  }

  void finish() {
    images_.close();
    annotations_.close();
    Output tracks(folder_ / kTracksFile);
    for (const auto& [id, record] : tracks_) tracks.write(record);
    tracks.close();
    counts_.tracks = tracks_.size();
    write_counts(folder_, counts_);
  }

 private:
  using Tracks = std::map<std::int64_t, std::string>;

  // `expected`: where the track probably is. Returns where the next one probably is: people come by
  // agent.
  Tracks::iterator add_track(const CocoImage& image, std::uint32_t agent,
                             Tracks::iterator expected) {
    const auto track = tracks_.try_emplace(expected, track_id(image, agent));
    if (track->second.empty()) append_track_record(track->second, image, agent);
    return std::next(track);
  }

  void add_object(const CocoImage& image, const render::ObjectInView& object) {
    const auto [track, is_new] = tracks_.try_emplace(track_id(image, object_number(object)));
    if (is_new) append_object_track_record(track->second, image, object);
  }

  fs::path folder_;
  Output images_;
  Output annotations_;
  Tracks tracks_;  // by id
  ShardCounts counts_;
  std::string text_;  // reused: the records of one frame
};

CocoShardWriter::CocoShardWriter(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error) fs::remove(folder / kShardFile, error);
  if (error) throw_write_error(folder, error.value());
  files_ = std::make_unique<Files>(folder);
}

CocoShardWriter::~CocoShardWriter() = default;

void CocoShardWriter::add(const CocoImage& image, const FrameLabels& labels) {
  check(files_ != nullptr, "nothing is added to a finished shard");
  check(image.id >= 0 && image.id <= kMaxImageId, "image ids keep annotation ids below 2^53");
  files_->add(image, labels);
}

void CocoShardWriter::finish() {
  check(files_ != nullptr, "a shard is finished once");
  files_->finish();
  files_.reset();
}

std::vector<ObjectCategory> object_categories(bool drones, bool vehicles) {
  std::vector<ObjectCategory> categories;
  for (const ObjectCategory& category : kObjectCategories) {
    const bool is_drone = category.id == kDroneCategory;
    if (is_drone ? drones : vehicles) categories.push_back(category);
  }
  return categories;
}

std::string coco_head(const std::string& description, const CocoCategories& wanted) {
  const nlohmann::json info = {{"description", description}, {"version", kLabelVersion}};
  nlohmann::json categories = {
      {{"id", kPersonCategory}, {"name", "person"}, {"supercategory", "person"}}};
  if (wanted.keypoints) {
    categories[0]["keypoints"] = skinning::kKeypointNames;
    categories[0]["skeleton"] = kSkeleton;
  }
  if (wanted.skeletons) {
    categories[0]["joints"] = skinning::joint_names();
    categories[0]["bones"] = skinning::bone_names();
  }
  for (const ObjectCategory& category : object_categories(wanted.drones, wanted.vehicles)) {
    categories.push_back(
        {{"id", category.id}, {"name", category.name}, {"supercategory", "vehicle"}});
  }
  return fmt::format("{{\"info\":{},\n\"licenses\":{},\n\"categories\":{}", info.dump(),
                     kCocoLicenses, categories.dump());
}

void merge_coco(const std::vector<fs::path>& shard_folders, const fs::path& output,
                const std::string& description, const CocoCategories& wanted) {
  std::vector<ShardCounts> counts;
  counts.reserve(shard_folders.size());
  for (const fs::path& folder : shard_folders) counts.push_back(read_counts(folder));
  const StagingFolder staging(output);
  const fs::path file = staging.path() / "merged.json";
  Output merged(file);
  merged.write(coco_head(description, wanted) + ",\n\"tracks\":[");
  merge_tracks(merged, shard_folders, counts);
  merged.write("\n],\n\"images\":[");
  merge_array(merged, shard_folders, counts, kImagesFile, &ShardCounts::images);
  merged.write("\n],\n\"annotations\":[");
  merge_array(merged, shard_folders, counts, kAnnotationsFile, &ShardCounts::annotations);
  merged.write("\n]}\n");
  merged.close();
  std::error_code error;
  fs::rename(file, output, error);
  if (error) {
    throw EnvironmentError(fmt::format("cannot publish {}: {}", output.string(), error.message()));
  }
}

}  // namespace throng::annotate
