// Tables of the durable queue and the migration of older versions.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

namespace throng::jobs {

/// Creates the tables in a new file, or migrates a file of any earlier version, in one transaction.
/// Throws EnvironmentError for a file of a newer version, and SQLite::Exception.
void prepare_tables(SQLite::Database& database);

}  // namespace throng::jobs
