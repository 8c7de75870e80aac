// Scenarios that users have sent, beside those that come with throng: all are found in one folder
// of links, which the server and its workers read.
//
// DATA/uploads/NAME/upload.json    whose it is, and how large DATA/uploads/NAME/files/         as
// it was sent DATA/scenarios/NAME              a link to the latter, or to a shipped one; recreated
// at the start
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
  std::int64_t max_bytes = 8LL << 30U;  ///< unpacked
  UnpackLimits each = {};
};

/// A bundle of scenarios that was sent.
struct ScenarioUpload {
  std::string name;   ///< [a-z0-9_]+, the first part of its scenarios' ids
  std::string owner;  ///< the id of the key that sent it
  std::int64_t created_ms = 0;
  std::int64_t bytes = 0;  ///< unpacked
  std::size_t files = 0;
  std::vector<std::string> ids;  ///< of its scenarios, with its name: "NAME/plaza"
  /// Summaries from the check (spec/scenarios/scenario_summary.h), in the order of the ids.
  std::vector<nlohmann::json> summaries;
};

/// The name is another's already. Answered with 409.
class NameTaken : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// There is no space for it. Answered with 507.
class UploadsFull : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A bundle that came with one job is named by its content: "b" and 16 hexadecimal digits.
bool is_bundle_name(std::string_view name);
std::string bundle_name(std::string_view bytes);
/// The first part of a scenario's id: the name of the upload that it may belong to.
std::string upload_name(const std::string& scenario_id);

/// Safe to use from many threads.
class ScenarioStore {
 public:
  /// Finds the uploads in the data folder and makes the folder of links. The checks outlive the
  /// store. Throws EnvironmentError.
  ScenarioStore(const std::filesystem::path& data, const std::filesystem::path& shipped,
                const ConfinedChecks& confined, UploadLimits limits);

  /// Search path of all scenarios, in a service with this data folder.
  static std::filesystem::path folder_in(const std::filesystem::path& data);
  const std::filesystem::path& folder() const { return links_; }

  /// A bundle that has been unpacked and found good, and is not published.
  struct Staged {
    ScenarioUpload upload;
    std::vector<jobs::ScenarioFinding> findings;  ///< that stop nobody from using it
    std::unique_ptr<StagingFolder> folder;
  };

  /// Unpacks and checks a bundle. A single folder that everything in it lies in is taken for the
  /// bundle's own. Throws InputError naming everything wrong, EnvironmentError.
  Staged stage(const std::string& name, std::string_view bytes, const std::string& owner) const;
  /// Checks the scenario NAME/place of a blueprint. Throws likewise.
  Staged stage_blueprint(const std::string& name, const nlohmann::json& blueprint,
                         const std::string& owner) const;
  /// Publishes it; durable when it returns. Throws NameTaken and UploadsFull.
  ScenarioUpload publish(Staged& staged);

  std::optional<ScenarioUpload> find(const std::string& name) const;
  std::vector<ScenarioUpload> list() const;
  /// Whether the name is an upload's or a shipped scenario's.
  bool is_taken(const std::string& name) const;
  /// False when there is no such upload. Nobody may be using it.
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
  std::map<std::string, ScenarioUpload> known_;  ///< guarded by mutex_
};

}  // namespace throng::server
