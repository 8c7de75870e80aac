// Packs rectangles into a larger one, in rows (shelves).
#pragma once

#include <Eigen/Core>
#include <optional>

namespace throng::render {

/// Fills row after row. Rectangles in order of descending height waste the least space.
class Shelves {
 public:
  explicit Shelves(const Eigen::Vector2i& size) : size_(size) {}

  /// Returns the position of a rectangle, or nothing if it does not fit; smaller ones may still
  /// fit.
  std::optional<Eigen::Vector2i> place(const Eigen::Vector2i& size);

  /// Number of pixel rows in use.
  int used_rows() const { return below_; }

 private:
  Eigen::Vector2i size_;
  Eigen::Vector2i next_ = Eigen::Vector2i::Zero();
  int below_ = 0;  ///< first pixel row below the current shelf
};

}  // namespace throng::render
