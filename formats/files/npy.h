// NumPy's files of float32 maps, as the dataset has them: .npz, and .npy in earlier versions.
#pragma once

#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <vector>

namespace throng::formats {

struct FloatMap {
  int width = 0;
  int height = 0;
  std::vector<float> value;  ///< row by row
};

/// Reads a .npy file, or the array "density" of a .npz file. Throws InputError unless it is version
/// 1.0, float32, C order, with two dimensions.
FloatMap read_npy(const std::filesystem::path& path);

/// The values of a .npy file, row-major. Throws InputError unless it is float32 of this shape.
std::vector<float> read_npy(const std::filesystem::path& path,
                            std::initializer_list<std::size_t> shape);

}  // namespace throng::formats
