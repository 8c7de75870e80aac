// Loading and stepping within the bounds of a fuzz run.
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <string_view>

#include "base/error.h"
#include "crowd/simulation.h"

namespace throng::crowd::fuzz {

/// Whether the text asks for more agents than a fuzz run has time for: a number above 40 in an
/// attribute that counts.
inline bool is_crowded(std::string_view text) {
  constexpr int kMaxSteps = 40;
  constexpr std::array<std::string_view, 8> kCounts = {
      "count_x", "count_y", "population", "density", "width", "count", "rate", "duration"};
  for (const std::string_view name : kCounts) {
    for (std::size_t at = text.find(name); at != std::string_view::npos;
         at = text.find(name, at + 1)) {
      std::string_view rest = text.substr(at + name.size());
      while (!rest.empty() && std::isdigit(static_cast<unsigned char>(rest.front())) == 0) {
        if (rest.front() == '>') break;
        rest.remove_prefix(1);
      }
      double value = 0;
      std::from_chars(rest.data(), rest.data() + std::min<std::size_t>(rest.size(), 32), value);
      if (value > kMaxSteps) return true;
    }
  }
  return false;
}

/// Loads and steps; every error that a user may see is as good as none. With THRONG_FUZZ_SAY in the
/// environment it says what it got, to see whether an input of the corpus gets as far as it should.
inline void load_and_step(const std::filesystem::path& scene, const std::filesystem::path& behavior,
                          const LoadOptions& options) {
  constexpr std::size_t kMaxAgents = 2000;
  constexpr int kSteps = 4;
  const bool say = std::getenv("THRONG_FUZZ_SAY") != nullptr;
  try {
    Simulation crowd(scene, behavior, options);
    if (crowd.agent_count() > kMaxAgents) return;
    for (int i = 0; i < kSteps && !crowd.all_final(); ++i) crowd.step();
    if (say) fmt::print(stderr, "{} agents\n", crowd.agent_count());
  } catch (const InputError& error) {
    if (say) fmt::print(stderr, "{}\n", error.what());
  } catch (const EnvironmentError& error) {
    if (say) fmt::print(stderr, "{}\n", error.what());
  }
}

}  // namespace throng::crowd::fuzz
