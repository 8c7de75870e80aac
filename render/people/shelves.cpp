#include "render/people/shelves.h"

#include <algorithm>

namespace throng::render {

std::optional<Eigen::Vector2i> Shelves::place(const Eigen::Vector2i& size) {
  Eigen::Vector2i at = next_;
  if (at.x() + size.x() > size_.x()) at = {0, below_};
  if (at.x() + size.x() > size_.x() || at.y() + size.y() > size_.y()) return std::nullopt;
  next_ = {at.x() + size.x(), at.y()};
  below_ = std::max(below_, at.y() + size.y());
  return at;
}

}  // namespace throng::render
