#include <algorithm>
#include <string>

#include "jobs/queue/dataset/archive_format.h"

namespace throng::jobs {

namespace {

constexpr std::int64_t kMax32 = 0xFFFFFFFF;  // said instead of what does not fit, which zip64 has
constexpr std::uint64_t kMax16 = 0xFFFF;
constexpr std::uint16_t kNeeds20 = 20;  // version 2.0 of the format
constexpr std::uint16_t kNeeds45 = 45;  // 4.5: zip64
constexpr std::uint16_t kMadeOnUnix = 3U << 8U;
constexpr std::uint16_t kNamesAreUtf8 = 1U << 11U;
constexpr std::uint16_t kFirstDay = 1U << 5U | 1U;  // 1 January 1980
constexpr std::uint32_t kFileMode = 0100644U << 16U;
constexpr std::uint16_t kZip64 = 1;

/// Little-endian numbers, one after the other.
class Bytes {
 public:
  template <typename T>
  Bytes& add(T number) {
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      text_ += static_cast<char>(static_cast<std::uint64_t>(number) >> (8 * i) & 0xFFU);
    }
    return *this;
  }
  Bytes& add_text(const std::string& text) {
    text_ += text;
    return *this;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

bool is_large(std::int64_t bytes) { return bytes >= kMax32; }

std::uint32_t limited(std::int64_t number) {
  return static_cast<std::uint32_t>(std::min(number, kMax32));
}

/// Versions needed to read a member, then what both of its headers say of it.
void add_common(const ArchiveMember& member, bool zip64, std::size_t extra_bytes, Bytes& bytes) {
  bytes.add(zip64 ? kNeeds45 : kNeeds20)
      .add(kNamesAreUtf8)
      .add<std::uint16_t>(0)  // stored
      .add<std::uint16_t>(0)  // midnight
      .add(kFirstDay)
      .add(member.crc32)
      .add(limited(member.bytes))
      .add(limited(member.bytes))
      .add(static_cast<std::uint16_t>(member.path.size()))
      .add(static_cast<std::uint16_t>(extra_bytes));
}

std::string zip64_extra(const Bytes& numbers) {
  if (numbers.text().empty()) return "";
  Bytes extra;
  extra.add(kZip64).add(static_cast<std::uint16_t>(numbers.text().size())).add_text(numbers.text());
  return extra.text();
}

}  // namespace

std::string zip_header(const ArchiveMember& member) {
  Bytes numbers;
  if (is_large(member.bytes)) numbers.add(member.bytes).add(member.bytes);
  const std::string extra = zip64_extra(numbers);
  Bytes header;
  header.add<std::uint32_t>(0x04034b50);
  add_common(member, !extra.empty(), extra.size(), header);
  header.add_text(member.path).add_text(extra);
  return header.text();
}

std::string zip_entry(const ArchiveMember& member) {
  Bytes numbers;
  if (is_large(member.bytes)) numbers.add(member.bytes).add(member.bytes);
  if (is_large(member.offset)) numbers.add(member.offset);
  const std::string extra = zip64_extra(numbers);
  const bool zip64 = !extra.empty();
  Bytes entry;
  entry.add<std::uint32_t>(0x02014b50)
      .add(static_cast<std::uint16_t>(kMadeOnUnix | (zip64 ? kNeeds45 : kNeeds20)));
  add_common(member, zip64, extra.size(), entry);
  entry
      .add<std::uint16_t>(0)  // comment
      .add<std::uint16_t>(0)  // disk
      .add<std::uint16_t>(0)  // internal attributes
      .add(kFileMode)
      .add(limited(member.offset))
      .add_text(member.path)
      .add_text(extra);
  return entry.text();
}

std::string zip_end(std::uint64_t entries, std::int64_t directory_offset,
                    std::int64_t directory_bytes) {
  Bytes end;
  if (entries >= kMax16 || is_large(directory_offset) || is_large(directory_bytes)) {
    constexpr std::uint64_t kRecordBytes = 44;  // behind this number
    end.add<std::uint32_t>(0x06064b50)
        .add(kRecordBytes)
        .add(static_cast<std::uint16_t>(kMadeOnUnix | kNeeds45))
        .add(kNeeds45)
        .add<std::uint32_t>(0)
        .add<std::uint32_t>(0)
        .add(entries)
        .add(entries)
        .add(directory_bytes)
        .add(directory_offset);
    end.add<std::uint32_t>(0x07064b50)
        .add<std::uint32_t>(0)
        .add(directory_offset + directory_bytes)
        .add<std::uint32_t>(1);
  }
  const auto count = static_cast<std::uint16_t>(std::min(entries, kMax16));
  end.add<std::uint32_t>(0x06054b50)
      .add<std::uint16_t>(0)
      .add<std::uint16_t>(0)
      .add(count)
      .add(count)
      .add(limited(directory_bytes))
      .add(limited(directory_offset))
      .add<std::uint16_t>(0);
  return end.text();
}

}  // namespace throng::jobs
