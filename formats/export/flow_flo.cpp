// Middlebury's .flo: float32 motion to the next frame; to the previous one and a mask of occlusion,
// if the dataset has them.
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "annotate/rasters/png.h"
#include "formats/dataset/raster_files.h"
#include "formats/export/makers.h"

namespace throng::formats {

namespace {

constexpr float kFloMagic = 202021.25F;
constexpr float kUnknownFlow = 1e10F;

void append_bytes(std::string& bytes, const auto& value) {
  const std::size_t at = bytes.size();
  bytes.resize(at + sizeof(value));
  std::memcpy(bytes.data() + at, &value, sizeof(value));
}

std::string encode_flo(const images::Raster& flow) {
  std::string bytes;
  bytes.reserve(12 + flow.samples.size() / 3 * 8);
  append_bytes(bytes, kFloMagic);
  append_bytes(bytes, static_cast<std::int32_t>(flow.width));
  append_bytes(bytes, static_cast<std::int32_t>(flow.height));
  for (std::size_t i = 0; i < flow.samples.size(); i += 3) {
    const auto motion_px = decode_flow(&flow.samples[i]);
    for (const Eigen::Index axis : {0, 1}) {
      append_bytes(bytes, motion_px ? static_cast<float>((*motion_px)[axis]) : kUnknownFlow);
    }
  }
  return bytes;
}

/// 255 where flow leads to what the next frame does not show.
std::string occlusion_png(const images::Raster& targets) {
  constexpr std::uint16_t kHidden = 2;
  std::vector<std::uint8_t> mask;
  mask.reserve(targets.samples.size());
  for (const std::uint16_t target : targets.samples) mask.push_back(target >= kHidden ? 255 : 0);
  return annotate::png_bytes({targets.width, targets.height, 1}, mask);
}

class FloExporter : public Exporter {
 public:
  FloExporter(const DatasetInfo& info, Output output) : info_(info), output_(std::move(output)) {}

  void add(const Image& image) override {
    const auto raster_of = [&](const char* kind) {
      return images::read_raster(raster_path(info_.root, kind, image.file));
    };
    const std::string stem = image.sequence() + "/" + image.stem();
    output_.write(stem + ".flo", encode_flo(raster_of("flow")));
    if (info_.has(annotate::GroundTruth::flow_backward)) {
      output_.write(stem + ".backward.flo", encode_flo(raster_of("flow_backward")));
    }
    if (info_.has(annotate::GroundTruth::flow_occlusion)) {
      output_.write(stem + ".occlusion.png", occlusion_png(raster_of("flow_occlusion")));
    }
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
