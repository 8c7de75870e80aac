#include "jobs/queue/confine/checked_scenarios.h"

#include "base/json/problem_json.h"

namespace throng::jobs {

using nlohmann::json;

void to_json(json& value, const CheckedScenarios& checked) {
  json findings = json::array();
  for (const ScenarioFinding& finding : checked.findings) {
    findings.push_back(
        {{"is_error", finding.is_error}, {"problem", finding.problem}, {"remedy", finding.remedy}});
  }
  value = {
      {"ids", checked.ids}, {"findings", std::move(findings)}, {"summaries", checked.summaries}};
}

void from_json(const json& value, CheckedScenarios& checked) {
  value.at("ids").get_to(checked.ids);
  value.at("summaries").get_to(checked.summaries);
  checked.findings.clear();
  for (const json& finding : value.at("findings")) {
    checked.findings.push_back(
        {finding.at("is_error"), finding.at("problem").get<Problem>(), finding.at("remedy")});
  }
}

}  // namespace throng::jobs
