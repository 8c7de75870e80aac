// A study: runs for each combination of case, policy and seed, compared in pairs; and the parser of
// its file.
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

/// A scenario with its alarm and duration.
struct Case {
  std::string id;
  std::string title;
  world::Alarm alarm;  ///< the scenario's; its time may be set in the study's file
  double duration_s = 900;
  world::Scenario scenario;
  metrics::ReferenceSpec reference;
  /// Horizons of the restricted means, the shorter one first (s from the alarm).
  std::array<double, 2> horizons_s{};
  /// Findings of scenarios::check() about the scenario; only load_study() looks for them.
  std::vector<std::string> findings = {};
};

/// One guidance policy, or none.
struct PolicyRow {
  std::string id;
  std::string title;
};

struct Study {
  std::string name;
  std::uint64_t seed = 1;
  int runs = 24;             ///< per case and policy; run i of every policy has the same seed
  std::size_t baseline = 0;  ///< index of the policy with which the others are compared
  /// Index of the case with which the others are compared, if cases are alternatives.
  std::optional<std::size_t> baseline_case;
  std::vector<Case> cases;
  std::vector<PolicyRow> policies;
  std::vector<std::vector<jobs::JobSpec>> jobs;  ///< per case and policy
  int people = 0;                                ///< max number of people at the start of a run
  /// Per case and policy: hash of all inputs of the results except for the run's number.
  std::vector<std::vector<std::string>> fingerprints;
};

/// Reads and checks a study's file (docs/study.md). Throws InputError that names file and JSON
/// pointer, also for mistakes in the jobs of its cases and policies.
Study load_study(const std::filesystem::path& file, const std::filesystem::path& scenarios);

/// A case and a policy, by their indices.
struct Cell {
  std::size_t one_case = 0;
  std::size_t policy = 0;
};

/// Reads a study's document; `source` names it in messages. With `only`, jobs and fingerprints of
/// all other cells stay empty, which takes a fraction of the time.
Study read_study(const nlohmann::json& document, const std::string& source,
                 const std::filesystem::path& scenarios, const std::optional<Cell>& only = {});

}  // namespace throng::study
