#include "formats/dataset/polygon.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <map>

#include "base/error.h"

namespace throng::formats {

namespace {

using PixelRing = std::vector<Pixel>;

/// Directions of edges between pixels: right, down, left, up; the mask is on their right side.
constexpr int kUp = 3;
constexpr std::array<Pixel, 4> kStep = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
/// From an edge's first corner to the pixel of the mask beside it.
constexpr std::array<Pixel, 4> kBeside = {{{0, 0}, {-1, 0}, {-1, -1}, {0, -1}}};

Pixel sum(const Pixel& a, const Pixel& b) { return {a.first + b.first, a.second + b.second}; }

/// The border between the mask and one region of its background, through the mask's pixels.
struct BorderRing {
  PixelRing places;
  std::int64_t area = 0;  ///< pixels within, negative if they are a hole
  PixelRing left_sides;   ///< pixels whose left side is part of it
};

/// Edges that are not in a ring yet: from each corner a bit for each direction.
using OpenEdges = std::map<Pixel, unsigned>;

OpenEdges open_edges(const Bitmap& mask) {
  OpenEdges edges;
  const auto add = [&](int x, int y, int direction) { edges[{x, y}] |= 1U << direction; };
  for (int y = mask.y; y < mask.y + mask.height; ++y) {
    for (int x = mask.x; x < mask.x + mask.width; ++x) {
      if (!mask.at(x, y)) continue;
      if (!mask.at(x, y - 1)) add(x, y, 0);
      if (!mask.at(x + 1, y)) add(x + 1, y, 1);
      if (!mask.at(x, y + 1)) add(x + 1, y + 1, 2);
      if (!mask.at(x - 1, y)) add(x, y + 1, kUp);
    }
  }
  return edges;
}

BorderRing take_border(OpenEdges& edges) {
  BorderRing ring;
  const Pixel start = edges.begin()->first;
  Pixel at = start;
  int direction = -1;
  std::int64_t twice_area = 0;
  do {
    const auto found = edges.find(at);
    check(found != edges.end(), "the edges of a mask form rings");
    // If two pixels touch by a corner, the path goes on to the other one: a turn to the left.
    int next = direction < 0 ? 0 : (direction + 3) % 4;
    while ((found->second & 1U << next) == 0) next = (next + 1) % 4;
    direction = next;
    found->second &= ~(1U << direction);
    if (found->second == 0) edges.erase(found);
    const Pixel pixel = sum(at, kBeside[static_cast<std::size_t>(direction)]);
    if (ring.places.empty() || ring.places.back() != pixel) ring.places.push_back(pixel);
    if (direction == kUp) ring.left_sides.push_back(pixel);
    const Pixel to = sum(at, kStep[static_cast<std::size_t>(direction)]);
    twice_area += std::int64_t{at.first} * to.second - std::int64_t{to.first} * at.second;
    at = to;
    // The leftmost corner is passed once: where a ring passes twice, it has edges farther left.
  } while (at != start);
  if (ring.places.size() > 1 && ring.places.back() == ring.places.front()) ring.places.pop_back();
  ring.area = twice_area / 2;
  return ring;
}

/// The places from `first` on, all the way round and back to it.
PixelRing turned_to(const PixelRing& ring, const Pixel& first) {
  const auto at = std::find(ring.begin(), ring.end(), first);
  check(at != ring.end(), "a ring passes its own places");
  PixelRing turned(at, ring.end());
  turned.insert(turned.end(), ring.begin(), at);
  turned.push_back(first);
  return turned;
}

/// Goes from a place of the ring to `first` of another one, around that one, and back.
void splice(PixelRing& ring, const Pixel& from, const PixelRing& other, const Pixel& first) {
  const auto at = std::find(ring.begin(), ring.end(), from);
  check(at != ring.end(), "rings are joined where they pass");
  PixelRing detour = turned_to(other, first);
  detour.push_back(from);
  ring.insert(at + 1, detour.begin(), detour.end());
}

/// PixelRing that hang together: their outer border with the holes' spliced in, and how many they
/// are.
struct Piece {
  PixelRing places;
  std::int64_t area = 0;
};

/// The pixel of the mask farthest to the left in a row without a gap.
Pixel row_start(const Bitmap& mask, Pixel place) {
  while (mask.at(place.first - 1, place.second)) --place.first;
  return place;
}

std::vector<Piece> split_pieces(const Bitmap& mask) {
  OpenEdges edges = open_edges(mask);
  std::vector<BorderRing> holes;
  std::vector<Piece> pieces;
  std::map<Pixel, std::size_t> piece_left_of;  // by a pixel whose left side is on its border
  while (!edges.empty()) {
    BorderRing ring = take_border(edges);
    if (ring.area < 0) {
      holes.push_back(std::move(ring));
      continue;
    }
    for (const Pixel& place : ring.left_sides) piece_left_of[place] = pieces.size();
    pieces.push_back({std::move(ring.places), ring.area});
  }
  // From its leftmost place a hole is joined to the border that its row begins at: the outer one,
  // or that of a hole farther left, which has been joined before.
  const auto leftmost = [](const BorderRing& ring) {
    return *std::min_element(ring.places.begin(), ring.places.end());
  };
  std::sort(holes.begin(), holes.end(),
            [&](const BorderRing& a, const BorderRing& b) { return leftmost(a) < leftmost(b); });
  for (const BorderRing& hole : holes) {
    const Pixel first = leftmost(hole);
    const Pixel border = row_start(mask, first);
    const std::size_t piece = piece_left_of.at(border);
    for (const Pixel& place : hole.left_sides) piece_left_of[place] = piece;
    splice(pieces[piece].places, border, hole.places, first);
    pieces[piece].area += hole.area;
  }
  return pieces;
}

/// The shortest path from what is joined to a piece that is not.
struct Bridge {
  Pixel from;
  Pixel to;
  int pixels = std::numeric_limits<int>::max();  ///< that a line from one to the other adds
};

void shorten(Bridge& bridge, const PixelRing& joined, const PixelRing& piece) {
  for (const Pixel& a : joined) {
    for (const Pixel& b : piece) {
      const int between = std::max(std::abs(a.first - b.first), std::abs(a.second - b.second)) - 1;
      if (between < bridge.pixels) bridge = {a, b, between};
    }
  }
}

PixelRing joined(std::vector<Piece> pieces, PolygonFit& fit) {
  fit.pieces = static_cast<int>(pieces.size());
  for (const Piece& piece : pieces) fit.mask_px += piece.area;
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const Piece& a, const Piece& b) { return a.area > b.area; });
  PixelRing all = pieces.front().places;
  pieces.erase(pieces.begin());
  std::vector<Bridge> bridges(pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) shorten(bridges[i], all, pieces[i].places);
  while (!pieces.empty()) {
    const auto nearest =
        std::min_element(bridges.begin(), bridges.end(),
                         [](const Bridge& a, const Bridge& b) { return a.pixels < b.pixels; });
    const auto at = nearest - bridges.begin();
    const Piece piece = std::move(pieces[static_cast<std::size_t>(at)]);
    const Bridge bridge = *nearest;
    pieces.erase(pieces.begin() + at);
    bridges.erase(nearest);
    if (bridge.pixels > piece.area) {
      fit.left_out_px += piece.area;
      continue;
    }
    fit.line_px += bridge.pixels;
    splice(all, bridge.from, piece.places, bridge.to);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      shorten(bridges[i], piece.places, pieces[i].places);
    }
  }
  return all;
}

