#include "cli/shell/job_summary.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/geometry/angle.h"
#include "base/text/words.h"
#include "spec/estimates/job_cost.h"
#include "spec/sun/sun.h"

namespace throng::cli {

using nlohmann::json;

namespace {

std::string duration_text(double seconds) {
  constexpr double kMinuteS = 60;
  constexpr double kHourS = 3600;
  if (seconds < 2 * kMinuteS) return fmt::format("{:.0f} s", std::max(seconds, 1.0));
  if (seconds < 2 * kHourS) return fmt::format("{:.0f} min", seconds / kMinuteS);
  return fmt::format("{:.1f} h", seconds / kHourS);
}

void print_view(const json& view) {
  constexpr double kPercent = 100;
  const double share = view["max_area_share"];
  const double pixels = view["max_person_px"];
  std::string line = fmt::format("  {:<10}shows up to {:.0f} % of the area",
                                 view["drone"].get<std::string>() + ":", kPercent * share);
  if (share < 1) line += ", which every image cuts";
  if (pixels > 0) line += fmt::format("; people up to {:.0f} px tall", pixels);
  fmt::print("{}\n", line);
}

/// The time, and where the sun stands if it does not differ between runs.
void print_light(const json& environment) {
  const json& time = environment["time_of_day"];
  const json& latitude = environment["latitude_deg"];
  const json& day = environment["day_of_year"];
  if (!time.is_string() || !latitude.is_number() || !day.is_number()) {
    fmt::print("  {:<10}at {}\n", "light", time.dump());
    return;
  }
  const std::string text = time;
  const double hours = std::stod(text) + std::stod(text.substr(3)) / 60;
  const double elevation_deg = jobs::sun_at(hours, latitude, day).elevation_rad / kDegree;
  fmt::print("  {:<10}{} solar time, the sun {:.1f} degrees {} the horizon\n", "light", text,
             std::abs(elevation_deg), elevation_deg < 0 ? "below" : "above");
}

/// A job whose scenario has errors runs, with figures that may say nothing.
std::string headline(const json& warnings) {
  const auto errors = std::count_if(warnings.begin(), warnings.end(), [](const json& warning) {
    return warning["found"].get<std::string>().starts_with("error in ");
  });
  if (errors > 0) {
    return fmt::format("valid, but its scenario has {}",
                       counted(static_cast<std::size_t>(errors), "error"));
  }
  return warnings.empty() ? "valid" : "valid, " + counted(warnings.size(), "warning");
}

/// People who take part and have not come by the end of a run are in none of its images; when they
/// come is sampled for each run.
std::string people_text(const json& answer) {
  const std::int64_t people = answer["people"];
  const std::int64_t asked = answer["job"].value(json::json_pointer("/crowd/agents"), people);
  if (people >= asked) return fmt::format("{}", people);
  return fmt::format("about {} of {}, as the others come after the end", people, asked);
}

}  // namespace

void print_job_summary(const json& answer, const std::string& file, int cores) {
  const json& estimate = answer["estimate"];
  const json& warnings = answer["warnings"];
  fmt::print("{}: {}\n", file, headline(warnings));
  fmt::print("  {:<10}{}, {}\n", "people", people_text(answer), counted(answer["runs"], "run"));
  print_light(answer["job"]["environment"]);
  const std::int64_t images = answer["frames"];
  fmt::print("  {:<10}{}\n", "images",
             images == 0 ? "none without drones: the job makes traces and figures"
                         : fmt::format("{} in {}", images, counted(answer["shards"], "shard")));
  fmt::print("  {:<10}about {} on {} of {} {}\n", "time",
             duration_text(estimate["cpu_s"].get<double>() / cores), counted(cores, "core"),
             estimate["basis"] == "this machine" ? "this" : "the reference", "machine");
  fmt::print("  {:<10}about {}\n", "disk", jobs::size_text(estimate["disk_bytes"].get<double>()));
  fmt::print("  {:<10}about {} MiB for each worker process\n", "memory",
             estimate["memory_mib"].get<std::int64_t>());
  for (const json& view : answer["views"]) print_view(view);
  for (const json& warning : warnings) {
    fmt::print("warning: {}\n",
               Problem{file, warning["pointer"], warning["found"], warning["expected"]}.text());
  }
}

}  // namespace throng::cli
