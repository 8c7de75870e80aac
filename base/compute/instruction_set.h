// Loops that are compiled for several instruction sets; the program selects one at run time, so the
// same program runs on all machines.
#pragma once

#include <string_view>

namespace throng {

enum class InstructionSet {
  baseline,  ///< supported by every machine of the architecture; SSE2 on x86-64
  avx2       ///< vectors of 8 floats
};

/// Returns the best instruction set that this machine supports.
inline InstructionSet best_instruction_set() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2") != 0) return InstructionSet::avx2;
#endif
  return InstructionSet::baseline;
}

inline std::string_view to_string(InstructionSet set) {
  return set == InstructionSet::avx2 ? "avx2" : "baseline";
}

/// Versions of a loop. A Kernel has `template <int kWidth> static R run(Args...)`, where kWidth is
/// the number of lanes (see simd.h). Functions that the kernel calls are inlined and so compiled
/// for the same instruction set. Versions differ only in speed: without fused multiply-adds, their
/// results are equal.
template <typename Kernel, typename Signature>
struct Versions;

template <typename Kernel, typename R, typename... Args>
struct Versions<Kernel, R(Args...)> {
  using Function = R (*)(Args...);

  [[gnu::flatten]] static R baseline(Args... args) { return Kernel::template run<4>(args...); }
#if defined(__x86_64__)
  [[gnu::target("avx2"), gnu::flatten]] static R avx2(Args... args) {
    return Kernel::template run<8>(args...);
  }
#endif

  static Function pick(InstructionSet set) {
#if defined(__x86_64__)
    if (set == InstructionSet::avx2) return &avx2;
#endif
    static_cast<void>(set);
    return &baseline;
  }
};

}  // namespace throng
