// throng scenarios: what places there are, here and on a server.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <vector>

#include "base/error.h"
#include "base/text/url.h"
#include "cli/remote/api_client.h"
#include "cli/remote/bundle.h"
#include "cli/shell/commands.h"
#include "cli/shell/document_kind.h"
#include "cli/shell/input_file.h"
#include "places/scenarios/blueprint/load_scenario.h"
#include "world/scenario.h"
#include "world/scenario_id.h"

namespace throng::cli {

namespace {

void list() {
  const auto folder = world::scenarios_folder();
  std::vector<Problem> problems;  // one broken file hides no other
  for (const std::string& id : world::list_scenarios(folder)) {
    try {
      fmt::print("{:<32} {}\n", id, scenarios::find_scenario(folder, id).name);
    } catch (const InputError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  }
  for (const Problem& problem : world::list_unnamed_scenarios(folder)) {
    fmt::print(stderr, "throng: warning: {}\n", problem.text());
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

struct UploadArguments {
  std::string from;
  std::string name;
  bool dry_run = false;
};

Bundle read_blueprint(const std::string& file) {
  std::string text = read_input_file(file, "a blueprint");
  require_scenario(text, file);
  return {world::id_from_file(file), std::move(text)};
}

void upload(const UploadArguments& arguments) {
  const std::filesystem::path from = arguments.from;
  const bool is_blueprint = from.extension() == ".json";
  const Bundle bundle = is_blueprint ? read_blueprint(arguments.from) : read_bundle(arguments.from);
  const std::string name = arguments.name.empty() ? bundle.name : arguments.name;
  ApiClient api;
  const nlohmann::json answer =
      api.upload(fmt::format("/v1/scenarios?name={}{}", percent_encoded(name),
                             arguments.dry_run ? "&dry_run" : ""),
                 bundle.bytes, is_blueprint ? "application/json" : "application/octet-stream");
  for (const nlohmann::json& finding : answer["findings"]) {
    fmt::print(stderr, "{}: {}\n  remedy: {}\n", finding["severity"].get<std::string>(),
               finding["message"].get<std::string>(), finding["remedy"].get<std::string>());
  }
  for (const nlohmann::json& id : answer["ids"]) fmt::print("{}\n", id.get<std::string>());
}

void add_upload(CLI::App& scenarios) {
  auto* command = scenarios.add_subcommand(
      "upload", "Send scenarios to a server ($THRONG_URL, $THRONG_KEY); prints their ids");
  const auto arguments = std::make_shared<UploadArguments>();
  command
      ->add_option("bundle", arguments->from,
                   "A folder, a zip, tar or tar.gz file, or a blueprint (.json)")
      ->required();
  command->add_option("--name", arguments->name,
                      "The first part of their ids; default: the folder's or file's name");
  command->add_flag("--dry-run", arguments->dry_run, "Only check the scenarios");
  command->callback([arguments] { upload(*arguments); });
}

}  // namespace

void add_scenarios(CLI::App& app) {
  auto* command = app.add_subcommand(
      "scenarios", "List the scenarios that a job can name; upload others to a server");
  command->require_subcommand(0, 1);
  command->callback([command] {
    if (command->get_subcommands().empty()) list();
  });
  add_upload(*command);
  auto* remove = command->add_subcommand("remove", "Remove an upload from a server");
  const auto name = std::make_shared<std::string>();
  remove->add_option("name", *name, "The first part of its scenarios' ids")->required();
  remove->callback([name] { ApiClient().remove("/v1/scenarios/" + percent_encoded(*name)); });
}

}  // namespace throng::cli
