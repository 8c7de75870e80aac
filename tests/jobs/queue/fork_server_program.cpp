// A fork server for tests: what its children do is named in their folder's request.json.
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "jobs/queue/confine/confined_task.h"
#include "jobs/queue/confine/fork_server.h"

namespace {

/// Notes the server's process, and then does nothing.
void wait_for_the_end(const std::filesystem::path& work) {
  std::ofstream(work / "begun", std::ios::app) << ::getppid() << std::endl;
  while (true) ::pause();
}

}  // namespace

int main() {
  using nlohmann::json;
  return throng::jobs::run_fork_server([](const std::filesystem::path& work) {
    return throng::jobs::run_confined_task(work, [&](const json& request) {
      if (request["do"] == "die") std::raise(SIGKILL);  // sanitizers handle others
      if (request["do"] == "fail") throw throng::EnvironmentError("no luck");
      if (request["do"] == "wait") wait_for_the_end(work);
      if (request["do"] == "refuse") {
        throw throng::InputError(throng::Problem{"a", "/b", "c", "d"});
      }
      return json{{"pid", ::getpid()}, {"server", ::getppid()}, {"n", request.at("n")}};
    });
  });
}
