// How much memory there is, for this process and its children.
#pragma once

#include <cstdint>

namespace throng::jobs {

/// All memory, in MiB: the machine's, or what the control group (a container) may use if that is
/// less. 0 where the kernel does not say.
std::int64_t total_memory_mib();

/// The part of it that is free now, in MiB, without swapping.
std::int64_t available_memory_mib();

}  // namespace throng::jobs
