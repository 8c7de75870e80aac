// Rows of the job store's table as values, and back.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <optional>
#include <string>
#include <vector>

#include "jobs/queue/store/service_clock.h"
#include "jobs/queue/store/store.h"

namespace throng::jobs {

/// Columns of the table job that a query has to select for read_row().
inline constexpr const char* kColumns =
    "job.id, job.name, job.state, job.attempt, job.spec, job.progress, job.error, job.created_ms, "
    "job.started_ms, job.ended_ms, job.kind, job.priority, job.labels, job.owner, job.bytes, "
    "job.keep, job.kept_from_ms, job.people";

/// The job in the query's current row.
JobRow read_row(SQLite::Statement& query);
/// All rows of a query.
std::vector<JobRow> read_rows(SQLite::Statement& query);
/// The first row of a query, if there is any.
std::optional<JobRow> read_first_row(SQLite::Statement& query);

/// The job of this id, in the transaction's view.
std::optional<JobRow> find_job(SQLite::Database& database, const std::string& id);
/// The job that was submitted with this key.
std::optional<JobRow> find_submission(SQLite::Database& database, const std::string& owner,
                                      const std::string& key);

/// The query of Store::list(), whose parameters are :kind, :limit and, where the filter has them,
/// :after, :label, :name and :viewer.
std::string list_query(const JobFilter& filter);

/// `job` has what a row does not: the key of its submission.
void insert_job(SQLite::Database& database, const JobRow& row, const NewJob& job);

/// Moves a job to its next state if it is still as in `row`; returns the new row.
std::optional<JobRow> move_to(SQLite::Database& database, JobState next, const JobRow& row,
                              JobEvent event, const std::string& error_json, const ClockMark& now);

void write_event(SQLite::Database& database, const std::string& job, std::int64_t at_ms,
                 const std::string& type, const std::string& data_json);

/// The times that were last saved; nothing in a new store.
std::optional<ClockMark> clock_mark(SQLite::Database& database);
void save_mark(SQLite::Database& database, const ClockMark& mark);

/// Why an owner may have no further active job; "" when they may.
std::string over_quota(SQLite::Database& database, const std::string& owner,
                       const OwnerLimits& limits);

/// NewJob::hash of a stored job.
std::string hash_of_submission(SQLite::Database& database, const std::string& id);

}  // namespace throng::jobs
