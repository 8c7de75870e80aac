#include "render/allocator.h"

#include <malloc.h>

#include <limits>

namespace throng::render {

void tune_allocator() {
  constexpr int kMiB = 1 << 20;
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  mallopt(M_MMAP_THRESHOLD, 32 * kMiB);
  mallopt(M_TOP_PAD, 256 * kMiB);
}

}  // namespace throng::render
