// The tables of the durable queue, and how those of older versions become today's.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

namespace throng::jobs {

/// Makes the tables in a new file, or takes over a file of any earlier version, at once or not at
/// all. Throws EnvironmentError for a file of a newer version, and SQLite::Exception.
void prepare_tables(SQLite::Database& database);

}  // namespace throng::jobs
