#include "jobs/queue/confine/worker_limits.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <string>

namespace throng::jobs {
namespace {

// Limits are permanent: each test limits a process of its own.
[[noreturn]] void leave(bool is_as_expected) { ::_exit(is_as_expected ? 0 : 1); }

template <typename... Arguments>
bool is_refused(long call, Arguments... arguments) {
  errno = 0;
  return ::syscall(call, arguments...) == -1 && errno == EACCES;
}

TEST(WorkerLimits, NoSocketLeadsOutOfTheMachine) {
  EXPECT_EXIT(
      {
        const bool was_limited = limit_this_process().find("network") == std::string::npos;
        bool refused = true;
        for (const int family : {AF_INET, AF_INET6, AF_NETLINK, AF_PACKET, AF_VSOCK, AF_ALG}) {
          refused = refused && ::socket(family, SOCK_STREAM, 0) < 0 && errno == EACCES;
        }
        leave((!was_limited || refused) && ::socket(AF_UNIX, SOCK_STREAM, 0) >= 0);
      },
      testing::ExitedWithCode(0), "");
}

TEST(WorkerLimits, OneThatPublishesConnectsAndIsLimitedOtherwise) {
  EXPECT_EXIT(
      {
        const bool was_limited =
            limit_this_process(Network::allowed).find("network") == std::string::npos;
        const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
        sockaddr_in nowhere{};
        nowhere.sin_family = AF_INET;
        nowhere.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        const bool is_connecting =
            ::connect(socket, reinterpret_cast<sockaddr*>(&nowhere), sizeof(nowhere)) != 0 &&
            errno != EACCES;
        leave(socket >= 0 && is_connecting && (!was_limited || is_refused(SYS_unshare)));
      },
      testing::ExitedWithCode(0), "");
}

bool are_ways_around_refused() {
  std::array<int, 2> pair{};
  const msghdr message{};
  return ::socketpair(AF_UNIX, SOCK_STREAM, 0, pair.data()) == 0 && ::write(pair[0], "x", 1) == 1 &&
         ::send(pair[0], "x", 1, 0) == 1 && is_refused(SYS_io_uring_setup) &&
         is_refused(SYS_connect) && is_refused(SYS_sendto, pair[0], "x", 1, 0, "y", 1) &&
         is_refused(SYS_unshare) && is_refused(SYS_bpf) && is_refused(SYS_pidfd_getfd) &&
         is_refused(SYS_setns) && is_refused(SYS_sendmsg, pair[0], &message, 0) &&
         is_refused(SYS_sendmmsg, pair[0], &message, 0, 0) &&
         is_refused(SYS_symlinkat, "x", AT_FDCWD, "throng_link") &&
         is_refused(SYS_mknodat, AT_FDCWD, "throng_pipe", S_IFIFO | 0600, 0) &&
         is_refused(SYS_chmod, "x", 0666) && is_refused(SYS_fchmod, pair[0], 0666) &&
         is_refused(SYS_fchmodat, AT_FDCWD, "x", 0666) && is_refused(452, AT_FDCWD, "x", 0666, 0) &&
         is_refused(SYS_chown, "x", 0, 0) && is_refused(SYS_fchownat, AT_FDCWD, "x", 0, 0, 0) &&
         is_refused(SYS_setxattr, "x", "user.a", "b", 1, 0) &&
         is_refused(SYS_utimensat, AT_FDCWD, "x", nullptr, 0);
}

TEST(WorkerLimits, WaysAroundTheSocketAreRefused) {
  EXPECT_EXIT(leave(!limit_this_process().empty() || are_ways_around_refused()),
              testing::ExitedWithCode(0), "");
}

/// Whether a process of the same user, who is not root, can open a file of another one in /proc.
bool can_read(pid_t other, const char* name) {
  const std::string file = "/proc/" + std::to_string(other) + "/" + name;
  const int descriptor = ::open(file.c_str(), O_RDONLY);
  if (descriptor >= 0) ::close(descriptor);
  return descriptor >= 0;
}

/// In a process that is not root, as a program that was just started.
bool is_protected_from_others() {
  constexpr uid_t kNobody = 65534;
  if (::geteuid() == 0 && ::setresuid(kNobody, kNobody, kNobody) != 0) return false;
  ::prctl(PR_SET_DUMPABLE, 1, 0, 0, 0);
  const pid_t parent = ::getpid();
  std::array<int, 2> ready{};
  if (::pipe(ready.data()) != 0) return false;
  const pid_t child = ::fork();
  if (child == 0) {
    const bool before = can_read(parent, "environ") && can_read(parent, "mem");
    char byte = 0;
    if (::read(ready[0], &byte, 1) != 1) leave(false);
    // Nothing to see if the system forbids it to all (Yama).
    leave(!before || (!can_read(parent, "environ") && !can_read(parent, "mem")));
  }
  constexpr useconds_t kUntilLooked = 200'000;
  ::usleep(kUntilLooked);
  protect_this_process();
  int status = 1;
  if (::write(ready[1], "x", 1) != 1 || ::waitpid(child, &status, 0) != child) return false;
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

// Root reads everything, unless it has given up its privileges.
bool is_protected_from_limited_root() {
  protect_this_process();
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child == 0) {
    if (!limit_this_process().empty()) leave(true);
    leave(!can_read(parent, "environ") && !can_read(parent, "mem"));
  }
  int status = 1;
  return ::waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

TEST(WorkerLimits, WorkersOfRootReadNeitherMemoryNorEnvironmentOfTheService) {
  EXPECT_EXIT(leave(is_protected_from_limited_root()), testing::ExitedWithCode(0), "");
}

TEST(WorkerLimits, OthersOfTheSameUserReadNeitherMemoryNorEnvironment) {
  EXPECT_EXIT(leave(is_protected_from_others()), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace throng::jobs
