#include "live/flight/outside/kept_flight.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>
#include <string>

#include "base/files/files.h"

namespace throng::live {

namespace fs = std::filesystem;
using nlohmann::json;

fs::path flight_folder(const fs::path& output, int number) {
  return output / fmt::format("flight{:03}", number);
}

int first_free_number(const fs::path& output) {
  int number = 0;
  while (fs::exists(flight_folder(output, number))) ++number;
  return number;
}

void write_flight(json result, const fs::path& folder) {
  json job = result.at("job");
  for (json& drone : result.at("drones")) {
    const auto id = drone.at("id").get<std::string>();
    write_file_atomically(folder / (id + ".csv"), drone.at("csv").get<std::string>());
    drone.erase("csv");
    for (json& own : job.at("drones")) {
      if (own.at("id") != id) continue;
      own.at("guidance").erase("setpoints");
      own["guidance"]["log"] = id + ".csv";
    }
  }
  result.erase("job");
  constexpr int kIndent = 1;
  write_file_atomically(folder / "job.json", job.dump(kIndent) + "\n");
  write_file_atomically(folder / "flight.json", result.dump(kIndent) + "\n");
}

fs::path recording_file(const fs::path& file, int flight) {
  if (flight == 0) return file;
  return file.parent_path() /
         fmt::format("{}-{}{}", file.stem().string(), flight + 1, file.extension().string());
}

}  // namespace throng::live
