// Rows of the job store.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "jobs/queue/store/state.h"
#include "spec/job/resolved_job.h"

namespace throng::jobs {

/// Kind of a queued job's result.
enum class JobKind { dataset, calibration, study };

inline constexpr std::array kJobKinds = {JobKind::dataset, JobKind::calibration, JobKind::study};

std::string_view to_string(JobKind kind);

/// One job as stored.
struct JobRow {
  std::string id;
  JobKind kind = JobKind::dataset;
  std::string name;
  JobState state = JobState::queued;
  int attempt = 0;              ///< how often a supervisor has started or resumed it
  std::string spec_json;        ///< the job with all defaults; a calibration's or study's request
  std::string progress_json;    ///< last saved progress; "" for none
  std::string error_json;       ///< why it failed; "" for none
  std::int64_t created_ms = 0;  ///< Unix time
  std::int64_t started_ms = 0;  ///< 0: not yet
  std::int64_t ended_ms = 0;    ///< 0: not yet
  int priority = 0;             ///< higher values start first
  std::vector<std::string> labels = {};
  std::string owner = {};         ///< id of the key that submitted it; "" without keys
  std::int64_t bytes = 0;         ///< size of its files on disk, as last measured
  bool keep = false;              ///< excluded from retention
  std::int64_t kept_from_ms = 0;  ///< when it ended, by Store::service_ms(); 0: not yet
  SceneLoad load = {};            ///< ResolvedJob::load()
  /// Hashes of the scenarios that it was resolved from, by the first parts of their ids; "{}" for
  /// none.
  std::string sources_json = "{}";
  std::int64_t planned_bytes = 0;  ///< estimated size of its files when it is done
  std::string waiting_for = {};    ///< not stored: why no task of it runs although it is its turn
  /// Not stored: the state in the file is not a known one. The job counts as failed and can only be
  /// removed.
  bool is_damaged = false;
};

/// Properties of a job that may be changed at any time.
struct JobChange {
  int priority = 0;
  std::vector<std::string> labels = {};
  bool keep = false;
};

/// Limits on all jobs of an owner together; another job is refused once one is reached.
struct OwnerLimits {
  int max_active = 0;  ///< number of queued and running jobs; 0: unlimited
  /// Total JobRow::bytes, of queued and running jobs at least JobRow::planned_bytes; 0: unlimited.
  std::int64_t max_bytes = 0;
};

/// A job to be queued.
struct NewJob {
  std::string name;
  std::string spec_json = "{}";
  JobKind kind = JobKind::dataset;
  int priority = 0;
  std::vector<std::string> labels = {};
  std::string owner = {};
  /// Idempotency key: another submission of the owner with the same key returns the first one's
  /// job; "" for none.
  std::string key = {};
  /// Hash of the request; it distinguishes a repeated submission from a key that is used twice.
  std::string hash = {};
  OwnerLimits limits = {};          ///< checked against the owner's jobs without this one
  SceneLoad load = {};              ///< ResolvedJob::load()
  std::string sources_json = "{}";  ///< JobRow::sources_json
  std::int64_t planned_bytes = 0;   ///< JobRow::planned_bytes
};

/// Jobs of an owner in a state.
struct OwnerCount {
  std::string owner;  ///< JobRow::owner
  JobState state = JobState::queued;
  std::int64_t jobs = 0;
};

/// Result of Store::retry().
struct Retried {
  std::optional<JobRow> row = {};  ///< none if the job's state has changed or allows no retry
  std::string over_quota = {};     ///< the limit that the owner has reached; "" for none
};

/// Result of Store::add().
struct Added {
  JobRow row;                   ///< empty if over_quota is set
  bool is_new = true;           ///< false: `row` is the job of an earlier submission with this key
  bool is_equal = true;         ///< false: the earlier submission had another NewJob::hash
  std::string over_quota = {};  ///< the limit that the owner has reached; "" for none
};

/// Jobs with this label are visible to all keys.
inline constexpr const char* kSharedLabel = "shared";

/// Criteria and page of Store::list().
struct JobFilter {
  JobKind kind = JobKind::dataset;
  std::vector<JobState> states = {};  ///< empty: any
  std::string label = {};             ///< "": any
  std::string name_part = {};         ///< substring of the name, case ignored; "": any
  bool oldest_first = false;          ///< false: newest first
  std::string after = {};             ///< last id of the previous page; "": first page
  int limit = 50;
  std::optional<std::string> visible_to = {};  ///< only jobs of this owner and shared ones
  bool with_spec = true;                       ///< false: JobRow::spec_json stays empty
  /// The page ends with the row at which the texts of its rows have as many bytes (text_bytes()).
  std::size_t max_text_bytes = std::numeric_limits<std::size_t>::max();
};

/// Size of the texts of a row.
std::size_t text_bytes(const JobRow& row);

}  // namespace throng::jobs
