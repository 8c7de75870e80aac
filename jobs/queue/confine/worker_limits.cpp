#include "jobs/queue/confine/worker_limits.h"

#include <fmt/core.h>
#include <linux/capability.h>
#include <seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <initializer_list>
#include <memory>

namespace throng::jobs {

namespace {

constexpr int kFchmodat2 = 452;  // of Linux 6.6, which libseccomp 2.5 does not know

// System calls by which a process could reach the network without socket(), other processes of the
// same user, or parts of the kernel that no task needs.
constexpr std::array kRefusedCalls = {
    SCMP_SYS(io_uring_setup), SCMP_SYS(io_uring_enter), SCMP_SYS(pidfd_getfd), SCMP_SYS(unshare),
    SCMP_SYS(setns), SCMP_SYS(mount), SCMP_SYS(umount2), SCMP_SYS(pivot_root), SCMP_SYS(bpf),
    SCMP_SYS(userfaultfd), SCMP_SYS(perf_event_open), SCMP_SYS(keyctl), SCMP_SYS(add_key),
    SCMP_SYS(request_key), SCMP_SYS(open_by_handle_at),
    // The service reads and writes in the folders of workers: nothing there may lead elsewhere.
    SCMP_SYS(symlink), SCMP_SYS(symlinkat), SCMP_SYS(mknod), SCMP_SYS(mknodat),
    // Landlock limits no modes, owners and attributes of files, and no task changes any.
    SCMP_SYS(chmod), SCMP_SYS(fchmod), SCMP_SYS(fchmodat), kFchmodat2, SCMP_SYS(chown),
    SCMP_SYS(fchown), SCMP_SYS(lchown), SCMP_SYS(fchownat), SCMP_SYS(setxattr), SCMP_SYS(lsetxattr),
    SCMP_SYS(fsetxattr), SCMP_SYS(removexattr), SCMP_SYS(lremovexattr), SCMP_SYS(fremovexattr),
    SCMP_SYS(utime), SCMP_SYS(utimes), SCMP_SYS(futimesat)};
// The leak check of AddressSanitizer traces the process itself.
#if !defined(THRONG_SANITIZE_ADDRESS) && !defined(THRONG_SANITIZE_THREAD)
constexpr std::array kRefusedTracing = {SCMP_SYS(ptrace), SCMP_SYS(process_vm_readv),
                                        SCMP_SYS(process_vm_writev)};
#else
constexpr std::array<int, 0> kRefusedTracing = {};
#endif

// From -1000 to 1000: the kernel ends the process with the greatest score first when memory runs
// out.
constexpr int kOomScore = 500;

/// Refuses all sockets but unconnected local ones, unless the network is allowed, and the calls
/// above; 0, or an errno.
int refuse_calls(Network network) {
  const std::unique_ptr<void, decltype(&seccomp_release)> filter(seccomp_init(SCMP_ACT_ALLOW),
                                                                 &seccomp_release);
  if (!filter) return ENOMEM;
  constexpr std::uint32_t kRefusal = SCMP_ACT_ERRNO(EACCES);
  const auto refuse = [&](int call, std::initializer_list<scmp_arg_cmp> conditions) {
    return seccomp_rule_add_array(filter.get(), kRefusal, call,
                                  static_cast<unsigned>(conditions.size()), conditions.begin());
  };
  int error = 0;
  if (network == Network::refused) {
    error = refuse(SCMP_SYS(socket), {{0, SCMP_CMP_NE, AF_UNIX, 0}});
    if (error == 0) error = refuse(SCMP_SYS(connect), {});
    // Datagrams to an address need no connection. A filter cannot see the address of a message.
    if (error == 0) error = refuse(SCMP_SYS(sendto), {{4, SCMP_CMP_NE, 0, 0}});
    if (error == 0) error = refuse(SCMP_SYS(sendmsg), {});
    if (error == 0) error = refuse(SCMP_SYS(sendmmsg), {});
  }
  // Times of files by their path; those of open files are its own.
  if (error == 0) error = refuse(SCMP_SYS(utimensat), {{1, SCMP_CMP_NE, 0, 0}});
  for (const int call : kRefusedCalls) error = error == 0 ? refuse(call, {}) : error;
  for (const int call : kRefusedTracing) error = error == 0 ? refuse(call, {}) : error;
  return error != 0 ? -error : -seccomp_load(filter.get());
}

/// Keeps of root's privileges those to use files: with the others, a worker of a service that runs
/// as root reads the service's memory. 0, or an errno.
int drop_capabilities() {
  constexpr std::uint32_t kKept =
      1U << CAP_DAC_OVERRIDE | 1U << CAP_DAC_READ_SEARCH | 1U << CAP_FOWNER;
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  std::array<__user_cap_data_struct, _LINUX_CAPABILITY_U32S_3> sets{};
  if (::syscall(SYS_capget, &header, sets.data()) != 0) return errno;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const std::uint32_t kept = i == 0 ? kKept : 0;
    sets[i].effective &= kept;
    sets[i].permitted &= kept;
    sets[i].inheritable = 0;
  }
  return ::syscall(SYS_capset, &header, sets.data()) == 0 ? 0 : errno;
}

}  // namespace

void protect_this_process() { ::prctl(PR_SET_DUMPABLE, 0, 0, 0, 0); }

std::string limit_this_process(Network network) {
  std::string refused;
  const auto add_refused = [&](const char* what, int error) {
    refused += fmt::format("{}{}: {}", refused.empty() ? "" : "; ", what, std::strerror(error));
  };
  const rlimit no_core{0, 0};
  if (::setrlimit(RLIMIT_CORE, &no_core) != 0) add_refused("core dumps", errno);
  // Rather than the server, which may have become larger in months.
  // A protected process may not write it.
  ::prctl(PR_SET_DUMPABLE, 1, 0, 0, 0);
  std::ofstream("/proc/self/oom_score_adj") << kOomScore;
  protect_this_process();
  const auto limit_memory = [&](decltype(RLIMIT_AS) kind, const char* variable) {
    const char* text = std::getenv(variable);
    constexpr rlim_t kMib = 1 << 20;
    const rlim_t bytes = text == nullptr ? 0 : std::strtoull(text, nullptr, 10) * kMib;
    const rlimit memory{bytes, bytes};
    if (bytes > 0 && ::setrlimit(kind, &memory) != 0) add_refused("memory", errno);
  };
  limit_memory(RLIMIT_AS, kMemoryVariable);
  limit_memory(RLIMIT_DATA, kDataVariable);
  if (const int error = drop_capabilities(); error != 0) add_refused("privileges", error);
  if (const int error = refuse_calls(network); error != 0) add_refused("the network", error);
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
