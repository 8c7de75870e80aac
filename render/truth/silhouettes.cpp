#include "render/truth/silhouettes.h"

#include <algorithm>
#include <array>

namespace throng::render {

namespace {

/// Along each side. People that do not fit are measured by CoverageCounter.
constexpr int kSilhouetteAtlas = 4096;
constexpr std::uint8_t kCovered = 255;

}  // namespace

Silhouettes::Silhouettes()
    : shelves_({kSilhouetteAtlas, kSilhouetteAtlas}),
      atlas_(make_texture_2d(GL_R8, kSilhouetteAtlas, kSilhouetteAtlas)),
      framebuffer_(make_framebuffer({atlas_.name()}, 0)) {}

void Silhouettes::begin() {
  shelves_ = Shelves({kSilhouetteAtlas, kSilhouetteAtlas});
  tiles_.clear();
}

std::optional<Eigen::Vector2i> Silhouettes::add(const Eigen::AlignedBox2i& pixels) {
  const auto at = shelves_.place(pixels.sizes());
  if (!at) return std::nullopt;
  tiles_.push_back({pixels, *at});
  return *at - pixels.min();
}

void Silhouettes::bind() {
  const std::uint8_t nothing = 0;
  glClearTexSubImage(atlas_.name(), 0, 0, 0, 0, kSilhouetteAtlas, shelves_.used_rows(), 1, GL_RED,
                     GL_UNSIGNED_BYTE, &nothing);
  glBindImageTexture(0, atlas_.name(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_R8);
}

void Silhouettes::read() {
  const int rows = shelves_.used_rows();
  if (rows == 0) return;
  texels_.resize(static_cast<std::size_t>(rows) * kSilhouetteAtlas);
  glMemoryBarrier(GL_FRAMEBUFFER_BARRIER_BIT);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, kSilhouetteAtlas, rows, GL_RED, GL_UNSIGNED_BYTE, texels_.data());
}

std::uint64_t Silhouettes::count(std::size_t tile, const PixelWeights* weights) const {
  const Tile& at = tiles_[tile];
  const Eigen::Vector2i size = at.pixels.sizes();
  std::uint64_t sum = 0;
  for (int y = 0; y < size.y(); ++y) {
    const std::size_t first = static_cast<std::size_t>(at.atlas.y() + y) * kSilhouetteAtlas +
                              static_cast<std::size_t>(at.atlas.x());
    sum += covered(std::span(texels_).subspan(first, static_cast<std::size_t>(size.x())),
                   at.pixels.min() + Eigen::Vector2i(0, y), weights);
  }
  return sum;
}

PixelMask Silhouettes::mask(std::size_t tile) const {
  const Tile& at = tiles_[tile];
  const Eigen::Vector2i size = at.pixels.sizes();
  PixelMask mask(at.pixels);
  for (int y = 0; y < size.y(); ++y) {
    const std::size_t first = static_cast<std::size_t>(at.atlas.y() + y) * kSilhouetteAtlas +
                              static_cast<std::size_t>(at.atlas.x());
    add_covered(std::span(texels_).subspan(first, static_cast<std::size_t>(size.x())),
                at.pixels.min() + Eigen::Vector2i(0, y), mask);
  }
  return mask;
}

void add_covered(std::span<const std::uint8_t> row, const Eigen::Vector2i& first, PixelMask& mask) {
  for (int x = 0; x < static_cast<int>(row.size()); ++x) {
    if (row[static_cast<std::size_t>(x)] == kCovered) mask.put(first.x() + x, first.y());
  }
}

std::uint64_t covered(std::span<const std::uint8_t> row, const Eigen::Vector2i& first,
                      const PixelWeights* weights) {
  if (weights == nullptr) {
    return static_cast<std::uint64_t>(std::count(row.begin(), row.end(), kCovered));
  }
  std::uint64_t sum = 0;
  for (int x = 0; x < static_cast<int>(row.size()); ++x) {
    if (row[static_cast<std::size_t>(x)] == kCovered) {
      sum += weights->at(first.x() + x, first.y());
    }
  }
  return sum;
}

}  // namespace throng::render
