#include "places/imports/sdf/model_finder.h"

#include <console_bridge/console.h>

#include <sdf/sdf.hh>
#include <string>
#include <utility>

namespace throng::imports {

ModelFinder::ModelFinder(const LocalFiles& files, std::filesystem::path file) {
  const auto find = [&files, file = std::move(file)](const std::string& uri) -> std::string {
    const auto found = files.find(uri, file);
    return found ? found->string() : "";
  };
  sdf::Console::Instance()->SetQuiet(true);
  console_bridge::noOutputHandler();  // by which the parser of URDF, which it tries next, complains
  config_.SetFindCallback(find);
  sdf::setFindCallback(find);
}

ModelFinder::~ModelFinder() { sdf::setFindCallback(nullptr); }

}  // namespace throng::imports
