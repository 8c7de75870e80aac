#include "jobs/spec/spec.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/json_text.h"
#include "crowd/project.h"
#include "jobs/spec/export_spec.h"
#include "jobs/spec/guidance_spec.h"
#include "jobs/spec/plan.h"
#include "jobs/spec/resolved_job.h"
#include "jobs/spec/schema.h"
#include "world/json_reader.h"

namespace throng::embedded {
extern const std::string_view kJobSchema;
}

namespace throng::jobs {

using nlohmann::json;

namespace {

// An object's field, or an empty object: what is left out has its default.
const json& part(const json& object, const char* key) {
  static const json empty = json::object();
  const auto found = object.find(key);
  return found == object.end() ? empty : *found;
}

template <typename Value>
void read(const json& object, const char* key, Value& value) {
  if (const auto found = object.find(key); found != object.end()) found->get_to(value);
}

Eigen::Vector3d read_point(const json& value) {
  return {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
}

json point_json(const Eigen::Vector3d& point) { return {point.x(), point.y(), point.z()}; }

// What flies: one that is shipped or one of the user's own, and how full its battery is.
void read_frame_and_battery(const json& value, std::size_t index, sim::DroneMission& mission,
                            std::vector<Problem>& problems) {
  const json& airframe = part(value, "airframe");
  if (airframe.is_string()) {
    airframe.get_to(mission.airframe);
  } else if (value.contains("airframe")) {
    mission.airframe = mission.id;
    mission.own_airframe = sim::read_airframe(mission.id, airframe,
                                              fmt::format("/drones/{}/airframe", index), problems);
  }
  if (const json& battery = part(value, "battery"); battery.contains("charge")) {
    mission.battery_charge = battery["charge"].get<double>();
  }
}

DroneSpec read_drone(const json& value, std::size_t index, const std::string& source,
                     std::vector<Problem>& problems) {
  DroneSpec drone;
  read(value, "id", drone.mission.id);
  read_frame_and_battery(value, index, drone.mission, problems);
  if (value.contains("start")) drone.mission.start = read_point(value["start"]);
  if (const auto goal = value.find("moves_goal"); goal != value.end()) {
    drone.mission.moves_goal = world::GoalRef{(*goal)[0].get<int>(), (*goal)[1].get<int>()};
  }
  drone.pilot_log =
      read_guidance(part(value, "guidance"), source, fmt::format("/drones/{}/guidance", index),
                    drone.mission, problems);
  drone.camera = read_camera(part(value, "camera"), camera_pointer(index), problems);
  return drone;
}

void read_crowd(const json& value, JobSpec& job) {
  if (value.contains("agents")) job.agents = value["agents"].get<int>();
  read(value, "model", job.crowd.model);
  read(value, "compliance", job.crowd.compliance);
  read(value, "physical", job.crowd.physical.on);
  read(value, "fall_impulse_ns", job.crowd.physical.fall_impulse_ns);
  if (value.contains("compat")) {
    job.crowd.compat = crowd::compat_of(value["compat"].get<std::string>());
  }
  if (value.contains("separation")) {
    job.crowd.hard_separation = crowd::is_hard(value["separation"].get<std::string>());
  }
}

render::Quality quality_of(std::string_view word) {
  const auto found =
      std::find_if(render::kQualities.begin(), render::kQualities.end(),
                   [&](const render::QualitySettings& row) { return row.word == word; });
  check(found != render::kQualities.end(), "the schema and the table name the same qualities");
  return static_cast<render::Quality>(found - render::kQualities.begin());
}

void read_scenario(const json& value, JobSpec& job, std::vector<Problem>& problems) {
  if (value.is_string()) value.get_to(job.scenario);
  if (!value.is_object()) return;
  if (value.size() != 1 || !value.contains("generate")) {
    problems.push_back(
        {"", "/scenario", value.dump(), "an id, or an object with only \"generate\""});
  }
  job.generate =
      places::read_place_spec(value.value("generate", json()), "/scenario/generate", problems);
  job.scenario = "generated/" + places::id_of(*job.generate);
}

// What the schema allows, as a job; absent fields keep the defaults of the structs.
JobSpec read_job(const json& value, const std::string& source, std::vector<Problem>& problems) {
  JobSpec job;
  read_scenario(value.value("scenario", json()), job, problems);
  job.name = job.scenario;
  read(value, "name", job.name);
  read(value, "seed", job.seed);
  read(value, "runs", job.runs);
  read_crowd(part(value, "crowd"), job);
  job.recorded = read_recorded(part(value, "crowd"), source, problems);
  for (const json& drone : part(value, "drones")) {
    job.drones.push_back(read_drone(drone, job.drones.size(), source, problems));
  }
  const json& capture = part(value, "capture");
  read(capture, "rate_hz", job.capture.rate_hz);
  read(capture, "from_s", job.capture.from_s);
  read(capture, "to_s", job.capture.to_s);
  job.environment = read_environment(part(value, "environment"), problems);
  if (value.contains("quality")) job.quality = quality_of(value["quality"].get<std::string>());
  const json& appearance = part(value, "appearance");
  read(appearance, "brightness", job.styling.brightness);
  read(appearance, "saturation", job.styling.saturation);
  read(appearance, "variety", job.styling.variety);
  read(appearance, "youngest_years", job.styling.youngest_years);
  read(appearance, "oldest_years", job.styling.oldest_years);
  read(appearance, "umbrellas", job.styling.umbrellas);
  read(part(value, "props"), "density", job.props_density);
  const json& outputs = part(value, "outputs");
  read(part(outputs, "image"), "format", job.outputs.image_format);
  read(part(outputs, "image"), "quality", job.outputs.image_quality);
  read(outputs, "annotations", job.outputs.annotations);
  read(part(outputs, "density"), "sigma_px", job.outputs.density_sigma_px);
  read(outputs, "previews", job.outputs.previews);
  read_exports(outputs, job.runs, job.outputs, problems);
  return job;
}

void check_times(const CaptureSpec& capture, std::vector<Problem>& problems) {
  if (capture.to_s >= capture.from_s) return;
  problems.push_back({"", "/capture/to_s", fmt::format("{}", capture.to_s),
                      fmt::format("a time not before from_s, which is {}", capture.from_s)});
}

json parse_with_schema(std::string_view text, const std::string& source) {
  json value = parse_json(text, source, kJobJsonLimits);
  std::vector<Problem> problems = schema_problems(value, source);
  if (!problems.empty()) throw InputError(std::move(problems));
  return value;
}

JobSpec job_from_json(json value, const std::string& source, std::vector<Problem>& problems) {
  std::vector<RandomField> randomize = take_randomize(value, problems);
  JobSpec job = read_job(value, source, problems);
  job.randomize = std::move(randomize);
  return job;
}

json drone_json(const DroneSpec& drone) {
  const sim::DroneMission& mission = drone.mission;
  json value = {{"id", mission.id},
                {"airframe", mission.own_airframe ? sim::to_json(*mission.own_airframe)
                                                  : json(mission.airframe)},
                {"guidance", guidance_json(mission)},
                {"camera", to_json(drone.camera)}};
  if (!drone.pilot_log.empty()) value["guidance"]["log"] = drone.pilot_log.filename().string();
  if (mission.battery_charge) value["battery"]["charge"] = *mission.battery_charge;
  if (mission.start) value["start"] = point_json(*mission.start);
  if (mission.moves_goal) {
    value["moves_goal"] = {mission.moves_goal->set, mission.moves_goal->goal};
  }
  return value;
}

}  // namespace

skinning::Styling styling_in(const JobSpec& job, render::Weather weather) {
  skinning::Styling styling = job.styling;
  if (weather != render::Weather::rain) styling.umbrellas = 0;
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

JobSpec parse_job(std::string_view text, const std::string& source,
                  std::vector<Problem>& problems) {
  json value = parse_with_schema(text, source);
  const std::size_t before = problems.size();
  JobSpec job = job_from_json(std::move(value), source, problems);
  check_times(job.capture, problems);
  for (std::size_t i = before; i < problems.size(); ++i) {
    if (problems[i].source.empty()) problems[i].source = source;
  }
  return job;
}

JobSpec parse_job(std::string_view text, const std::string& source) {
  std::vector<Problem> problems;
  JobSpec job = parse_job(text, source, problems);
  if (!problems.empty()) throw InputError(std::move(problems));
  return job;
}

void check_job_schema(std::string_view text, const std::string& source) {
  static_cast<void>(parse_with_schema(text, source));
}

ResolvedJob read_resolved_job(std::string_view text, const std::string& source) {
  std::vector<Problem> problems;
  try {
    ResolvedJob job(job_from_json(parse_json(text, source, kJobJsonLimits), source, problems));
    if (problems.empty()) return job;
  } catch (const json::exception& error) {
    throw EnvironmentError(fmt::format("{} is damaged: {}", source, error.what()));
  }
  throw InputError(std::move(problems));
}

json to_json(const JobSpec& job) {
  json drones = json::array();
  for (const DroneSpec& drone : job.drones) drones.push_back(drone_json(drone));
  json value = {
      {"name", job.name},
      {"scenario",
       job.generate ? json{{"generate", places::to_json(*job.generate)}} : json(job.scenario)},
      {"seed", job.seed},
      {"runs", job.runs},
      {"crowd",
       {{"compat", crowd::kCompatWords[static_cast<std::size_t>(job.crowd.compat)]},
        {"separation", crowd::kSeparationWords[job.crowd.hard_separation ? 1 : 0]},
        {"compliance", job.crowd.compliance},
        {"physical", job.crowd.physical.on},
        {"fall_impulse_ns", job.crowd.physical.fall_impulse_ns}}},
      {"capture",
       {{"rate_hz", job.capture.rate_hz},
        {"from_s", job.capture.from_s},
        {"to_s", job.capture.to_s}}},
      {"environment", to_json(job.environment)},
      {"quality", render::settings_of(job.quality).word},
      {"appearance",
       {{"brightness", job.styling.brightness},
        {"saturation", job.styling.saturation},
        {"variety", job.styling.variety},
        {"youngest_years", job.styling.youngest_years},
        {"oldest_years", job.styling.oldest_years},
        {"umbrellas", job.styling.umbrellas}}},
      {"props", {{"density", job.props_density}}},
      {"outputs",
       {{"image", {{"format", job.outputs.image_format}, {"quality", job.outputs.image_quality}}},
        {"annotations", job.outputs.annotations},
        {"density", {{"sigma_px", job.outputs.density_sigma_px}}},
        {"previews", job.outputs.previews}}}};
  value["outputs"].update(exports_json(job.outputs));
  if (!job.crowd.model.empty()) value["crowd"]["model"] = job.crowd.model;
  if (!drones.empty()) value["drones"] = std::move(drones);
  if (job.agents) value["crowd"]["agents"] = *job.agents;
  if (job.recorded) value["crowd"]["recorded"] = to_json(*job.recorded);
  if (!job.randomize.empty()) value["randomize"] = to_json(job.randomize);
  return value;
}

JobSpec job_of_run(const JobSpec& job, int run) {
  if (job.randomize.empty()) return job;
  const std::uint64_t seed = plan_runs(job).at(static_cast<std::size_t>(run)).seed;
  json value = to_json(job);
  value["crowd"].erase("recorded");  // its file is known from where the job lies
  for (const RandomField& field : job.randomize) {
    value[json::json_pointer(field.pointer)] = field.draw(seed);
  }
  std::vector<Problem> problems;
  JobSpec run_job = read_job(value, "", problems);
  run_job.recorded = job.recorded;
  check(problems.empty(), "what is drawn for a job is what the job may say");
  return run_job;
}

namespace {

/// Adds what a run had where a distribution was asked for. What its models do not use was not had.
void add_drawn(const json& asked, const json& had, const std::string& path, json& drawn) {
  for (const auto& [name, value] : asked.items()) {
    if (!value.is_object() || !had.contains(name)) continue;
    if (had[name].is_object()) {
      add_drawn(value, had[name], path + name + ".", drawn);
    } else {
      drawn[path + name] = had[name];
    }
  }
}

}  // namespace

json drawn_of_run(const JobSpec& job, int run) {
  const std::uint64_t seed = plan_runs(job).at(static_cast<std::size_t>(run)).seed;
  json drawn = json::object();
  for (const RandomField& field : job.randomize) drawn[field.path] = field.draw(seed);
  const json asked = to_json(job.environment);
  const json had = to_json(environment_of_run(job.environment, seed));
  add_drawn(asked, had, "environment.", drawn);
  for (std::size_t i = 0; i < job.drones.size(); ++i) {
    const std::string pointer = camera_pointer(i);
    const json camera = to_json(camera_of_run(job.drones[i].camera, seed, pointer));
    for (const auto& [name, distribution] : job.drones[i].camera.drawn) {
      drawn[dotted(pointer + "/" + name)] = camera.at(json::json_pointer("/" + name));
    }
  }
  return drawn;
}

std::string_view job_schema() { return embedded::kJobSchema; }

}  // namespace throng::jobs
