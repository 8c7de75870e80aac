// Archives as others may send them: also those that no honest program writes.
#pragma once

#include <archive.h>
#include <archive_entry.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace throng::testing {

struct PackedEntry {
  std::string path;
  std::string bytes = {};
  unsigned type = AE_IFREG;
  std::string link = {};  ///< where a symbolic link leads
  std::string hard_link = {};
};

enum class Packing { tar, tar_gz, zip, zip_stored };

inline std::string packed(Packing packing, const std::vector<PackedEntry>& entries) {
  using Writer = std::unique_ptr<archive, int (*)(archive*)>;
  const Writer writer(archive_write_new(), archive_write_free);
  if (packing == Packing::zip || packing == Packing::zip_stored) {
    archive_write_set_format_zip(writer.get());
    if (packing == Packing::zip_stored) archive_write_zip_set_compression_store(writer.get());
  } else {
    archive_write_set_format_pax_restricted(writer.get());
    if (packing == Packing::tar_gz) archive_write_add_filter_gzip(writer.get());
  }
  archive_write_set_bytes_in_last_block(writer.get(), 1);
  std::string out;
  const auto append = [](archive*, void* text, const void* data, std::size_t size) {
    static_cast<std::string*>(text)->append(static_cast<const char*>(data), size);
    return static_cast<la_ssize_t>(size);
  };
  EXPECT_EQ(archive_write_open(writer.get(), &out, nullptr, append, nullptr), ARCHIVE_OK);
  for (const PackedEntry& from : entries) {
    const std::unique_ptr<archive_entry, void (*)(archive_entry*)> entry(archive_entry_new(),
                                                                         archive_entry_free);
    archive_entry_set_pathname(entry.get(), from.path.c_str());
    archive_entry_set_filetype(entry.get(), from.type);
    archive_entry_set_perm(entry.get(), 0644);
    archive_entry_set_size(entry.get(), static_cast<la_int64_t>(from.bytes.size()));
    if (!from.link.empty()) archive_entry_set_symlink(entry.get(), from.link.c_str());
    if (!from.hard_link.empty()) archive_entry_set_hardlink(entry.get(), from.hard_link.c_str());
    EXPECT_GE(archive_write_header(writer.get(), entry.get()), ARCHIVE_WARN) << from.path;
    if (!from.bytes.empty()) {
      archive_write_data(writer.get(), from.bytes.data(), from.bytes.size());
    }
  }
  EXPECT_EQ(archive_write_close(writer.get()), ARCHIVE_OK);
  return out;
}

}  // namespace throng::testing
