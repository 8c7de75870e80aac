#include "jobs/queue/confined_task.h"

#include <fmt/core.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <new>
#include <nlohmann/json.hpp>
#include <semaphore>
#include <thread>

#include "base/error.h"
#include "base/files.h"
#include "base/json_text.h"
#include "base/problem_json.h"
#include "jobs/queue/child_process.h"
#include "jobs/queue/worker_limits.h"

namespace throng::jobs {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr const char* kRequestName = "request.json";
constexpr const char* kAnswerName = "answer.json";
constexpr int kRefusedExit = 2;
constexpr int kFailedExit = 3;
constexpr auto kMaxTime = std::chrono::minutes(2);
constexpr auto kMaxWait = std::chrono::minutes(1);  // for others
constexpr int kMinAtOnce = 4;
constexpr int kMaxAtOnce = 64;

#if defined(THRONG_SANITIZE_ADDRESS) || defined(THRONG_SANITIZE_THREAD)
constexpr bool kMayLimitMemory = false;  // sanitizers reserve terabytes of addresses
#else
constexpr bool kMayLimitMemory = true;
#endif

using Places = std::counting_semaphore<kMaxAtOnce>;

/// One of the children that may run at once.
class Place {
 public:
  explicit Place(Places& places) : places_(places) {
    if (!places_.try_acquire_for(kMaxWait)) {
      throw EnvironmentError("too many checks are under way; try again later");
    }
  }
  ~Place() { places_.release(); }
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;

 private:
  Places& places_;
};

void limit(decltype(RLIMIT_AS) what, rlim_t max) {
  const rlimit value{max, max};
  ::setrlimit(what, &value);
}

void confine_this_process() {
  constexpr rlim_t kMaxMemory = 4ULL << 30U;
  constexpr rlim_t kMaxCpuSeconds = 110;
  constexpr rlim_t kMaxFileBytes = 64ULL << 20U;
  constexpr rlim_t kMaxFiles = 256;
  if (kMayLimitMemory) limit(RLIMIT_AS, kMaxMemory);
  limit(RLIMIT_CPU, kMaxCpuSeconds);
  limit(RLIMIT_FSIZE, kMaxFileBytes);
  limit(RLIMIT_NOFILE, kMaxFiles);
  static_cast<void>(limit_this_process());  // no network, no core dumps
}

/// The status of a child; SIGALRM when it took too long and was killed.
ExitStatus end_of(ChildProcess& child) {
  const auto end = std::chrono::steady_clock::now() + kMaxTime;
  while (!child.has_ended()) {
    if (std::chrono::steady_clock::now() > end) return {0, SIGALRM};  // it ends with its object
    // The child's output is closed when it ends, a moment before it can be collected.
    constexpr int kPollMs = 50;
    pollfd output{child.output(), POLLIN, 0};
    ::poll(&output, 1, kPollMs);
    child.read_lines();
    if ((output.revents & POLLHUP) != 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return child.wait();
}

json answer_of(const ExitStatus& status, const json& request, const fs::path& work) {
  const std::string subject = request.value("subject", "scenarios");
  if (status.signal == SIGALRM) {
    throw InputError(
        Problem{"", "", fmt::format("{} that take minutes to load", subject), "smaller ones"});
  }
  if (status.signal != 0) {
    throw InputError(Problem{
        "", "",
        fmt::format("{} at which the reader was ended by signal {}", subject, status.signal),
        "ones that load within 4 GiB of memory and two minutes"});
  }
  const auto answer = [&] { return parse_own_json(read_file(work / kAnswerName), kAnswerName); };
  if (status.code == 0) return answer();
  if (status.code == kRefusedExit) throw InputError(answer().get<std::vector<Problem>>());
  throw EnvironmentError("the check failed: the server's log says why");
}

/// `run` has a child do the work in a folder.
ConfinedTask task_by(std::function<ExitStatus(const fs::path& work)> run) {
  const int cores = static_cast<int>(std::thread::hardware_concurrency());
  const auto places = std::make_shared<Places>(std::clamp(cores, kMinAtOnce, kMaxAtOnce));
  return [run = std::move(run), places](const json& request, const fs::path& work) {
    const Place place(*places);
    // The request may hold any bytes that a client sent.
    write_file_atomically(work / kRequestName,
                          request.dump(-1, ' ', false, json::error_handler_t::replace));
    return answer_of(run(work), request, work);
  };
}

}  // namespace

ConfinedTask confined_task_in_child(std::vector<std::string> command) {
  return task_by([command = std::move(command)](const fs::path& work) {
    std::vector<std::string> words = command;
    words.push_back(work.string());
    ChildProcess child(words, {}, work / "log.txt");
    return end_of(child);
  });
}

ConfinedTask confined_task_by(std::shared_ptr<ForkServer> server) {
  return task_by([server = std::move(server)](const fs::path& work) { return server->run(work); });
}

int run_confined_task(const fs::path& work, const std::function<json(const json&)>& perform) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  confine_this_process();
  ::setenv("TMPDIR", work.c_str(), 1);  // removed with the work folder, however this process ends
  const auto write = [&](const json& value) {
    write_file_atomically(work / kAnswerName,
                          value.dump(-1, ' ', false, json::error_handler_t::replace));
  };
  try {
    write(perform(parse_own_json(read_file(work / kRequestName), kRequestName)));
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

}  // namespace throng::jobs
