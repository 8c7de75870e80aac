// A fork server for tests: what its children do is named in their folder's request.json.
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "jobs/queue/confined_task.h"
#include "jobs/queue/fork_server.h"

int main() {
  using nlohmann::json;
  return throng::jobs::run_fork_server([](const std::filesystem::path& work) {
    return throng::jobs::run_confined_task(work, [](const json& request) {
      if (request["do"] == "die") std::raise(SIGKILL);  // sanitizers handle others
      if (request["do"] == "fail") throw throng::EnvironmentError("no luck");
      if (request["do"] == "sleep") ::sleep(60);
      if (request["do"] == "refuse") {
        throw throng::InputError(throng::Problem{"a", "/b", "c", "d"});
      }
      return json{{"pid", ::getpid()}, {"server", ::getppid()}, {"n", request.at("n")}};
    });
  });
}
