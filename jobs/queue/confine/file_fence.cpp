#include "jobs/queue/confine/file_fence.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <linux/landlock.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <string_view>

#include "base/files/files.h"

namespace throng::jobs {

namespace {

namespace fs = std::filesystem;

// The right to truncate came with version 3 of the interface (Linux 6.2); the header of Debian 12's
// kernel lacks it.
constexpr std::uint64_t kTruncate = 1ULL << 14U;
constexpr int kFirstWithRenames = 2;
constexpr int kFirstWithTruncate = 3;
// Version 6 (Linux 6.12): no signals to processes outside, no abstract local sockets of theirs.
constexpr int kFirstWithScopes = 6;
constexpr std::uint64_t kScopes = 1ULL << 0U | 1ULL << 1U;

// As the kernel knows it since version 6; older kernels get the first field only.
struct RulesetAttributes {
  std::uint64_t files;
  std::uint64_t network;
  std::uint64_t scopes;
};

constexpr std::uint64_t kRead =
    LANDLOCK_ACCESS_FS_EXECUTE | LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR;
constexpr std::uint64_t kWrite =
    LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_REMOVE_DIR | LANDLOCK_ACCESS_FS_REMOVE_FILE |
    LANDLOCK_ACCESS_FS_MAKE_CHAR | LANDLOCK_ACCESS_FS_MAKE_DIR | LANDLOCK_ACCESS_FS_MAKE_REG |
    LANDLOCK_ACCESS_FS_MAKE_SOCK | LANDLOCK_ACCESS_FS_MAKE_FIFO | LANDLOCK_ACCESS_FS_MAKE_BLOCK |
    LANDLOCK_ACCESS_FS_MAKE_SYM | LANDLOCK_ACCESS_FS_REFER;
// The service reads and appends to files in these folders: nothing there is a link, a device or a
// pipe.
constexpr std::uint64_t kWriteFiles =
    LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_REMOVE_DIR | LANDLOCK_ACCESS_FS_REMOVE_FILE |
    LANDLOCK_ACCESS_FS_MAKE_DIR | LANDLOCK_ACCESS_FS_MAKE_REG | LANDLOCK_ACCESS_FS_REFER |
    kTruncate;
// Rights that a rule for a file may hold.
constexpr std::uint64_t kOfFiles = LANDLOCK_ACCESS_FS_EXECUTE | LANDLOCK_ACCESS_FS_WRITE_FILE |
                                   LANDLOCK_ACCESS_FS_READ_FILE | kTruncate;

/// Closes its descriptor.
class Descriptor {
 public:
  explicit Descriptor(int value) : value_(value) {}
  ~Descriptor() {
    if (value_ >= 0) ::close(value_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return value_; }

 private:
  int value_;
};

class Ruleset {
 public:
  explicit Ruleset(int version)
      : handled_(kRead | kWrite | (version >= kFirstWithTruncate ? kTruncate : 0)),
        descriptor_(create(handled_, version)) {}

  bool is_good() const { return descriptor_.get() >= 0; }

  /// Paths that cannot be opened are left out: they may not be used either.
  void allow(const fs::path& path, std::uint64_t rights) {
    const Descriptor opened(::open(path.c_str(), O_PATH | O_CLOEXEC));
    if (opened.get() < 0) return;
    struct stat status {};
    if (::fstat(opened.get(), &status) != 0) return;
    rights &= handled_;
    if (!S_ISDIR(status.st_mode)) rights &= kOfFiles;
    landlock_path_beneath_attr rule{};
    rule.allowed_access = rights;
    rule.parent_fd = opened.get();
    ::syscall(SYS_landlock_add_rule, descriptor_.get(), LANDLOCK_RULE_PATH_BENEATH, &rule, 0);
  }

  bool restrict_this_process() const {
    return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
           ::syscall(SYS_landlock_restrict_self, descriptor_.get(), 0) == 0;
  }

 private:
  static int create(std::uint64_t handled, int version) {
    const bool has_scopes = version >= kFirstWithScopes;
    const RulesetAttributes attributes{handled, 0, has_scopes ? kScopes : 0};
    const std::size_t size = has_scopes ? sizeof(attributes) : sizeof(attributes.files);
    return static_cast<int>(::syscall(SYS_landlock_create_ruleset, &attributes, size, 0));
  }

