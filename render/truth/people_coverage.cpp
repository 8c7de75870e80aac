#include "render/truth/people_coverage.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace throng::render {

namespace {

/// Whole pixels that a box touches, and one more on each side for the rasterizer's rounding.
Eigen::AlignedBox2i pixel_box(const Eigen::AlignedBox2d& box) {
  return {box.min().array().floor().cast<int>() - 1, box.max().array().ceil().cast<int>() + 1};
}

/// Sets what shows a person.
void add_visible(const Frame& frame, std::uint32_t agent, PixelMask& mask) {
  if (mask.set.empty()) return;
  for (int y = mask.pixels.min().y(); y < mask.pixels.max().y(); ++y) {
    for (int x = mask.pixels.min().x(); x < mask.pixels.max().x(); ++x) {
      const std::size_t pixel =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width()) +
          static_cast<std::size_t>(x);
      if (frame.id[pixel] == id_of_agent(agent)) mask.put(x, y);
    }
  }
}

/// Weight of the pixels [min, max) that show a person.
std::uint64_t visible_in(const Frame& frame, std::uint32_t agent, const Eigen::AlignedBox2i& pixels,
                         const PixelWeights* weights) {
  const Eigen::AlignedBox2i image(Eigen::Vector2i::Zero(),
                                  Eigen::Vector2i(frame.width(), frame.height()));
  const Eigen::AlignedBox2i box = pixels.intersection(image);
  const std::uint32_t own = id_of_agent(agent);
  std::uint64_t sum = 0;
  for (int y = box.min().y(); y < box.max().y(); ++y) {
    const std::uint32_t* row =
        &frame.id[static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width())];
    for (int x = box.min().x(); x < box.max().x(); ++x) {
      if (row[x] == own) sum += weights == nullptr ? 1 : weights->at(x, y);
    }
  }
  return sum;
}

}  // namespace

void PeopleCoverage::prepare(const camera::Camera& camera, std::vector<Seen>& seen) {
  const Eigen::AlignedBox2i image(
      Eigen::Vector2i::Zero(), Eigen::Vector2i(camera.intrinsics.width, camera.intrinsics.height));
  struct Room {
    std::size_t person;
    Eigen::AlignedBox2i pixels;
  };
  std::vector<Room> rooms;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (!seen[i].is_listed || seen[i].is_painted) continue;
    const Eigen::AlignedBox2i pixels = pixel_box(seen[i].truth.amodal_box);
    if (image.contains(pixels)) rooms.push_back({i, pixels});
  }
  std::stable_sort(rooms.begin(), rooms.end(), [](const Room& a, const Room& b) {
    return a.pixels.sizes().y() > b.pixels.sizes().y();
  });
  silhouettes_.begin();
  std::size_t tile = 0;
  for (const Room& room : rooms) {
    const auto shift = silhouettes_.add(room.pixels);
    if (!shift) continue;
    seen[room.person].draw.shift = {shift->x(), shift->y()};
    seen[room.person].tile = tile++;
  }
  silhouettes_.bind();
}

void PeopleCoverage::measure(PeoplePass& pass, const Scene& scene, const Frame& frame,
                             const Eigen::AlignedBox2i& measured, const PixelWeights* weights,
                             bool whole_masks, std::vector<Seen>& seen) {
  silhouettes_.read();
  std::vector<std::size_t> requested;
  std::vector<CoverageRequest> requests;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (!seen[i].is_listed || seen[i].is_painted) continue;
    PersonInView& truth = seen[i].truth;
    if (seen[i].tile) {
      truth.amodal_area_px = silhouettes_.count(*seen[i].tile, weights);
      if (whole_masks) {
        truth.whole_mask = std::make_shared<PixelMask>(silhouettes_.mask(*seen[i].tile));
      }
      continue;
    }
    requested.push_back(i);
    requests.push_back({seen[i].draw, pixel_box(truth.amodal_box)});
  }
  std::vector<PixelMask> masks;
  if (whole_masks) {
    const Eigen::AlignedBox2i image(Eigen::Vector2i::Zero(),
                                    Eigen::Vector2i(frame.width(), frame.height()));
    for (const CoverageRequest& request : requests) {
      masks.emplace_back(request.bounds.intersection(image));
    }
  }
  const std::vector<std::uint64_t> counts =
      counter_.count(pass, scene.people, requests, frame.camera, measured, weights, masks);
  for (std::size_t i = 0; i < requested.size(); ++i) {
    // A texel at the threshold of an alpha test may round differently in a tile; what is visible is
    // covered all the same.
    PersonInView& truth = seen[requested[i]].truth;
    truth.amodal_area_px =
        std::max(counts[i], visible_in(frame, truth.agent, requests[i].bounds, weights));
    if (!whole_masks) continue;
    add_visible(frame, truth.agent, masks[i]);
    truth.whole_mask = std::make_shared<PixelMask>(std::move(masks[i]));
  }
}

}  // namespace throng::render
