#include "spec/job/job_fields.h"

#include <algorithm>
#include <array>

#include "base/error.h"
#include "base/text/control_characters.h"
#include "crowd/description/options.h"
#include "spec/job/airframe_camera.h"
#include "spec/job/randomize.h"
#include "spec/job/scenario_mix.h"
#include "spec/render/quality.h"

namespace throng::jobs {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

json scenario_json(const JobSpec& job) {
  if (!job.mix.empty()) return mix_json(job.mix);
  return job.generate ? json{{"generate", scenarios::to_json(*job.generate)}} : json(job.scenario);
}

void set_scenario(JobSpec& job, const json& value, const FieldLocation& place) {
  if (value.is_array()) return read_mix(job, value, place);
  if (value.is_string()) {
    value.get_to(job.scenario);
    return;
  }
  if (value.size() != 1 || !value.contains("generate")) {
    place.problems.push_back(
        {"", place.pointer, value.dump(), "an id, or an object with only \"generate\""});
    return;
  }
  job.generate = scenarios::read_generator_spec(value.value("generate", json()),
                                                place.pointer + "/generate", place.problems);
  job.scenario = scenarios::generated_scenario_id(*job.generate);
}

json drones_json(const JobSpec& job) {
  json drones = job.is_without_drones ? json::array() : json();
  for (const DroneSpec& drone : job.drones) drones.push_back(drone_fields().print(drone));
  return drones;
}

void set_drones(JobSpec& job, const json& value, const FieldLocation& place) {
  job.is_without_drones = value.is_array() && value.empty();
  for (const json& drone : value) {
    const std::string index = std::to_string(job.drones.size());
    const FieldLocation at = place.below(index);
    drone_fields().read(with_airframe_camera(drone, at), job.drones.emplace_back(), at);
  }
}

ordered_json drone_rules() {
  ordered_json rules = {
      {"title", "Drone"}, {"description", "One drone and its camera."}, {"type", "object"}};
  rules.update(drone_fields().schema());
  return rules;
}

std::vector<std::string> quality_words() {
  std::vector<std::string> words;
  words.reserve(std::size(render::kQualities));
  for (const render::QualitySettings& row : render::kQualities) words.emplace_back(row.word);
  return words;
}

void add_crowd_fields(FieldTable<JobSpec>& table) {
  table.group("crowd", "Crowd", "The people of a run and their movement.");
  table
      .add("crowd/agents", "Agents", "people", integers(1, kMaxJobAgents), at(&JobSpec::agents),
           "Number of the scenario's people that take part, sampled by the seed; default: all.")
      .randomized();
  table.add(
      "crowd/model", "Pedestrian model", "", identifiers(),
      at(&JobSpec::crowd, &sim::CrowdSpec::model),
      "The pedestrian model (collision avoidance): a name that throng crowd --list prints, for "
      "example orca or helbing. Default: the scenario's, else ttc, whose speeds and "
      "flows are those of real crowds (orca if compat asks for the results of Menge).");
  table.add_word(
      "crowd/compat", "Compatibility", crowd::kCompatWords,
      at(&JobSpec::crowd, &sim::CrowdSpec::compat),
      "Program whose results are reproduced where the scenario's files leave a choice: none, "
      "Menge with its quirks (menge), or also the elements that "
      "Huang's group added to it (huang2016).");
  table
      .add_word(
          "crowd/separation", "Separation", crowd::kSeparationWords,
          at(&JobSpec::crowd, &sim::CrowdSpec::separation),
          "soft: as the model gives it; hard: no two people ever overlap by more than 1 cm; auto: "
          "hard with ttc (without compat), else soft.")
      .randomized();
  table
      .add_word("crowd/constants", "Constants of the model", crowd::kConstantsWords,
                at(&JobSpec::crowd, &sim::CrowdSpec::constants),
                "best: those that fit recorded people best; posterior: each run draws them from "
                "the posterior of an earlier fit by its seed, so that results spread more "
                "(docs/crowd.md); conservative: exits pass no more than IMO 4 and NIST 5.2 "
                "allow, which is less than recorded people do. Models other than ttc have best.")
      .randomized();
  table.add("crowd/compliance", "Compliance", "", numbers(0, 1),
            at(&JobSpec::crowd, &sim::CrowdSpec::compliance),
            "Probability that a person near a guide follows it; multiplies that of the "
            "behavior file.");
  table.add("crowd/leading", "Leading", "", numbers(0, 1),
            at(&JobSpec::crowd, &sim::CrowdSpec::leading),
            "Share of people who lead something on wheels: a suitcase, a pram or a bicycle. They "
            "take up more room and are slower.");
  table.add(
      "crowd/physical", "Physical", "", booleans(),
      at(&JobSpec::crowd, &sim::CrowdSpec::physical, &crowd::Physical::on),
      "Physical contact: people whom a drone hits or a crowd presses are pushed, and fall above "
      "a limit of the force.");
  table.add("crowd/fall_impulse_ns", "Impulse of a fall", "N s", numbers(0.1, 1000),
            at(&JobSpec::crowd, &sim::CrowdSpec::physical, &crowd::Physical::fall_impulse_ns),
            "Impulse that knocks a person down; needs crowd.physical.");
  table.add(
      "crowd/recorded", "Recorded people", "", object_with(recorded_fields().schema()),
      [](const JobSpec& job) { return job.recorded ? to_json(*job.recorded) : json(); },
      [](JobSpec& job, const json& value, const FieldLocation& place) {
        job.recorded = read_recorded(value, place);
      },
      "People of a trajectory file, who are replayed instead of simulating the scenario's; see "
      "docs/recorded.md.");
}

void add_appearance_fields(FieldTable<JobSpec>& table) {
  table.group("appearance", "Appearance",
              "Which characters take part, and adjustments of their clothes' colors.");
  table
      .add("appearance/brightness", "Brightness", "", numbers(0.3, 2),
           at(&JobSpec::styling, &skinning::Styling::brightness),
           "Factor on the lightness of dyed clothes' colors.")
      .randomized();
  table
      .add("appearance/saturation", "Saturation", "", numbers(0, 2),
           at(&JobSpec::styling, &skinning::Styling::saturation),
           "Factor on the saturation of dyed clothes' colors: 0 makes them gray, 2 twice as "
           "colorful.")
      .randomized();
  table
      .add("appearance/variety", "Variety", "", numbers(0.01, 1),
           at(&JobSpec::styling, &skinning::Styling::variety),
           "Share of the characters (docs/people.md) that take part in a run, chosen by its seed.")
      .randomized();
  table
      .add("appearance/youngest_years", "Youngest", "years", numbers(0, 150),
           at(&JobSpec::styling, &skinning::Styling::youngest_years),
           "Minimum age of the characters that take part.")
      .randomized();
  table
      .add("appearance/oldest_years", "Oldest", "years", numbers(0, 150),
           at(&JobSpec::styling, &skinning::Styling::oldest_years),
           "Maximum age of the characters that take part.")
      .randomized();
  table
      .add("appearance/umbrellas", "Umbrellas", "", numbers(0, 1),
           at(&JobSpec::styling, &skinning::Styling::umbrellas),
           "Share of people under an umbrella when it rains; none in dry weather.")
      .randomized();
  table.group("props", "Props", "The props of the scenario.");
  table
      .add("props/density", "Density", "", numbers(0, 1), at(&JobSpec::props_density),
           "Share of the scenario's scattered props that are present in a run, chosen by its seed.")
      .randomized();
}

FieldTable<JobSpec> make_job_fields() {
  FieldTable<JobSpec> table;
  table.add("name", "Name", "", texts(1, 120), at(&JobSpec::name),
            "Name of the dataset; also of the archive and its folder.");
  table
      .add(
          "scenario", "Scenario", "",
          raw({{"type", {"string", "object", "array"}},
               {"minLength", 1},
               {"maxLength", 200},
               {kOneLine, true},
               {"minItems", 1},
               {"maxItems", 64},
               {"items", share_rules()}},
              R"(the id of a scenario, {"generate": ...}, or a list of scenarios)"),
          scenario_json, set_scenario,
          R"(Id of a scenario: its path below the scenarios folder, without suffix, for example city_square/nearest_exit. Or {"generate": {"kind": "plaza", "seed": 5}}, a scenario generated from a seed; docs/blueprint.md lists its parameters. Or a list of these, among which the runs are shared out: ["campus/everyday", {"id": "station/everyday", "weight": 2, "agents": 120}, {"generate": {"kind": "street"}}], where a generated scenario without a seed is another one in each run.)")
      .required();
  table.add("seed", "Seed", "", integers(0, 9007199254740991), at(&JobSpec::seed),
            "All randomness comes from it: equal jobs with equal seeds give equal bytes.");
  table.add("runs", "Runs", "runs", integers(1, kMaxJobRuns), at(&JobSpec::runs),
            "Number of simulations of the scenario, each with its own seed.");
  add_crowd_fields(table);
  table.add("drones", "Drones", "", lists(0, 16, drone_rules()), drones_json, set_drones,
            "The drones, one camera each; default: the scenario's drones, hovering "
            "at their starts. [] or a scenario without drones: figures without images.");
  table.group("capture", "Capture",
              "Times of the frames of every run and camera: from_s, then every 1 / "
              "rate_hz, up to to_s. The run lasts until run_to_s.");
  table.add("capture/rate_hz", "Rate", "Hz", numbers(0.01, 60),
            at(&JobSpec::capture, &CaptureSpec::rate_hz), "Frames per simulated second.");
  table.add("capture/from_s", "From", "s", numbers(0, 7200),
            at(&JobSpec::capture, &CaptureSpec::from_s),
            "Time of the first frame, from the run's start.");
  table.add("capture/to_s", "To", "s", numbers_above(0, 7200),
            at(&JobSpec::capture, &CaptureSpec::to_s), "Maximum time of a frame.");
  table.add("capture/run_to_s", "Run to", "s", numbers_above(0, 7200),
            at(&JobSpec::capture, &CaptureSpec::run_to_s),
            "End of the run, if it goes on after the last frame, so that figures tell of an "
            "evacuation to its end; default: to_s.");
  table
      .add_word("quality", "Quality", quality_words(), at(&JobSpec::quality),
                "Image quality: draft (quick: flat colors, no shadows, coarse people), "
                "standard, high (soft shadows, finer people, four color samples per pixel).")
      .randomized();
  table.group("environment", "Environment",
              "Light and weather. Any field may be a distribution, sampled again for every run.");
  table.add_all("environment", environment_fields(), at(&JobSpec::environment));
  add_appearance_fields(table);
  table.add(
      "randomize", "Randomize", "",
      raw({{"type", "object"},
           {"additionalProperties", true},
           {"properties", ordered_json::object()}}),
      [](const JobSpec& job) { return job.randomize.empty() ? json() : to_json(job.randomize); },
      [](JobSpec&, const json&, const FieldLocation&) {},
      R"(Fields that are sampled again for every run, by their dotted paths, each with a distribution: {"drones.0.camera.pitch_deg": {"uniform": [-80, -35]}}.)");
  add_output_fields(table);
  return table;
}

/// Refuses a field that the block "randomize" names, but the job and its scenario do not have.
[[noreturn]] void refuse_place(const std::string& pointer) {
  throw InputError({"", "/randomize/" + dotted(pointer), "a path that the job does not have",
                    "a field of a drone of the job, and a start only where it is given"});
}

/// Sets a field of an object, or an element of a field that is a list or a member of one that is an
/// object. `pointer` is that of the whole job, for messages.
template <typename Object>
void set_at(const FieldTable<Object>& table, Object& object, const std::string& path,
            const json& value, const std::string& pointer) {
  const std::string source;
  std::vector<Problem> problems;
  const FieldLocation place{pointer, source, problems};
  if (const Field<Object>* field = table.find(path)) {
    field->set(object, value, place);
  } else {
    const std::size_t end = path.rfind('/');
    const Field<Object>* list = table.find(path.substr(0, end));
    check(list != nullptr, "the block randomize names fields of the tables");
    json whole = list->get(object);
    const std::string last = path.substr(end + 1);
    if (list->values.rules.contains("properties")) {
      whole[last] = value;
    } else {
      const std::size_t index = std::stoul(last);
      if (index >= whole.size()) refuse_place(pointer);
      whole[index] = value;
    }
    list->set(object, whole, place);
  }
  check(problems.empty(), "a sampled value is a permitted value");
}

}  // namespace

