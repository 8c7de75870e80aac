// Uploaded scenarios and their use by jobs: uploads that jobs need are not removed.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <set>
#include <shared_mutex>
#include <string>
#include <string_view>
#include <vector>

#include "jobs/queue/store/store.h"
#include "server/catalog/confined_checks.h"
#include "server/catalog/scenario_store.h"
#include "server/catalog/service_folders.h"
#include "server/http/key_limit.h"

namespace throng::server {

/// Uploads that a key may send at once; then it may send one each second.
inline constexpr int kUploadBurst = 60;

/// Safe to use from many threads.
class Uploads {
 public:
  /// Removes bundles that no job names. All arguments but the limits must outlive this object.
  Uploads(const ServiceFolders& folders, jobs::Store& jobs, const ConfinedChecks& confined,
          UploadLimits limits);

  ScenarioStore& scenarios() { return scenarios_; }
  const ScenarioStore& scenarios() const { return scenarios_; }

  /// Throws QuotaError if the owner has sent too many uploads in a short time: each is unpacked and
  /// checked.
  void require_rate(const std::string& owner);

  /// Removes an upload. Returns false if there is none. Throws ConflictError if an active job uses
  /// it.
  bool remove(const std::string& name);
  /// Removes the bundle that was sent with a removed job, unless other jobs name it.
  void drop_bundle_of(const jobs::JobRow& removed);

  /// Hashes of the scenarios that a resolved job, or a study's document, names
  /// (JobRow::sources_json). Throws InputError if one of them was uploaded after the given number
  /// of publications: it is not the one that was checked. Call with hold().
  std::string sources_json(const nlohmann::json& spec, jobs::JobKind kind,
                           std::uint64_t publications) const;
  /// Throws InputError if a scenario of the job was removed or has other content than when the job
  /// was resolved: a dataset would have parts of two places.
  void require_same_sources(const jobs::JobRow& row) const;

  /// A lock to hold while a job that may name an upload is added: no upload is removed meanwhile.
  std::shared_lock<std::shared_mutex> hold() const { return std::shared_lock(mutex_); }

  /// A bundle that was sent with a request. It exists during the lifetime of this object, and
  /// longer if keep() was called. The constructor throws InputError and UploadsFull.
  class Pinned {
   public:
    Pinned(Uploads& uploads, std::string_view bundle, const std::string& owner);
    ~Pinned();
    Pinned(const Pinned&) = delete;
    Pinned& operator=(const Pinned&) = delete;

    /// Keeps the bundle, because a job names it now.
    void keep() { is_kept_ = true; }

   private:
    Uploads& uploads_;
    std::string name_;
    bool is_kept_ = false;
  };

 private:
  std::vector<jobs::JobRow> jobs_that_name(const std::string& upload,
                                           const std::vector<jobs::JobState>& states) const;
  void drop_if_unused(const std::string& bundle);

  jobs::Store& jobs_;
  ScenarioStore scenarios_;
  KeyRate rate_{kUploadBurst, std::chrono::seconds(1)};
  /// Shared while a job that may name an upload is added, exclusive while uploads are removed.
  mutable std::shared_mutex mutex_;
  std::multiset<std::string> pinned_;  ///< bundles of current requests; guarded by mutex_
};

/// Replaces "bundle/" in the job's scenario by the bundle's name. Throws InputError if its scenario
/// does not begin with that.
void name_bundle(std::string_view bundle, nlohmann::json& job);

}  // namespace throng::server
