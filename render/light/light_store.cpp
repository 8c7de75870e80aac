#include "render/light/light_store.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <Eigen/Core>
#include <algorithm>
#include <cerrno>
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
constexpr std::size_t kValueBytes = 2;

/// Half floats, lower byte first.
std::string encode(const std::vector<float>& values) {
  std::string bytes;
  bytes.reserve(values.size() * kValueBytes);
  for (const float value : values) {
    const std::uint16_t half = Eigen::half_impl::float_to_half_rtne(value).x;
    bytes.push_back(static_cast<char>(half & 0xFFU));
    bytes.push_back(static_cast<char>(half >> 8U));
  }
  return bytes;
}

std::vector<float> decode(std::string_view bytes) {
  std::vector<float> values;
  values.reserve(bytes.size() / kValueBytes);
  const auto byte = [&](std::size_t i) {
    return static_cast<unsigned>(static_cast<unsigned char>(bytes[i]));
  };
  for (std::size_t i = 0; i + 1 < bytes.size(); i += kValueBytes) {
    const auto half = static_cast<std::uint16_t>(byte(i) | byte(i + 1) << 8U);
    values.push_back(Eigen::half_impl::half_to_float(Eigen::half_impl::raw_uint16_to_half(half)));
  }
  return values;
}

/// The values of a file, which ends with their hash; none if it is absent or damaged.
std::optional<std::vector<float>> read_values(const fs::path& file, std::size_t count) {
  std::error_code error;
  if (!fs::is_regular_file(fs::symlink_status(file, error))) return std::nullopt;
  if (fs::file_size(file, error) != count * kValueBytes + kHashDigits) return std::nullopt;
  const std::string bytes = read_file(file);
  if (bytes.size() != count * kValueBytes + kHashDigits) return std::nullopt;
  const std::string_view content = std::string_view(bytes).substr(0, bytes.size() - kHashDigits);
  if (sha256_hex(content) != std::string_view(bytes).substr(content.size())) return std::nullopt;
  return decode(content);
}

/// Holds the folder's lock until destruction. If a file system has no locks, several processes
/// may make the same bytes.
class Turn {
 public:
  explicit Turn(const fs::path& folder)
      : descriptor_(::open((folder / "lock").c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600)) {
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
    const std::vector<float> values = make();
    check(values.size() == count, "light has the values that its key says");
    return encode(values);
  };
  if (folder.empty()) return decode(made());
  const fs::path file = folder / (key + ".light");
  if (auto values = read_values(file, count)) return *std::move(values);
  make_folders(folder);
  const Turn turn(folder);
  if (auto values = read_values(file, count)) return *std::move(values);
  const std::string bytes = made();
  make_room(folder, count * kValueBytes + kHashDigits);
  StagedFile staged(file);
  staged.write(bytes);
  staged.write(sha256_hex(bytes));
  staged.commit();
  return decode(bytes);
}

}  // namespace throng::render
