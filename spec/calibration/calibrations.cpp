#include "spec/calibration/calibrations.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "base/error.h"

namespace throng::jobs {

using nlohmann::json;

void put_calibrations(json& job, const FindCamera& find) {
  if (!job.is_object() || !job.contains("drones") || !job["drones"].is_array()) return;
  for (std::size_t i = 0; i < job["drones"].size(); ++i) {
    const json::json_pointer at(fmt::format("/drones/{}/camera/calibration", i));
    if (!job["drones"][i].is_object() || !job.contains(at) || !job.at(at).is_string()) continue;
    const std::string name = job.at(at);
    try {
      job[at] = find(name);
    } catch (const EnvironmentError& error) {
      throw InputError(Problem{"", at.to_string(), fmt::format("\"{}\": {}", name, error.what()),
                               "a camera of throng calibrate"});
    }
  }
}

}  // namespace throng::jobs
