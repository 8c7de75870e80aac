#include "server/jobs/image_list.h"

#include <algorithm>
#include <charconv>
#include <optional>

namespace throng::server {

namespace {

constexpr std::string_view kImageFolder = "images/";

std::optional<ImageFile> parse_image_file(const jobs::FileEntry& file) {
  std::string_view rest = std::string_view(file.path).substr(kImageFolder.size());
  const auto next_part = [&rest] {
    const std::string_view part = rest.substr(0, rest.find('/'));
    rest.remove_prefix(std::min(part.size() + 1, rest.size()));
    return part;
  };
  ImageFile image;
  image.run = next_part();
  image.camera = next_part();
  const std::string_view frame = rest.substr(0, rest.find('.'));
  const auto result = std::from_chars(frame.data(), frame.data() + frame.size(), image.frame);
  const bool is_number =
      !frame.empty() && result.ec == std::errc() && result.ptr == frame.data() + frame.size();
  if (image.run.empty() || image.camera.empty() || !is_number || image.frame < 0) {
    return std::nullopt;
  }
  image.file = &file;
  return image;
}

void note(CameraFrames& frames, int frame) {
  frames.first = frames.images == 0 ? frame : std::min(frames.first, frame);
  frames.last = std::max(frames.last, frame);
  ++frames.images;
}

}  // namespace

ImageList list_images(std::span<const jobs::FileEntry> files, const ImageQuery& query) {
  ImageList list;
  const auto first = std::lower_bound(
      files.begin(), files.end(), kImageFolder,
      [](const jobs::FileEntry& file, std::string_view path) { return file.path < path; });
  for (auto file = first; file != files.end() && file->path.starts_with(kImageFolder); ++file) {
    const std::optional<ImageFile> image = parse_image_file(*file);
    if (!image) continue;
    note(list.runs[image->run][image->camera], image->frame);
    const bool fits = (query.run.empty() || query.run == image->run) &&
                      (query.camera.empty() || query.camera == image->camera);
    if (!fits) continue;
    if (list.total >= query.offset && list.total < query.offset + query.limit) {
      list.images.push_back(*image);
    }
    ++list.total;
  }
  return list;
}

}  // namespace throng::server
