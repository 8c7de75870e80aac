#include "crowd/xml.h"

#include <fmt/core.h>
#include <tinyxml2.h>

#include "base/files.h"

namespace throng::crowd {

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kLongest = 60;
  std::string out = "\"";
  for (const char c : text.substr(0, kLongest)) out += (c >= ' ' && c <= '~') ? c : '?';
  if (text.size() > kLongest) out += "...";
  return out + "\"";
}

std::string_view Element::name() const { return node_->Name(); }

std::vector<Element> Element::children() const {
  std::vector<Element> all;
  for (const auto* node = node_->FirstChildElement(); node != nullptr;
       node = node->NextSiblingElement()) {
    all.emplace_back(node, source_);
  }
  return all;
}

std::vector<std::pair<std::string_view, std::string_view>> Element::attributes() const {
  std::vector<std::pair<std::string_view, std::string_view>> all;
  for (const auto* a = node_->FirstAttribute(); a != nullptr; a = a->Next()) {
    all.emplace_back(a->Name(), a->Value());
  }
  return all;
}

std::optional<std::string_view> Element::attribute(std::string_view name) const {
  for (const auto& [key, value] : attributes()) {
    if (key == name) return value;
  }
  return std::nullopt;
}

Element Element::only_child(std::string_view expected) const {
  const std::vector<Element> all = children();
  if (all.size() != 1 || all.front().name() != expected) {
    fail(fmt::format("{} child elements{}", all.size(),
                     all.empty() ? "" : fmt::format(", the first <{}>", all.front().name())),
         fmt::format("exactly one <{}>", expected));
  }
  return all.front();
}

void Element::require_no_children() const {
  const std::vector<Element> all = children();
  if (!all.empty()) all.front().fail_unknown("no child element");
}

Problem Element::problem(std::string found, std::string expected) const {
  const std::string name_text = in_quotes(name());
  return {source_->name,
          fmt::format("line {}, element <{}>", node_->GetLineNum(),
                      name_text.substr(1, name_text.size() - 2)),
          std::move(found), std::move(expected)};
}

Problem Element::attribute_problem(std::string_view attribute, std::string found,
                                   std::string expected) const {
  Problem what = problem(std::move(found), std::move(expected));
  what.where += ", attribute " + in_quotes(attribute);
  return what;
}

void Element::fail(std::string found, std::string expected) const {
  throw InputError(problem(std::move(found), std::move(expected)));
}

void Element::fail_attribute(std::string_view attribute, std::string found,
                             std::string expected) const {
  throw InputError(attribute_problem(attribute, std::move(found), std::move(expected)));
}

void Element::fail_unknown(std::string expected) const {
  fail("an element that is not known here", std::move(expected));
}

void Element::warn(std::string found, std::string expected) const {
  source_->warnings.push_back(problem(std::move(found), std::move(expected)));
}

void Element::warn_attribute(std::string_view attribute, std::string found,
                             std::string expected) const {
  source_->warnings.push_back(attribute_problem(attribute, std::move(found), std::move(expected)));
}

std::filesystem::path Element::file_beside(std::string_view file_name) const {
  return source_->path.parent_path() / file_name;
}

XmlFile::XmlFile(const std::filesystem::path& path, std::string_view root_name)
    : source_(std::make_unique<XmlSource>(XmlSource{path, path.filename().string(), {}})),
      document_(std::make_unique<tinyxml2::XMLDocument>()) {
  const std::string text = read_file(path);
  if (document_->Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    throw InputError(Problem{
        source_->name, fmt::format("line {}", std::max(1, document_->ErrorLineNum())),
        fmt::format("text that cannot be parsed ({})", document_->ErrorName()), "well-formed XML"});
  }
  if (document_->RootElement() == nullptr) {
    throw InputError(Problem{source_->name, "line 1", "no element",
                             fmt::format("a root element <{}>", root_name)});
  }
  if (root().name() != root_name) root().fail_unknown(fmt::format("the root <{}>", root_name));
}

XmlFile::~XmlFile() = default;

Element XmlFile::root() const { return {document_->RootElement(), source_.get()}; }

}  // namespace throng::crowd
