// Memory of the machine or container, for this process and its children.
#pragma once

#include <cstdint>

namespace throng::jobs {

/// Total memory in MiB: that of the machine, or the limit of the control group (container) if that
/// is less. 0 if /proc/meminfo cannot be read.
std::int64_t total_memory_mib();

/// Memory in MiB that can be allocated now without swapping, with the same limits.
std::int64_t available_memory_mib();

}  // namespace throng::jobs
