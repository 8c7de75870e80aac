// Any archive: it is unpacked within its limits, into its folder and nowhere else, or refused.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>

#include "base/error.h"
#include "base/files/unpack.h"
#include "tests/fuzz/fuzz_folder.h"

namespace {

namespace fs = std::filesystem;

/// Bytes of the regular files in a folder; aborts at anything but files and
/// folders.
std::uintmax_t bytes_below(const fs::path& folder) {
  std::uintmax_t bytes = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    const fs::file_status status = entry.symlink_status();
    if (!fs::is_regular_file(status) && !fs::is_directory(status)) std::abort();
    if (fs::is_regular_file(status)) bytes += entry.file_size();
  }
  return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const throng::crowd::fuzz::Folder outer;
  const fs::path inner = outer.write("beside", "x").parent_path() / "inner";
  fs::create_directory(inner);
  throng::UnpackLimits limits;
  limits.max_entries = 50;
  limits.max_file_bytes = 100'000;
  limits.max_bytes = 200'000;
  try {
    const throng::Unpacked unpacked =
        throng::unpack_archive({reinterpret_cast<const char*>(data), size}, inner, limits);
    if (unpacked.bytes > limits.max_bytes || unpacked.files == 0) std::abort();
  } catch (const throng::InputError&) {
  } catch (const throng::EnvironmentError&) {
  }
  // A block more may have been written when a limit was found to be broken.
  constexpr std::uintmax_t kBlock = 64 << 10;
  if (bytes_below(inner) > static_cast<std::uintmax_t>(limits.max_bytes) + kBlock) std::abort();
  fs::remove_all(inner);
  if (std::distance(fs::directory_iterator(inner.parent_path()), {}) != 1) std::abort();
  return 0;
}
