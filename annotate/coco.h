// COCO instances JSON, streamed: records are written as they come and never rewritten, so memory
// does not grow with the number of frames.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "annotate/labels.h"
#include "camera/camera.h"

namespace throng::annotate {

struct CocoImage {
  std::int64_t id = 0;
  std::string file_name;  ///< relative to the image root, forward slashes
  std::string run;        ///< "run000"
  std::string camera_id;  ///< drone id
  std::int64_t frame_index = 0;
  double time_s = 0;
  camera::Camera camera;  ///< K, R, t are written with the image
};

/// Appends the records of one shard of frames: `images.jsonl` and `annotations.jsonl` in a folder,
/// one JSON object per line. Annotation ids are image id * 100000 + agent id + 1: unique over the file
/// and independent of how frames are sharded.
class CocoShardWriter {
 public:
  explicit CocoShardWriter(const std::filesystem::path& folder);
  ~CocoShardWriter();
  CocoShardWriter(const CocoShardWriter&) = delete;
  CocoShardWriter& operator=(const CocoShardWriter&) = delete;
  void add(const CocoImage& image, const FrameLabels& labels);
  /// Flushes and closes; throws EnvironmentError when the disk refused.
  void finish();

 private:
  struct Files;
  std::unique_ptr<Files> files_;
};

/// One linear pass over shard folders, in the given order, into one COCO file (written beside and
/// renamed). `description` becomes info.description.
void merge_coco(const std::vector<std::filesystem::path>& shard_folders,
                const std::filesystem::path& output, const std::string& description);

}  // namespace throng::annotate
