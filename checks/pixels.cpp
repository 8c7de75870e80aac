#include "checks/pixels.h"

#include <fmt/format.h>
#include <turbojpeg.h>

#include <array>
#include <memory>
#include <type_traits>

#include "base/error.h"
#include "base/files/files.h"
#include "base/graphics/images/jpeg_file.h"
#include "formats/dataset/raster_files.h"

namespace throng::checks {

namespace fs = std::filesystem;
using annotate::GroundTruth;

namespace {

/// The quantization tables of a JPEG, as they stand in the file.
std::string quantization_tables(const std::string& bytes) {
  std::string tables;
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
  for (std::size_t at = 2; at + 4 <= bytes.size() && byte(at) == 0xFF && byte(at + 1) != 0xDA;) {
    const std::size_t length = static_cast<std::size_t>(byte(at + 2)) << 8U | byte(at + 3);
    if (byte(at + 1) == 0xDB && at + 2 + length <= bytes.size()) {
      tables += bytes.substr(at + 4, length - 2);
    }
    at += 2 + length;
  }
  return tables;
}

/// The tables that a quality stands for.
std::string quantization_of_quality(int quality) {
  const std::unique_ptr<std::remove_pointer_t<tjhandle>, decltype(&tjDestroy)> encoder(
      tjInitCompress(), &tjDestroy);
  constexpr int kSide = 16;
  const std::array<unsigned char, std::size_t{3} * kSide * kSide> gray{};
  unsigned char* made = nullptr;
  unsigned long size = 0;
  std::string tables;
  if (tjCompress2(encoder.get(), gray.data(), kSide, 0, kSide, TJPF_RGB, &made, &size, TJSAMP_420,
                  quality, 0) == 0) {
    tables = quantization_tables({reinterpret_cast<const char*>(made), size});
  }
  tjFree(made);
  return tables;
}

void read_rgb(const formats::DatasetInfo& info, const formats::Image& image, Pixels& pixels,
              Findings& findings) {
  const fs::path path = info.root / image.file;
  const std::string record = fmt::format("image {}", image.id);
  if (!fs::is_regular_file(path)) {
    findings.add("image", image.file, record, "no such file");
    return;
  }
  const std::string bytes = read_file(path);
  try {
    const images::JpegFile jpeg(bytes, image.file);
    if (jpeg.width() != image.width || jpeg.height() != image.height) {
      findings.add("image", image.file, record,
                   fmt::format("{} x {} pixels, but the record says {} x {}", jpeg.width(),
                               jpeg.height(), image.width, image.height));
      return;
    }
    pixels.rgb = jpeg.decode(TJPF_RGB, /*strict=*/true);
  } catch (const InputError&) {
    findings.add("image", image.file, record, "no whole JPEG");
    return;
  }
  const auto sensor = image.record.find("sensor");
  if (sensor == image.record.end() || !sensor->contains("jpeg_quality")) return;
  const int quality = sensor->at("jpeg_quality").get<int>();
  if (quality < 1 || quality > 100 ||
      quantization_tables(bytes) != quantization_of_quality(quality)) {
    findings.add("image", image.file, record,
                 fmt::format("not compressed with the quality that its record says, {}", quality));
  }
}

/// A raster's samples, if it is of the image's size.
std::vector<std::uint16_t> read_plane(const formats::DatasetInfo& info, const formats::Image& image,
                                      GroundTruth what, int channels, int bits,
                                      Findings& findings) {
  if (!info.has(what)) return {};
  const std::string name = ground_truth_file(what, image.run, image.camera, image.frame);
  const std::string kind(ground_truth_kind(what).name);
  try {
    images::Raster raster = images::read_raster(info.root / name);
    if (raster.width == image.width && raster.height == image.height &&
        raster.channels == channels && raster.bits == bits) {
      return std::move(raster.samples);
    }
    findings.add(kind, name, fmt::format("image {}", image.id),
                 fmt::format("{} x {} pixels of {} channels and {} bits, expected {} x {} of {} "
                             "channels and {} bits",
                             raster.width, raster.height, raster.channels, raster.bits, image.width,
                             image.height, channels, bits));
  } catch (const InputError& error) {
    findings.add(kind, name, fmt::format("image {}", image.id), error.problems().front().found);
  }
  return {};
}

}  // namespace

std::string raster_name(const char* kind, const formats::Image& image) {
  return formats::raster_path("", kind, image.file).string();
}

Pixels read_pixels(const formats::DatasetInfo& info, const formats::Image& image,
                   Findings& findings) {
  Pixels pixels;
  pixels.width = image.width;
  pixels.height = image.height;
  read_rgb(info, image, pixels, findings);
  const std::vector<std::uint16_t> rgb =
      read_plane(info, image, GroundTruth::instances, 3, 8, findings);
  pixels.ids.resize(rgb.size() / 3);
  for (std::size_t i = 0; i < pixels.ids.size(); ++i) {
    pixels.ids[i] = static_cast<std::uint32_t>(rgb[3 * i]) |
                    static_cast<std::uint32_t>(rgb[3 * i + 1]) << 8U |
                    static_cast<std::uint32_t>(rgb[3 * i + 2]) << 16U;
  }
  pixels.depth_cm = read_plane(info, image, GroundTruth::depth, 1, 16, findings);
  pixels.normals = read_plane(info, image, GroundTruth::normals, 3, 8, findings);
  pixels.flow = read_plane(info, image, GroundTruth::flow, 3, 16, findings);
  pixels.flow_backward = read_plane(info, image, GroundTruth::flow_backward, 3, 16, findings);
  pixels.flow_occlusion = read_plane(info, image, GroundTruth::flow_occlusion, 1, 8, findings);
  pixels.scene_flow = read_plane(info, image, GroundTruth::scene_flow, 3, 16, findings);
  pixels.hazard_opacity = read_plane(info, image, GroundTruth::hazard_opacity, 3, 8, findings);
  pixels.parts = read_plane(info, image, GroundTruth::parts, 1, 8, findings);
  pixels.semantic = read_plane(info, image, GroundTruth::semantic, 1, 8, findings);
  return pixels;
}

}  // namespace throng::checks
