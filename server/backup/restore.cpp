#include <SQLiteCpp/SQLiteCpp.h>
#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/files/files.h"
#include "base/files/hash.h"
#include "base/files/path_below.h"
#include "base/files/untrusted_folders.h"
#include "base/json/json_text.h"
#include "base/version.h"
#include "server/backup/backup.h"
#include "server/backup/backup_files.h"

namespace throng::server {

namespace fs = std::filesystem;

namespace {

struct SavedFile {
  std::string path;  ///< below data/
  std::string sha256_hex;
};

bool is_database(const std::string& path) {
  return std::find(kDatabases.begin(), kDatabases.end(), path) != kDatabases.end();
}

/// Whether a backup may have a file of this name: nothing else is the service's.
bool is_known(const std::string& path) {
  const bool is_audit_log = path.starts_with("audit.log") && path.find('/') == std::string::npos;
  const std::string folder = path.substr(0, path.find('/'));
  constexpr std::array kFolders = {"jobs", "calibrations", "studies", "uploads"};
  const bool is_in_folder = folder.size() < path.size() &&
                            std::find(kFolders.begin(), kFolders.end(), folder) != kFolders.end();
  return is_audit_log || is_in_folder || is_database(path);
}

/// The list of hashes, which the note is about. Throws InputError.
std::string read_sums(const fs::path& backup) {
  const std::string source = (backup / kBackupNote).string();
  if (!is_there(backup / kBackupNote)) {
    throw InputError(Problem{source, "", "no such file", "the folder of a complete backup"});
  }
  const nlohmann::json note = parse_json(read_file(backup / kBackupNote), source);
  const auto text = [&](const char* name) {
    return note.is_object() && note.contains(name) && note[name].is_string()
               ? note[name].get<std::string>()
               : std::string();
  };
  if (text("format") != kBackupFormat) {
    throw InputError(Problem{source, "/format",
                             fmt::format("\"{}\", by {}", text("format"), text("program")),
                             fmt::format("\"{}\", which {} knows", kBackupFormat, kGenerator)});
  }
  std::string sums = read_file(backup / kBackupSums);
  if (sha256_hex(sums) != text("sums_sha256")) {
    throw InputError(Problem{(backup / kBackupSums).string(), "", "another file than was written",
                             "SHA-256 " + text("sums_sha256")});
  }
  return sums;
}

std::vector<SavedFile> parse_sums(std::string_view sums, const std::string& source) {
  constexpr std::size_t kHashLength = 64;
  constexpr std::string_view kBlanks = "  ";
  const std::string folder = std::string(kBackupData) + "/";
  std::vector<SavedFile> files;
  std::set<std::string> paths;
  for (int number = 1; !sums.empty(); ++number) {
    const std::string_view line = sums.substr(0, sums.find('\n'));
    sums.remove_prefix(std::min(line.size() + 1, sums.size()));
    const std::string where = fmt::format("line {}", number);
    const std::string_view hash = line.substr(0, std::min(line.size(), kHashLength));
    const std::string_view rest = line.substr(hash.size());
    const bool is_line = hash.size() == kHashLength && rest.starts_with(kBlanks) &&
                         rest.substr(kBlanks.size()).starts_with(folder);
    if (!is_line) {
      throw InputError(Problem{source, where, std::string(line), "SHA-256  data/PATH"});
    }
    const std::string path(rest.substr(kBlanks.size() + folder.size()));
    require_path_below(path, source, where);
    if (!is_known(path) || !paths.insert(path).second) {
      throw InputError(
          Problem{source, where, path, "a file of a service's data folder, named once"});
    }
    files.push_back({path, std::string(hash)});
  }
  if (!paths.contains("jobs.sqlite")) {
    throw InputError(Problem{source, "", "no data/jobs.sqlite", "the databases of a service"});
  }
  return files;
}

/// Ids are names of folders: one that leads elsewhere would have the service remove others' files.
void require_ids(const fs::path& database) {
  try {
    SQLite::Database jobs(database, SQLite::OPEN_READONLY);
    SQLite::Statement query(jobs, "SELECT id FROM job WHERE id = '' OR id GLOB '*[^a-z0-9]*'");
    if (!query.executeStep()) return;
    throw InputError(Problem{database.string(), "",
                             "a job with the id " + query.getColumn(0).getString(),
                             "lower-case letters and digits"});
  } catch (const SQLite::Exception& error) {
    throw InputError(Problem{database.string(), "", error.what(), "the database of a service"});
  }
}

void require_hash(const fs::path& file, const SavedFile& saved) {
  std::string found = "no such file, or a link";
  if (exists_without_links(file)) {
    found = sha256_hex_of_file(file);
    if (found == saved.sha256_hex) return;
    found = "other bytes (SHA-256 " + found + ")";
  }
  throw InputError(Problem{file.string(), "", found, "SHA-256 " + saved.sha256_hex});
}

/// A folder to be filled; emptied again unless keep() is called.
class NewFolder {
 public:
  explicit NewFolder(const fs::path& path) : path_(path), is_made_(!is_there(path)) {
    const bool is_folder = is_made_ || fs::is_directory(path);
    if (!is_folder || (!is_made_ && !fs::is_empty(path))) {
      throw InputError(Problem{"throng restore", "",
                               path.string() + (is_folder ? ", which is not empty" : ", a file"),
                               "a new or an empty folder"});
    }
    make_folders(path);
    fs::permissions(path, fs::perms::owner_all);
  }
  ~NewFolder() {
    if (is_kept_) return;
    std::error_code ignored;
    std::vector<fs::path> entries;
    for (const auto& entry : fs::directory_iterator(path_, ignored)) entries.push_back(entry);
    for (const fs::path& entry : entries) fs::remove_all(entry, ignored);
    if (is_made_) fs::remove(path_, ignored);
  }
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;

