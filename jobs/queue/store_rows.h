// Rows of the job store's table as values, and back.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <optional>
#include <string>
#include <vector>

#include "jobs/queue/store.h"

namespace throng::jobs {

/// Columns that a query has to select for row_of().
inline constexpr const char* kColumns =
    "id, name, state, attempt, spec, progress, error, created_ms, started_ms, ended_ms, kind, "
    "priority, labels, owner, bytes, keep";

/// Of the query's current row.
JobRow row_of(SQLite::Statement& query);
/// All rows of a query.
std::vector<JobRow> rows_of(SQLite::Statement& query);
/// The first row of a query, if there is any.
std::optional<JobRow> first_of(SQLite::Statement& query);

/// `job` has what a row does not: the key of its submission.
void insert_job(SQLite::Database& database, const JobRow& row, const NewJob& job);

/// Why an owner may have no further active job; "" when they may.
std::string over_quota(SQLite::Database& database, const std::string& owner,
                       const OwnerLimits& limits);

/// NewJob::hash of a stored job.
std::string hash_of_submission(SQLite::Database& database, const std::string& id);

}  // namespace throng::jobs
