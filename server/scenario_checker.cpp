#include "server/scenario_checker.h"

#include <fmt/core.h>
#include <sys/prctl.h>
#include <sys/resource.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/error.h"
#include "base/files.h"
#include "base/json_text.h"
#include "base/problem_json.h"
#include "jobs/pipeline/scenario_check.h"
#include "jobs/queue/child_process.h"
#include "jobs/queue/worker_limits.h"
#include "server/answers.h"

namespace throng::server {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr const char* kResultName = "check.json";
constexpr int kRefusedExit = 2;
constexpr int kFailedExit = 3;
constexpr auto kLongestCheck = std::chrono::minutes(2);
constexpr auto kCheckStep = std::chrono::milliseconds(5);

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kMayLimitMemory = false;  // sanitizers reserve terabytes of addresses
#else
constexpr bool kMayLimitMemory = true;
#endif

json json_of(const jobs::CheckedScenarios& checked) {
  json findings = json::array();
  for (const places::Finding& finding : checked.findings) {
    findings.push_back({{"is_error", finding.severity == places::Severity::error},
                        {"problem", finding.problem},
                        {"remedy", finding.remedy}});
  }
  return {{"ids", checked.ids}, {"findings", std::move(findings)}};
}

jobs::CheckedScenarios checked_from(const json& value) {
  jobs::CheckedScenarios checked{value.at("ids"), {}};
  for (const json& finding : value.at("findings")) {
    checked.findings.push_back(
        {finding.at("is_error") ? places::Severity::error : places::Severity::warning,
         finding.at("problem").get<Problem>(), finding.at("remedy")});
  }
  return checked;
}

void limit(decltype(RLIMIT_AS) what, rlim_t most) {
  const rlimit value{most, most};
  ::setrlimit(what, &value);
}

void confine_this_process() {
  constexpr rlim_t kMostMemory = 4ULL << 30U;
  constexpr rlim_t kMostSeconds = 110;
  constexpr rlim_t kMostFileBytes = 16ULL << 20U;
  constexpr rlim_t kMostFiles = 256;
  if (kMayLimitMemory) limit(RLIMIT_AS, kMostMemory);
  limit(RLIMIT_CPU, kMostSeconds);
  limit(RLIMIT_FSIZE, kMostFileBytes);
  limit(RLIMIT_NOFILE, kMostFiles);
  static_cast<void>(jobs::limit_this_process());  // no network, no core dumps
}

jobs::ExitStatus ended(jobs::ChildProcess& child) {
  const auto end = std::chrono::steady_clock::now() + kLongestCheck;
  while (!child.has_ended()) {
    if (std::chrono::steady_clock::now() > end) {
      throw InputError(Problem{"", "", "scenarios that take minutes to load", "smaller ones"});
    }
    child.read_lines();
    std::this_thread::sleep_for(kCheckStep);
  }
  return child.wait();
}

}  // namespace

ScenarioChecker scenario_checker_in_process() {
  return [](const fs::path& folder, const fs::path&) { return jobs::check_scenarios(folder); };
}

ScenarioChecker scenario_checker_in_child(std::vector<std::string> command) {
  return [command = std::move(command)](const fs::path& folder, const fs::path& work) {
    std::vector<std::string> words = command;
    words.push_back(folder.string());
    words.push_back(work.string());
    jobs::ChildProcess child(words, {}, work / "log.txt");
    const jobs::ExitStatus status = ended(child);
    if (status.signal != 0) {
      throw InputError(Problem{
          "", "",
          fmt::format("scenarios at which the reader was ended by signal {}", status.signal),
          "ones that load within 4 GiB of memory and two minutes"});
    }
    if (status.code == 0)
      return checked_from(parse_own_json(read_file(work / kResultName), kResultName));
    if (status.code == kRefusedExit) {
      throw InputError(
          parse_own_json(read_file(work / kResultName), kResultName).get<std::vector<Problem>>());
    }
    throw EnvironmentError("the scenarios could not be checked");
  };
}

int run_scenario_check_child(const fs::path& folder, const fs::path& work) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  confine_this_process();
  const auto write = [&](const json& value) {
    write_file_atomically(work / kResultName, text_of(value));
  };
  try {
    write(json_of(jobs::check_scenarios(folder)));
    return 0;
  } catch (const InputError& error) {
    write(error.problems());
    return kRefusedExit;
  } catch (const std::bad_alloc&) {
    write(std::vector<Problem>{
        {"", "", "scenarios that need more than 4 GiB of memory", "smaller ones"}});
    return kRefusedExit;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return kFailedExit;
  }
}

}  // namespace throng::server
