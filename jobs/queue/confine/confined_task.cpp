#include "jobs/queue/confine/confined_task.h"

#include <fmt/core.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>

#include "base/error.h"
#include "base/files/files.h"
#include "base/files/unpack.h"
#include "base/json/json_text.h"
#include "base/json/problem_json.h"
#include "jobs/queue/confine/child_process.h"
#include "jobs/queue/confine/file_fence.h"
#include "jobs/queue/confine/machine_memory.h"
#include "jobs/queue/confine/worker_limits.h"

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

/// Memory that a child may use: a quarter of the machine's, but 1 to 4 GiB.
std::int64_t max_memory_mib() {
  constexpr std::int64_t kMinMib = 1024;
  constexpr std::int64_t kMaxMib = 4096;
  const std::int64_t total_mib = total_memory_mib();
  return total_mib == 0 ? kMaxMib : std::clamp(total_mib / 4, kMinMib, kMaxMib);
}

/// Children that may run at once: so many that each finds its memory, though all take it at once.
/// Among the requests that wait, one of the sender with the fewest running children is next, then
/// the oldest. A sender has at most half of the children, whose checks may take minutes.
class Slots {
 public:
  explicit Slots(int max) : max_(max) {}

  void acquire(const std::string& sender) {
    std::unique_lock lock(mutex_);
    const auto end = std::chrono::steady_clock::now() + kMaxWait;
    const auto own = waiting_.insert(waiting_.end(), sender);
    while (!has_room() || next() != own || has_its_part(sender)) {
      if (std::chrono::steady_clock::now() > end) {
        waiting_.erase(own);
        throw EnvironmentError("too many checks are under way; try again later");
      }
      changed_.wait_for(lock, kMemoryInterval);
    }
    waiting_.erase(own);
    ++running_;
    ++running_of_[sender];
    changed_.notify_all();
  }

  void release(const std::string& sender) {
    {
      const std::lock_guard lock(mutex_);
      --running_;
      if (--running_of_[sender] == 0) running_of_.erase(sender);
    }
    changed_.notify_all();
  }

 private:
  // Memory becomes free without a notice.
  static constexpr auto kMemoryInterval = std::chrono::milliseconds(100);

  bool has_room() const {
    if (running_ == 0) return true;
    if (running_ >= max_) return false;
    return total_memory_mib() == 0 || available_memory_mib() >= (running_ + 1) * max_memory_mib();
  }

  int running_of(const std::string& sender) const {
    const auto found = running_of_.find(sender);
    return found == running_of_.end() ? 0 : found->second;
  }

  bool has_its_part(const std::string& sender) const {
    return !sender.empty() && running_of(sender) >= std::max(1, max_ / 2);
  }

  std::list<std::string>::const_iterator next() const {
    return std::min_element(
        waiting_.begin(), waiting_.end(),
        [&](const std::string& a, const std::string& b) { return running_of(a) < running_of(b); });
  }

  int max_;
  // Guarded by mutex_:
  int running_ = 0;
  std::map<std::string, int> running_of_;  ///< by sender
  std::list<std::string> waiting_;         ///< their senders, in the order in which they came
  std::mutex mutex_;
  std::condition_variable changed_;
};

/// One of the children that may run at once.
class Slot {
 public:
  Slot(Slots& slots, std::string sender) : slots_(slots), sender_(std::move(sender)) {
    slots_.acquire(sender_);
  }
  ~Slot() { slots_.release(sender_); }
  Slot(const Slot&) = delete;
  Slot& operator=(const Slot&) = delete;

 private:
  Slots& slots_;
  std::string sender_;
};

thread_local std::string sender_of_this_thread;

void limit(decltype(RLIMIT_AS) what, rlim_t max) {
  const rlimit value{max, max};
  ::setrlimit(what, &value);
}

void confine_this_process() {
  constexpr rlim_t kMib = 1 << 20;
  constexpr rlim_t kMaxCpuSeconds = 110;
  constexpr rlim_t kMaxFileBytes = UnpackLimits{}.max_file_bytes;
  constexpr rlim_t kMaxFiles = 256;
  if (kMayLimitMemory) limit(RLIMIT_AS, static_cast<rlim_t>(max_memory_mib()) * kMib);
  limit(RLIMIT_CPU, kMaxCpuSeconds);
  limit(RLIMIT_FSIZE, kMaxFileBytes);
  limit(RLIMIT_NOFILE, kMaxFiles);
  static_cast<void>(limit_this_process());  // no network, no core dumps
}

