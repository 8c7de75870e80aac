// Store of the scenarios uploaded by users. Together with the shipped ones they are visible in one
// folder of symbolic links, which the server and its workers read.
//
//   DATA/uploads/NAME/upload.json    owner, size and summaries
//   DATA/uploads/NAME/files/         the unpacked files
//   DATA/scenarios/NAME              link to the latter, or to a shipped scenario; recreated at the
//                                    start
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "base/files/files.h"
#include "base/files/unpack.h"
#include "server/catalog/confined_checks.h"

namespace throng::server {

/// Max size of all uploads together.
struct UploadLimits {
  std::size_t max_uploads = 500;
  std::size_t max_uploads_of_key = 100;  ///< of one owner; not without keys
  std::int64_t max_bytes = 8LL << 30U;   ///< unpacked
  UnpackLimits each = {};
};

/// An uploaded bundle of scenarios.
struct ScenarioUpload {
  std::string name;   ///< [a-z0-9_]+, the first part of its scenarios' ids
  std::string owner;  ///< id of the key that uploaded it
  std::int64_t created_ms = 0;
  std::int64_t bytes = 0;  ///< unpacked
  std::size_t files = 0;
  std::vector<std::string> ids;  ///< ids of its scenarios: "NAME/plaza"
  /// Summaries from the check (spec/scenarios/scenario_summary.h), in the order of the ids.
  std::vector<nlohmann::json> summaries;
  std::uint64_t publication = 0;  ///< ScenarioStore::publications() when it was published
};

/// The name belongs to another upload or scenario. Answered with 409.
class NameTaken : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The limits on uploads are reached. Answered with 507.
class UploadsFull : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Name of a bundle that was sent with a job, from its content: "b" and 16 hexadecimal digits.
bool is_bundle_name(std::string_view name);
std::string bundle_name(std::string_view bytes);
/// The first part of a scenario's id: the name of its upload if it is an uploaded one.
std::string upload_name(const std::string& scenario_id);

/// Safe to use from many threads.
class ScenarioStore {
 public:
  /// Finds the uploads in the data folder and creates the folder of links. `confined` must outlive
  /// this object. Throws EnvironmentError.
  ScenarioStore(const std::filesystem::path& data, const std::filesystem::path& shipped,
                const ConfinedChecks& confined, UploadLimits limits);

  /// The folder of links in a service with this data folder.
  static std::filesystem::path folder_in(const std::filesystem::path& data);
  const std::filesystem::path& folder() const { return links_; }

  /// A bundle that has been unpacked and checked, but not published.
  struct Staged {
    ScenarioUpload upload;
    std::vector<jobs::ScenarioFinding> findings;  ///< do not prevent its use
    std::unique_ptr<StagingFolder> folder;
  };

  /// Unpacks and checks a bundle. If all files are in a single folder, that folder is skipped.
  /// Throws InputError with all problems, and EnvironmentError.
  Staged stage(const std::string& name, std::string_view bytes, const std::string& owner) const;
  /// Checks a blueprint as the scenario NAME/place. Throws as stage().
  Staged stage_blueprint(const std::string& name, const nlohmann::json& blueprint,
                         const std::string& owner) const;
  /// Publishes a staged bundle; durable when this returns. Throws NameTaken, UploadsFull, and
  /// QuotaError if the owner has a fifth of the uploads or of their bytes.
  ScenarioUpload publish(Staged& staged);

  std::optional<ScenarioUpload> find(const std::string& name) const;
  std::vector<ScenarioUpload> list() const;
  /// Whether the name is an upload's or a shipped scenario's.
  bool is_taken(const std::string& name) const;
  /// Number of publications since the start.
  std::uint64_t publications() const;
  /// Whether an upload was published when there had been so many publications, or later.
  bool is_published_after(const std::string& name, std::uint64_t publications) const;
  /// Hash of all files of the scenarios whose ids begin with this name, uploaded or shipped; "" if
  /// there are none. Another content has another hash.
  std::string content_hash(const std::string& name) const;
  /// Removes an upload, which no job may be using. Returns false if there is none with this name.
  bool remove(const std::string& name);

 private:
  Staged begin_staging(const std::string& name, const std::string& owner) const;
  void finish_staging(Staged& staged) const;
  void find_uploads();
  void describe(ScenarioUpload& upload) const;
  void make_links(const std::filesystem::path& shipped) const;

  std::filesystem::path data_;
  std::filesystem::path uploads_;
  std::filesystem::path links_;
  const ConfinedChecks& confined_;
  UploadLimits limits_;
  mutable std::mutex mutex_;
  std::map<std::string, ScenarioUpload> known_;        ///< guarded by mutex_
  std::uint64_t publications_ = 0;                     ///< guarded by mutex_
  mutable std::mutex hashes_mutex_;                    ///< another one: files are read for long
  mutable std::map<std::string, std::string> hashes_;  ///< content_hash(); guarded by hashes_mutex_
};

}  // namespace throng::server
