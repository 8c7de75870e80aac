#include "server/backup/backup.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/files/files.h"
#include "base/files/hash.h"
#include "base/files/path_below.h"
#include "base/files/staging.h"
#include "base/files/untrusted_folders.h"
#include "base/version.h"
#include "server/backup/backup_files.h"
#include "server/catalog/api_json.h"
#include "server/catalog/unix_time.h"

namespace throng::server {

namespace fs = std::filesystem;

namespace {

constexpr int kBusyTimeoutMs = 60'000;

/// State of a job; another one when anything has been done with it.
struct JobMark {
  std::string kind;
  std::string state;
  int attempt = 0;
  bool operator==(const JobMark&) const = default;
};

std::map<std::string, JobMark> read_marks(SQLite::Database& database) {
  std::map<std::string, JobMark> marks;
  SQLite::Statement query(database, "SELECT id, kind, state, attempt FROM job");
  while (query.executeStep()) {
    marks[query.getColumn(0).getString()] = {query.getColumn(1).getString(),
                                             query.getColumn(2).getString(),
                                             query.getColumn(3).getInt()};
  }
  return marks;
}

/// Copies a database as it is at one moment, while others write it.
void copy_database(const fs::path& from, const fs::path& to) {
  SQLite::Database source(from, SQLite::OPEN_READWRITE, kBusyTimeoutMs);
  SQLite::Statement copy(source, "VACUUM INTO ?");
  copy.bind(1, to.string());
  copy.exec();
  SQLite::Database made(to, SQLite::OPEN_READWRITE);
  const std::string state = made.execAndGet("PRAGMA quick_check(1)").getString();
  if (state != "ok") {
    throw EnvironmentError(fmt::format("{} is damaged: {}", from.string(), state));
  }
}

fs::path job_folder(const std::string& id, const JobMark& mark) {
  return fs::path(mark.kind == "calibration" ? "calibrations"
                  : mark.kind == "study"     ? "studies"
                                             : "jobs") /
         id;
}

class Backup {
 public:
  Backup(const BackupOptions& options, const fs::path& to)
      : data_(options.data),
        database_(options.database.empty() ? options.data : options.database),
        to_(to / kBackupData) {}

  void copy_databases(bool with_datasets) {
    for (const char* name : kDatabases) {
      if (!fs::exists(database_ / name)) continue;
      try {
        copy_database(database_ / name, to_ / name);
      } catch (const SQLite::Exception& error) {
        throw EnvironmentError(
            fmt::format("cannot copy {}: {}", (database_ / name).string(), error.what()));
      }
    }
    SQLite::Database jobs(to_ / "jobs.sqlite", SQLite::OPEN_READWRITE);
    if (!with_datasets) {
      jobs.exec("DELETE FROM job WHERE kind = 'dataset' AND state NOT IN ('queued', 'running')");
    }
    marks_ = read_marks(jobs);
  }

  void copy_files(const OnBackupBytes& on_bytes, const std::stop_token& stop) {
    for (const auto& [id, mark] : marks_) list(job_folder(id, mark));
    list("uploads");
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(data_)) {
      const std::string name = entry.path().filename().string();
      if (name.starts_with("audit.log")) files_.emplace_back(name, entry.file_size(error));
    }
    std::int64_t total = 0;
    for (const auto& [file, bytes] : files_) total += bytes;
    copier_.emplace(2 * total, on_bytes, stop);  // read, and read again for its hash
    for (const auto& [file, bytes] : files_) copier_->copy(data_ / file, to_ / file);
  }

  /// Takes out of the backup what others have changed while its files were copied.
  void settle() {
    SQLite::Database live(database_ / "jobs.sqlite", SQLite::OPEN_READWRITE, kBusyTimeoutMs);
    const std::map<std::string, JobMark> now = read_marks(live);
    SQLite::Database jobs(to_ / "jobs.sqlite", SQLite::OPEN_READWRITE);
    for (const auto& [id, mark] : marks_) {
      const auto found = now.find(id);
      if (found != now.end() && found->second == mark) continue;
      const bool is_gone = found == now.end();
      const fs::path folder = to_ / job_folder(id, mark);
      // A dataset is made again from the tasks' results, which are checked then.
      fs::remove_all(is_gone ? folder : folder / "dataset");
      SQLite::Statement change(
          jobs, is_gone ? "DELETE FROM job WHERE id = ?"
                        : "UPDATE job SET state = 'queued', ended_ms = 0, kept_from_ms = 0, "
                          "error = '', progress = '' WHERE id = ?");
      change.bind(1, id);
      change.exec();
    }
    require_same_uploads();
  }