  std::uint64_t handled_;
  Descriptor descriptor_;
};

/// Everything in a folder but what is hidden: whatever lies beside it and beside the folders around
/// it.
void allow_reading_around(Ruleset& rules, const fs::path& folder,
                          const std::vector<fs::path>& hidden) {
  const auto is_hidden = [&](const fs::path& path) {
    return std::find(hidden.begin(), hidden.end(), path) != hidden.end();
  };
  const auto holds_hidden = [&](const fs::path& path) {
    return std::any_of(hidden.begin(), hidden.end(),
                       [&](const fs::path& one) { return is_within(one, path); });
  };
  if (!holds_hidden(folder)) return rules.allow(folder, kRead);
  if (is_hidden(folder)) return;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    // Links lead to what has a rule of its own, or to what is hidden.
    if (!entry.is_symlink(error)) allow_reading_around(rules, entry.path(), hidden);
  }
}

std::vector<fs::path> credential_paths() {
  std::vector<fs::path> paths;
  const char* home = std::getenv("HOME");
  std::error_code error;
  const bool has_home = home != nullptr && *home != '\0';
  if (has_home && fs::exists(fs::path(home) / ".aws", error)) {
    paths.push_back(fs::path(home) / ".aws");
  }
  const char* files = std::getenv(kPrivateCredentialsVariable);
  std::istringstream list(files == nullptr ? "" : files);
  for (std::string file; std::getline(list, file, ':');) paths.emplace_back(file);
  return paths;
}

void allow_devices(Ruleset& rules) {
  constexpr std::uint64_t kUse =
      LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_READ_DIR;
  for (const char* name : {"null", "zero", "full", "tty", "dri", "kfd", "nvidia-caps"}) {
    rules.allow(fs::path("/dev") / name, kUse);
  }
  std::error_code error;
  for (const auto& entry : fs::directory_iterator("/dev", error)) {
    if (entry.path().filename().string().starts_with("nvidia")) rules.allow(entry.path(), kUse);
  }
}

}  // namespace

std::string fence_this_process(const FileFence& fence) {
  const auto version = static_cast<int>(
      ::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION));
  if (version < 0) return fmt::format("files: {}", std::strerror(errno));
  // Version 1 forbids every rename into another folder.
  if (version < kFirstWithRenames) return "files: Landlock of this kernel cannot rename";
  Ruleset rules(version);
  if (!rules.is_good()) return fmt::format("files: {}", std::strerror(errno));
  std::error_code error;
  std::vector<fs::path> hidden;
  for (const fs::path& folder : fence.hidden) {
    fs::path canonical = fs::weakly_canonical(folder, error);
    // "/data/" has an empty last part.
    if (!canonical.has_filename()) canonical = canonical.parent_path();
    if (!canonical.empty()) hidden.push_back(std::move(canonical));
  }
  allow_reading_around(rules, "/", hidden);
  for (const fs::path& path : fence.readable) rules.allow(path, kRead);
  for (const fs::path& path : fence.writable) rules.allow(path, kRead | kWriteFiles);
  allow_devices(rules);
  if (!rules.restrict_this_process()) return fmt::format("files: {}", std::strerror(errno));
  return "";
}

FileFence fence_of_folder(const fs::path& folder, Credentials credentials) {
  FileFence fence;
  fence.writable = {folder};
  if (credentials == Credentials::hidden) fence.hidden = credential_paths();
  const char* database = std::getenv(kPrivateDatabaseVariable);
  if (database != nullptr && *database != '\0') fence.hidden.emplace_back(database);
  const char* data = std::getenv(kPrivateFolderVariable);
  if (data == nullptr || *data == '\0') return fence;
  fence.hidden.emplace_back(data);
  fence.readable = {fs::path(data) / "scenarios", fs::path(data) / "uploads"};
  return fence;
}

fs::path shader_cache_folder() {
  const auto value_of = [](const char* name) {
    const char* value = std::getenv(name);
    return std::string_view(value == nullptr ? "" : value);
  };
  constexpr const char* kName = "mesa_shader_cache";
  if (const auto folder = value_of("MESA_SHADER_CACHE_DIR"); !folder.empty()) {
    return fs::path(folder) / kName;
  }
  if (const auto folder = value_of("XDG_CACHE_HOME"); !folder.empty()) {
    return fs::path(folder) / kName;
  }
  const auto home = value_of("HOME");
  return home.empty() ? fs::path() : fs::path(home) / ".cache" / kName;
}

}  // namespace throng::jobs
