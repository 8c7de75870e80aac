// Work on untrusted input in a child process whose memory, time, files and network are limited:
// input that crashes a parser fails one request and not the service. Request and answer are JSON.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "jobs/queue/confine/fork_server.h"

namespace throng::jobs {

/// Performs a request (jobs/pipeline/confined_work.h lists the requests) and returns the answer.
/// `work` is a folder for the files of both sides. Throws InputError with the problems found, also
/// if the child exceeded a limit, and EnvironmentError. Safe to call from many threads.
using ConfinedTask =
    std::function<nlohmann::json(const nlohmann::json& request, const std::filesystem::path& work)>;

/// Names the sender, such as a key's id, of the requests that this thread makes during the lifetime
/// of the object. Requests of senders take turns; one sender has at most half of the children.
class TaskSender {
 public:
  explicit TaskSender(std::string sender);
  ~TaskSender();
  TaskSender(const TaskSender&) = delete;
  TaskSender& operator=(const TaskSender&) = delete;

 private:
  std::string before_;
};

/// A task that starts `command` with the work folder appended for each request. One child per core
/// runs at once, but 4 to 64, and fewer if memory is short; a request that waits for more than a
/// minute fails with EnvironmentError. A child is killed after two minutes.
ConfinedTask confined_task_in_child(std::vector<std::string> command);

/// A task with the same limits whose children are forked by `server`, which runs
/// run_confined_task().
ConfinedTask confined_task_by(std::shared_ptr<ForkServer> server);

/// The child's side: limits this process, reads work/request.json, calls `perform`, and writes its
/// result, or the problems of its InputError, to work/answer.json. Returns the exit code.
int run_confined_task(const std::filesystem::path& work,
                      const std::function<nlohmann::json(const nlohmann::json&)>& perform);

}  // namespace throng::jobs
