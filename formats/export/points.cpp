// Heads as points and density maps, as ShanghaiTech has them: .mat, .h5 and .npy.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "annotate/rasters/density.h"
#include "base/error.h"
#include "base/resource_exhaustion.h"
#include "formats/dataset/heads.h"
#include "formats/dataset/image_camera.h"
#include "formats/export/makers.h"
#include "formats/files/mat_file.h"
#include "world/hdf5_file.h"

namespace throng::formats {

namespace fs = std::filesystem;

namespace {

enum class Kernel : std::uint8_t { fixed, adaptive, perspective };

constexpr double kFixedSigmaPx = 4;
constexpr double kMinSigmaPx = 0.5;

struct Heads {
  std::vector<Eigen::Vector2d> place;  ///< box coordinates, inside the image
  std::vector<Eigen::Vector3d> body;   ///< middles of the people, m, world
};

Heads head_positions(const Image& image) {
  Heads heads;
  for (const Person& person : image.people) {
    if (person.is_ignored || !person.head) continue;
    const Eigen::Vector2d& at = *person.head;
    if (!is_in_image(image, at)) continue;
    heads.place.push_back(at);
    heads.body.push_back(person.box_middle);
  }
  return heads;
}

/// 0.3 times the mean distance to the three nearest heads (Zhang et al., 2016, eq. 2); of a head
/// alone, a quarter of the image's mean side.
std::vector<double> adaptive_sigmas(const Heads& heads, const Image& image) {
  constexpr double kBeta = 0.3;
  constexpr std::size_t kNeighbors = 3;
  std::vector<double> sigmas;
  std::vector<double> distances;
  for (const Eigen::Vector2d& head : heads.place) {
    distances.clear();
    for (const Eigen::Vector2d& other : heads.place) {
      if (&other != &head) distances.push_back((other - head).norm());
    }
    const std::size_t count = std::min(kNeighbors, distances.size());
    std::partial_sort(distances.begin(), distances.begin() + static_cast<std::ptrdiff_t>(count),
                      distances.end());
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum += distances[i];
    const double alone = (image.width + image.height) / 8.0;
    sigmas.push_back(count == 0 ? alone : kBeta * sum / static_cast<double>(count));
  }
  return sigmas;
}

/// 0.2 m at the head's distance (Zhang et al., 2015: 0.2 times the pixels of a meter).
std::vector<double> perspective_sigmas(const Heads& heads, const Image& image) {
  constexpr double kSigmaM = 0.2;
  const camera::Camera camera = image_camera(image);
  std::vector<double> sigmas;
  sigmas.reserve(heads.body.size());
  for (const Eigen::Vector3d& body : heads.body) {
    sigmas.push_back(pixels_across(camera, body, kSigmaM));
  }
  return sigmas;
}

std::vector<double> kernel_sigmas(Kernel kernel, const Heads& heads, const Image& image) {
  std::vector<double> sigmas(heads.place.size(), kFixedSigmaPx);
  if (kernel == Kernel::adaptive) sigmas = adaptive_sigmas(heads, image);
  if (kernel == Kernel::perspective) sigmas = perspective_sigmas(heads, image);
  for (double& sigma : sigmas) sigma = std::max(sigma, kMinSigmaPx);
  return sigmas;
}

void write_h5(const fs::path& path, const annotate::DensityMap& map) {
  namespace hdf5 = world::hdf5;
  try {
    fs::create_directories(path.parent_path());
    hdf5::Handle file = hdf5::create_file(path.string());
    const hdf5::ElementType type = hdf5::element_type<float>();
    {
      constexpr hsize_t kRowsPerChunk = 64;
      hdf5::RowDataset rows(file, "density", type.file, type.memory,
                            {static_cast<hsize_t>(map.width)}, kRowsPerChunk, "people per pixel");
      rows.append(map.value.data(), static_cast<hsize_t>(map.height));
    }
    file.close(path.string());
  } catch (const hdf5::Failure&) {
    throw_write_error(path, 0);
  }
}

class PointsExporter : public Exporter {
 public:
  PointsExporter(const DatasetInfo& info, Output output, Kernel kernel)
      : info_(info), output_(std::move(output)), kernel_(kernel) {}

  void add(const Image& image) override {
    const std::string folder = fmt::format("{}_data", to_string(image.split));
    const std::string name = "IMG_" + image.stem();
    output_.link(fmt::format("{}/images/{}.jpg", folder, name), info_.root / image.file);
    const Heads heads = head_positions(image);
    // MATLAB's pixels: the middle of the first is 1.
    std::vector<Eigen::Vector2d> points = heads.place;
    for (Eigen::Vector2d& point : points) point.array() += 0.5;
    const std::string truth = fmt::format("{}/ground_truth/", folder);
    output_.write(truth + "GT_" + name + ".mat", image_info_mat(points));
    const annotate::DensityMap map = annotate::density_map(
        heads.place, kernel_sigmas(kernel_, heads, image), image.width, image.height);
    output_.write(truth + name + ".npy", annotate::npy_bytes(map));
    write_h5(output_.folder() / (truth + name + ".h5"), map);
    output_.written(truth + name + ".h5");
  }
  void finish() override {}

 private:
  const DatasetInfo& info_;
  Output output_;
  Kernel kernel_;
};

}  // namespace

ExporterPointer make_points(const DatasetInfo& info, Output output) {
  return std::make_unique<PointsExporter>(info, std::move(output), Kernel::fixed);
}

ExporterPointer make_points_adaptive(const DatasetInfo& info, Output output) {
  return std::make_unique<PointsExporter>(info, std::move(output), Kernel::adaptive);
}

ExporterPointer make_points_perspective(const DatasetInfo& info, Output output) {
  return std::make_unique<PointsExporter>(info, std::move(output), Kernel::perspective);
}

}  // namespace throng::formats
