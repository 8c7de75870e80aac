// Descriptions of binary records for programs in other languages (documents/layouts.h).
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

namespace throng::layouts {

/// A field of a record: one number, or several of the same type.
struct BinaryField {
  std::string_view name;
  std::string_view type;  ///< as NumPy names it: "<f4", "<u2", "|u1"
  std::size_t count = 1;
  std::size_t bytes = 0;  ///< of the whole field
};

/// NumPy's name of a type of numbers; little-endian.
template <typename Number>
constexpr std::string_view numpy_type() {
  if constexpr (std::same_as<Number, double>) return "<f8";
  if constexpr (std::same_as<Number, float>) return "<f4";
  if constexpr (std::same_as<Number, std::uint32_t>) return "<u4";
  if constexpr (std::same_as<Number, std::uint16_t>) return "<u2";
  if constexpr (std::same_as<Number, std::int16_t>) return "<i2";
  if constexpr (std::same_as<Number, std::uint8_t>) return "|u1";
}

/// The field of a record in which a member is stored.
template <typename Record, typename Number>
constexpr BinaryField field(std::string_view name, Number Record::* /*member*/) {
  return {name, numpy_type<Number>(), 1, sizeof(Number)};
}
template <typename Record, typename Number, std::size_t count>
constexpr BinaryField field(std::string_view name, std::array<Number, count> Record::* /*member*/) {
  return {name, numpy_type<Number>(), count, sizeof(Number) * count};
}

/// Whether fields follow each other without gaps and fill a record of this size.
template <std::size_t count>
constexpr bool fill(const std::array<BinaryField, count>& fields, std::size_t record_bytes) {
  std::size_t bytes = 0;
  for (const BinaryField& field : fields) bytes += field.bytes;
  return bytes == record_bytes;
}

}  // namespace throng::layouts
