#include "crowd/output/scb.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "crowd/elements/element.h"

namespace throng::crowd {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kWord = 4;  // bytes
/// By kScbVersions.
constexpr std::array<std::size_t, kScbVersions.size()> kFloats = {3, 3, 4, 8, 4, 4};
constexpr std::size_t kMaxRecordValues = 8;

void put(std::string& bytes, std::uint32_t word) {
  for (unsigned shift = 0; shift < 32; shift += 8) {
    bytes += static_cast<char>((word >> shift) & 0xFFU);
  }
}

std::uint32_t get(const char* bytes) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < kWord; ++i) {
    word |= std::uint32_t{static_cast<unsigned char>(bytes[i])} << (8 * i);
  }
  return word;
}

std::size_t version_index(std::string_view version) {
  const auto found = std::find(kScbVersions.begin(), kScbVersions.end(), version);
  check(found != kScbVersions.end(), "the version of an .scb file is a known one");
  return static_cast<std::size_t>(found - kScbVersions.begin());
}

/// A version's values of an agent; as many as kFloats are used.
std::array<float, kMaxRecordValues> record_values(std::size_t version, const Simulation& crowd,
                                                  std::size_t agent) {
  const Eigen::Vector2f& p = crowd.positions()[agent];
  const float yaw_rad = crowd.yaws_rad()[agent];
  const auto state = static_cast<float>(crowd.states()[agent]);
  if (kScbVersions[version] == "2.2") {
    const Eigen::Vector2f preferred = crowd.preferred_velocity(agent);
    const Eigen::Vector2f& v = crowd.velocities()[agent];
    return {p.x(), p.y(), yaw_rad, state, preferred.x(), preferred.y(), v.x(), v.y()};
  }
  if (kScbVersions[version] == "2.3") return {p.x(), p.y(), std::cos(yaw_rad), std::sin(yaw_rad)};
  if (kScbVersions[version] == "2.4") return {p.x(), crowd.ground_m(agent), p.y(), yaw_rad};
  return {p.x(), p.y(), yaw_rad, state};
}

}  // namespace

ScbFile::ScbFile(const fs::path& path, std::string_view version, double dt_s,
                 std::span<const std::int32_t> classes)
    : file_(path) {
  bytes_ = version;
  bytes_ += '\0';
  put(bytes_, static_cast<std::uint32_t>(classes.size()));
  if (version != "1.0") {
    put(bytes_, std::bit_cast<std::uint32_t>(static_cast<float>(dt_s)));
    for (const std::int32_t agent_class : classes) {
      put(bytes_, static_cast<std::uint32_t>(agent_class));
    }
  }
  file_.write(bytes_);
}

void ScbFile::add(std::span<const float> values) {
  bytes_.clear();
  for (const float value : values) put(bytes_, std::bit_cast<std::uint32_t>(value));
  file_.write(bytes_);
}

ScbWriter::ScbWriter(const fs::path& path, std::string_view version, const Simulation& crowd)
    : version_(version_index(version)), file_(path, version, crowd.dt_s(), crowd.agent_classes()) {}

void ScbWriter::record(const Simulation& crowd) {
  const std::size_t floats = kFloats[version_];
  frame_.clear();
  for (std::size_t i = 0; i < crowd.agent_count(); ++i) {
    std::array<float, kMaxRecordValues> values{};
    if (crowd.present()[i] != 0) {
      values = record_values(version_, crowd, i);
    } else {
      values.fill(std::numeric_limits<float>::quiet_NaN());
    }
    frame_.insert(frame_.end(), values.begin(),
                  values.begin() + static_cast<std::ptrdiff_t>(floats));
  }
  file_.add(frame_);
}

void ScbWriter::finish(const Simulation&) { file_.commit(); }

ScbReader::ScbReader(const fs::path& path)
    : file_(path, std::ios::binary), name_(path.filename().string()) {
  if (!file_ || !fs::is_regular_file(path)) {
    throw EnvironmentError(fmt::format("cannot read {}", path.string()));
  }
  const auto fail = [&](std::string found, std::string expected) {
    throw InputError(Problem{name_, "header", std::move(found), std::move(expected)});
  };
  const std::uint64_t size = fs::file_size(path);
  constexpr std::size_t kVersionBytes = 4;
  std::array<char, kVersionBytes + 2 * kWord> start{};
  file_.read(start.data(), start.size());
  const auto end = std::find(start.begin(), start.begin() + kVersionBytes, '\0');
  version_.assign(start.begin(), end);
  const auto known = std::find(kScbVersions.begin(), kScbVersions.end(), version_);
  if (known == kScbVersions.end() || size < kVersionBytes + kWord) {
    fail(in_quotes(version_), fmt::format("a version: {}", fmt::join(kScbVersions, ", ")));
  }
  floats_per_agent_ = kFloats[static_cast<std::size_t>(known - kScbVersions.begin())];
  const std::uint64_t count = get(start.data() + kVersionBytes);
  const bool has_classes = version_ != "1.0";
  header_bytes_ = kVersionBytes + kWord + (has_classes ? kWord * (1 + count) : 0);
  if (count == 0 || header_bytes_ > size) {
    fail(fmt::format("{} agents in {} bytes", count, size), "as many agents as the file holds");
  }
  agent_count_ = count;
  frame_count_ = (size - header_bytes_) / (count * floats_per_agent_ * kWord);
  if (!has_classes) return;
  dt_s_ = std::bit_cast<float>(get(start.data() + kVersionBytes + kWord));
  std::vector<char> bytes(count * kWord);
  file_.seekg(kVersionBytes + 2 * kWord);
  file_.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  for (std::size_t i = 0; i < count; ++i) classes_.push_back(get(bytes.data() + i * kWord));
}

std::vector<float> ScbReader::frame(std::size_t index) {
  check(index < frame_count_, "only frames that are there are read");
  const std::size_t floats = agent_count_ * floats_per_agent_;
  std::vector<char> bytes(floats * kWord);
  file_.clear();
  file_.seekg(static_cast<std::streamoff>(header_bytes_ + index * bytes.size()));
  file_.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file_) throw EnvironmentError(fmt::format("cannot read {}", name_));
  std::vector<float> values(floats);
  for (std::size_t i = 0; i < floats; ++i) {
    values[i] = std::bit_cast<float>(get(bytes.data() + i * kWord));
  }
  return values;
}

}  // namespace throng::crowd