/// Without the places in the middle of straight lines of single steps.
PixelRing straightened(const PixelRing& ring) {
  const auto step = [](const Pixel& a, const Pixel& b) {
    return Pixel(b.first - a.first, b.second - a.second);
  };
  const auto is_single = [](const Pixel& d) {
    return std::abs(d.first) <= 1 && std::abs(d.second) <= 1;
  };
  PixelRing kept;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Pixel before = step(ring[(i + ring.size() - 1) % ring.size()], ring[i]);
    const Pixel after = step(ring[i], ring[(i + 1) % ring.size()]);
    const bool is_repeated = before == Pixel(0, 0);
    if (!is_repeated && (before != after || !is_single(before))) kept.push_back(ring[i]);
  }
  if (kept.empty()) kept.push_back(ring.front());
  return kept;
}

}  // namespace

std::vector<Pixel> trace_polygon(const Bitmap& mask, PolygonFit* fit) {
  std::vector<Piece> pieces = split_pieces(mask);
  if (pieces.empty()) return {};
  PolygonFit found;
  PixelRing polygon = straightened(joined(std::move(pieces), found));
  if (fit != nullptr) *fit = found;
  constexpr std::size_t kMinPoints = 3;  // of a polygon: fewer are taken for a box
  while (polygon.size() < kMinPoints) polygon.push_back(polygon.back());
  return polygon;
}

}  // namespace throng::formats
