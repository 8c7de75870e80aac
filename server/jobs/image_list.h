// Images of a dataset, from the files of its manifest.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "jobs/queue/dataset/publication.h"

namespace throng::server {

/// images/RUN/CAMERA/FRAME.jpg
struct ImageFile {
  std::string_view run;
  std::string_view camera;
  int frame = 0;
  const jobs::FileEntry* file = nullptr;
};

/// Frames that a camera took in a run.
struct CameraFrames {
  std::int64_t images = 0;
  int first = 0;
  int last = 0;
};

struct ImageQuery {
  std::string run;     ///< "": all
  std::string camera;  ///< "": all
  std::int64_t offset = 0;
  std::int64_t limit = 100;
};

struct ImageList {
  std::vector<ImageFile> images;  ///< [offset, offset + limit) of those that fit, by their paths
  std::int64_t total = 0;         ///< that fit
  /// All frames of the dataset, by run and camera.
  std::map<std::string_view, std::map<std::string_view, CameraFrames>> runs;
};

/// `files` are sorted by path and outlive the result. Other files below images/ are left out.
ImageList list_images(std::span<const jobs::FileEntry> files, const ImageQuery& query);

}  // namespace throng::server
