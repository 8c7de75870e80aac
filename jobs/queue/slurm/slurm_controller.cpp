#include "jobs/queue/slurm/slurm_controller.h"

#include <fmt/core.h>
#include <poll.h>

#include <algorithm>
#include <cmath>
#include <csignal>

#include "base/error.h"

namespace throng::jobs {

namespace {

constexpr double kFirstPauseS = 1;

std::chrono::steady_clock::duration seconds(double value) {
  return std::chrono::duration_cast<std::chrono::steady_clock::duration>(
      std::chrono::duration<double>(value));
}

/// The first line that says something, without the program's name.
std::string first_line(const std::string& text) {
  const std::string line = text.substr(0, text.find('\n'));
  return line.empty() ? "no answer" : line;
}

}  // namespace

SlurmAnswer run_slurm(const std::vector<std::string>& command, double timeout_s,
                      const std::stop_token& stop) {
  std::vector<std::string> line = {"/bin/sh", "-c", "exec \"$@\" 2>&1", "sh"};
  line.insert(line.end(), command.begin(), command.end());
  const auto end = std::chrono::steady_clock::now() + seconds(timeout_s);
  SlurmAnswer answer;
  try {
    ChildProcess process(line, {}, "/dev/null");
    const auto read = [&] {
      for (const std::string& text : process.read_lines()) answer.text += text + "\n";
    };
    while (!process.has_ended()) {
      if (std::chrono::steady_clock::now() > end || stop.stop_requested()) {
        answer.text += fmt::format("{}: no answer within {} s\n", command[0], timeout_s);
        answer.is_away = true;
        return answer;  // the destructor ends the process
      }
      constexpr int kPollMs = 20;
      pollfd output{process.output(), POLLIN, 0};
      ::poll(&output, 1, kPollMs);
      read();
      // A closed pipe is always "readable".
      if ((output.revents & (POLLIN | POLLHUP)) == POLLHUP) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    }
    read();
    const ExitStatus status = process.wait();
    answer.is_ok = status.code == 0 && status.signal == 0;
  } catch (const EnvironmentError& error) {
    answer.text = error.what();
    answer.is_away = true;  // no room for a process
  }
  if (!answer.is_ok) answer.is_away = answer.is_away || is_controller_away(answer.text);
  return answer;
}

SlurmController::SlurmController(SlurmControllerOptions options)
    : options_(options),
      queue_(std::make_shared<SlurmQueue>()),
      thread_([this](const std::stop_token& stop) { work(stop); }) {}

SlurmController::~SlurmController() {
  thread_.request_stop();
  thread_.join();
  drain();
}

SlurmController::Watch::Watch(SlurmController& controller) : controller_(controller) {
  const std::lock_guard lock(controller_.mutex_);
  ++controller_.watches_;
  controller_.changed_.notify_all();
}

SlurmController::Watch::~Watch() {
  const std::lock_guard lock(controller_.mutex_);
  --controller_.watches_;
}

std::shared_ptr<const SlurmQueue> SlurmController::queue() const {
  const std::lock_guard lock(mutex_);
  return queue_;
}

std::future<SlurmAnswer> SlurmController::run(std::vector<std::string> command) {
  const std::lock_guard lock(mutex_);
  orders_.push_back({std::move(command), std::promise<SlurmAnswer>()});
  changed_.notify_all();
  return orders_.back().promise->get_future();
}

void SlurmController::run_until_answered(std::vector<std::string> command) {
  const std::lock_guard lock(mutex_);
  orders_.push_back({std::move(command), std::nullopt});
  changed_.notify_all();
}

void SlurmController::poll_next() {
  constexpr double kPauseS = 1;
  const std::lock_guard lock(mutex_);
  if (failures_ == 0) next_look_ = std::min(next_look_, Clock::now() + seconds(kPauseS));
  changed_.notify_all();
}

bool SlurmController::has_orders_now() const {
  return !orders_.empty() && Clock::now() >= next_order_;
}

void SlurmController::work(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    if (has_orders_now()) {
      Order order = std::move(orders_.front());
      orders_.pop_front();
      lock.unlock();
      carry_out(std::move(order), stop);
      lock.lock();
      continue;
    }
    if (watches_ > 0 && Clock::now() >= next_look_) {
      lock.unlock();
      look(stop);
      lock.lock();
      continue;
    }
    Clock::time_point next = Clock::time_point::max();
    if (watches_ > 0) next = next_look_;
    if (!orders_.empty()) next = std::min(next, next_order_);
    const auto is_due = [this] {
      return has_orders_now() || (watches_ > 0 && Clock::now() >= next_look_);
    };
    if (next == Clock::time_point::max()) {
      changed_.wait(lock, stop, [&] { return watches_ > 0 || !orders_.empty(); });
    } else {
      changed_.wait_until(lock, stop, next, is_due);
    }
  }
}

void SlurmController::carry_out(Order order, const std::stop_token& stop) {
  SlurmAnswer answer = run_slurm(order.command, options_.command_timeout_s, stop);
  if (answer.is_away) {
    note_away(answer.text);
  } else {
    note_back();
  }
  if (order.promise) {
    order.promise->set_value(std::move(answer));
  } else if (answer.is_away) {
    const std::lock_guard lock(mutex_);
    orders_.push_front(std::move(order));
  }
}

void SlurmController::look(const std::stop_token& stop) {
  const Clock::time_point asked = Clock::now();
  const SlurmAnswer answer = run_slurm({"squeue", "--me", "--array", "--states=all", "--noheader",
                                        std::string("--Format=") + kQueueFormat},
                                       options_.command_timeout_s, stop);
  if (!answer.is_ok) return note_away(answer.text);
  auto queue = std::make_shared<SlurmQueue>();
  queue->asked = asked;
  for (SlurmTask& task : read_queue(answer.text, kSlurmPrefix)) {
    queue->jobs[task.name] = task.job;
    SlurmQueue::Key key(task.job, task.index);
    queue->tasks.insert_or_assign(std::move(key), std::move(task));
  }
  note_back();
  const std::lock_guard lock(mutex_);
  queue_ = std::move(queue);
  next_look_ = Clock::now() + seconds(options_.poll_s);
}

void SlurmController::note_away(const std::string& why) {
  const std::lock_guard lock(mutex_);
  const double pause_s =
      std::min(options_.max_pause_s, kFirstPauseS * std::pow(2.0, std::min(failures_, 10)));
  ++failures_;
  next_look_ = next_order_ = Clock::now() + seconds(pause_s);
  auto queue = std::make_shared<SlurmQueue>(*queue_);
  queue->away = first_line(why);
  queue_ = std::move(queue);
}

void SlurmController::note_back() {
  const std::lock_guard lock(mutex_);
  if (failures_ == 0) return;
  failures_ = 0;
  next_look_ = next_order_ = {};
  auto queue = std::make_shared<SlurmQueue>(*queue_);
  queue->away.clear();
  queue_ = std::move(queue);
}

void SlurmController::drain() {
  constexpr double kTimeoutS = 5;
  for (const Order& order : orders_) {
    if (order.promise) continue;
    if (run_slurm(order.command, kTimeoutS).is_away) return;
  }
}

}  // namespace throng::jobs
