#include "annotate/drone_labels.h"

#include <algorithm>

namespace throng::annotate {

namespace {

/// The pixels of a drone, and their bounds and number.
DroneLabel shown(const render::Frame& frame, const render::DroneInView& drone) {
  const Eigen::AlignedBox2i image(Eigen::Vector2i::Zero(),
                                  Eigen::Vector2i(frame.width(), frame.height()));
  const Eigen::AlignedBox2d& box = drone.amodal_box;
  const Eigen::Array2d far(1e6, 1e6);
  render::PixelMask mask(
      image.intersection(Eigen::AlignedBox2i(box.min().array().max(-far).floor().cast<int>() - 2,
                                             box.max().array().min(far).ceil().cast<int>() + 2)));
  Eigen::AlignedBox2i bounds;
  DroneLabel label;
  if (mask.set.empty()) return label;
  for (int y = mask.pixels.min().y(); y < mask.pixels.max().y(); ++y) {
    for (int x = mask.pixels.min().x(); x < mask.pixels.max().x(); ++x) {
      const std::size_t pixel =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width()) +
          static_cast<std::size_t>(x);
      if (frame.id[pixel] != render::kIdDrone + drone.drone) continue;
      mask.put(x, y);
      bounds.extend(Eigen::Vector2i(x, y));
      ++label.area_px;
    }
  }
  if (label.area_px == 0) return label;
  const Eigen::Vector2i size = bounds.sizes().array() + 1;
  label.box = {bounds.min().x(), bounds.min().y(), size.x(), size.y()};
  label.mask = run_lengths(mask, frame.width(), frame.height());
  label.drone = drone;
  label.drone.amodal_area_px = std::max(drone.amodal_area_px, label.area_px);
  label.visibility =
      static_cast<double>(label.area_px) / static_cast<double>(label.drone.amodal_area_px);
  return label;
}

}  // namespace

std::vector<DroneLabel> label_drones(const render::Frame& frame) {
  std::vector<DroneLabel> labels;
  for (const render::DroneInView& drone : frame.drones) {
    DroneLabel label = shown(frame, drone);
    if (label.area_px > 0) labels.push_back(std::move(label));
  }
  return labels;
}

}  // namespace throng::annotate
