#include "annotate/rasters/density.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <numeric>

#include "base/error.h"
#include "base/files/zip_member.h"

namespace throng::annotate {

namespace {

constexpr double kCutOffSigmas = 4.0;

// One axis of a kernel: weights of the pixels first, first + 1, ..., which sum to 1.
struct AxisKernel {
  int first = 0;
  std::vector<double> weight;
};

// Gaussian about `centre` (box coordinates, inside [0, size)), taken at the pixels' middles.
// Weights are relative to that of the head's own pixel, so that they do not vanish for a tiny
// sigma.
void set_kernel(AxisKernel& kernel, double center, int size, double sigma) {
  const double reach = kCutOffSigmas * sigma;
  const int own = std::min(static_cast<int>(center), size - 1);
  kernel.first = static_cast<int>(std::floor(std::max(0.0, center - reach)));
  const int last = static_cast<int>(std::floor(std::min<double>(size - 1, center + reach)));
  kernel.weight.resize(last - kernel.first + 1);
  const double own_distance = own + 0.5 - center;
  const double scale = 1 / (2 * sigma * sigma);
  // From pixel to pixel a Gaussian's values change by a factor that itself changes by a constant
  // one; outwards from the head's own pixel all of these are at most 1.
  const double change = std::exp(-2 * scale);
  double sum = kernel.weight[own - kernel.first] = 1;
  double factor = std::exp(-(1 + 2 * own_distance) * scale);
  double weight = 1;
  for (int i = own + 1; i <= last; ++i, factor *= change) {
    sum += kernel.weight[i - kernel.first] = weight *= factor;
  }
  factor = std::exp(-(1 - 2 * own_distance) * scale);
  weight = 1;
  for (int i = own - 1; i >= kernel.first; --i, factor *= change) {
    sum += kernel.weight[i - kernel.first] = weight *= factor;
  }
  for (double& share : kernel.weight) share /= sum;
}

bool is_inside(const Eigen::Vector2d& head, int width, int height) {
  return head.x() >= 0 && head.x() < width && head.y() >= 0 && head.y() < height;
}

}  // namespace

double DensityMap::sum() const { return std::accumulate(value.begin(), value.end(), 0.0); }

DensityMap density_map(std::span<const Eigen::Vector2d> heads, int width, int height,
                       double sigma_px) {
  return density_map(heads, std::vector<double>(heads.size(), sigma_px), width, height);
}

DensityMap density_map(std::span<const Eigen::Vector2d> heads, std::span<const double> sigmas_px,
                       int width, int height) {
  check(width > 0 && height > 0, "a density map has pixels");
  check(heads.size() == sigmas_px.size(), "each head has a width of kernel");
  // Doubles: thousands of tails add up in one pixel.
  std::vector<double> sums(static_cast<std::size_t>(width) * height);
  AxisKernel across;
  AxisKernel down;
  for (std::size_t i = 0; i < heads.size(); ++i) {
    const Eigen::Vector2d& head = heads[i];
    const double sigma_px = sigmas_px[i];
    check(sigma_px > 0, "a kernel has a width");
    if (!is_inside(head, width, height)) continue;
    set_kernel(across, head.x(), width, sigma_px);
    set_kernel(down, head.y(), height, sigma_px);
    for (std::size_t y = 0; y < down.weight.size(); ++y) {
      double* row = sums.data() + (down.first + y) * width + across.first;
      const double weight = down.weight[y];
      for (std::size_t x = 0; x < across.weight.size(); ++x) row[x] += weight * across.weight[x];
    }
  }
  return {width, height, std::vector<float>(sums.begin(), sums.end())};
}

std::string npy_bytes(std::span<const int> shape, std::span<const float> values) {
  static_assert(std::endian::native == std::endian::little, "values are written as they lie");
  std::string header = fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}), }}",
                                   fmt::join(shape, ", "));
  constexpr std::size_t kPreamble = 10;  // magic, version, length of the header
  constexpr std::size_t kAlignment = 64;
  while ((kPreamble + header.size() + 1) % kAlignment != 0) header.push_back(' ');
  header.push_back('\n');
  std::string bytes = "\x93NUMPY";
  bytes += {'\x01', '\x00', static_cast<char>(header.size() & 0xff),
            static_cast<char>(header.size() >> 8)};
  bytes += header;
  const std::size_t start = bytes.size();
  bytes.resize(start + values.size() * sizeof(float));
  std::memcpy(bytes.data() + start, values.data(), values.size() * sizeof(float));
  return bytes;
}

std::string npy_bytes(const DensityMap& map) {
  return npy_bytes(std::array{map.height, map.width}, map.value);
}

std::string npz_bytes(const DensityMap& map) { return make_zip("density.npy", npy_bytes(map)); }

}  // namespace throng::annotate
