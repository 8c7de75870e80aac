#include "spec/job/spec.h"

#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/json/json_text.h"
#include "base/text/utf8.h"
#include "spec/job/job_fields.h"
#include "spec/job/plan.h"
#include "spec/job/resolved_job.h"
#include "spec/job/scenario_mix.h"
#include "spec/job/schema.h"
#include "spec/sun/sun_times.h"

namespace throng::jobs {

using nlohmann::json;

namespace {

constexpr std::size_t kMaxNameLength = 120;  // as in the schema

// Reads a value that the schema allows; absent fields keep the defaults of the structs.
JobSpec read_fields(const json& value, const std::string& source, std::vector<Problem>& problems) {
  JobSpec job;
  job_fields().read(value, job, {"", source, problems});
  if (job.name.empty()) job.name = first_characters(scenario_names(job), kMaxNameLength);
  formats::settle_shares(value_at(value, "outputs/splits/train") != nullptr, "/outputs/splits",
                         job.outputs.exports.splits, problems);
  return job;
}

void check_times(const CaptureSpec& capture, std::vector<Problem>& problems) {
  if (capture.to_s < capture.from_s) {
    problems.push_back({"", "/capture/to_s", fmt::format("{}", capture.to_s),
                        fmt::format("at least from_s, which is {}", capture.from_s)});
  }
  if (capture.run_to_s && *capture.run_to_s < capture.to_s) {
    problems.push_back({"", "/capture/run_to_s", fmt::format("{}", *capture.run_to_s),
                        fmt::format("at least to_s, which is {}", capture.to_s)});
  }
}

// A drone begins at its start or where it aims at somebody.
void check_starts(const JobSpec& job, std::vector<Problem>& problems) {
  for (std::size_t i = 0; i < job.drones.size(); ++i) {
    if (!job.drones[i].mission.start) continue;
    const std::string pointer = fmt::format("/drones/{}/aim", i);
    const auto refuse = [&](const std::string& where) {
      problems.push_back({"", where, "an aim beside a start", "one of them"});
    };
    if (job.drones[i].mission.aim) refuse(pointer);
    for (const RandomField& field : job.randomize) {
      if (field.pointer.starts_with(pointer + "/")) refuse("/randomize/" + field.path);
    }
  }
}

JobSpec job_from_json(json value, const std::string& source, std::vector<Problem>& problems) {
  std::vector<RandomField> randomize = take_randomize(value, problems);
  JobSpec job = read_fields(value, source, problems);
  job.randomize = std::move(randomize);
  return job;
}

}  // namespace

skinning::Styling styling_in(const JobSpec& job, render::Weather weather) {
  skinning::Styling styling = job.styling;
  if (weather != render::Weather::rain) styling.umbrellas = 0;
  styling.leading = job.crowd.leading;
  return styling;
}

std::int64_t JobSpec::frames_per_camera() const {
  // A frame that falls on to_s counts even if the division lands just below.
  constexpr double kSlack = 1e-9;
  return 1 + static_cast<std::int64_t>(
                 std::floor((capture.to_s - capture.from_s) * capture.rate_hz + kSlack));
}

double JobSpec::frame_time_s(std::int64_t frame) const {
  return capture.from_s + static_cast<double>(frame) / capture.rate_hz;
}

json parse_job_document(std::string_view text, const std::string& source) {
  return parse_json(text, source, kJobJsonLimits);
}

void check_job_schema(const json& document, const std::string& source) {
  std::vector<Problem> problems = schema_problems(document, source);
  if (!problems.empty()) throw InputError(std::move(problems));
}

JobSpec read_job(json document, const std::string& source, std::vector<Problem>& problems) {
  std::vector<Problem> of_schema;  // which resolves the words, too
  resolve_sun_times(document, of_schema);
  const std::size_t before = problems.size();
  JobSpec job = job_from_json(std::move(document), source, problems);
  check_times(job.capture, problems);
  check_starts(job, problems);
  for (std::size_t i = before; i < problems.size(); ++i) {
    if (problems[i].source.empty()) problems[i].source = source;
  }
  return job;
}

JobSpec parse_job(std::string_view text, const std::string& source) {
  return check_and_read_job(parse_job_document(text, source), source);
}

JobSpec check_and_read_job(json document, const std::string& source) {
  check_job_schema(document, source);
  std::vector<Problem> problems;
  JobSpec job = read_job(std::move(document), source, problems);
  if (!problems.empty()) throw InputError(std::move(problems));
  return job;
}

void to_json(json& value, const SceneLoad& load) {
  value = {{"people", load.people}, {"models_mib", load.models_mib}};
}

void from_json(const json& value, SceneLoad& load) {
  value.at("people").get_to(load.people);
  value.at("models_mib").get_to(load.models_mib);
}

ResolvedJob read_resolved_job(std::string_view text, const std::string& source) {
  return resolved_job_from_json(parse_job_document(text, source), source);
}

ResolvedJob resolved_job_from_json(json document, const std::string& source, SceneLoad load) {
  std::vector<Problem> problems;
  try {
    ResolvedJob job(job_from_json(std::move(document), source, problems), load);
    if (problems.empty()) return job;
  } catch (const json::exception& error) {
    throw EnvironmentError(fmt::format("{} is damaged: {}", source, error.what()));
  }
  throw InputError(std::move(problems));
}

json to_json(const JobSpec& job) { return job_fields().print(job); }

bool differs_between_runs(const JobSpec& job) { return !job.randomize.empty() || !job.mix.empty(); }

JobSpec job_of_run(const JobSpec& job, int run) {
  if (!differs_between_runs(job)) return job;
  const std::uint64_t seed = run_seed(job, run);
  JobSpec run_job = in_scenario_of_run(job, run);
  run_job.randomize.clear();
  for (const RandomField& field : job.randomize) {
    set_field(run_job, field.pointer, field.draw(seed));
  }
  return run_job;
}

namespace {

/// Adds a run's values of the fields with a distribution, except those that its models do not use.
void add_sampled(const json& asked, const json& had, const std::string& path, json& drawn) {
  for (const auto& [name, value] : asked.items()) {
    if (!value.is_object() || !had.contains(name)) continue;
    if (had[name].is_object()) {
      add_sampled(value, had[name], path + name + ".", drawn);
    } else {
      drawn[path + name] = had[name];
    }
  }
}

}  // namespace

json samples_of_run(const JobSpec& job, int run) {
  const std::uint64_t seed = run_seed(job, run);
  json drawn = json::object();
  if (!job.mix.empty()) drawn["scenario"] = in_scenario_of_run(job, run).scenario;
  for (const RandomField& field : job.randomize) drawn[field.path] = field.draw(seed);
  const json asked = to_json(job.environment);
  const json had = to_json(environment_of_run(job.environment, seed));
  add_sampled(asked, had, "environment.", drawn);
  for (std::size_t i = 0; i < job.drones.size(); ++i) {
    const std::string pointer = camera_pointer(i);
    const json camera = to_json(camera_of_run(job.drones[i].camera, seed, pointer));
    for (const auto& [name, distribution] : job.drones[i].camera.sampled) {
      drawn[dotted(pointer + "/" + name)] = camera.at(json::json_pointer("/" + name));
    }
  }
  return drawn;
}

}  // namespace throng::jobs
