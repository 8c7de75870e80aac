#include "jobs/queue/workers/injected_faults.h"

#include <fmt/core.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>
#include <utility>

#include "base/error.h"

namespace throng::jobs {

namespace {

using KindName = std::pair<std::string_view, Fault::Kind>;
constexpr std::array kKinds = {
    KindName{"die", Fault::Kind::die}, KindName{"fail", Fault::Kind::fail},
    KindName{"grow", Fault::Kind::grow}, KindName{"hang", Fault::Kind::hang},
    KindName{"slow", Fault::Kind::slow}};

Fault parse_fault(std::string_view text) {
  const auto malformed = [&] {
    return InputError(
        Problem{"", kFaultsVariable, fmt::format("\"{}\"", text),
                "die, fail, grow, hang or slow, a colon, a task's name or *, and optionally a "
                "colon and a number, as in die:run000/shard0001:2"});
  };
  const std::size_t first = text.find(':');
  if (first == std::string_view::npos) throw malformed();
  Fault fault;
  bool is_known = false;
  for (const auto& [name, kind] : kKinds) {
    if (name != text.substr(0, first)) continue;
    fault.kind = kind;
    is_known = true;
  }
  const std::size_t second = text.find(':', first + 1);
  fault.place =
      text.substr(first + 1, second == std::string_view::npos ? second : second - first - 1);
  if (second != std::string_view::npos) {
    const std::string_view number = text.substr(second + 1);
    double amount = 0;
    const auto end = std::from_chars(number.data(), number.data() + number.size(), amount);
    if (end.ec != std::errc() || end.ptr != number.data() + number.size() || !(amount >= 0)) {
      throw malformed();
    }
    fault.amount = amount;
  }
  if (!is_known || fault.place.empty()) throw malformed();
  return fault;
}

/// Takes memory until the limit of the worker refuses it (std::bad_alloc).
void take_all_memory() {
  constexpr int kMaxBlocks = 256;
  constexpr std::size_t kBlockBytes = std::size_t{16} << 20U;
  std::vector<std::vector<char>> blocks;
  blocks.reserve(kMaxBlocks);
  for (int i = 0; i < kMaxBlocks; ++i) blocks.emplace_back(kBlockBytes, '\1');
  throw EnvironmentError(fmt::format("took 4 GiB of memory on purpose ({})", kFaultsVariable));
}

void provoke(const Fault& fault, int attempt) {
  if (fault.kind == Fault::Kind::slow) {
    std::this_thread::sleep_for(std::chrono::duration<double>(fault.amount.value_or(1)));
    return;
  }
  if (fault.amount && attempt > *fault.amount) return;
  switch (fault.kind) {
    case Fault::Kind::die:
      std::raise(SIGKILL);
      break;
    case Fault::Kind::fail:
      throw EnvironmentError(fmt::format("fails on purpose ({})", kFaultsVariable));
    case Fault::Kind::grow:
      take_all_memory();
      break;
    case Fault::Kind::hang:
      std::raise(SIGSTOP);  // all threads, also the one that gives signs of life
      break;
    case Fault::Kind::slow:
      break;
  }
}

}  // namespace

std::vector<Fault> parse_faults(std::string_view list) {
  std::vector<Fault> faults;
  while (!list.empty()) {
    const std::size_t comma = list.find(',');
    faults.push_back(parse_fault(list.substr(0, comma)));
    list.remove_prefix(comma == std::string_view::npos ? list.size() : comma + 1);
  }
  return faults;
}

void inject_faults(std::string_view place, int attempt) {
  const char* list = std::getenv(kFaultsVariable);
  if (list == nullptr) return;
  for (const Fault& fault : parse_faults(list)) {
    const bool is_here =
        fault.place == place || (fault.place == "*" && !place.starts_with("server/"));
    if (is_here) provoke(fault, attempt);
  }
}

}  // namespace throng::jobs
