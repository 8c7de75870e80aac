// Settings of the C library's heap for processes that render in software.
#pragma once

namespace throng::render {

/// Keeps freed memory in the process instead of returning it to the kernel. llvmpipe allocates and
/// frees its bins in every frame; without this setting, page faults take a third of the time of a
/// crowded frame. Call it once at the start of a rendering process.
void tune_allocator();

}  // namespace throng::render
