// Packs rectangles into a bigger one, in rows.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace throng::render {

/// Fills row after row; rectangles that come by falling height waste the least.
class Shelves {
 public:
  explicit Shelves(const Eigen::Vector2i& size) : size_(size) {}

  /// Position of a rectangle; nothing when the space is used up. Others may still fit.
  std::optional<Eigen::Vector2i> place(const Eigen::Vector2i& size);

  /// Rows that hold something.
  int used_rows() const { return below_; }

 private:
  Eigen::Vector2i size_;
  Eigen::Vector2i next_ = Eigen::Vector2i::Zero();
  int below_ = 0;  ///< first row under the shelf that is being filled
};

}  // namespace throng::render
