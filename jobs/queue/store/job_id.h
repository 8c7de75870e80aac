// Ids of queued jobs: "j", 9 characters of time and 6 random characters in Crockford's base 32. Ids
// sort by time of submission.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace throng::jobs {

/// The id of a job submitted at `now_ms` (Unix time). It is greater than `previous` ("" for none)
/// even if the clock stands still or goes back. `random` makes it hard to guess.
std::string make_job_id(std::int64_t now_ms, std::string_view previous, std::uint32_t random);

/// Whether a text has the form of an id. Check it before the text becomes part of a path.
bool is_job_id(std::string_view text);

}  // namespace throng::jobs
