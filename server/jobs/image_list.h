// List of a dataset's images, from its manifest.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "jobs/queue/dataset/publication.h"

namespace throng::server {

/// The file images/RUN/CAMERA/FRAME.jpg.
struct ImageFile {
  std::string_view run;
  std::string_view camera;
  int frame = 0;
  const jobs::FileEntry* file = nullptr;
};

/// Frames of a camera in a run.
struct CameraFrames {
  std::int64_t images = 0;
  int first = 0;
  int last = 0;
};

/// Filter and page of a list.
struct ImageQuery {
  std::string run;     ///< "": all
  std::string camera;  ///< "": all
  std::int64_t offset = 0;
  std::int64_t limit = 100;
};

/// A page of images and an overview of all frames.
struct ImageList {
  std::vector<ImageFile> images;  ///< matches [offset, offset + limit), sorted by path
  std::int64_t total = 0;         ///< number of all matches
  /// All frames of the dataset, by run and camera.
  std::map<std::string_view, std::map<std::string_view, CameraFrames>> runs;
};

/// Lists images. `files` must be sorted by path and outlive the result; files below images/ with
/// other names are ignored.
ImageList list_images(std::span<const jobs::FileEntry> files, const ImageQuery& query);

}  // namespace throng::server
