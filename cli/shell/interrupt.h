// Ctrl-C and SIGTERM as a std::stop_token, so that long work can end cleanly.
#pragma once

#include <stop_token>
#include <thread>

namespace throng::cli {

/// During the lifetime of this object, SIGINT and SIGTERM request a stop; a second signal ends the
/// program at once. Only one object may exist at a time.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  std::stop_token token() const { return source_.get_token(); }

 private:
  std::stop_source source_;
  std::jthread watcher_;
};

}  // namespace throng::cli
