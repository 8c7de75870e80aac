#include "jobs/queue/confine/fork_server.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <future>
#include <optional>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/resource_exhaustion.h"
#include "jobs/queue/confine/worker_limits.h"

namespace throng::jobs {

namespace fs = std::filesystem;

namespace {

// A message is a folder's path; an answer is "CODE SIGNAL PATH".
constexpr std::size_t kMaxMessage = 8192;
constexpr unsigned kMaxSeconds = 120;
constexpr int kIdleMs = 300'000;

/// The next message; nothing when the other side is gone.
std::optional<std::string> receive(int socket) {
  std::array<char, kMaxMessage> block{};
  ssize_t count = 0;
  do {
    count = ::recv(socket, block.data(), block.size(), 0);
  } while (count < 0 && errno == EINTR);
  if (count <= 0) return std::nullopt;
  return std::string(block.data(), static_cast<std::size_t>(count));
}

bool send_message(int socket, const std::string& text) {
  ssize_t count = 0;
  do {
    count = ::send(socket, text.data(), text.size(), MSG_NOSIGNAL);
  } while (count < 0 && errno == EINTR);
  return count == static_cast<ssize_t>(text.size());
}

struct Answer {
  ExitStatus status;
  std::string folder;
};

Answer parse_answer(std::string_view text) {
  Answer answer;
  const char* end = text.data() + text.size();
  auto result = std::from_chars(text.data(), end, answer.status.code);
  if (result.ptr != end) result = std::from_chars(result.ptr + 1, end, answer.status.signal);
  if (result.ptr != end) answer.folder.assign(result.ptr + 1, end);
  return answer;
}

std::pair<int, int> socket_pair() {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    throw_environment_error("cannot create a socket", errno);
  }
  return {ends[0], ends[1]};
}

}  // namespace

/// One running server.
class ForkServer::Connection {
 public:
  explicit Connection(const std::vector<std::string>& command)
      : Connection(command, socket_pair()) {}
  ~Connection() {
    end();
    reader_.join();
    ::close(socket_);
  }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// Nothing when the server is gone.
  std::optional<ExitStatus> run(const std::string& folder) {
    std::future<std::optional<ExitStatus>> end;
    {
      const std::lock_guard lock(mutex_);
      if (is_gone_) return std::nullopt;
      end = waiting_[folder].get_future();
      if (!send_message(socket_, folder)) {
        waiting_.erase(folder);
        return std::nullopt;
      }
    }
    return end.get();
  }

  bool is_gone() const {
    const std::lock_guard lock(mutex_);
    return is_gone_;
  }

  /// Wakes the reader, which ends the process.
  void end() const { ::shutdown(socket_, SHUT_RDWR); }

 private:
  Connection(const std::vector<std::string>& command, std::pair<int, int> ends)
      : socket_(ends.first), process_(start(command, ends)), reader_([this] { read_answers(); }) {}

  static std::unique_ptr<ChildProcess> start(const std::vector<std::string>& command,
                                             std::pair<int, int> ends) {
    try {
      auto process = std::make_unique<ChildProcess>(command, ChildProcess::Variables{}, "/dev/null",
                                                    ends.second);
      ::close(ends.second);
      return process;
    } catch (...) {
      ::close(ends.first);
      ::close(ends.second);
      throw;
    }
  }

  void read_answers() {
    while (const std::optional<std::string> text = receive(socket_)) {
      const Answer answer = parse_answer(*text);
      const std::lock_guard lock(mutex_);
      if (auto waiting = waiting_.extract(answer.folder)) waiting.mapped().set_value(answer.status);
    }
    process_->signal_group(SIGKILL);
    process_->wait();  // no zombie stays
    const std::lock_guard lock(mutex_);
    is_gone_ = true;
    for (auto& [folder, end] : waiting_) end.set_value(std::nullopt);
    waiting_.clear();
  }

