// Middlebury's .flo: float32 motion to the next frame.
#include <cstdint>
#include <cstring>
#include <string>

#include "formats/makers.h"
#include "formats/raster_files.h"

namespace throng::formats {

namespace {

constexpr float kMagic = 202021.25F;
constexpr float kUnknownFlow = 1e10F;
constexpr float kPerPixel = 64;
constexpr float kZeroAt = 32768;

void append_bytes(std::string& bytes, const auto& value) {
  const std::size_t at = bytes.size();
  bytes.resize(at + sizeof(value));
  std::memcpy(bytes.data() + at, &value, sizeof(value));
}

class FloExporter : public Exporter {
 public:
  FloExporter(const DatasetInfo& info, Output output) : info_(info), output_(std::move(output)) {}

  void add(const Image& image) override {
    const images::Raster flow = images::read_raster(raster_path(info_.root, "flow", image.file));
    std::string bytes;
    bytes.reserve(12 + flow.samples.size() / 3 * 8);
    append_bytes(bytes, kMagic);
    append_bytes(bytes, static_cast<std::int32_t>(flow.width));
    append_bytes(bytes, static_cast<std::int32_t>(flow.height));
    for (std::size_t i = 0; i < flow.samples.size(); i += 3) {
      const bool is_known = flow.samples[i + 2] != 0;
      for (std::size_t axis = 0; axis < 2; ++axis) {
        const float value = (static_cast<float>(flow.samples[i + axis]) - kZeroAt) / kPerPixel;
        append_bytes(bytes, is_known ? value : kUnknownFlow);
      }
    }
    output_.write(image.sequence() + "/" + image.stem() + ".flo", bytes);
  }
  void finish() override {}

 private:
  const DatasetInfo& info_;
  Output output_;
};

}  // namespace

ExporterPointer make_flow_flo(const DatasetInfo& info, Output output) {
  return std::make_unique<FloExporter>(info, std::move(output));
}

}  // namespace throng::formats
