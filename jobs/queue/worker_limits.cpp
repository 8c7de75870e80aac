#include "jobs/queue/worker_limits.h"

#include <fmt/core.h>
#include <seccomp.h>
#include <sys/resource.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>

namespace throng::jobs {

namespace {

/// Refuses sockets that lead out of this machine; 0, or an errno.
int refuse_network() {
  const std::unique_ptr<void, decltype(&seccomp_release)> filter(seccomp_init(SCMP_ACT_ALLOW),
                                                                 &seccomp_release);
  if (!filter) return ENOMEM;
  for (const int family : {AF_INET, AF_INET6, AF_PACKET, AF_VSOCK}) {
    // The kernel takes the lower 32 bits of the first argument, whatever the others are.
    constexpr scmp_datum_t kInt = 0xFFFFFFFF;
    const std::array conditions = {
        scmp_arg_cmp{0, SCMP_CMP_MASKED_EQ, kInt, static_cast<scmp_datum_t>(family)}};
    const int result = seccomp_rule_add_array(filter.get(), SCMP_ACT_ERRNO(EACCES),
                                              SCMP_SYS(socket), 1, conditions.data());
    if (result != 0) return -result;
  }
  return -seccomp_load(filter.get());
}

}  // namespace

std::string limit_this_process() {
  std::string refused;
  const auto add_refused = [&](const char* what, int error) {
    refused += fmt::format("{}{}: {}", refused.empty() ? "" : "; ", what, std::strerror(error));
  };
  const rlimit no_core{0, 0};
  if (::setrlimit(RLIMIT_CORE, &no_core) != 0) add_refused("core dumps", errno);
  if (const char* text = std::getenv(kMemoryVariable)) {
    constexpr rlim_t kMib = 1 << 20;
    const rlim_t bytes = std::strtoull(text, nullptr, 10) * kMib;
    const rlimit memory{bytes, bytes};
    if (bytes > 0 && ::setrlimit(RLIMIT_AS, &memory) != 0) add_refused("memory", errno);
  }
  if (const int error = refuse_network(); error != 0) add_refused("the network", error);
  return refused;
}

long long kills_for_memory() {
  std::ifstream file("/proc/vmstat");
  std::string name;
  long long value = 0;
  while (file >> name >> value) {
    if (name == "oom_kill") return value;
  }
  return 0;
}

}  // namespace throng::jobs
