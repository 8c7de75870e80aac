// Work on input from strangers, done in a child process whose memory, time, files and network are
// limited: what a reader stumbles over costs one request and not the service. Request and answer
// are JSON.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "jobs/queue/confine/fork_server.h"

namespace throng::jobs {

/// Carries out a request (jobs/pipeline/confined_work.h lists them) and returns the answer. `work`
/// is a folder for the files of both sides. Throws InputError with the problems that were found,
/// also when a limit ended the work, and EnvironmentError. Safe to use from many threads.
using ConfinedTask =
    std::function<nlohmann::json(const nlohmann::json& request, const std::filesystem::path& work)>;

/// In a child: `command` with the work folder appended. At most as many at once as there are cores,
/// at least four; others wait for a minute. A child is ended after two minutes.
ConfinedTask confined_task_in_child(std::vector<std::string> command);

/// The same in children of a fork server, whose work is run_confined_task().
ConfinedTask confined_task_by(std::shared_ptr<ForkServer> server);

/// The child's side: limits this process, reads work/request.json, and writes what `perform`
/// returns, or the problems that it throws, to work/answer.json. Returns the exit code.
int run_confined_task(const std::filesystem::path& work,
                      const std::function<nlohmann::json(const nlohmann::json&)>& perform);

}  // namespace throng::jobs
