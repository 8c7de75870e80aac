#include "server/live/live_flight.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include "base/error.h"
#include "base/json/json_text.h"
#include "base/resource_exhaustion.h"
#include "jobs/queue/confine/child_process.h"
#include "jobs/queue/workers/worker_interface.h"
#include "server/catalog/api_json.h"

namespace throng::server {

using live::Message;
using live::MessageType;
using nlohmann::json;
using namespace std::chrono_literals;

namespace {

constexpr auto kSignOfLife = 1s;        // to viewers, of a world that rests
constexpr auto kOutcomePatience = 20s;  // for the outcome of a flight that ends
constexpr int kFlightPollMs = 100;
constexpr std::size_t kMaxKeptEvents = 200;  // that are kept for viewers who come later

}  // namespace

const char* to_string(LiveState state) {
  constexpr std::array kNames = {"starting", "flying", "ended", "failed"};
  return kNames[static_cast<std::size_t>(state)];
}

LiveFlight::LiveFlight(LiveFlightSpec spec)
    : spec_(std::move(spec)), folder_(spec_.folder / spec_.id), last_seen_(spec_.now()) {
  write_file_atomically(folder_.path() / "job.json", spec_.job_json);
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw_environment_error("cannot create a pipe", errno);
  input_read_ = ends[0];
  input_ = ends[1];
  // A process that does not read must not hold up those who command it.
  ::fcntl(input_, F_SETFL, O_NONBLOCK);
  thread_ = std::jthread([this] { run(); });
}

LiveFlight::~LiveFlight() {
  {
    const std::lock_guard lock(mutex_);
    should_end_ = true;
  }
  if (thread_.joinable()) thread_.join();
  ::close(input_);
  if (input_read_ >= 0) ::close(input_read_);
}

LiveState LiveFlight::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

int LiveFlight::viewers() const {
  const std::lock_guard lock(mutex_);
  return viewers_;
}

double LiveFlight::time_s() const {
  const std::lock_guard lock(mutex_);
  return time_s_;
}

json LiveFlight::outcome() const {
  const std::lock_guard lock(mutex_);
  return outcome_;
}

SteadyTime::duration LiveFlight::unseen() const {
  const std::lock_guard lock(mutex_);
  return viewers_ > 0 ? 0s : spec_.now() - last_seen_;
}

// The process dies with the thread that started it, so this thread lives as long as the process.
void LiveFlight::run() {
  try {
    jobs::ChildProcess::Variables variables = {
        {jobs::kSupervisorVariable, std::to_string(::getpid())}};
    if (spec_.memory_mib > 0) {
      constexpr std::int64_t kMoreMib = 2048;
      variables.emplace_back(jobs::kDataVariable, std::to_string(2 * spec_.memory_mib + kMoreMib));
    }
    std::vector<std::string> command = spec_.command;
    command.push_back(folder_.path().string());
    if (spec_.is_recorded) {
      command.insert(command.end(), {"--record", std::to_string(spec_.min_free_mib), "--max-bytes",
                                     std::to_string(spec_.max_recorded_bytes)});
    }
    jobs::ChildProcess process(command, variables, folder_.path() / "log.txt", input_read_);
    ::close(std::exchange(input_read_, -1));
    live::MessageReader reader;
    std::array<char, 1 << 16> block{};
    while (true) {
      pollfd output{process.output(), POLLIN, 0};
      ::poll(&output, 1, kFlightPollMs);
      {
        const std::lock_guard lock(mutex_);
        if (should_end_) return;  // the process ends with its object
      }
      const ssize_t count = ::read(process.output(), block.data(), block.size());
      if (count < 0 && (errno == EAGAIN || errno == EINTR)) continue;
      if (count <= 0) break;
      reader.add({block.data(), static_cast<std::size_t>(count)});
      while (const auto message = reader.next()) take(*message);
    }
    const jobs::ExitStatus status = process.wait();
    if (state() != LiveState::starting && state() != LiveState::flying) return;
    spdlog::error("live flight {}: {}", spec_.id, read_file(folder_.path() / "log.txt"));
    fail("crash", status.signal != 0 ? fmt::format("the flight was ended by signal {} ({})",
                                                   status.signal, ::strsignal(status.signal))
                                     : fmt::format("the flight ended with code {}", status.code));
  } catch (const std::exception& error) {
    spdlog::error("live flight {}: {}", spec_.id, error.what());
    fail("environment", "the flight cannot be carried out");
  }
}

void LiveFlight::fail(const std::string& kind, const std::string& message) {
  take({MessageType::failure,
        dump_text({{"kind", kind}, {"message", message}, {"problems", json::array()}})});
}

void LiveFlight::take(const Message& message) {
  const std::lock_guard lock(mutex_);
  if (end_.number > 0) return;
  Numbered numbered{++count_, live::framed(message)};
  switch (message.type) {
    case MessageType::hello:
      hello_ = std::move(numbered);
      state_ = LiveState::flying;
      break;
    case MessageType::state: {
      constexpr std::size_t kTimeAt = 8;
      if (message.bytes.size() >= kTimeAt + sizeof(double)) {
        std::memcpy(&time_s_, message.bytes.data() + kTimeAt, sizeof(double));
      }
      world_ = std::move(numbered);
      break;
    }
    case MessageType::image:
      image_ = std::move(numbered);
      break;
    case MessageType::event:
      if (events_.size() == kMaxKeptEvents) events_.erase(events_.begin());
      events_.push_back(std::move(numbered));
      break;
    case MessageType::result:
    case MessageType::failure:
      outcome_ = parse_own_json(message.bytes, "the outcome of a live flight");
      state_ = message.type == MessageType::result ? LiveState::ended : LiveState::failed;
      last_seen_ = spec_.now();
      end_ = std::move(numbered);
      break;
    case MessageType::alive:
      break;
  }
  changed_.notify_all();
}

void LiveFlight::send(const json& line) {
  const std::string text = dump_text(line) + "\n";
  // Shorter than a pipe's atomic writes, or else a part of a line could be left behind.
  if (::write(input_, text.data(), text.size()) < 0 && errno != EAGAIN && errno != EPIPE) {
    spdlog::warn("live flight {}: {}", spec_.id, std::strerror(errno));
  }
}

void LiveFlight::add_viewer(int change) {
  const std::lock_guard lock(mutex_);
  viewers_ += change;
  last_seen_ = spec_.now();
  if (end_.number == 0) send({{"viewers", viewers_}});
}

bool LiveFlight::command(const live::Commands& commands) {
  const std::lock_guard lock(mutex_);
  if (end_.number > 0) return false;
  // A drone at a time: lines stay short.
  live::Commands line = commands;
  line.drones.clear();
  for (const live::DroneCommand& drone : commands.drones) {
    live::Commands one;
    one.drones = {drone};
    send({{"commands", to_json(one)}});
  }
  send({{"commands", to_json(line)}});
  return true;
}

bool LiveFlight::stop() {
  std::unique_lock lock(mutex_);
  if (end_.number == 0) send({{"stop", true}});
  return changed_.wait_for(lock, kOutcomePatience, [this] { return end_.number > 0; });
}

void LiveFlight::end() {
  fail("removed", "the flight was removed");
  const std::lock_guard lock(mutex_);
  should_end_ = true;
}

LiveFlight::Viewer::Viewer(std::shared_ptr<LiveFlight> flight) : flight_(std::move(flight)) {
  flight_->add_viewer(1);
}

LiveFlight::Viewer::~Viewer() { flight_->add_viewer(-1); }

std::string LiveFlight::Viewer::next() {
  LiveFlight& flight = *flight_;
  std::unique_lock lock(flight.mutex_);
  const auto newest = [&] {
    return std::max({flight.hello_.number, flight.world_.number, flight.image_.number,
                     flight.events_.empty() ? 0 : flight.events_.back().number,
                     flight.end_.number});
  };
  if (seen_ > 0 && flight.end_.number > 0 && seen_ >= flight.end_.number) return "";
  if (!flight.changed_.wait_for(lock, kSignOfLife, [&] { return newest() > seen_; })) {
    return live::framed({MessageType::alive, ""});
  }
  std::string bytes;
  const auto add = [&](const Numbered& message) {
    if (message.number > seen_) bytes += message.bytes;
  };
  add(flight.hello_);
  add(flight.world_);
  for (const Numbered& event : flight.events_) add(event);
  add(flight.image_);
  add(flight.end_);
  seen_ = newest();
  return bytes;
}

}  // namespace throng::server
