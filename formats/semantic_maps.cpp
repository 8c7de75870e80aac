// Images of semantic classes in the classes and layouts of other datasets: Cityscapes (Cordts et
// al. 2016) and UAVid (Lyu et al. 2020). world/semantic_class.h maps the classes.
#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "annotate/png.h"
#include "base/error.h"
#include "formats/makers.h"
#include "formats/raster_files.h"
#include "images/raster.h"
#include "world/semantic_class.h"

namespace throng::formats {

namespace fs = std::filesystem;
using world::CityscapesClass;
using world::SemanticClassInfo;

namespace {

/// The class of each pixel of an image, and the image's size.
struct Classes {
  int width = 0;
  int height = 0;
  std::vector<const SemanticClassInfo*> pixels;
};

Classes read_classes(const DatasetInfo& info, const Image& image) {
  const fs::path path = raster_path(info.root, "semantic", image.file);
  const images::Raster raster = images::read_raster(path);
  if (raster.bits != 8 || raster.channels != 1) {
    throw InputError({path.string(), "", "another kind of PNG", "8-bit gray"});
  }
  Classes classes{raster.width, raster.height, {}};
  classes.pixels.reserve(raster.samples.size());
  const auto known = world::semantic_classes();
  for (const std::uint16_t value : raster.samples) {
    if (value >= known.size()) {
      throw InputError({path.string(), "", fmt::format("class {}", value),
                        fmt::format("0 to {}", known.size() - 1)});
    }
    classes.pixels.push_back(&known[value]);
  }
  return classes;
}

/// A gray PNG of one number for each pixel.
template <typename Sample>
std::string gray_png(const Classes& classes, auto&& number_of) {
  std::vector<Sample> samples;
  samples.reserve(classes.pixels.size());
  for (const SemanticClassInfo* pixel : classes.pixels) samples.push_back(number_of(*pixel));
  return annotate::png_bytes({classes.width, classes.height, 1}, std::span<const Sample>(samples));
}

std::string color_png(const Classes& classes, auto&& color_of) {
  std::vector<std::uint8_t> samples;
  samples.reserve(3 * classes.pixels.size());
  for (const SemanticClassInfo* pixel : classes.pixels) {
    const std::array<std::uint8_t, 3> color = color_of(*pixel);
    samples.insert(samples.end(), color.begin(), color.end());
  }
  return annotate::png_bytes({classes.width, classes.height, 3},
                             std::span<const std::uint8_t>(samples));
}

const CityscapesClass& in_cityscapes(const SemanticClassInfo& info) {
  return world::cityscapes_class(info.cityscapes);
}

/// Cityscapes' instanceIds: the label, or for people, cars and trains 1000 times the label and a
/// number from 0 within the image.
std::string instance_ids_png(const Classes& classes, std::span<const std::uint32_t> ids) {
  constexpr std::uint32_t kPerClass = 1000;
  std::map<std::uint32_t, std::uint32_t> numbers;  // by id
  std::map<std::uint8_t, std::uint32_t> counts;    // by label
  std::vector<std::uint16_t> samples;
  samples.reserve(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    using world::SemanticClass;
    const SemanticClassInfo& info = *classes.pixels[i];
    const bool is_counted = info.value == SemanticClass::person ||
                            info.value == SemanticClass::car || info.value == SemanticClass::train;
    if (!is_counted) {
      samples.push_back(info.cityscapes);
      continue;
    }
    const auto [known, is_new] = numbers.try_emplace(ids[i], 0);
    if (is_new) known->second = counts[info.cityscapes]++;
    // Beyond 65 535 there is no room: such pixels are of the class without an instance.
    const std::uint32_t value = info.cityscapes * kPerClass + known->second;
    samples.push_back(known->second < kPerClass ? static_cast<std::uint16_t>(value)
                                                : std::uint16_t{info.cityscapes});
  }
  return annotate::png_bytes({classes.width, classes.height, 1},
                             std::span<const std::uint16_t>(samples));
}

class CityscapesExporter : public Exporter {
 public:
  CityscapesExporter(const DatasetInfo& info, Output output)
      : info_(info), output_(std::move(output)) {}

  void add(const Image& image) override {
    const Classes classes = read_classes(info_, image);
    const std::string name =
        fmt::format("{}/{}/{}", name_of(image.split), image.sequence(), image.stem());
    output_.link("leftImg8bit/" + name + "_leftImg8bit.jpg", info_.root / image.file);
    const std::string labels = "gtFine/" + name + "_gtFine_";
    output_.write(labels + "labelIds.png",
                  gray_png<std::uint8_t>(
                      classes, [](const SemanticClassInfo& pixel) { return pixel.cityscapes; }));
    output_.write(labels + "labelTrainIds.png",
                  gray_png<std::uint8_t>(classes, [](const SemanticClassInfo& pixel) {
                    return in_cityscapes(pixel).train_id;
                  }));
    output_.write(labels + "color.png", color_png(classes, [](const SemanticClassInfo& pixel) {
                    return in_cityscapes(pixel).color;
                  }));
    const fs::path instances = raster_path(info_.root, "instances", image.file);
    if (!fs::is_regular_file(instances)) return;
    const std::vector<std::uint32_t> ids = read_instances(instances);
    if (ids.size() != classes.pixels.size()) {
      throw InputError({instances.string(), "", fmt::format("{} pixels", ids.size()),
                        fmt::format("{}, as in semantic/", classes.pixels.size())});
    }
    output_.write(labels + "instanceIds.png", instance_ids_png(classes, ids));
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
    const Classes classes = read_classes(info_, image);
    const std::string sequence = fmt::format("uavid_{}/{}", name_of(image.split), image.sequence());
    output_.link(fmt::format("{}/Images/{}.jpg", sequence, image.stem()), info_.root / image.file);
    output_.write(fmt::format("{}/Labels/{}.png", sequence, image.stem()),
                  color_png(classes, [](const SemanticClassInfo& pixel) {
                    return world::uavid_classes()[pixel.uavid].color;
                  }));
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
