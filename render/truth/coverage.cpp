#include "render/truth/coverage.h"

#include <algorithm>
#include <array>
#include <utility>

#include "render/frame/view.h"
#include "render/people/shelves.h"
#include "render/truth/silhouettes.h"

namespace throng::render {

namespace {

constexpr int kAtlasSize = 2048;

/// Tiles start at multiples of this in the image and in the atlas, so that the blocks of pixels in
/// which texture detail is chosen are the same in both.
constexpr int kBlock = 8;

int block_below(int pixel) {
  // Rounds toward minus infinity, also left of and above the image.
  return pixel >= 0 ? pixel / kBlock * kBlock : -((-pixel + kBlock - 1) / kBlock * kBlock);
}

}  // namespace

CoverageCounter::CoverageCounter()
    : atlas_(make_texture_2d(GL_R8, kAtlasSize, kAtlasSize)),
      framebuffer_(make_framebuffer({atlas_.name()}, 0)),
      view_(make_buffer()),
      pixels_(static_cast<std::size_t>(kAtlasSize) * kAtlasSize) {}

std::vector<CoverageCounter::Tile> CoverageCounter::tiles_of(
    std::span<const CoverageRequest> requests, const Eigen::AlignedBox2i& measured) {
  // One pixel less: what is limited ends there.
  const Eigen::AlignedBox2i unlimited(measured.min().array() + 1, measured.max().array() - 1);
  std::vector<Tile> tiles;
  for (std::size_t i = 0; i < requests.size(); ++i) {
    const Eigen::AlignedBox2i& bounds = requests[i].bounds;
    const Eigen::Vector2i end = bounds.max();
    const bool is_one = (bounds.sizes().array() + kBlock <= kAtlasSize).all();
    const bool holds_all = is_one && unlimited.contains(bounds);
    for (int y = block_below(bounds.min().y()); y < end.y(); y += kAtlasSize) {
      for (int x = block_below(bounds.min().x()); x < end.x(); x += kAtlasSize) {
        const Eigen::Vector2i tile_size = (end - Eigen::Vector2i(x, y)).cwiseMin(kAtlasSize);
        tiles.push_back({i, {x, y}, tile_size, Eigen::Vector2i::Zero(), holds_all});
      }
    }
  }
  // Equal heights beside each other waste the least of the atlas.
  std::stable_sort(tiles.begin(), tiles.end(),
                   [](const Tile& a, const Tile& b) { return a.size.y() > b.size.y(); });
  return tiles;
}

std::size_t CoverageCounter::place(std::vector<Tile>& tiles, std::size_t first, int& used_rows) {
  Shelves shelves({kAtlasSize, kAtlasSize});
  std::size_t i = first;
  for (; i < tiles.size(); ++i) {
    const Eigen::Vector2i room = (tiles[i].size.array() + (kBlock - 1)) / kBlock * kBlock;
    const auto at = shelves.place(room);
    if (!at) break;
    tiles[i].atlas = *at;
  }
  used_rows = shelves.used_rows();
  return i;
}

std::uint64_t CoverageCounter::covered_in(const Tile& tile, const PixelWeights* weights) const {
  std::uint64_t sum = 0;
  for (int y = 0; y < tile.size.y(); ++y) {
    const std::size_t first = static_cast<std::size_t>(tile.atlas.y() + y) * kAtlasSize +
                              static_cast<std::size_t>(tile.atlas.x());
    sum += covered(std::span(pixels_).subspan(first, static_cast<std::size_t>(tile.size.x())),
                   tile.image + Eigen::Vector2i(0, y), weights);
  }
  return sum;
}

void CoverageCounter::draw_and_add(PeoplePass& pass, std::span<const PersonInstance> people,
                                   std::span<const CoverageRequest> requests,
                                   std::span<const Tile> tiles, int used_rows,
                                   const PixelWeights* weights, std::vector<std::uint64_t>& counts,
                                   std::span<PixelMask> masks) {
  const std::array<float, 4> nothing{};
  glClearNamedFramebufferfv(framebuffer_.name(), GL_COLOR, 0, nothing.data());
  std::vector<PersonDraw> draws;
  std::vector<std::pair<PersonDraw, Tile>> larger;  // than their tiles
  for (const Tile& tile : tiles) {
    PersonDraw draw = requests[tile.request].draw;
    draw.shift = {tile.atlas.x() - tile.image.x(), tile.atlas.y() - tile.image.y()};
    if (tile.holds_all) {
      draws.push_back(draw);
    } else {
      larger.emplace_back(draw, tile);
    }
  }
  pass.draw(PeoplePass::Purpose::coverage, people, std::move(draws));
  // The rest of these must not reach into others' tiles.
  if (!larger.empty()) glEnable(GL_SCISSOR_TEST);
  for (const auto& [draw, tile] : larger) {
    glScissor(tile.atlas.x(), tile.atlas.y(), tile.size.x(), tile.size.y());
    pass.draw(PeoplePass::Purpose::coverage, people, {draw});
  }
  glDisable(GL_SCISSOR_TEST);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, kAtlasSize, used_rows, GL_RED, GL_UNSIGNED_BYTE, pixels_.data());
  for (const Tile& tile : tiles) {
    counts[tile.request] += covered_in(tile, weights);
    if (!masks.empty()) add_to_mask(tile, masks[tile.request]);
  }
}

void CoverageCounter::add_to_mask(const Tile& tile, PixelMask& mask) const {
  for (int y = 0; y < tile.size.y(); ++y) {
    const std::size_t first = static_cast<std::size_t>(tile.atlas.y() + y) * kAtlasSize +
                              static_cast<std::size_t>(tile.atlas.x());
    add_covered(std::span(pixels_).subspan(first, static_cast<std::size_t>(tile.size.x())),
                tile.image + Eigen::Vector2i(0, y), mask);
  }
}

std::vector<std::uint64_t> CoverageCounter::count(
    PeoplePass& pass, std::span<const PersonInstance> people,
    std::span<const CoverageRequest> requests, const camera::Camera& camera,
    const Eigen::AlignedBox2i& measured, const PixelWeights* weights, std::span<PixelMask> masks) {
  std::vector<std::uint64_t> counts(requests.size(), 0);
  if (requests.empty()) return counts;
  const Viewport viewport = guarded_viewport(kAtlasSize, kAtlasSize);
  const ViewBlock block = view_block(camera, viewport);
  glNamedBufferData(view_.name(), sizeof(block), &block, GL_STREAM_DRAW);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, view_.name());
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glViewport(viewport.x, viewport.y, viewport.width, viewport.height);
  glDisable(GL_DEPTH_TEST);
  std::vector<Tile> tiles = tiles_of(requests, measured);
  for (std::size_t first = 0; first < tiles.size();) {
    int used_rows = 0;
    const std::size_t end = place(tiles, first, used_rows);
    draw_and_add(pass, people, requests, std::span(tiles).subspan(first, end - first), used_rows,
                 weights, counts, masks);
    first = end;
  }
  return counts;
}

}  // namespace throng::render
