#include "render/light/light_store.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/files/files.h"
#include "base/files/hash.h"

namespace throng::render {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kHashDigits = 64;

std::string_view as_bytes(const std::vector<float>& values) {
  return {reinterpret_cast<const char*>(
              values.data()),  // NOLINT(cppcoreguidelines-pro-type-reinterpret-cast)
          values.size() * sizeof(float)};
}

/// The values of a file, which ends with their hash; none if it is absent or damaged.
std::optional<std::vector<float>> read_values(const fs::path& file, std::size_t count) {
  std::error_code error;
  if (!fs::is_regular_file(fs::symlink_status(file, error))) return std::nullopt;
  if (fs::file_size(file, error) != count * sizeof(float) + kHashDigits) return std::nullopt;
  const std::string bytes = read_file(file);
  if (bytes.size() != count * sizeof(float) + kHashDigits) return std::nullopt;
  const std::string_view content = std::string_view(bytes).substr(0, bytes.size() - kHashDigits);
  if (sha256_hex(content) != std::string_view(bytes).substr(content.size())) return std::nullopt;
  std::vector<float> values(count);
  std::memcpy(values.data(), content.data(), content.size());
  return values;
}

/// Holds the folder's lock until destruction. If a file system has no locks, several processes
/// may make the same bytes.
class Turn {
 public:
  explicit Turn(const fs::path& folder)
      : descriptor_(::open((folder / "lock").c_str(), O_CREAT | O_RDWR | O_CLOEXEC,
                           0600)) {  // NOLINT(cppcoreguidelines-pro-type-vararg)
    while (descriptor_ >= 0 && ::flock(descriptor_, LOCK_EX) != 0 && errno == EINTR) {
    }
  }
  ~Turn() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  int descriptor_;
};

/// Removes the oldest files until `more` bytes fit.
void make_room(const fs::path& folder, std::uint64_t more) {
  std::error_code error;
  std::vector<std::pair<fs::file_time_type, fs::path>> files;
  std::uint64_t sum = more;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() != ".light" || !entry.is_regular_file(error)) continue;
    files.emplace_back(entry.last_write_time(error), entry.path());
    sum += entry.file_size(error);
  }
  std::sort(files.begin(), files.end());
  for (const auto& [time, file] : files) {
    if (sum <= kMaxLightBytes) return;
    sum -= std::min<std::uint64_t>(sum, fs::file_size(file, error));
    fs::remove(file, error);
  }
}

}  // namespace

std::vector<float> load_or_make(const fs::path& folder, const std::string& key, std::size_t count,
                                const std::function<std::vector<float>()>& make) {
  const auto made = [&] {
    std::vector<float> values = make();
    check(values.size() == count, "light has the values that its key says");
    return values;
  };
  if (folder.empty()) return made();
  const fs::path file = folder / (key + ".light");
  if (auto values = read_values(file, count)) return *std::move(values);
  make_folders(folder);
  const Turn turn(folder);
  if (auto values = read_values(file, count)) return *std::move(values);
  std::vector<float> values = made();
  make_room(folder, count * sizeof(float) + kHashDigits);
  StagedFile staged(file);
  staged.write(as_bytes(values));
  staged.write(sha256_hex(as_bytes(values)));
  staged.commit();
  return values;
}

}  // namespace throng::render
