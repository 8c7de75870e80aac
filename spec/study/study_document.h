// A study's document: cases, policies and seeds, as a user writes them (docs/study.md).
// jobs/study/study.h makes jobs of it.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"

namespace throng::study {

/// Speed and capacities of the reference time.
struct ReferenceDocument {
  std::optional<double> speed_mps;
  std::optional<std::vector<double>> capacity_per_s;  ///< of each exit
  std::string capacity_pointer;                       ///< JSON pointer of capacity_per_s
};

struct CaseDocument {
  std::string id;
  std::string title;     ///< "": the id
  std::string scenario;  ///< id
  std::vector<std::string> closed_exits;
  nlohmann::json crowd;           ///< as in a job; null: none
  std::optional<double> alarm_s;  ///< none: the scenario's
  double duration_s = 900;
  ReferenceDocument reference;
};

struct PolicyDocument {
  std::string id;
  std::string title;      ///< "": the id
  nlohmann::json drones;  ///< as in a job; null: none
};

struct StudyDocument {
  std::string name = "study";
  std::uint64_t seed = 1;
  int runs = 24;                             ///< of each case and policy
  std::optional<std::string> baseline;       ///< id of a policy
  std::optional<std::string> baseline_case;  ///< id of a case
  /// The two times up to which restricted means are taken (s from the alarm).
  std::optional<std::array<double, 2>> horizons_s;
  std::vector<CaseDocument> cases;
  std::optional<std::vector<PolicyDocument>> policies;
};

/// Reads the fields of a study. Adds a problem with its JSON pointer for each mistake; `source`
/// names the document in problems. Names of scenarios and exits, and the fields of jobs, are not
/// checked.
StudyDocument read_study_document(const nlohmann::json& document, const std::string& source,
                                  std::vector<Problem>& problems);

/// The JSON Schema of a study. "crowd" of a case and "drones" of a policy have the schemas that are
/// given: those of a job.
nlohmann::ordered_json study_schema(nlohmann::ordered_json crowd, nlohmann::ordered_json drones);

}  // namespace throng::study
