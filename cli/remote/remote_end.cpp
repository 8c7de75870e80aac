#include "cli/remote/remote_end.h"

#include <fmt/core.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/error.h"
#include "cli/shell/interrupt.h"

namespace throng::cli {

using nlohmann::json;
using namespace std::chrono_literals;

namespace {

bool has_ended(const json& job) { return job["state"] != "queued" && job["state"] != "running"; }

}  // namespace

json followed(ApiClient& api, const std::string& path, const std::string& name,
              const Following& following) {
  constexpr auto kPatience = 60s;
  constexpr auto kPause = 1s;
  const Interrupt interrupt;
  ProgressBar bar(name);
  auto last_answer = std::chrono::steady_clock::now();
  while (true) {
    if (interrupt.token().stop_requested()) throw Cancelled();
    try {
      json value = api.get(path);
      last_answer = std::chrono::steady_clock::now();
      following.show(bar, value);
      if (has_ended(value)) return value;
      following.wait();
    } catch (const EnvironmentError&) {
      if (std::chrono::steady_clock::now() - last_answer > kPatience) throw;
      std::this_thread::sleep_for(kPause);
    }
  }
}

void require_success(const json& job) {
  if (job["state"] == "succeeded") return;
  if (job["state"] == "cancelled") throw Cancelled();
  const json& error = job["error"];
  const std::vector<Problem> problems = read_problems(error["problems"]);
  if (error["kind"] == "input" && !problems.empty()) throw InputError(problems);
  std::string message = error["message"].get<std::string>();
  if (job["state"] != "partial") {
    throw EnvironmentError(fmt::format("it failed: {}", message));
  }
  for (const json& run : error["runs"]) {
    message += fmt::format("\n{}", run["message"].get<std::string>());
  }
  throw EnvironmentError(
      fmt::format("{}\n`throng fetch {}` has the others, `throng retry {}` tries again", message,
                  job["id"].get<std::string>(), job["id"].get<std::string>()));
}

}  // namespace throng::cli
