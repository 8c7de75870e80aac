#include "jobs/queue/dataset/archive.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstring>
#include <unordered_map>

#include "base/error.h"
#include "base/files/files.h"
#include "base/files/hash.h"
#include "base/files/read_only_file.h"
#include "base/text/portable_name.h"

namespace throng::jobs {

namespace fs = std::filesystem;

namespace {

std::int64_t tar_padding(std::int64_t bytes) { return (kTarBlock - bytes % kTarBlock) % kTarBlock; }

void read_exactly(const fs::path& path, std::int64_t offset, std::span<char> buffer) {
  if (ReadOnlyFile(path).read_at(offset, buffer) < buffer.size()) {
    throw EnvironmentError(fmt::format("{} is shorter than the manifest says", path.string()));
  }
}

// A dataset of another version may hold names that are one file, or none, where it is unpacked.
void require_portable(const std::string& path, DistinctPaths& paths) {
  if (const auto fault = path_fault(path)) {
    throw EnvironmentError(
        fmt::format("the dataset's file \"{}\" cannot be in an archive: {} is not "
                    "allowed on Windows or macOS",
                    path, *fault));
  }
  if (const auto clash = paths.add(path)) {
    throw EnvironmentError(
        fmt::format("the dataset's files \"{}\" and \"{}\" cannot be in one "
                    "archive: they are one file on Windows and macOS",
                    clash->earlier, path));
  }
}

}  // namespace

Archive::Archive(fs::path dataset, const Manifest& manifest, const std::string& root,
                 ArchiveFormat format, const Selection& selection)
    : dataset_(std::move(dataset)), root_(root + "/"), format_(format) {
  choose(manifest, selection);
  if (format_ == ArchiveFormat::tar) {
    link_equal_files();
    lay_out_tar();
  } else {
    lay_out_zip();
  }
}

void Archive::choose(const Manifest& manifest, const Selection& selection) {
  for (const FileEntry& file : manifest.files) {
    if (!selection.holds(file.path)) continue;
    if (format_ == ArchiveFormat::zip && !file.crc32) {
      throw EnvironmentError(
          "the dataset was made before checksums for zip were kept; ask for tar");
    }
    files_.push_back(file);
  }
  files_.push_back(manifest.itself);
  std::sort(files_.begin(), files_.end(),
            [](const FileEntry& a, const FileEntry& b) { return a.path < b.path; });
  DistinctPaths paths;
  for (const FileEntry& file : files_) {
    require_portable(root_ + file.path, paths);
    members_.push_back({root_ + file.path, file.bytes, 0, "", file.crc32.value_or(0)});
  }
}

// Other formats hold the same images under other names.
void Archive::link_equal_files() {
  constexpr std::size_t kMaxLinkLength = 100;
  std::unordered_map<std::string, std::string> first_of;
  for (std::size_t i = 0; i < files_.size(); ++i) {
    const auto [first, is_new] = first_of.try_emplace(files_[i].sha256, members_[i].path);
    if (is_new || files_[i].bytes <= kTarBlock || first->second.size() > kMaxLinkLength) continue;
    members_[i].same_as = first->second;
    members_[i].bytes = 0;
  }
}

void Archive::add_part(PartKind kind, std::size_t member, std::int64_t bytes) {
  if (bytes == 0) return;
  parts_.push_back({size_, kind, static_cast<std::uint32_t>(member)});
  size_ += bytes;
}

void Archive::lay_out_tar() {
  for (std::size_t i = 0; i < members_.size(); ++i) {
    members_[i].offset = size_;
    add_part(PartKind::header, i, kTarBlock);
    add_part(PartKind::content, i, members_[i].bytes);
    add_part(PartKind::zeros, i, tar_padding(members_[i].bytes));
  }
  add_part(PartKind::zeros, 0, kTarEndBytes);
}

void Archive::lay_out_zip() {
  for (std::size_t i = 0; i < members_.size(); ++i) {
    members_[i].offset = size_;
    add_part(PartKind::header, i, static_cast<std::int64_t>(zip_header(members_[i]).size()));
    add_part(PartKind::content, i, members_[i].bytes);
  }
  const std::int64_t directory = size_;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    add_part(PartKind::entry, i, static_cast<std::int64_t>(zip_entry(members_[i]).size()));
  }
  end_ = zip_end(members_.size(), directory, size_ - directory);
  add_part(PartKind::end, 0, static_cast<std::int64_t>(end_.size()));
}

std::size_t Archive::read(std::int64_t offset, std::span<char> buffer) const {
  if (offset < 0 || offset >= size_) return 0;
  buffer = buffer.first(
      static_cast<std::size_t>(std::min(static_cast<std::int64_t>(buffer.size()), size_ - offset)));
  auto part = std::upper_bound(
      parts_.begin(), parts_.end(), offset,
      [](std::int64_t place, const Part& candidate) { return place < candidate.offset; });
  --part;  // the first begins at 0
  std::size_t filled = 0;
  for (; filled < buffer.size(); ++part) {
    const std::int64_t place = offset + static_cast<std::int64_t>(filled);
    const std::int64_t end = part + 1 == parts_.end() ? size_ : (part + 1)->offset;
    const auto count = static_cast<std::size_t>(
        std::min(end - place, static_cast<std::int64_t>(buffer.size() - filled)));
    read_part(*part, place - part->offset, buffer.subspan(filled, count));
    filled += count;
  }
  return buffer.size();
}

void Archive::read_part(const Part& part, std::int64_t from, std::span<char> buffer) const {
  const ArchiveMember& member = members_[part.member];
  const auto copy = [&](const std::string& text) {
    std::copy_n(text.begin() + from, buffer.size(), buffer.begin());
  };
  switch (part.kind) {
    case PartKind::header:
      return copy(format_ == ArchiveFormat::tar ? tar_header(member) : zip_header(member));
    case PartKind::content:
      return read_exactly(dataset_ / files_[part.member].path, from, buffer);
    case PartKind::zeros:
      std::fill(buffer.begin(), buffer.end(), '\0');
      return;
    case PartKind::entry:
      return copy(zip_entry(member));
    case PartKind::end:
      return copy(end_);
  }
}

}  // namespace throng::jobs
