#include "places/imports/sdf/sdf_names.h"

#include <fmt/core.h>
#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "places/imports/sdf/included_files.h"

namespace throng::imports {

namespace {

using tinyxml2::XMLElement;

struct Named {
  const XMLElement* element;
  std::string name;
};

/// Siblings of one group must not have the same name.
std::string find_group(std::string_view parent, std::string_view element) {
  constexpr std::array<std::string_view, 4> kEntities = {"model", "include", "light", "actor"};
  const bool is_entity = std::find(kEntities.begin(), kEntities.end(), element) != kEntities.end();
  if ((parent == "world" || parent == "model") && is_entity) return "entity";
  const bool is_part = (parent == "model" && element == "link") ||
                       (parent == "link" && (element == "visual" || element == "collision"));
  return is_part ? std::string(element) : "";
}

class NameWalk {
 public:
  NameWalk(SdfText& text, const std::filesystem::path& file, const LocalFiles& files)
      : text_(text), file_(file), files_(files) {}

  void run() {
    tinyxml2::XMLDocument document;
    if (document.Parse(text_.text().data(), text_.text().size()) != tinyxml2::XML_SUCCESS) return;
    if (document.RootElement() != nullptr) visit(*document.RootElement());
    for (const Change& change : changes_) {
      if (change.of_include) {
        text_.set_name_element(change.line, change.name);
      } else {
        text_.set_name_attribute(change.line, change.name);
      }
    }
  }

 private:
  struct Change {
    int line;
    std::string name;
    bool of_include;
  };

  std::string name_of(const XMLElement& element) const {
    if (std::string_view(element.Name()) != "include") {
      const char* name = element.Attribute("name");
      return name == nullptr ? "" : name;
    }
    if (element.BoolAttribute("merge", false)) return "";
    const XMLElement* own = element.FirstChildElement("name");
    if (own != nullptr && own->GetText() != nullptr) return own->GetText();
    const XMLElement* uri = element.FirstChildElement("uri");
    if (uri == nullptr || uri->GetText() == nullptr) return "";
    return included_name(uri->GetText(), file_, files_);
  }

  void visit(const XMLElement& parent) {
    std::map<std::string, std::vector<Named>> groups;
    for (auto* child = parent.FirstChildElement(); child; child = child->NextSiblingElement()) {
      const std::string group = find_group(parent.Name(), child->Name());
      if (!group.empty()) groups[group].push_back({child, name_of(*child)});
      const std::string_view kind = child->Name();
      if (kind == "world" || kind == "model" || kind == "link") visit(*child);
    }
    for (const auto& [group, siblings] : groups) rename(siblings);
  }

  void rename(const std::vector<Named>& siblings) {
    std::set<std::string> all;
    for (const Named& one : siblings) all.insert(one.name);
    std::set<std::string> seen;
    for (const Named& one : siblings) {
      if (one.name.empty() || seen.insert(one.name).second) continue;
      std::string name = one.name;
      for (int i = 0; all.contains(name); ++i) name = fmt::format("{}_{}", one.name, i);
      all.insert(name);
      const bool is_include = std::string_view(one.element->Name()) == "include";
      changes_.push_back({one.element->GetLineNum(), name, is_include});
    }
  }

  SdfText& text_;
  const std::filesystem::path& file_;
  const LocalFiles& files_;
  std::vector<Change> changes_;
};

}  // namespace

void make_names_unique(SdfText& text, const std::filesystem::path& file, const LocalFiles& files) {
  NameWalk(text, file, files).run();
}

}  // namespace throng::imports
