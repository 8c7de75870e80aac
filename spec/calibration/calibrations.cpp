#include "spec/calibration/calibrations.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/json/json_text.h"

namespace throng::jobs {

using nlohmann::json;

std::string with_calibrations(std::string_view job_json, const FindCamera& find) {
  json job = parse_json_or_discard(job_json, kJobJsonLimits);
  if (!job.is_object() || !job.contains("drones") || !job["drones"].is_array()) {
    return std::string(job_json);
  }
  bool any = false;
  for (std::size_t i = 0; i < job["drones"].size(); ++i) {
    const json::json_pointer at(fmt::format("/drones/{}/camera/calibration", i));
    if (!job["drones"][i].is_object() || !job.contains(at) || !job.at(at).is_string()) continue;
    const std::string name = job.at(at);
    try {
      job[at] = find(name);
      any = true;
    } catch (const EnvironmentError& error) {
      throw InputError(Problem{"", at.to_string(), fmt::format("\"{}\": {}", name, error.what()),
                               "a camera of throng calibrate"});
    }
  }
  return any ? job.dump() : std::string(job_json);
}

}  // namespace throng::jobs
