#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

#include "base/error.h"
#include "jobs/queue/dataset/archive_format.h"

namespace throng::jobs {

namespace {

using Header = std::array<char, kTarBlock>;

// Places of the fields of a ustar header (POSIX.1-1988).
struct HeaderField {
  std::size_t offset;
  std::size_t length;
};
constexpr HeaderField kName{0, 100};
constexpr HeaderField kMode{100, 8};
constexpr HeaderField kOwner{108, 8};
constexpr HeaderField kGroup{116, 8};
constexpr HeaderField kSize{124, 12};
constexpr HeaderField kTime{136, 12};
constexpr HeaderField kChecksum{148, 8};
constexpr HeaderField kType{156, 1};
constexpr HeaderField kLink{157, 100};
constexpr HeaderField kMagic{257, 8};
constexpr HeaderField kPrefix{345, 155};

void put(Header& header, HeaderField field, std::string_view text) {
  check(text.size() <= field.length, "a tar field holds its text");
  std::copy(text.begin(), text.end(), header.begin() + static_cast<std::ptrdiff_t>(field.offset));
}

// Octal digits with a closing zero byte; sizes of 8 GiB and more in the binary form that all
// readers know.
void put_number(Header& header, HeaderField field, std::int64_t value) {
  const std::string digits = fmt::format("{:0{}o}", value, field.length - 1);
  if (digits.size() < field.length) return put(header, field, digits);
  for (std::size_t i = field.length; i-- > 0; value >>= 8) {
    header[field.offset + i] = static_cast<char>(value & 0xFF);
  }
  header[field.offset] = static_cast<char>(0x80);
}

// A path longer than the name field is split at a '/' between the two fields.
void put_path(Header& header, const std::string& path) {
  if (path.size() <= kName.length) return put(header, kName, path);
  const auto slash = path.find('/', path.size() - kName.length - 1);
  check(slash != std::string::npos && slash <= kPrefix.length, "paths in a dataset are short");
  put(header, kPrefix, path.substr(0, slash));
  put(header, kName, path.substr(slash + 1));
}

}  // namespace

std::string tar_header(const ArchiveMember& member) {
  Header header{};
  put_path(header, member.path);
  put(header, kMode, "0000644");
  put_number(header, kOwner, 0);
  put_number(header, kGroup, 0);
  put_number(header, kSize, member.bytes);
  put_number(header, kTime, 0);
  put(header, kType, member.same_as.empty() ? "0" : "1");
  put(header, kLink, member.same_as);
  put(header, kMagic,
      std::string_view("ustar\0"
                       "00",
                       kMagic.length));
  // The sum counts the checksum's own field as spaces.
  put(header, kChecksum, "        ");
  unsigned sum = 0;
  for (const char c : header) sum += static_cast<unsigned char>(c);
  put(header, kChecksum, fmt::format("{:06o}", sum));
  header[kChecksum.offset + 6] = '\0';
  return {header.begin(), header.end()};
}

}  // namespace throng::jobs
