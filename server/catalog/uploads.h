// Scenarios that users have sent, kept as long as jobs need them.
#pragma once

#include <set>
#include <shared_mutex>
#include <string>
#include <string_view>
#include <vector>

#include "jobs/queue/store/store.h"
#include "server/catalog/confined_checks.h"
#include "server/catalog/scenario_store.h"
#include "server/catalog/service_folders.h"

namespace throng::server {

/// Safe to use from many threads.
class Uploads {
 public:
  /// Bundles that no job names are removed. All but the limits must outlive it.
  Uploads(const ServiceFolders& folders, jobs::Store& jobs, const ConfinedChecks& confined,
          UploadLimits limits);

  ScenarioStore& scenarios() { return scenarios_; }

  /// Removes an upload. False when there is none. Throws ConflictError while an active job uses it.
  bool remove(const std::string& name);
  /// Removes a job's own bundle, unless other jobs name it.
  void drop_bundle_of(const jobs::JobRow& removed);

  /// As long as it is held no upload goes: while a job that may name one is added.
  std::shared_lock<std::shared_mutex> hold() const { return std::shared_lock(mutex_); }

  /// A bundle that came with a request: it is there as long as this is; afterwards, if a job names
  /// it. Throws InputError and UploadsFull.
  class Pinned {
   public:
    Pinned(Uploads& uploads, std::string_view bundle, const std::string& owner);
    ~Pinned();
    Pinned(const Pinned&) = delete;
    Pinned& operator=(const Pinned&) = delete;

    /// A job names it from now on.
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
  /// Held together while a job that may name an upload is added, alone while uploads go.
  mutable std::shared_mutex mutex_;
  std::multiset<std::string> pinned_;  ///< bundles that requests work with; guarded by mutex_
};

/// The job with its "bundle/NAME" as the bundle's own name. Throws InputError when it names none.
std::string naming_bundle(std::string_view bundle, std::string_view job_json);

}  // namespace throng::server
