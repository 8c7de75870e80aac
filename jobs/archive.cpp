#include "jobs/archive.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <unordered_map>

#include "base/error.h"
#include "jobs/manifest.h"

namespace throng::jobs {

namespace fs = std::filesystem;

namespace {

constexpr std::int64_t kBlock = 512;
constexpr std::int64_t kEndBytes = 2 * kBlock;  // two blocks of zeros end a tar file
using Header = std::array<char, kBlock>;

// Places of the fields of a ustar header (POSIX.1-1988).
struct Field {
  std::size_t offset;
  std::size_t length;
};
constexpr Field kName{0, 100};
constexpr Field kMode{100, 8};
constexpr Field kOwner{108, 8};
constexpr Field kGroup{116, 8};
constexpr Field kSize{124, 12};
constexpr Field kTime{136, 12};
constexpr Field kChecksum{148, 8};
constexpr Field kType{156, 1};
constexpr Field kLink{157, 100};
constexpr Field kMagic{257, 8};
constexpr Field kPrefix{345, 155};

std::int64_t padded(std::int64_t bytes) { return (bytes + kBlock - 1) / kBlock * kBlock; }

void put(Header& header, Field field, std::string_view text) {
  check(text.size() <= field.length, "a tar field holds its text");
  std::copy(text.begin(), text.end(), header.begin() + static_cast<std::ptrdiff_t>(field.offset));
}

// Octal digits with a closing zero byte; sizes of 8 GiB and more in the binary form that all
// readers know.
void put_number(Header& header, Field field, std::int64_t value) {
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

// `same_as`: the path of an earlier member that this one is a hard link to, or "".
Header header_of(const std::string& path, std::int64_t bytes, const std::string& same_as) {
  Header header{};
  put_path(header, path);
  put(header, kMode, "0000644");
  put_number(header, kOwner, 0);
  put_number(header, kGroup, 0);
  put_number(header, kSize, bytes);
  put_number(header, kTime, 0);
  put(header, kType, same_as.empty() ? "0" : "1");
  put(header, kLink, same_as);
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
  return header;
}

class OpenFile {
 public:
  explicit OpenFile(const fs::path& path)
      : descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (descriptor_ < 0) {
      throw EnvironmentError(
          fmt::format("cannot open {}: {}", path.string(), std::strerror(errno)));
    }
  }
  ~OpenFile() { ::close(descriptor_); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

void read_exactly(const fs::path& path, std::int64_t offset, std::span<char> buffer) {
  const OpenFile file(path);
  while (!buffer.empty()) {
    const ssize_t count = ::pread(file.descriptor(), buffer.data(), buffer.size(), offset);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      throw EnvironmentError(fmt::format("{} is shorter than the manifest says", path.string()));
    }
    offset += count;
    buffer = buffer.subspan(static_cast<std::size_t>(count));
  }
}

}  // namespace

Archive::Archive(fs::path dataset, std::string root)
    : dataset_(std::move(dataset)), root_(std::move(root)) {
  // Other formats hold the same pictures under other names.
  std::unordered_map<std::string, std::string> first_of;
  for (FileEntry& file : read_manifest_files(dataset_)) {
    const auto [first, is_new] = first_of.try_emplace(file.sha256, file.path);
    const std::string target = is_new ? "" : root_ + "/" + first->second;
    if (is_new || file.bytes <= kBlock || target.size() > kLink.length) {
      members_.push_back({std::move(file.path), file.bytes, 0, ""});
    } else {
      members_.push_back({std::move(file.path), 0, 0, target});
    }
  }
  std::error_code error;
  const auto manifest_bytes = fs::file_size(dataset_ / kManifestName, error);
  if (error) throw EnvironmentError(fmt::format("cannot read {}", kManifestName));
  members_.push_back({kManifestName, static_cast<std::int64_t>(manifest_bytes), 0, ""});
  std::sort(members_.begin(), members_.end(),
            [](const Member& a, const Member& b) { return a.path < b.path; });
  for (Member& member : members_) {
    member.offset = size_;
    size_ += kBlock + padded(member.bytes);
  }
  size_ += kEndBytes;
}

std::size_t Archive::read(std::int64_t offset, std::span<char> buffer) const {
  if (offset < 0 || offset >= size_) return 0;
  buffer = buffer.first(
      static_cast<std::size_t>(std::min(static_cast<std::int64_t>(buffer.size()), size_ - offset)));
  auto member = std::upper_bound(
      members_.begin(), members_.end(), offset,
      [](std::int64_t place, const Member& candidate) { return place < candidate.offset; });
  if (member != members_.begin()) --member;
  std::size_t filled = 0;
  while (filled < buffer.size()) {
    const std::int64_t place = offset + static_cast<std::int64_t>(filled);
    if (member == members_.end()) {
      std::fill(buffer.begin() + static_cast<std::ptrdiff_t>(filled), buffer.end(), '\0');
      break;
    }
    filled += read_member(*member, place - member->offset, buffer.subspan(filled));
    ++member;
  }
  return buffer.size();
}

// Reads header, content and padding of one member, from `offset` in it on.
std::size_t Archive::read_member(const Member& member, std::int64_t offset,
                                 std::span<char> buffer) const {
  const std::int64_t end = kBlock + padded(member.bytes);
  buffer = buffer.first(static_cast<std::size_t>(
      std::clamp<std::int64_t>(end - offset, 0, static_cast<std::int64_t>(buffer.size()))));
  const std::size_t total = buffer.size();
  const auto take = [&](std::int64_t part_end) {
    const auto count =
        std::clamp<std::int64_t>(part_end - offset, 0, static_cast<std::int64_t>(buffer.size()));
    const std::span<char> part = buffer.first(static_cast<std::size_t>(count));
    buffer = buffer.subspan(part.size());
    offset += count;
    return part;
  };
  if (offset < kBlock) {
    const Header header = header_of(root_ + "/" + member.path, member.bytes, member.same_as);
    const std::int64_t from = offset;
    const std::span<char> part = take(kBlock);
    std::copy_n(header.begin() + from, part.size(), part.begin());
  }
  const std::int64_t from = offset - kBlock;
  const std::span<char> content = take(kBlock + member.bytes);
  if (!content.empty()) read_exactly(dataset_ / member.path, from, content);
  std::fill(buffer.begin(), buffer.end(), '\0');
  return total;
}

std::string slug(const std::string& name) {
  constexpr std::size_t kLongest = 60;
  std::string text;
  for (const char c : name) {
    const bool upper = c >= 'A' && c <= 'Z';
    const bool keep = upper || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    if (keep) {
      text += static_cast<char>(upper ? c - 'A' + 'a' : c);
    } else if (!text.empty() && text.back() != '-') {
      text += '-';
    }
    if (text.size() == kLongest) break;
  }
  while (!text.empty() && text.back() == '-') text.pop_back();
  return text.empty() ? "dataset" : text;
}

}  // namespace throng::jobs
