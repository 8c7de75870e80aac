// Folders of flights that were flown from outside.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace throng::live {

/// The folder of a flight below `output`: flight000.
std::filesystem::path flight_folder(const std::filesystem::path& output, int number);

/// The first number whose folder does not exist.
int first_free_number(const std::filesystem::path& output);

/// Writes beside the trace: each drone's pilot log as DRONE.csv, job.json, which flies them again,
/// and flight.json, the rest of the result of Flight::finish().
void write_flight(nlohmann::json result, const std::filesystem::path& folder);

/// The file of the flight with this number (0 for the first): the given one, or for flights after a
/// reset name-2.mcap, name-3.mcap.
std::filesystem::path recording_file(const std::filesystem::path& file, int flight);

}  // namespace throng::live
