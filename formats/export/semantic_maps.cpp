// Images of semantic classes in the classes and layouts of other datasets: Cityscapes (Cordts et
// al. 2016) and UAVid (Lyu et al. 2020). formats/dataset/class_mappings.h maps the classes.
#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "annotate/rasters/png.h"
#include "base/error.h"
#include "formats/dataset/class_mappings.h"
#include "formats/dataset/raster_files.h"
#include "formats/export/makers.h"
#include "world/semantic_class.h"

namespace throng::formats {

namespace fs = std::filesystem;
using world::SemanticClass;

namespace {

/// The classes of an image's pixels.
struct Classes {
  int width = 0;
  int height = 0;
  std::vector<SemanticClass> pixels;
};

Classes list_classes(const DatasetInfo& info, const Image& image) {
  return {image.width, image.height,
          read_classes(raster_path(info.root, "semantic", image.file), image.width, image.height)};
}

/// A gray PNG of one number for each pixel.
std::string gray_png(const Classes& classes, auto&& number_of) {
  std::vector<std::uint8_t> samples;
  samples.reserve(classes.pixels.size());
  for (const SemanticClass pixel : classes.pixels) samples.push_back(number_of(pixel));
  return annotate::png_bytes({classes.width, classes.height, 1},
                             std::span<const std::uint8_t>(samples));
}

std::string color_png(const Classes& classes, auto&& color_of) {
  std::vector<std::uint8_t> samples;
  samples.reserve(3 * classes.pixels.size());
  for (const SemanticClass pixel : classes.pixels) {
    const std::array<std::uint8_t, 3> color = color_of(pixel);
    samples.insert(samples.end(), color.begin(), color.end());
  }
  return annotate::png_bytes({classes.width, classes.height, 3},
                             std::span<const std::uint8_t>(samples));
}

/// Cityscapes' instanceIds: the label, or for people and vehicles 1000 times the label and a
/// number from 0 within the image.
std::string instance_ids_png(const Classes& classes, std::span<const std::uint32_t> ids) {
  constexpr std::uint32_t kPerClass = 1000;
  std::map<std::uint32_t, std::uint32_t> numbers;  // by id
  std::map<std::uint8_t, std::uint32_t> counts;    // by label
  std::vector<std::uint16_t> samples;
  samples.reserve(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const SemanticClass value = classes.pixels[i];
    const std::uint8_t label = cityscapes_class(value).id;
    const bool is_counted = value == SemanticClass::person || world::is_vehicle(value);
    if (!is_counted) {
      samples.push_back(label);
      continue;
    }
    const auto [known, is_new] = numbers.try_emplace(ids[i], 0);
    if (is_new) known->second = counts[label]++;
    // After 1000 of a class numbers would be those of the next: pixels without an instance.
    const std::uint32_t number = label * kPerClass + known->second;
    samples.push_back(known->second < kPerClass ? static_cast<std::uint16_t>(number)
                                                : std::uint16_t{label});
  }
  return annotate::png_bytes({classes.width, classes.height, 1},
                             std::span<const std::uint16_t>(samples));
}

class CityscapesExporter : public Exporter {
 public:
  CityscapesExporter(const DatasetInfo& info, Output output)
      : info_(info), output_(std::move(output)) {}

  void add(const Image& image) override {
    const Classes classes = list_classes(info_, image);
    const std::string name =
        fmt::format("{}/{}/{}", to_string(image.split), image.sequence(), image.stem());
    output_.link("leftImg8bit/" + name + "_leftImg8bit.jpg", info_.root / image.file);
    const std::string labels = "gtFine/" + name + "_gtFine_";
    output_.write(labels + "labelIds.png", gray_png(classes, [](SemanticClass pixel) {
                    return cityscapes_class(pixel).id;
                  }));
    output_.write(labels + "labelTrainIds.png", gray_png(classes, [](SemanticClass pixel) {
                    return cityscapes_class(pixel).train_id;
                  }));
    output_.write(labels + "color.png", color_png(classes, [](SemanticClass pixel) {
                    return cityscapes_class(pixel).color;
                  }));
    const fs::path instances = raster_path(info_.root, "instances", image.file);
    if (!fs::is_regular_file(instances)) return;
    output_.write(labels + "instanceIds.png",
                  instance_ids_png(classes, read_instances(instances, image.width, image.height)));
  }
  void finish() override {}

 private:
  const DatasetInfo& info_;
  Output output_;
};

class UavidExporter : public Exporter {
 public:
  UavidExporter(const DatasetInfo& info, Output output) : info_(info), output_(std::move(output)) {}

  void add(const Image& image) override {
    const Classes classes = list_classes(info_, image);
    const std::string sequence =
        fmt::format("uavid_{}/{}", to_string(image.split), image.sequence());
    output_.link(fmt::format("{}/Images/{}.jpg", sequence, image.stem()), info_.root / image.file);
    output_.write(fmt::format("{}/Labels/{}.png", sequence, image.stem()),
                  color_png(classes, [](SemanticClass pixel) { return uavid_class(pixel).color; }));
  }
  void finish() override {}

 private:
  const DatasetInfo& info_;
  Output output_;
};

}  // namespace

ExporterPointer make_cityscapes(const DatasetInfo& info, Output output) {
  return std::make_unique<CityscapesExporter>(info, std::move(output));
}

ExporterPointer make_uavid(const DatasetInfo& info, Output output) {
  return std::make_unique<UavidExporter>(info, std::move(output));
}

}  // namespace throng::formats
