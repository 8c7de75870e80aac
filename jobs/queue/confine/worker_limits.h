// Confinement of a worker process: it reads scenarios and meshes that strangers may have sent.
#pragma once

#include <string>

namespace throng::jobs {

/// How much address space a worker may use, in MiB; unset or 0: any.
inline constexpr const char* kMemoryVariable = "THRONG_WORKER_MEMORY_MIB";

/// Likewise of private writable memory, which reserved addresses are not.
inline constexpr const char* kDataVariable = "THRONG_WORKER_DATA_MIB";

/// From now on other processes of the same user cannot read or change this process's memory, nor
/// read its environment (/proc/PID): workers run code over files of strangers, and the service has
/// everybody's keys. Children that it forks are protected, programs that it starts are not.
void protect_this_process();

/// Whether a process may use the network.
enum class Network { refused, allowed };

/// From now on this process and its children connect to nothing, unless they may, trace no process,
/// write no core dumps, gain no privileges, are ended first when memory runs out, and use no more
/// memory than $THRONG_WORKER_MEMORY_MIB and $THRONG_WORKER_DATA_MIB. Returns what the kernel does
/// not allow to be limited, for people; "" for nothing.
std::string limit_this_process(Network network = Network::refused);

/// How many processes the kernel has killed since it started because memory ran out; 0 where it
/// does not say.
long long kills_for_memory();

}  // namespace throng::jobs
