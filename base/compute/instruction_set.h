// Hot loops compiled for more than one instruction set; which one runs is chosen at run time, so
// the same program runs everywhere.
#pragma once

#include <string_view>

namespace throng {

enum class InstructionSet {
  baseline,  ///< what every machine of this architecture has; on x86-64 that is SSE2
  avx2       ///< vectors of 8 floats
};

/// The best one that this machine has.
inline InstructionSet best_instruction_set() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2") != 0) return InstructionSet::avx2;
#endif
  return InstructionSet::baseline;
}

inline std::string_view to_string(InstructionSet set) {
  return set == InstructionSet::avx2 ? "avx2" : "baseline";
}

/// A loop in several versions. A Kernel has `template <int kWidth> static R run(Args...)`, where
/// kWidth is the number of lanes (see simd.h); everything that it calls is inlined into it and so
/// compiled for the same instruction set. Versions differ in speed only: there are no fused
/// multiply-adds, so they round alike.
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
