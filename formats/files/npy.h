// Reader for a dataset's float32 arrays in NumPy's formats .npz and .npy.
#pragma once

#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <vector>

namespace throng::formats {

/// A two-dimensional array.
struct FloatMap {
  int width = 0;
  int height = 0;
  std::vector<float> value;  ///< row by row
};

/// Reads a .npy file, or the array "density" of a .npz file. Throws InputError unless the array has
/// version 1.0, float32, C order and two dimensions.
FloatMap read_npy(const std::filesystem::path& path);

/// Reads the values of a .npy file, row-major. Throws InputError unless it is float32 with this
/// shape.
std::vector<float> read_npy(const std::filesystem::path& path,
                            std::initializer_list<std::size_t> shape);

}  // namespace throng::formats
