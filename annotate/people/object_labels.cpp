#include "annotate/people/object_labels.h"

#include <algorithm>

#include "annotate/people/run_lengths.h"
#include "annotate/people/visible_mask.h"

namespace throng::annotate {

namespace {

/// The pixels of an object, and their bounds and number.
ObjectLabel shown(const render::Frame& frame, const render::ObjectInView& object) {
  const Eigen::AlignedBox2i image(Eigen::Vector2i::Zero(),
                                  Eigen::Vector2i(frame.width(), frame.height()));
  const Eigen::AlignedBox2d& box = object.amodal_box;
  const Eigen::Array2d far(1e6, 1e6);
  const render::PixelMask mask = visible_mask(
      frame, object.id,
      image.intersection(Eigen::AlignedBox2i(box.min().array().max(-far).floor().cast<int>() - 2,
                                             box.max().array().min(far).ceil().cast<int>() + 2)));
  Eigen::AlignedBox2i bounds;
  ObjectLabel label;
  if (mask.set.empty()) return label;
  for (int y = mask.pixels.min().y(); y < mask.pixels.max().y(); ++y) {
    for (int x = mask.pixels.min().x(); x < mask.pixels.max().x(); ++x) {
      if (!mask.at(x, y)) continue;
      bounds.extend(Eigen::Vector2i(x, y));
      ++label.area_px;
    }
  }
  if (label.area_px == 0) return label;
  const Eigen::Vector2i size = bounds.sizes().array() + 1;
  label.box = {bounds.min().x(), bounds.min().y(), size.x(), size.y()};
  label.mask = run_lengths(mask, frame.width(), frame.height());
  label.object = object;
  label.object.amodal_area_px = std::max(object.amodal_area_px, label.area_px);
  label.visibility =
      static_cast<double>(label.area_px) / static_cast<double>(label.object.amodal_area_px);
  return label;
}

}  // namespace

std::vector<ObjectLabel> label_objects(const render::Frame& frame) {
  std::vector<ObjectLabel> labels;
  for (const render::ObjectInView& object : frame.objects) {
    ObjectLabel label = shown(frame, object);
    if (label.area_px > 0) labels.push_back(std::move(label));
  }
  return labels;
}

}  // namespace throng::annotate
