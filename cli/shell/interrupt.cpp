#include "cli/shell/interrupt.h"

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>

namespace throng::cli {

namespace {

// A signal handler can reach nothing but a global; lock-free atomics are safe in it.
std::atomic<int> signals_seen{0};
static_assert(std::atomic<int>::is_always_lock_free);

constexpr int kExitInterrupted = 130;

extern "C" void count_signal(int) {
  if (++signals_seen > 1) std::_Exit(kExitInterrupted);
}

void handle_with(void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

}  // namespace

Interrupt::Interrupt() {
  signals_seen = 0;
  handle_with(&count_signal);
  watcher_ = std::jthread([this](const std::stop_token& done) {
    while (!done.stop_requested()) {
      if (signals_seen > 0) source_.request_stop();
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  });
}

Interrupt::~Interrupt() { handle_with(SIG_DFL); }

}  // namespace throng::cli
