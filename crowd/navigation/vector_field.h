// Vector fields: directions on a grid from a file.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "crowd/elements/text_file.h"

namespace throng::crowd {

/// Vectors at the centers of the cells of a grid; outside the grid, those of the nearest cell.
class VectorField {
 public:
  /// Reads Menge's format: rows and columns, cell size, corner with min x and y, then vectors row
  /// by row. Throws InputError (file, line, found, expected), EnvironmentError if the file cannot
  /// be read.
  explicit VectorField(const TextFile& source);

  /// Returns the vector of the cell that contains the point.
  Eigen::Vector2f nearest(const Eigen::Vector2f& point) const;
  /// Returns the bilinear interpolation of the four cells around the point.
  Eigen::Vector2f interpolated(const Eigen::Vector2f& point) const;

 private:
  const Eigen::Vector2f& at(int row, int column) const;
  Eigen::Vector2f cell_of(const Eigen::Vector2f& point) const {
    return (point - min_) / cell_size_m_;
  }

  int rows_ = 0;
  int columns_ = 0;
  float cell_size_m_ = 1;
  Eigen::Vector2f min_;
  std::vector<Eigen::Vector2f> vectors_;  // row by row
};

}  // namespace throng::crowd
