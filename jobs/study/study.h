// A study: cases times policies times seeds, compared pair by pair. The file that describes it.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "metrics/bounds/run_bound.h"
#include "spec/job/spec.h"
#include "world/scenario.h"

namespace throng::study {

/// A place and what happens there.
struct Case {
  std::string id;
  std::string title;
  world::Alarm alarm;  ///< the scenario's, at the time that the study's file gives, if it does
  double duration_s = 900;
  world::Scenario scenario;
  metrics::ReferenceSpec reference;
  /// Up to which restricted means are taken, the shorter one first (s from the alarm).
  std::array<double, 2> horizons_s{};
};

/// One guidance method; or none.
struct PolicyRow {
  std::string id;
  std::string title;
};

struct Study {
  std::string name;
  std::uint64_t seed = 1;
  int runs = 24;             ///< paired: run i of every policy has the same seed
  std::size_t baseline = 0;  ///< index of the policy that the others are compared with
  /// Index of the case that the others are compared with, if cases are alternatives.
  std::optional<std::size_t> baseline_case;
  std::vector<Case> cases;
  std::vector<PolicyRow> policies;
  std::vector<std::vector<jobs::JobSpec>> jobs;  ///< per case and policy; without drones: none fly
  int people = 0;                                ///< most that a run begins with
  /// Per case and policy: of everything that results depend on beside the run's number.
  std::vector<std::vector<std::string>> fingerprints;
};

/// Reads and checks a study's file (docs/guidance.md). Throws InputError, naming file and JSON
/// pointer, also for anything that the jobs it makes would be refused for.
Study load_study(const std::filesystem::path& file, const std::filesystem::path& scenarios);

/// A case and a policy, by their indices.
struct Cell {
  std::size_t one_case = 0;
  std::size_t policy = 0;
};

/// Likewise from a text; `source` names it in messages. With `only`, jobs and fingerprints of all
/// other cells stay empty, which takes a fraction of the time.
Study read_study(std::string_view text, const std::string& source,
                 const std::filesystem::path& scenarios, const std::optional<Cell>& only = {});

}  // namespace throng::study
