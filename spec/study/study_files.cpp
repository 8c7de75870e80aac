#include "spec/study/study_files.h"

#include <fmt/core.h>

namespace throng::study {

StudyRun StudySize::at(std::size_t number) const {
  const std::size_t of_pair = number % (cases * policies);
  return {of_pair / policies, of_pair % policies, static_cast<int>(number / (cases * policies))};
}

std::filesystem::path result_file(const std::string& case_id, const std::string& policy_id,
                                  int run) {
  return std::filesystem::path("runs") / case_id / policy_id / fmt::format("{:03d}.json", run);
}

}  // namespace throng::study
