// Confinement of a worker process: it reads scenarios and meshes that strangers may have sent.
#pragma once

#include <string>

namespace throng::jobs {

/// How much address space a worker may use, in MiB; unset or 0: any.
inline constexpr const char* kMemoryVariable = "THRONG_WORKER_MEMORY_MIB";

/// From now on this process and its children can open no socket but local ones, write no core
/// dumps, gain no privileges, and use no more memory than $THRONG_WORKER_MEMORY_MIB. Returns what
/// the kernel does not allow to be limited, for people; "" for nothing.
std::string limit_this_process();

/// How many processes the kernel has killed since it started because memory ran out; 0 where it
/// does not say.
long long kills_for_memory();

}  // namespace throng::jobs
