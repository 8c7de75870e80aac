#include "world/imports/gazebo/model_finder.h"

#include <sdf/sdf.hh>
#include <string>
#include <utility>

namespace throng::imports {

ModelFinder::ModelFinder(const LocalFiles& files, std::filesystem::path file) {
  const auto find = [&files, file = std::move(file)](const std::string& uri) -> std::string {
    const auto found = files.find(uri, file);
    return found ? found->string() : "";
  };
  config_.SetFindCallback(find);
  sdf::setFindCallback(find);
}

ModelFinder::~ModelFinder() { sdf::setFindCallback(nullptr); }

}  // namespace throng::imports
