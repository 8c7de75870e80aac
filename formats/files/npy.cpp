#include "formats/files/npy.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdint>
#include <cstring>
#include <regex>
#include <string>

#include "base/error.h"
#include "base/files/files.h"
#include "base/files/zip_member.h"

namespace throng::formats {

namespace {

/// The bytes of a .npy file, or of the one in a .npz file.
std::string npy_file(const std::filesystem::path& path) {
  std::string bytes = read_file(path);
  if (path.extension() != ".npz") return bytes;
  constexpr std::size_t kMaxBytes = 7680UL * 4320UL * sizeof(float) + 4096;  // of the largest image
  try {
    return zip_member(bytes, "density.npy", kMaxBytes);
  } catch (const InputError& error) {
    Problem problem = error.problems().front();
    problem.source = path.string();
    throw InputError(std::move(problem));
  }
}

}  // namespace

FloatMap read_npy(const std::filesystem::path& path) {
  const auto refuse = [&](const char* found) -> InputError {
    return InputError(
        {path.string(), "", found, "an array of NumPy: float32, C order, 2 dimensions"});
  };
  if (!std::filesystem::is_regular_file(path)) throw refuse("no such file");
  const std::string bytes = npy_file(path);
  constexpr std::size_t kPreamble = 10;
  if (bytes.size() < kPreamble || bytes.compare(0, 8, std::string("\x93NUMPY\x01\x00", 8)) != 0) {
    throw refuse("another kind of file");
  }
  const std::size_t length = static_cast<unsigned char>(bytes[8]) |
                             static_cast<std::size_t>(static_cast<unsigned char>(bytes[9])) << 8;
  constexpr std::size_t kMaxHeader = 1000;  // regular expressions are matched recursively
  if (length > kMaxHeader) throw refuse("another header");
  const std::string header = bytes.substr(kPreamble, length);
  static const std::regex kHeader(
      R"(\{'descr': '<f4', 'fortran_order': False, 'shape': \((\d{1,6}), (\d{1,6})\), \}\s*)");
  std::smatch match;
  if (!std::regex_match(header, match, kHeader)) throw refuse("another header");
  FloatMap map{std::stoi(match[2]), std::stoi(match[1]), {}};
  const std::size_t values =
      static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height);
  if (bytes.size() != kPreamble + length + values * sizeof(float)) {
    throw refuse("a file of another length");
  }
  map.value.resize(values);
  std::memcpy(map.value.data(), bytes.data() + kPreamble + length,
              map.value.size() * sizeof(float));
  return map;
}

std::vector<float> read_npy(const std::filesystem::path& path,
                            std::initializer_list<std::size_t> shape) {
  const std::string wanted = fmt::format("({})", fmt::join(shape, ", "));
  const auto refuse = [&](const char* found) -> InputError {
    return InputError({path.string(), "", found, "float32 of shape " + wanted});
  };
  if (!std::filesystem::is_regular_file(path)) throw refuse("no such file");
  const std::string bytes = read_file(path);
  std::size_t count = 1;
  for (const std::size_t size : shape) count *= size;
  constexpr std::size_t kPreamble = 10;
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
  const std::size_t start =
      bytes.size() < kPreamble ? bytes.size() : kPreamble + byte(8) + 256U * byte(9);
  if (start + count * sizeof(float) != bytes.size() ||
      bytes.find("'shape': " + wanted) == std::string::npos ||
      bytes.find("'<f4'") == std::string::npos) {
    throw refuse("another shape or type");
  }
  std::vector<float> values(count);
  std::memcpy(values.data(), bytes.data() + start, count * sizeof(float));
  return values;
}

}  // namespace throng::formats