/// A request may name folders that are read besides the work folder; the service writes them.
void fence_this_task(const fs::path& work, const json& request) {
  FileFence fence = fence_of_folder(work);
  for (const char* name : {"folder", "files", "scenarios"}) {
    const auto found = request.find(name);
    if (found != request.end() && found->is_string()) {
      fence.readable.emplace_back(found->get<std::string>());
    }
  }
  static_cast<void>(fence_this_process(fence));
}

/// The status of a child; SIGALRM when it took too long and was killed.
ExitStatus wait_for_end(ChildProcess& child) {
  const auto end = std::chrono::steady_clock::now() + kMaxTime;
  while (!child.has_ended()) {
    if (std::chrono::steady_clock::now() > end) return {0, SIGALRM};  // it ends with its object
    // The child's output is closed when it ends, a moment before it can be collected.
    constexpr int kPollMs = 500;
    pollfd output{child.output(), POLLIN, 0};
    ::poll(&output, 1, kPollMs);
    child.read_lines();
    if ((output.revents & POLLHUP) != 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return child.wait();
}

json parse_answer(const ExitStatus& status, const json& request, const fs::path& work) {
  const std::string subject = request.value("subject", "scenarios");
  if (status.signal == SIGALRM) {
    throw InputError(
        Problem{"", "", fmt::format("{} that take minutes to load", subject), "smaller ones"});
  }
  if (status.signal != 0) {
    throw InputError(Problem{
        "", "",
        fmt::format("{} at which the reader was ended by signal {}", subject, status.signal),
        fmt::format("ones that load within {} MiB of memory and two minutes", max_memory_mib())});
  }
  constexpr std::uintmax_t kMaxAnswerBytes = 16 << 20;  // each takes many times of it in memory
  const auto answer = [&] {
    std::error_code error;
    const auto bytes = fs::file_size(work / kAnswerName, error);
    if (!error && bytes > kMaxAnswerBytes) {
      throw InputError(Problem{"", "", fmt::format("{} whose check has {} bytes", subject, bytes),
                               fmt::format("ones of at most {}", kMaxAnswerBytes)});
    }
    return parse_own_json(read_file(work / kAnswerName), kAnswerName);
  };
  if (status.code == 0) return answer();
  if (status.code == kRefusedExit) throw InputError(answer().get<std::vector<Problem>>());
  throw EnvironmentError("the check failed: the server's log says why");
}

/// `run` has a child do the work in a folder.
ConfinedTask task_by(std::function<ExitStatus(const fs::path& work)> run) {
  const int cores = static_cast<int>(std::thread::hardware_concurrency());
  const auto slots = std::make_shared<Slots>(std::clamp(cores, kMinAtOnce, kMaxAtOnce));
  return [run = std::move(run), slots](const json& request, const fs::path& work) {
    const Slot slot(*slots, sender_of_this_thread);
    // The request may hold any bytes that a client sent.
    write_temporary_file(work / kRequestName,
                         request.dump(-1, ' ', false, json::error_handler_t::replace));
    return parse_answer(run(work), request, work);
  };
}

}  // namespace

TaskSender::TaskSender(std::string sender)
    : before_(std::exchange(sender_of_this_thread, std::move(sender))) {}

TaskSender::~TaskSender() { sender_of_this_thread = std::move(before_); }

ConfinedTask confined_task_in_child(std::vector<std::string> command) {
  return task_by([command = std::move(command)](const fs::path& work) {
    std::vector<std::string> words = command;
    words.push_back(work.string());
    ChildProcess child(words, {}, work / "log.txt");
    return wait_for_end(child);
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
    write_temporary_file(work / kAnswerName,
                         value.dump(-1, ' ', false, json::error_handler_t::replace));
  };
  try {
    const json request = parse_own_json(read_file(work / kRequestName), kRequestName);
    fence_this_task(work, request);
    write(perform(request));
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
