// Depth as OpenEXR: one float channel in meters, infinity where nothing is. Scan lines without
// compression (OpenEXR file layout, Academy Software Foundation): a header of attributes, a table
// of the lines' places, the lines.
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>

#include "formats/dataset/raster_files.h"
#include "formats/export/makers.h"

namespace throng::formats {

namespace {

constexpr float kMetersPerUnit = 0.01F;
/// Luminance: of single channels, the one that OpenCV reads. It ignores one named Z.
constexpr std::string_view kChannel = "Y";

class Bytes {
 public:
  void add(const auto& value) {
    const std::size_t at = bytes_.size();
    bytes_.resize(at + sizeof(value));
    std::memcpy(bytes_.data() + at, &value, sizeof(value));
  }
  void add_text(std::string_view text) {
    bytes_ += text;
    bytes_.push_back('\0');
  }
  void add_attribute(std::string_view name, std::string_view type, const Bytes& value) {
    add_text(name);
    add_text(type);
    add(static_cast<std::int32_t>(value.bytes_.size()));
    bytes_ += value.bytes_;
  }
  std::string& text() { return bytes_; }

 private:
  std::string bytes_;
};

Bytes of(const auto&... values) {
  Bytes bytes;
  (bytes.add(values), ...);
  return bytes;
}

/// Everything before the table of lines.
Bytes header_of(int width, int height) {
  constexpr std::uint32_t kMagicNumber = 20000630;
  constexpr std::uint32_t kVersion = 2;
  constexpr std::int32_t kFloat = 2;
  Bytes channels;
  channels.add_text(kChannel);
  channels.add(kFloat);
  channels.add(std::uint32_t{0});  // not perceptually linear, and three bytes that are kept free
  channels.add(std::int32_t{1});
  channels.add(std::int32_t{1});
  channels.add(std::uint8_t{0});
  const Bytes window = of(std::int32_t{0}, std::int32_t{0}, static_cast<std::int32_t>(width - 1),
                          static_cast<std::int32_t>(height - 1));
  Bytes header = of(kMagicNumber, kVersion);
  header.add_attribute("channels", "chlist", channels);
  header.add_attribute("compression", "compression", of(std::uint8_t{0}));
  header.add_attribute("dataWindow", "box2i", window);
  header.add_attribute("displayWindow", "box2i", window);
  header.add_attribute("lineOrder", "lineOrder", of(std::uint8_t{0}));
  header.add_attribute("pixelAspectRatio", "float", of(1.0F));
  header.add_attribute("screenWindowCenter", "v2f", of(0.0F, 0.0F));
  header.add_attribute("screenWindowWidth", "float", of(1.0F));
  header.add(std::uint8_t{0});
  return header;
}

std::string exr_bytes(const images::Raster& depth) {
  Bytes file = header_of(depth.width, depth.height);
  const std::int32_t line_bytes = depth.width * static_cast<std::int32_t>(sizeof(float));
  constexpr std::uint64_t kLineHeader = 8;
  std::uint64_t place =
      file.text().size() + sizeof(std::uint64_t) * static_cast<std::uint64_t>(depth.height);
  for (int y = 0; y < depth.height; ++y) {
    file.add(place);
    place += kLineHeader + static_cast<std::uint64_t>(line_bytes);
  }
  const std::uint16_t* sample = depth.samples.data();
  for (std::int32_t y = 0; y < depth.height; ++y) {
    file.add(y);
    file.add(line_bytes);
    for (int x = 0; x < depth.width; ++x, ++sample) {
      file.add(*sample == 0 ? std::numeric_limits<float>::infinity()
                            : kMetersPerUnit * static_cast<float>(*sample));
    }
  }
  return std::move(file.text());
}

class ExrExporter : public Exporter {
 public:
  ExrExporter(const DatasetInfo& info, Output output) : info_(info), output_(std::move(output)) {}

  void add(const Image& image) override {
    const images::Raster depth = images::read_raster(raster_path(info_.root, "depth", image.file));
    output_.write(image.sequence() + "/" + image.stem() + ".exr", exr_bytes(depth));
  }
  void finish() override {}

 private:
  const DatasetInfo& info_;
  Output output_;
};

}  // namespace

ExporterPointer make_depth_exr(const DatasetInfo& info, Output output) {
  return std::make_unique<ExrExporter>(info, std::move(output));
}

}  // namespace throng::formats
