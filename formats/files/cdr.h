// Little-endian CDR (OMG Common Data Representation), as ROS 2 serializes its messages.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace throng::formats {

static_assert(std::endian::native == std::endian::little, "CDR is written as memory has it");

/// Writes one message: fields in the order of the message's definition. Numbers are aligned to
/// their size, counted from the end of the header of four bytes.
class CdrWriter {
 public:
  CdrWriter() : bytes_("\0\1\0\0", kHeaderBytes) {}

  template <typename Number>
  requires std::is_arithmetic_v<Number> CdrWriter& add(Number number) {
    align(sizeof(Number));
    bytes_.append(reinterpret_cast<const char*>(&number), sizeof(Number));
    return *this;
  }

  CdrWriter& add(std::string_view text) {
    add(static_cast<std::uint32_t>(text.size() + 1));
    bytes_.append(text).push_back('\0');
    return *this;
  }
  CdrWriter& add(const char* text) { return add(std::string_view(text)); }

  /// Length of a sequence, whose elements follow.
  CdrWriter& count(std::size_t elements) { return add(static_cast<std::uint32_t>(elements)); }

  /// A sequence of bytes.
  CdrWriter& add_bytes(std::string_view data) {
    count(data.size());
    bytes_.append(data);
    return *this;
  }

  /// Elements of an array, or of a sequence after its count().
  CdrWriter& add_all(std::span<const double> numbers) {
    for (const double number : numbers) add(number);
    return *this;
  }

  /// geometry_msgs/Vector3 or Point.
  CdrWriter& add(const Eigen::Vector3d& v) { return add(v.x()).add(v.y()).add(v.z()); }
  /// geometry_msgs/Quaternion.
  CdrWriter& add(const Eigen::Quaterniond& q) {
    return add(q.x()).add(q.y()).add(q.z()).add(q.w());
  }

  const std::string& bytes() const { return bytes_; }

 private:
  static constexpr std::size_t kHeaderBytes = 4;

  void align(std::size_t size) {
    const std::size_t over = (bytes_.size() - kHeaderBytes) % size;
    if (over > 0) bytes_.append(size - over, '\0');
  }

  std::string bytes_;
};

}  // namespace throng::formats
