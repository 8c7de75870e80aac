#include "live/loop/input_lines.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>

#include "base/resource_exhaustion.h"

namespace throng::live {

namespace {

/// Becomes readable when something is written.
struct Event {
  Event() : descriptor(::eventfd(0, EFD_CLOEXEC)) {}
  ~Event() { ::close(descriptor); }
  Event(const Event&) = delete;
  Event& operator=(const Event&) = delete;

  const int descriptor;
};

}  // namespace

void read_lines(int input, const std::stop_token& stop,
                const std::function<void(const std::string& line)>& take) {
  const Event stopped;
  const std::stop_callback at_stop(stop, [&] { ::eventfd_write(stopped.descriptor, 1); });
  std::string pending;
  std::array<char, 1 << 12> block{};
  while (true) {
    std::array<pollfd, 2> waits = {pollfd{input, POLLIN, 0}, pollfd{stopped.descriptor, POLLIN, 0}};
    ::poll(waits.data(), waits.size(), -1);
    if (stop.stop_requested()) return;
    const ssize_t count = ::read(input, block.data(), block.size());
    if (count < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (count < 0) throw_environment_error("cannot read what is asked of the flight", errno);
    if (count == 0) return;
    pending.append(block.data(), static_cast<std::size_t>(count));
    std::size_t begin = 0;
    for (std::size_t end = 0; (end = pending.find('\n', begin)) != std::string::npos;
         begin = end + 1) {
      take(pending.substr(begin, end - begin));
    }
    pending.erase(0, begin);
  }
}

}  // namespace throng::live
