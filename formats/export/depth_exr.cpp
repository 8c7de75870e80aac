// Depth as OpenEXR: one float channel in meters, infinity where nothing is, compressed.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "formats/dataset/raster_files.h"
#include "formats/export/makers.h"

namespace throng::formats {

namespace {

/// Luminance: of single channels, the one that OpenCV reads. It ignores one named Z.
constexpr const char* kChannel = "Y";

/// A file in memory, as OpenEXR writes it.
class MemoryStream : public Imf::OStream {
 public:
  MemoryStream() : OStream("depth.exr") {}
  void write(const char* bytes, int count) override {
    const std::size_t end = place_ + static_cast<std::size_t>(count);
    if (bytes_.size() < end) bytes_.resize(end);
    std::copy_n(bytes, count, bytes_.begin() + static_cast<std::ptrdiff_t>(place_));
    place_ = end;
  }
  std::uint64_t tellp() override { return place_; }
  void seekp(std::uint64_t place) override { place_ = place; }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  std::size_t place_ = 0;
};

std::string exr_bytes(const images::Raster& depth) {
  std::vector<float> meters = depth_meters(depth);
  Imf::Header header(depth.width, depth.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  header.channels().insert(kChannel, Imf::Channel(Imf::FLOAT));
  MemoryStream stream;
  {
    constexpr int kThreads = 0;  // that of the caller
    Imf::OutputFile file(stream, header, kThreads);
    Imf::FrameBuffer buffer;
    const auto row_bytes = static_cast<std::size_t>(depth.width) * sizeof(float);
    buffer.insert(kChannel, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(meters.data()),
                                       sizeof(float), row_bytes));
    file.setFrameBuffer(buffer);
    file.writePixels(depth.height);
  }
  return stream.bytes();
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
