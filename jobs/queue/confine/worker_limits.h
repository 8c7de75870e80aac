// Confinement of worker processes, because they parse scenarios and meshes from untrusted users.
#pragma once

#include <string>

namespace throng::jobs {

/// Environment variable with the max address space of a worker in MiB; unset or 0: unlimited.
inline constexpr const char* kMemoryVariable = "THRONG_WORKER_MEMORY_MIB";

/// Environment variable with the max private writable memory of a worker in MiB (RLIMIT_DATA),
/// which excludes merely reserved addresses; unset or 0: unlimited.
inline constexpr const char* kDataVariable = "THRONG_WORKER_DATA_MIB";

/// Keeps other processes of the same user from reading or changing this process's memory and from
/// reading its environment (/proc/PID), because the service holds all users' keys while workers
/// parse untrusted files. Forked children inherit the protection, started programs do not.
void protect_this_process();

/// Access to the network.
enum class Network { refused, allowed };

/// Restricts this process and its future children: no network unless allowed, no tracing of other
/// processes, no core dumps, no changes of modes, owners and attributes of files, of root's
/// privileges those to use files only, no further ones, first to be killed when memory runs out,
/// and no more memory than $THRONG_WORKER_MEMORY_MIB and $THRONG_WORKER_DATA_MIB. Returns the
/// restrictions that the kernel refuses, for people; "" if it accepts all.
std::string limit_this_process(Network network = Network::refused);

/// The number of processes that the kernel has killed since boot because memory ran out; 0 if
/// /proc/vmstat does not say.
long long kills_for_memory();

}  // namespace throng::jobs
