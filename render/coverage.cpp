#include "render/coverage.h"

#include <algorithm>
#include <array>
#include <tuple>

#include "render/view.h"

namespace throng::render {

namespace {

constexpr int kAtlasSize = 2048;

/// Tiles start at multiples of this in the image and in the atlas, so that the blocks of pixels in
/// which texture detail is chosen are the same in both.
constexpr int kBlock = 8;

int block_below(int pixel) {
  // Rounds towards minus infinity, also left of and above the image.
  return pixel >= 0 ? pixel / kBlock * kBlock : -((-pixel + kBlock - 1) / kBlock * kBlock);
}

}  // namespace

CoverageCounter::CoverageCounter()
    : atlas_(make_texture_2d(GL_R8, kAtlasSize, kAtlasSize)),
      framebuffer_(make_framebuffer({atlas_.name()}, 0)),
      view_(make_buffer()),
      pixels_(static_cast<std::size_t>(kAtlasSize) * kAtlasSize) {}

std::vector<CoverageCounter::Tile> CoverageCounter::tiles_of(
    std::span<const CoverageRequest> requests) {
  std::vector<Tile> tiles;
  for (std::size_t i = 0; i < requests.size(); ++i) {
    const Eigen::AlignedBox2i& bounds = requests[i].bounds;
    const Eigen::Vector2i end = bounds.max();
    for (int y = block_below(bounds.min().y()); y < end.y(); y += kAtlasSize) {
      for (int x = block_below(bounds.min().x()); x < end.x(); x += kAtlasSize) {
        const Eigen::Vector2i size = (end - Eigen::Vector2i(x, y)).cwiseMin(kAtlasSize);
        tiles.push_back({i, {x, y}, size, Eigen::Vector2i::Zero()});
      }
    }
  }
  // Equal heights beside each other waste the least of the atlas.
  std::stable_sort(tiles.begin(), tiles.end(),
                   [](const Tile& a, const Tile& b) { return a.size.y() > b.size.y(); });
  return tiles;
}

std::size_t CoverageCounter::place(std::vector<Tile>& tiles, std::size_t first, int& used_rows) {
  int x = 0;
  int y = 0;
  int row_height = 0;
  std::size_t i = first;
  for (; i < tiles.size(); ++i) {
    const Eigen::Vector2i room = (tiles[i].size.array() + (kBlock - 1)) / kBlock * kBlock;
    if (x + room.x() > kAtlasSize) {
      x = 0;
      y += row_height;
      row_height = 0;
    }
    if (y + room.y() > kAtlasSize) break;
    tiles[i].atlas = {x, y};
    x += room.x();
    row_height = std::max(row_height, room.y());
  }
  used_rows = std::min(y + row_height, kAtlasSize);
  return i;
}

std::uint64_t CoverageCounter::covered_in(const Tile& tile, const PixelWeights* weights) const {
  constexpr std::uint8_t kCovered = 255;
  std::uint64_t covered = 0;
  for (int y = 0; y < tile.size.y(); ++y) {
    const auto row = pixels_.begin() +
                     (static_cast<std::ptrdiff_t>(tile.atlas.y()) + y) * kAtlasSize +
                     tile.atlas.x();
    if (weights == nullptr) {
      covered += static_cast<std::uint64_t>(std::count(row, row + tile.size.x(), kCovered));
      continue;
    }
    for (int x = 0; x < tile.size.x(); ++x) {
      if (row[x] == kCovered) covered += weights->at(tile.image.x() + x, tile.image.y() + y);
    }
  }
  return covered;
}

void CoverageCounter::draw_and_add(PeoplePass& pass, std::span<const PersonInstance> people,
                                   std::span<const CoverageRequest> requests,
                                   std::span<const Tile> tiles, int used_rows,
                                   const PixelWeights* weights,
                                   std::vector<std::uint64_t>& counts) {
  const std::array<float, 4> nothing{};
  glClearNamedFramebufferfv(framebuffer_.name(), GL_COLOR, 0, nothing.data());
  std::vector<PersonDraw> draws;
  for (const Tile& tile : tiles) {
    PersonDraw draw = requests[tile.request].draw;
    draw.shift = {tile.atlas.x() - tile.image.x(), tile.atlas.y() - tile.image.y()};
    draws.push_back(draw);
  }
  pass.draw(PeoplePass::Purpose::coverage, people, std::move(draws));
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, kAtlasSize, used_rows, GL_RED, GL_UNSIGNED_BYTE, pixels_.data());
  for (const Tile& tile : tiles) counts[tile.request] += covered_in(tile, weights);
}

std::vector<std::uint64_t> CoverageCounter::count(PeoplePass& pass,
                                                  std::span<const PersonInstance> people,
                                                  std::span<const CoverageRequest> requests,
                                                  const camera::Camera& camera,
                                                  const PixelWeights* weights) {
  std::vector<std::uint64_t> counts(requests.size(), 0);
  if (requests.empty()) return counts;
  const Viewport viewport = guarded_viewport(kAtlasSize, kAtlasSize);
  const ViewBlock block = view_block(camera, viewport);
  glNamedBufferData(view_.name(), sizeof(block), &block, GL_STREAM_DRAW);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, view_.name());
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glViewport(viewport.x, viewport.y, viewport.width, viewport.height);
  glDisable(GL_DEPTH_TEST);
  std::vector<Tile> tiles = tiles_of(requests);
  for (std::size_t first = 0; first < tiles.size();) {
    int used_rows = 0;
    const std::size_t end = place(tiles, first, used_rows);
    draw_and_add(pass, people, requests, std::span(tiles).subspan(first, end - first), used_rows,
                 weights, counts);
    first = end;
  }
  return counts;
}

}  // namespace throng::render
