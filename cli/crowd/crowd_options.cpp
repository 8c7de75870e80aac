#include "cli/crowd/crowd_options.h"

#include "crowd/state/model.h"

namespace throng::cli {

namespace {

constexpr double kMinStepS = 1e-4;
constexpr double kMaxStepS = 10;
constexpr double kMaxRunS = 1e7;
constexpr int kMaxSubSteps = 1000;
constexpr int kMaxThreads = 1024;

void add_run_options(CLI::App& command, CrowdArguments& arguments) {
  command.add_option("project,-p,--project", arguments.project_file,
                     "Menge project file (docs/crowd.md)");
  command.add_option("-s,--scene", arguments.scene_file, "Scene file instead of the project's");
  command.add_option("-b,--behavior", arguments.behavior_file,
                     "Behavior file instead of the project's");
  command.add_option("-m,--model", arguments.model, "Pedestrian model instead of the project's")
      ->type_name(model_words());
  command
      .add_option("-d,--duration", arguments.duration_s,
                  "Max simulated time in s, instead of the project's")
      ->check(CLI::Range(0.0, kMaxRunS));
  command.add_option("-r,--random", arguments.seed, "Seed instead of the project's (0 becomes 1)");
  command
      .add_option("-t,--time-step", arguments.time_step_s,
                  "Time step in s instead of the project's or scene's")
      ->check(CLI::Range(kMinStepS, kMaxStepS));
  command
      .add_option("--sub-steps,--subSteps", arguments.sub_steps,
                  "Unrecorded sub-steps per time step")
      ->check(CLI::Range(0, kMaxSubSteps));
  command
      .add_option("--compat", arguments.compat,
                  "Whose results are wanted: the sensible ones (none), Menge's with its quirks "
                  "(menge), or also those of the paper's authors (huang2016)")
      ->check(CLI::IsMember(
          std::vector<std::string>(crowd::kCompatWords.begin(), crowd::kCompatWords.end())));
  command
      .add_option(
          "--separation", arguments.separation,
          "hard: no two bodies overlap by more than 1 cm, whatever the model does; auto (the "
          "default): hard with ttc, else soft")
      ->check(CLI::IsMember(std::vector<std::string>(crowd::kSeparationWords.begin(),
                                                     crowd::kSeparationWords.end())));
  command
      .add_option(
          "--constants", arguments.constants,
          "Constants of ttc: those of the best fit to recorded people (best), a draw from "
          "the posterior of that fit by the seed (posterior), or those with which exits pass "
          "no more than standards allow (conservative)")
      ->check(CLI::IsMember(
          std::vector<std::string>(crowd::kConstantsWords.begin(), crowd::kConstantsWords.end())));
  command.add_option("--threads", arguments.threads, "Threads (0: one per core)")
      ->check(CLI::Range(0, kMaxThreads))
      ->capture_default_str();
}

void add_output_options(CLI::App& command, CrowdArguments& arguments) {
  command.add_option("-o,--output", arguments.output,
                     "Trajectories to write: a trace if the name ends with .h5, else .scb");
  command
      .add_option("--scb-version,--scbVersion", arguments.scb_version, "Version of an .scb output")
      ->check(CLI::IsMember(
          std::vector<std::string>(crowd::kScbVersions.begin(), crowd::kScbVersions.end())));
  command.add_option("--series", arguments.series_file,
                     "CSV table to write: figures of the whole crowd, every second");
  auto* positions =
      command.add_option("--positions", arguments.positions_file,
                         "CSV table to write: positions of all agents at given times");
  command
      .add_option("--at", arguments.positions_at_s,
                  "Times of --positions in s (without: begin, 10, 25, 50, 75 % and end)")
      ->delimiter(',')
      ->check(CLI::NonNegativeNumber)
      ->needs(positions);
  command.add_flag("-q,--quiet", arguments.quiet, "Print errors only");
  auto* list =
      command.add_flag("-l,-L,--list", arguments.list,
                       "Print the vocabulary of project, scene and behavior files and exit");
  command.add_flag("--json", arguments.json, "Print the list as JSON")->needs(list);
  command
      .add_flag("--markdown", arguments.markdown,
                "Print the list as Markdown, as in docs/reference")
      ->needs(list);
}

/// Options of Menge's program that have no effect without its viewer.
void add_ignored_options(CLI::App& command, CrowdArguments& arguments) {
  command.add_option("--view", arguments.ignored_view, "As Menge's, for its viewer; ignored");
  command.add_option("-u,--dumpPath", arguments.ignored_dump_path,
                     "As Menge's, for its viewer; ignored");
  command.add_flag("--verbose", arguments.ignored_verbose, "As Menge's; ignored");
}

}  // namespace

std::string model_words() {
  std::string words;
  for (const crowd::ModelEntry& model : crowd::models()) {
    words += (words.empty() ? "" : ",") + std::string(model.name);
  }
  return "TEXT:{" + words + "}";
}

void add_crowd_options(CLI::App& command, CrowdArguments& arguments) {
  add_run_options(command, arguments);
  add_output_options(command, arguments);
  add_ignored_options(command, arguments);
}

crowd::Project load_project(const CrowdArguments& arguments) {
  crowd::Project project;
  if (!arguments.project_file.empty()) project = crowd::load_project(arguments.project_file);
  if (!arguments.scene_file.empty()) project.scene_file = arguments.scene_file;
  if (!arguments.behavior_file.empty()) project.behavior_file = arguments.behavior_file;
  if (!arguments.model.empty()) project.options.model = arguments.model;
  if (!arguments.compat.empty()) project.options.compat = crowd::parse_compat(arguments.compat);
  if (!arguments.separation.empty()) {
    project.options.separation = crowd::parse_separation(arguments.separation);
  }
  if (!arguments.constants.empty()) {
    project.options.constants = crowd::parse_constants(arguments.constants);
  }
  if (!arguments.output.empty()) project.output = arguments.output;
  if (!arguments.scb_version.empty()) project.scb_version = arguments.scb_version;
  if (arguments.duration_s) project.duration_s = *arguments.duration_s;
  if (arguments.time_step_s) project.options.time_step_s = arguments.time_step_s;
  if (arguments.sub_steps) project.options.sub_steps = *arguments.sub_steps;
  if (arguments.seed) {
    project.options.seed = crowd::seed_or_default(*arguments.seed);
    if (*arguments.seed == 0) {
      project.warnings.push_back({"", "--random", "0, which makes every run of Menge another one",
                                  "a seed above 0; here it is taken for 1"});
    }
  }
  return project;
}

}  // namespace throng::cli
