// Requests per second of the HTTP service over loopback, on connections that are kept; one thread
// per connection sends the next request when it has the answer. Submissions include the disk sync
// that makes them durable.
#include <arpa/inet.h>
#include <benchmark/benchmark.h>
#include <spdlog/spdlog.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "base/error.h"
#include "base/files/resources.h"
#include "jobs/queue/workers/executor.h"
#include "server/routes/api.h"

namespace throng::server {
namespace {

namespace fs = std::filesystem;

constexpr const char* kJobText = R"({"scenario": "city_square/nearest_exit"})";

/// Leaves every job queued behind the first: the benchmarks are about the service.
class IdleExecutor final : public jobs::Executor {
 public:
  std::vector<jobs::TaskResult> run(const jobs::JobFolder&, std::span<const jobs::Task> tasks,
                                    const OnProgress&, std::stop_token stop,
                                    const jobs::Share&) override {
    while (!stop.stop_requested()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return std::vector<jobs::TaskResult>(tasks.size(), {jobs::Outcome::cancelled, 1, "", {}});
  }
};

class RunningService {
 public:
  RunningService()
      : data_(make_folder()),
        service_({.data = data_,
                  .scenarios = source_folder() / "scenarios",
                  .confined = jobs::confined_task_by(std::make_shared<jobs::ForkServer>(
                      std::vector<std::string>{THRONG_PROGRAM, "confined"}))},
                 executor_),
        keys_(data_),
        hooks_(service_.queue(), data_),
        api_(service_, keys_, hooks_, {}),
        job_(service_.queue().submit({nlohmann::json::parse(kJobText)}).row.id),
        thread_([this] { api_.run(); }) {}
  ~RunningService() {
    api_.stop();
    thread_.join();
    fs::remove_all(data_);
  }
  RunningService(const RunningService&) = delete;
  RunningService& operator=(const RunningService&) = delete;

  int port() const { return api_.port(); }
  const std::string& job() const { return job_; }

 private:
  static fs::path make_folder() {
    spdlog::set_level(spdlog::level::off);
    std::string name = (fs::temp_directory_path() / "throng-bench-XXXXXX").string();
    return ::mkdtemp(name.data());
  }

  fs::path data_;
  IdleExecutor executor_;
  Service service_;
  Keys keys_;
  WebhookSender hooks_;
  Api api_;
  std::string job_;
  std::jthread thread_;
};

/// A client that costs next to nothing, so that the server is what is measured.
class Connection {
 public:
  explicit Connection(int port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const int result = ::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof(address));
    check(result == 0, "the service listens");
  }
  ~Connection() { ::close(socket_); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// Sends a request and reads its answer; returns the status.
  int ask(const std::string& request) {
    ::send(socket_, request.data(), request.size(), MSG_NOSIGNAL);
    std::string answer;
    std::size_t length = std::string::npos;
    while (answer.size() < length) {
      std::array<char, 16384> block{};
      const ssize_t count = ::recv(socket_, block.data(), block.size(), 0);
      if (count <= 0) return 0;
      answer.append(block.data(), static_cast<std::size_t>(count));
      const auto head = answer.find("\r\n\r\n");
      if (length != std::string::npos || head == std::string::npos) continue;
      constexpr std::string_view kField = "Content-Length: ";
      length = head + 4 + std::stoul(answer.substr(answer.find(kField) + kField.size()));
    }
    return std::stoi(answer.substr(answer.find(' ')));
  }

 private:
  int socket_;
};

std::string get(const std::string& path) {
  return "GET " + path + " HTTP/1.1\r\nHost: localhost\r\n\r\n";
}

std::string post(const std::string& path, const std::string& body) {
  return "POST " + path + " HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n" +
         "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
}

RunningService& service() {
  static RunningService running;
  return running;
}

void ask_again_and_again(benchmark::State& state, const std::string& request, int status) {
  Connection connection(service().port());
  for (auto _ : state) {
    if (connection.ask(request) != status) {
      state.SkipWithError("an unexpected answer");
      break;
    }
  }
  state.SetItemsProcessed(state.iterations());
}

void health(benchmark::State& state) { ask_again_and_again(state, get("/healthz"), 200); }

void job_status(benchmark::State& state) {
  ask_again_and_again(state, get("/v1/jobs/" + service().job()), 200);
}

void job_list(benchmark::State& state) {
  ask_again_and_again(state, get("/v1/jobs?limit=50"), 200);
}

void submit(benchmark::State& state) {
  ask_again_and_again(state, post("/v1/jobs", kJobText), 201);
}

// The number of threads is the number of connections. The list comes last, when there are jobs.
void add(const char* name, void (*function)(benchmark::State&),
         std::initializer_list<int> connections) {
  auto* added = benchmark::RegisterBenchmark(name, function)->UseRealTime();
  for (const int count : connections) added->Threads(count);
}

const bool kRegistered = [] {
  add("BM_Health/connections", &health, {1, 16, 64});
  add("BM_JobStatus/connections", &job_status, {1, 16, 64});
  add("BM_Submit/durable/connections", &submit, {1, 16});
  add("BM_JobList/jobs:50/connections", &job_list, {1, 16});
  return true;
}();

}  // namespace
}  // namespace throng::server
