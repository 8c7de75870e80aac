// Writer for COCO instances JSON. It streams: records are written at once and never changed, so
// memory does not grow with the number of frames.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "annotate/people/coco_image.h"
#include "annotate/people/frame_labels.h"
#include "annotate/people/person_facts.h"
#include "camera/camera.h"
#include "world/semantic_class.h"

namespace throng::annotate {

/// Writes the records of one shard into a folder: `images.jsonl`, `annotations.jsonl` and, for the
/// people in them, `tracks.jsonl`, each with one JSON object per line, and `coco_shard.json`, which
/// counts the records and marks the shard as complete. Ids depend on image and agent only, not on
/// the division into shards.
class CocoShardWriter {
 public:
  /// Creates the folder; replaces the files of an earlier attempt. Throws EnvironmentError.
  explicit CocoShardWriter(const std::filesystem::path& folder);
  ~CocoShardWriter();
  CocoShardWriter(const CocoShardWriter&) = delete;
  CocoShardWriter& operator=(const CocoShardWriter&) = delete;
  /// Appends the records of an image. Its id must be unique in the dataset and at most kMaxImageId.
  /// Throws EnvironmentError if the files cannot be written.
  void add(const CocoImage& image, const FrameLabels& labels);
  /// Flushes and closes the files and marks the shard as complete. Throws EnvironmentError if the
  /// files cannot be written.
  void finish();

 private:
  class Files;
  std::unique_ptr<Files> files_;
};

/// Content of the COCO file's `categories`.
struct CocoCategories {
  bool keypoints = false;  ///< the category of people names COCO's keypoints
  bool drones = false;     ///< there is a category of drones
  bool vehicles = false;   ///< there are categories of vehicles
  bool skeletons = false;  ///< the category of people names joints and bones
};

/// The beginning of the COCO file up to its records: `info`, `licenses` and `categories`.
/// `description` becomes info.description. With "}" appended it is a JSON object.
std::string coco_head(const std::string& description, const CocoCategories& categories);

/// Concatenates shards, which must be in the order of their runs, into one COCO file, in one pass
/// and atomically. `description` becomes info.description. Throws EnvironmentError that names file
/// and line if a shard is incomplete or damaged, or if the file cannot be written.
void merge_coco(const std::vector<std::filesystem::path>& shard_folders,
                const std::filesystem::path& output, const std::string& description,
                const CocoCategories& categories = {});

}  // namespace throng::annotate
