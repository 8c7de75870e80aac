// The C library's heap, set up for a process that renders in software.
#pragma once

namespace throng::render {

/// Keeps freed memory in the process instead of giving it back to the kernel. llvmpipe allocates
/// and frees its bins every frame; without this a third of a crowded frame is page faults. Call
/// once at the start of a rendering process; costs nothing elsewhere.
void tune_allocator();

}  // namespace throng::render
