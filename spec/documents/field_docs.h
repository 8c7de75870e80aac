// The files that follow from the tables of fields: the job schema as a file and docs/job.md's
// table.
#pragma once

#include <string>

namespace throng::jobs {

/// The lines of the table in docs/job.md, without its head: one for each field.
std::string job_fields_markdown();

/// The text of docs/job.md with the lines of its table replaced. Throws InputError when it has no
/// such table.
std::string with_job_fields(const std::string& document);

}  // namespace throng::jobs