const FieldTable<JobSpec>& job_fields() {
  static const FieldTable<JobSpec> table = make_job_fields();
  return table;
}

namespace {

ordered_json make_job_schema() {
  ordered_json schema = {
      {"$schema", "http://json-schema.org/draft-07/schema#"},
      {"$id", "urn:throng:job:1"},
      {"title", "Job"},
      {"description",
       "Request for a dataset: a scenario, number of runs, drones with cameras, and outputs. "
       "All fields except \"scenario\" have a default."},
      {"type", "object"}};
  schema.update(job_fields().schema());
  return schema;
}

}  // namespace

const ordered_json& ordered_job_schema() {
  static const ordered_json schema = make_job_schema();
  return schema;
}

void set_field(JobSpec& job, const std::string& pointer, const json& value) {
  constexpr std::string_view kDrones = "/drones/";
  if (!pointer.starts_with(kDrones)) {
    return set_at(job_fields(), job, pointer.substr(1), value, pointer);
  }
  const std::size_t end = pointer.find('/', kDrones.size());
  const std::size_t index = std::stoul(pointer.substr(kDrones.size(), end - kDrones.size()));
  if (index >= job.drones.size()) refuse_place(pointer);
  set_at(drone_fields(), job.drones[index], pointer.substr(end + 1), value, pointer);
}

}  // namespace throng::jobs