  /// Writes the list of all files and then the note, which makes the backup one.
  BackupSize seal() {
    BackupSize size;
    std::vector<std::string> lines;
    for (const auto& entry : fs::recursive_directory_iterator(to_)) {
      if (!entry.is_regular_file()) continue;
      const std::string path = entry.path().lexically_relative(to_.parent_path()).generic_string();
      require_path_below(path, data_.string(), "");
      lines.push_back(fmt::format("{}  {}\n", sha256_hex_of_file(entry.path()), path));
      ++size.files;
      size.bytes += static_cast<std::int64_t>(entry.file_size());
      copier_->count(static_cast<std::int64_t>(entry.file_size()));
    }
    std::sort(lines.begin(), lines.end());
    std::string sums;
    for (const std::string& line : lines) sums += line;
    write_temporary_file(to_.parent_path() / kBackupSums, sums);
    write_temporary_file(to_.parent_path() / kBackupNote,
                         dump_text({{"format", kBackupFormat},
                                    {"program", kGenerator},
                                    {"made_at", time_json(unix_ms_now())},
                                    {"files", size.files},
                                    {"bytes", size.bytes},
                                    {"sums_sha256", sha256_hex(sums)}}) +
                             "\n");
    return size;
  }

 private:
  /// Adds the files below a folder that may be gone; links and pipes are none of the service's.
  void list(const fs::path& folder) {
    std::error_code error;
    if (!exists_without_links(data_ / folder)) return;
    fs::recursive_directory_iterator entry(data_ / folder, error);
    for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
      const std::string name = entry->path().filename().string();
      std::error_code gone;
      const fs::file_status status = entry->symlink_status(gone);
      // Attempts on a cluster are those of the service that runs.
      if (is_staging_name(name) || (name == "attempts" && entry.depth() == 0)) {
        entry.disable_recursion_pending();
      } else if (fs::is_regular_file(status)) {
        files_.emplace_back(entry->path().lexically_relative(data_),
                            static_cast<std::int64_t>(entry->file_size(gone)));
      }
    }
    if (error && error != std::errc::no_such_file_or_directory) {
      throw EnvironmentError(
          fmt::format("cannot read {}: {}", (data_ / folder).string(), error.message()));
    }
  }

  void require_same_uploads() const {
    std::error_code error;
    std::vector<fs::path> gone;
    for (const auto& upload : fs::directory_iterator(to_ / "uploads", error)) {
      const fs::path note = fs::path("uploads") / upload.path().filename() / "upload.json";
      if (!fs::exists(data_ / note) || !fs::exists(to_ / note)) {
        gone.push_back(upload.path());
      } else if (read_file(data_ / note) != read_file(to_ / note)) {
        throw EnvironmentError(fmt::format("{} was replaced during the backup: try again",
                                           (data_ / note).parent_path().string()));
      }
    }
    for (const fs::path& upload : gone) fs::remove_all(upload);
  }

  fs::path data_;
  fs::path database_;
  fs::path to_;
  std::optional<FileCopier> copier_;
  std::map<std::string, JobMark> marks_;
  std::vector<std::pair<fs::path, std::int64_t>> files_;  ///< with their sizes
};

}  // namespace

BackupSize back_up(const BackupOptions& options, const OnBackupBytes& on_bytes,
                   const std::stop_token& stop) {
  const fs::path& database = options.database.empty() ? options.data : options.database;
  if (!is_there(options.data / ".") || !is_there(database / "jobs.sqlite")) {
    throw InputError(Problem{"throng backup", "", database.string(),
                             "the data folder of a service, with jobs.sqlite (or its --database)"});
  }
  require_apart(options.data, options.output, "--output");
  require_apart(database, options.output, "--output");
  if (is_there(options.output)) {
    throw InputError(Problem{"--output", "", options.output.string() + ", which is there already",
                             "a folder to be made"});
  }
  // A worker that was taken over could link a result to a secret.
  distrust_folders_in(options.data);
  StagingFolder staging(options.output);
  try {
    fs::permissions(staging.path(), fs::perms::owner_all);
    fs::create_directory(staging.path() / kBackupData);
    Backup backup(options, staging.path());
    backup.copy_databases(options.with_datasets);
    backup.copy_files(on_bytes, stop);
    backup.settle();
    const BackupSize size = backup.seal();
    staging.commit();
    return size;
  } catch (const SQLite::Exception& error) {
    throw EnvironmentError(fmt::format("cannot make a backup: {}", error.what()));
  } catch (const fs::filesystem_error& error) {
    throw EnvironmentError(fmt::format("cannot make a backup: {}", error.what()));
  }
}

}  // namespace throng::server
