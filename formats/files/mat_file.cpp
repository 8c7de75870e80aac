#include "formats/files/mat_file.h"

#include <cstdint>
#include <cstring>
#include <string_view>

namespace throng::formats {

namespace {

// Numbers of "MAT-File Level 5 Format" (The MathWorks), tables 1-1 and 1-3.
enum class Type : std::uint32_t { int8 = 1, int32 = 5, uint32 = 6, doubles = 9, matrix = 14 };
enum class Class : std::uint32_t { cell = 1, structure = 2, numbers = 6 };

constexpr std::size_t kAligned = 8;

template <typename Value>
void add(std::string& bytes, const Value& value) {
  const std::size_t at = bytes.size();
  bytes.resize(at + sizeof(value));
  std::memcpy(bytes.data() + at, &value, sizeof(value));
}

void add_element(std::string& bytes, Type type, std::string_view content) {
  add(bytes, static_cast<std::uint32_t>(type));
  add(bytes, static_cast<std::uint32_t>(content.size()));
  bytes += content;
  while (bytes.size() % kAligned != 0) bytes.push_back('\0');
}

/// The beginning of every array.
std::string array_start(Class kind, std::int32_t rows, std::int32_t columns,
                        std::string_view name) {
  std::string flags;
  add(flags, static_cast<std::uint32_t>(kind));
  add(flags, std::uint32_t{0});
  std::string dimensions;
  add(dimensions, rows);
  add(dimensions, columns);
  std::string bytes;
  add_element(bytes, Type::uint32, flags);
  add_element(bytes, Type::int32, dimensions);
  add_element(bytes, Type::int8, name);
  return bytes;
}

/// Column by column.
std::string number_array(std::int32_t rows, std::int32_t columns, std::string_view values,
                         std::string_view name = "") {
  std::string bytes = array_start(Class::numbers, rows, columns, name);
  add_element(bytes, Type::doubles, values);
  return bytes;
}

/// The head, before the first variable.
std::string file_start() {
  constexpr std::size_t kTextLength = 124;
  constexpr std::uint16_t kVersion = 0x0100;
  std::string file = "MATLAB 5.0 MAT-file, written by throng";
  file.resize(kTextLength - kAligned, ' ');
  file.resize(kTextLength, '\0');
  add(file, kVersion);
  file += "IM";  // little-endian
  return file;
}

}  // namespace

std::string matrices_mat(const std::vector<NamedMatrix>& matrices) {
  std::string file = file_start();
  for (const NamedMatrix& matrix : matrices) {
    const std::size_t rows = matrix.values.size() / matrix.columns;
    std::string values;
    for (std::size_t column = 0; column < matrix.columns; ++column) {
      for (std::size_t row = 0; row < rows; ++row) {
        add(values, matrix.values[row * matrix.columns + column]);
      }
    }
    add_element(file, Type::matrix,
                number_array(static_cast<std::int32_t>(rows),
                             static_cast<std::int32_t>(matrix.columns), values, matrix.name));
  }
  return file;
}

std::string image_info_mat(std::span<const Eigen::Vector2d> points) {
  std::string places;
  for (const int axis : {0, 1}) {
    for (const Eigen::Vector2d& point : points) add(places, point[axis]);
  }
  std::string count;
  add(count, static_cast<double>(points.size()));

  constexpr std::size_t kNameLength = 32;
  std::string names;
  for (const std::string_view field : {"location", "number"}) {
    names += field;
    names.resize((names.size() / kNameLength + 1) * kNameLength, '\0');
  }
  std::string name_length;
  add(name_length, static_cast<std::int32_t>(kNameLength));
  std::string inner = array_start(Class::structure, 1, 1, "");
  add_element(inner, Type::int32, name_length);
  add_element(inner, Type::int8, names);
  add_element(inner, Type::matrix,
              number_array(static_cast<std::int32_t>(points.size()), 2, places));
  add_element(inner, Type::matrix, number_array(1, 1, count));

  std::string outer = array_start(Class::cell, 1, 1, "image_info");
  add_element(outer, Type::matrix, inner);

  std::string file = file_start();
  add_element(file, Type::matrix, outer);
  return file;
}

}  // namespace throng::formats
