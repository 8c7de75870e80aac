#include "base/files/zip_member.h"

#include <archive.h>
#include <archive_entry.h>
#include <fmt/core.h>

#include <memory>

#include "base/error.h"

namespace throng {

namespace {

struct FreeArchive {
  void operator()(archive* one) const { archive_free(one); }
};
struct FreeEntry {
  void operator()(archive_entry* one) const { archive_entry_free(one); }
};
using ZipArchive = std::unique_ptr<archive, FreeArchive>;
using ZipEntry = std::unique_ptr<archive_entry, FreeEntry>;

void require_zip(archive* zip, int result) {
  if (result == ARCHIVE_OK) return;
  throw EnvironmentError(fmt::format("cannot make a ZIP file: {}", archive_error_string(zip)));
}

InputError zip_error(std::string found) {
  return InputError(Problem{"", "", std::move(found), "a ZIP file that is whole"});
}

/// The data of the entry that was read last.
std::string read_member(archive* zip, std::string_view name, std::size_t max_bytes) {
  constexpr std::size_t kStepBytes = 1U << 20U;
  std::string bytes;
  std::size_t used = 0;
  for (;;) {
    bytes.resize(used + kStepBytes);
    const la_ssize_t count = archive_read_data(zip, bytes.data() + used, kStepBytes);
    if (count < 0) throw zip_error(fmt::format("a damaged member \"{}\"", name));
    used += static_cast<std::size_t>(count);
    if (used > max_bytes) {
      throw zip_error(fmt::format("a member \"{}\" of more than {} bytes", name, max_bytes));
    }
    if (count > 0) continue;
    bytes.resize(used);
    return bytes;
  }
}

}  // namespace

std::string make_zip(std::string_view name, std::string_view bytes) {
  constexpr std::size_t kOverhead = 1000;  // headers, and blocks that do not deflate
  constexpr std::size_t kBlockBytes = 16'000;
  std::string out(bytes.size() + bytes.size() / kBlockBytes * 5 + kOverhead + 4 * name.size(), 0);
  std::size_t used = 0;
  const ZipArchive zip(archive_write_new());
  require_zip(zip.get(), archive_write_set_format_zip(zip.get()));
  require_zip(zip.get(), archive_write_set_options(zip.get(), "zip:compression-level=6"));
  require_zip(zip.get(), archive_write_set_bytes_in_last_block(zip.get(), 1));
  require_zip(zip.get(), archive_write_open_memory(zip.get(), out.data(), out.size(), &used));
  const ZipEntry entry(archive_entry_new());
  archive_entry_set_pathname(entry.get(), std::string(name).c_str());
  archive_entry_set_filetype(entry.get(), AE_IFREG);
  archive_entry_set_perm(entry.get(), 0644);
  archive_entry_set_size(entry.get(), static_cast<la_int64_t>(bytes.size()));
  require_zip(zip.get(), archive_write_header(zip.get(), entry.get()));
  const la_ssize_t written = archive_write_data(zip.get(), bytes.data(), bytes.size());
  require_zip(zip.get(),
              written == static_cast<la_ssize_t>(bytes.size()) ? ARCHIVE_OK : ARCHIVE_FATAL);
  require_zip(zip.get(), archive_write_close(zip.get()));
  out.resize(used);
  return out;
}

std::string zip_member(std::string_view zip_bytes, std::string_view name, std::size_t max_bytes) {
  const ZipArchive zip(archive_read_new());
  archive_read_support_format_zip(zip.get());
  if (archive_read_open_memory(zip.get(), zip_bytes.data(), zip_bytes.size()) != ARCHIVE_OK) {
    throw zip_error("another kind of file");
  }
  archive_entry* entry = nullptr;
  int result = ARCHIVE_OK;
  while ((result = archive_read_next_header(zip.get(), &entry)) == ARCHIVE_OK) {
    const char* path = archive_entry_pathname(entry);
    if (path == nullptr || path != name) continue;
    return read_member(zip.get(), name, max_bytes);
  }
  throw zip_error(result == ARCHIVE_EOF ? fmt::format("no member \"{}\"", name)
                                        : std::string("a damaged file"));
}

}  // namespace throng
