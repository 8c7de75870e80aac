#include "places/imports/sdf/included_files.h"

#include <fmt/core.h>
#include <tinyxml2.h>

#include <algorithm>
#include <optional>
#include <sdf/sdf.hh>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"
#include "places/imports/sdf/sdf_numbers.h"

namespace throng::imports {

namespace fs = std::filesystem;

namespace {

/// The file of a model, whose folder an <include> may name.
std::optional<fs::path> model_file(const std::string& uri, const fs::path& from,
                                   const LocalFiles& files) {
  const auto found = files.find(uri, from);
  if (!found || !fs::is_directory(*found)) return found;
  const std::string file = sdf::getModelFilePath(found->string());
  if (file.empty()) return std::nullopt;
  return fs::path(file);
}

class IncludeWalk {
 public:
  explicit IncludeWalk(const LocalFiles& files) : files_(files) {}

  void enter(const fs::path& file) {
    tinyxml2::XMLDocument document;
    if (document.LoadFile(file.c_str()) != tinyxml2::XML_SUCCESS) return;
    open_.push_back(file);
    if (document.RootElement() != nullptr) {
      find_number_commas(*document.RootElement(), file.string(), problems_);
    }
    visit(document.RootElement());
    open_.pop_back();
    done_.insert(file);
  }

  void reject() const {
    constexpr std::size_t kMaxProblems = 10;
    if (problems_.empty()) return;
    std::vector<Problem> first(
        problems_.begin(),
        problems_.begin() + static_cast<std::ptrdiff_t>(std::min(problems_.size(), kMaxProblems)));
    if (problems_.size() > kMaxProblems) {
      first.back().expected +=
          fmt::format(" ({} more numbers have commas)", problems_.size() - kMaxProblems);
    }
    throw InputError(std::move(first));
  }

 private:
  void visit(const tinyxml2::XMLElement* element) {
    if (element == nullptr) return;
    if (std::string_view(element->Name()) == "include") follow(*element);
    for (auto* child = element->FirstChildElement(); child; child = child->NextSiblingElement()) {
      visit(child);
    }
  }

  void follow(const tinyxml2::XMLElement& include) {
    const tinyxml2::XMLElement* uri = include.FirstChildElement("uri");
    if (uri == nullptr || uri->GetText() == nullptr) return;
    const auto file = model_file(uri->GetText(), open_.front(), files_);
    if (!file || done_.contains(*file)) return;
    if (std::find(open_.begin(), open_.end(), *file) != open_.end()) {
      throw InputError({open_.back().string(), fmt::format("line {}", uri->GetLineNum()),
                        fmt::format("<include> of {}, which includes this file", uri->GetText()),
                        "models that do not include themselves"});
    }
    enter(*file);
  }

  const LocalFiles& files_;
  std::vector<fs::path> open_;  ///< each includes the next
  std::set<fs::path> done_;
  std::vector<Problem> problems_;  ///< numbers with commas
};

}  // namespace

void check_included_files(const fs::path& file, const LocalFiles& files) {
  std::error_code error;
  const fs::path known = fs::canonical(file, error);
  IncludeWalk walk(files);
  walk.enter(error ? file : known);
  walk.reject();
}

std::string included_name(const std::string& uri, const fs::path& from, const LocalFiles& files) {
  const auto file = model_file(uri, from, files);
  tinyxml2::XMLDocument document;
  if (!file || document.LoadFile(file->c_str()) != tinyxml2::XML_SUCCESS) return "";
  const tinyxml2::XMLElement* root = document.RootElement();
  for (const char* kind : {"model", "light", "actor"}) {
    const auto* found = root == nullptr ? nullptr : root->FirstChildElement(kind);
    const char* name = found == nullptr ? nullptr : found->Attribute("name");
    if (name != nullptr) return name;
  }
  return "";
}

}  // namespace throng::imports
