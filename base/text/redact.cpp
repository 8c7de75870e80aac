#include "base/text/redact.h"

namespace throng {

namespace {

void remove_all(std::string& text, const std::string& what) {
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at)) {
    text.erase(at, what.size());
  }
}

}  // namespace

std::string without_folders(std::string text, const std::vector<std::filesystem::path>& folders) {
  for (const std::filesystem::path& folder : folders) {
    if (folder.empty()) continue;
    remove_all(text, std::filesystem::absolute(folder).lexically_normal().string() + "/");
    remove_all(text, folder.string() + "/");
  }
  return text;
}

}  // namespace throng
