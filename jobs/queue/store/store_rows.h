// Conversion between rows of the job store's tables and values.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "jobs/queue/store/job_row.h"
#include "jobs/queue/store/service_clock.h"

namespace throng::jobs {

/// Columns of the table job that a query has to select for read_row().
inline constexpr const char* kColumns =
    "job.id, job.name, job.state, job.attempt, job.spec, job.progress, job.error, job.created_ms, "
    "job.started_ms, job.ended_ms, job.kind, job.priority, job.labels, job.owner, job.bytes, "
    "job.keep, job.kept_from_ms, job.people, job.sources, "
    "job.planned_bytes, job.models_mib";

/// The job in the query's current row.
JobRow read_row(SQLite::Statement& query);
/// All rows of a query, or those up to the one at which their texts have `max_text_bytes`.
std::vector<JobRow> read_rows(SQLite::Statement& query,
                              std::size_t max_text_bytes = std::numeric_limits<std::size_t>::max());
/// The first row of a query; std::nullopt if there is none.
std::optional<JobRow> read_first_row(SQLite::Statement& query);

/// The job of this id, as the current transaction sees it.
std::optional<JobRow> find_job(SQLite::Database& database, const std::string& id);
/// The job that this owner submitted with this idempotency key.
std::optional<JobRow> find_submission(SQLite::Database& database, const std::string& owner,
                                      const std::string& key);

/// The query of Store::list(). Its parameters are :kind, :limit and, if the filter sets them,
/// :after, :label, :name and :viewer.
std::string list_query(const JobFilter& filter);

/// Inserts a job. `job` supplies the key and hash of the submission, which a row lacks.
void insert_job(SQLite::Database& database, const JobRow& row, const NewJob& job);

/// Moves a job to the state `next` if it still has the state and attempt of `row`. Returns the new
/// row; std::nullopt otherwise.
std::optional<JobRow> move_to(SQLite::Database& database, JobState next, const JobRow& row,
                              JobEvent event, const std::string& error_json, const ClockMark& now);

/// Appends an event under the next number.
void write_event(SQLite::Database& database, const std::string& job, std::int64_t at_ms,
                 const std::string& type, const std::string& data_json);

/// The last saved times of the service clock; std::nullopt in a new store.
std::optional<ClockMark> clock_mark(SQLite::Database& database);
void save_mark(SQLite::Database& database, const ClockMark& mark);

/// Number of an owner's active jobs, and disk usage of all: of active ones as estimated or more.
struct OwnerUsage {
  std::int64_t active = 0;
  std::int64_t bytes = 0;
};
OwnerUsage owner_usage(SQLite::Database& database, const std::string& owner);

/// The limit that keeps an owner from having another active job that adds so many bytes, as a
/// sentence; "" if none does.
std::string over_quota(SQLite::Database& database, const std::string& owner,
                       const OwnerLimits& limits, std::int64_t added_bytes);

/// The stored NewJob::hash of a job.
std::string hash_of_submission(SQLite::Database& database, const std::string& id);

}  // namespace throng::jobs
