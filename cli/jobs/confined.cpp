// throng confined: requests of the service, each in a process that is limited.
#include <CLI/CLI.hpp>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/jobs/processes.h"
#include "jobs/queue/confine/confined_task.h"
#include "jobs/study/service_work.h"

namespace throng::cli {

void add_confined(CLI::App& app, const jobs::ConfinedWork& others) {
  auto* command = app.add_subcommand("confined", "Work off requests of the service");
  command->group("");  // not for users
  const auto work = std::make_shared<std::string>();
  command->add_option("work", *work,
                      "Folder with the request, for the answer; without it, folders come on stdin");
  jobs::ConfinedWork all = others;
  all.emplace("study", &study::check_request);
  command->callback([work, all] {
    const auto perform = [&all](const std::filesystem::path& folder) {
      return jobs::run_confined_task(folder, [&all](const nlohmann::json& request) {
        return jobs::do_confined_work(request, all);
      });
    };
    std::exit(work->empty() ? jobs::run_fork_server(perform) : perform(*work));
  });
}

}  // namespace throng::cli