  int socket_;
  std::unique_ptr<ChildProcess> process_;
  mutable std::mutex mutex_;
  bool is_gone_ = false;                                                    ///< guarded by mutex_
  std::map<std::string, std::promise<std::optional<ExitStatus>>> waiting_;  ///< guarded by mutex_
  std::thread reader_;
};

ForkServer::ForkServer(std::vector<std::string> command) : command_(std::move(command)) {}

ForkServer::~ForkServer() = default;

std::shared_ptr<ForkServer::Connection> ForkServer::connection() {
  const std::lock_guard lock(mutex_);
  if (is_stopped_) throw EnvironmentError("the service ends; try again later");
  if (!connection_ || connection_->is_gone()) {
    connection_.reset();
    connection_ = std::make_shared<Connection>(command_);
  }
  return connection_;
}

ExitStatus ForkServer::run(const fs::path& work) {
  // A server that ends because it was idle may do so just now: then another one does it.
  constexpr int kTries = 2;
  for (int i = 0; i < kTries; ++i) {
    if (const auto status = connection()->run(work.string())) return *status;
  }
  throw EnvironmentError("the process that starts checks has ended");
}

void ForkServer::stop() {
  const std::lock_guard lock(mutex_);
  is_stopped_ = true;
  if (connection_) connection_->end();
}

namespace {

/// Main function of the forked child; does not return.
[[noreturn]] void do_in_child(const fs::path& folder, int signals,
                              const std::function<int(const fs::path&)>& work) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  ::setpgid(0, 0);
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  ::close(signals);
  const int nothing = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(nothing, STDOUT_FILENO);
  constexpr int kLogMode = 0644;
  const int log =
      ::open((folder / "log.txt").c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, kLogMode);
  ::dup2(log < 0 ? nothing : log, STDERR_FILENO);
  ::alarm(kMaxSeconds);
  const int code = work(folder);
  std::fflush(stderr);
  // Not exit(): the destructors of the libraries' statics touch, and so copy, most of the memory
  // that is shared with the server.
  std::_Exit(code);
}

/// Tells the client about children that have ended.
void report_ended(std::map<pid_t, std::string>& running) {
  int status = 0;
  for (pid_t pid = 0; (pid = ::waitpid(-1, &status, WNOHANG)) > 0;) {
    const auto found = running.find(pid);
    if (found == running.end()) continue;
    const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
    send_message(STDIN_FILENO, fmt::format("{} {} {}", code, signal, found->second));
    running.erase(found);
  }
}

}  // namespace

int run_fork_server(const std::function<int(const fs::path&)>& work) {
  protect_this_process();
  // Not PR_SET_PDEATHSIG: that looks at the thread that started this process, which may end before
  // its process does. The end of the client closes the socket.
  sigset_t ends;
  sigemptyset(&ends);
  sigaddset(&ends, SIGCHLD);
  ::sigprocmask(SIG_BLOCK, &ends, nullptr);
  const int signals = ::signalfd(-1, &ends, SFD_CLOEXEC | SFD_NONBLOCK);
  std::map<pid_t, std::string> running;
  while (true) {
    std::array<pollfd, 2> events = {pollfd{STDIN_FILENO, POLLIN, 0}, pollfd{signals, POLLIN, 0}};
    const int count = ::poll(events.data(), events.size(), running.empty() ? kIdleMs : -1);
    if (count == 0) return 0;
    if (count < 0 && errno != EINTR) return 1;
    signalfd_siginfo info{};
    while (::read(signals, &info, sizeof(info)) > 0) {
    }
    report_ended(running);
    if ((events[0].revents & (POLLIN | POLLHUP)) == 0) continue;
    const std::optional<std::string> folder = receive(STDIN_FILENO);
    if (!folder) return 0;  // the children die with this process
    const pid_t child = ::fork();
    if (child == 0) do_in_child(*folder, signals, work);
    if (child > 0) {
      running.emplace(child, *folder);
    } else {
      constexpr int kNoChild = 3;
      send_message(STDIN_FILENO, fmt::format("{} 0 {}", kNoChild, *folder));
    }
  }
}

}  // namespace throng::jobs
