#include "formats/dataset/joints.h"

#include <fmt/format.h>

#include "base/error.h"
#include "formats/files/json_vectors.h"

namespace throng::formats {

using nlohmann::json;

namespace {

const json& find_list(const json& record, const char* key, std::size_t size) {
  const auto found = record.find(key);
  if (found != record.end() && found->size() == size) return *found;
  const std::size_t has = found == record.end() ? 0 : found->size();
  throw InputError({"", fmt::format("annotation {}/{}", record.value("id", 0), key),
                    fmt::format("{} values", has), fmt::format("{} values", size)});
}

}  // namespace

std::vector<JointInImage> read_joints(const json& record) {
  const json& values = find_list(record, "joints", 3 * skinning::kJointCount);
  std::vector<JointInImage> joints;
  for (std::size_t i = 0; i < values.size(); i += 3) {
    joints.push_back(
        {{values[i].get<double>(), values[i + 1].get<double>()}, values[i + 2].get<int>()});
  }
  return joints;
}

std::vector<Eigen::Vector3d> read_joints_3d(const json& record) {
  std::vector<Eigen::Vector3d> joints;
  for (const json& place : find_list(record, "joints_3d", skinning::kJointCount)) {
    joints.push_back(numbers_at<3>(place));
  }
  return joints;
}

}  // namespace throng::formats
