#include "formats/raster_files.h"

#include "base/error.h"

namespace throng::formats {

namespace fs = std::filesystem;

std::vector<std::uint32_t> read_instances(const fs::path& path) {
  const images::Raster raster = images::read_raster(path);
  if (raster.bits != 8 || raster.channels != 3) {
    throw InputError({path.string(), "", "another kind of PNG", "8-bit RGB"});
  }
  std::vector<std::uint32_t> ids(raster.samples.size() / 3);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const std::uint16_t* rgb = raster.samples.data() + 3 * i;
    ids[i] = static_cast<std::uint32_t>(rgb[0]) | static_cast<std::uint32_t>(rgb[1]) << 8 |
             static_cast<std::uint32_t>(rgb[2]) << 16;
  }
  return ids;
}

fs::path raster_path(const fs::path& root, const char* kind, const std::string& image_file) {
  const std::size_t slash = image_file.find('/');
  const std::string rest = slash == std::string::npos ? image_file : image_file.substr(slash + 1);
  return (root / kind / rest).replace_extension(".png");
}

}  // namespace throng::formats