  /// Makes what was written survive a power failure.
  void sync() const {
    const int folder = ::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0) return;
    ::syncfs(folder);
    ::close(folder);
  }
  void keep() { is_kept_ = true; }

 private:
  fs::path path_;
  bool is_made_;
  bool is_kept_ = false;
};

}  // namespace

BackupSize restore(const fs::path& backup, const fs::path& data, const fs::path& database,
                   const OnBackupBytes& on_bytes, const std::stop_token& stop) {
  require_apart(backup, data, "throng restore");
  if (!database.empty()) require_apart(data, database, "--database");
  distrust_folders_in(backup);
  std::vector<SavedFile> files = parse_sums(read_sums(backup), (backup / kBackupSums).string());
  // Databases last, and that of the jobs at the end: a service that starts sees all files of its
  // jobs and needs its keys.
  const auto first_database = std::stable_partition(
      files.begin(), files.end(), [](const SavedFile& file) { return !is_database(file.path); });
  std::stable_partition(first_database, files.end(),
                        [](const SavedFile& file) { return file.path != "jobs.sqlite"; });
  const fs::path from = backup / kBackupData;
  BackupSize size{static_cast<std::int64_t>(files.size()), 0};
  for (const SavedFile& file : files) {
    std::error_code missing;  // reported below
    const auto bytes = fs::file_size(from / file.path, missing);
    if (!missing) size.bytes += static_cast<std::int64_t>(bytes);
  }
  FileCopier copier(2 * size.bytes, on_bytes, stop);
  for (const SavedFile& file : files) {
    require_hash(from / file.path, file);
    copier.count(static_cast<std::int64_t>(fs::file_size(from / file.path)));
  }
  require_ids(from / "jobs.sqlite");
  try {
    NewFolder folder(data);
    std::optional<NewFolder> databases;
    if (!database.empty()) databases.emplace(database);
    for (const SavedFile& file : files) {
      const fs::path to = (is_database(file.path) && databases ? database : data) / file.path;
      copier.copy(from / file.path, to);
      require_hash(to, file);
    }
    folder.sync();
    if (databases) {
      databases->sync();
      databases->keep();
    }
    folder.keep();
    return size;
  } catch (const fs::filesystem_error& error) {
    throw EnvironmentError(fmt::format("cannot restore {}: {}", backup.string(), error.what()));
  }
}

}  // namespace throng::server
