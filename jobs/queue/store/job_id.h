// Ids of queued jobs: "j", 9 characters of time, 6 random ones; later jobs sort after earlier ones.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace throng::jobs {

/// The id for a job made at `now_ms` (Unix time). Always greater than `previous` ("" for none),
/// also when clocks stand still or go back. `random` makes it hard to guess.
std::string make_job_id(std::int64_t now_ms, std::string_view previous, std::uint32_t random);

/// Whether a text has the form of an id; anything else names no job (and no folder).
bool is_job_id(std::string_view text);

}  // namespace throng::jobs
