#include "crowd/xml.h"

#include <fmt/core.h>
#include <tinyxml2.h>

#include <algorithm>
#include <iterator>

#include "base/confine.h"
#include "base/files.h"
#include "crowd/suggest.h"

namespace throng::crowd {

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kLongestShown = 60;
  std::string out = "\"";
  for (const char c : text.substr(0, kLongestShown)) out += (c >= ' ' && c <= '~') ? c : '?';
  if (text.size() > kLongestShown) out += "...";
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
  std::string found = "an element that is not known here";
  found += did_you_mean(name(), names_in_brackets(expected));
  fail(std::move(found), std::move(expected));
}

void Element::warn(std::string found, std::string expected) const {
  add_warning(problem(std::move(found), std::move(expected)));
}

void Element::warn_attribute(std::string_view attribute, std::string found,
                             std::string expected) const {
  add_warning(attribute_problem(attribute, std::move(found), std::move(expected)));
}

/// Once, also of an element that is read several times in a row.
void Element::add_warning(Problem warning) const {
  constexpr std::ptrdiff_t kInARow = 64;
  std::vector<Problem>& all = source_->warnings;
  const auto last = all.end() - std::min(kInARow, std::ssize(all));
  const bool is_known = std::any_of(last, all.end(), [&](const Problem& known) {
    return known.where == warning.where && known.found == warning.found;
  });
  if (!is_known) all.push_back(std::move(warning));
}

std::filesystem::path Element::file_beside(std::string_view file_name) const {
  std::filesystem::path path = source_->path.parent_path() / file_name;
  if (!Confinement::allows(path)) {
    fail(fmt::format("the file {}, which lies elsewhere", in_quotes(file_name)),
         "a file that came with the scenario");
  }
  return path;
}

namespace {

/// How many bytes of `text` are a character in UTF-8 (RFC 3629): 0 when it begins with none.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
  };
  const auto continues = [&](std::size_t i) { return (byte(i) & 0xC0U) == 0x80U; };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return continues(1) ? 2 : 0;
  if (first >= 0xE0 && first <= 0xEF) {
    const bool overlong = first == 0xE0 && byte(1) < 0xA0;
    const bool surrogate = first == 0xED && byte(1) > 0x9F;
    return !overlong && !surrogate && continues(1) && continues(2) ? 3 : 0;
  }
  if (first >= 0xF0 && first <= 0xF4) {
    const bool overlong = first == 0xF0 && byte(1) < 0x90;
    const bool too_high = first == 0xF4 && byte(1) > 0x8F;
    return !overlong && !too_high && continues(1) && continues(2) && continues(3) ? 4 : 0;
  }
  return 0;
}

/// Where the first byte is that is no UTF-8; npos when there is none.
std::size_t find_no_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text.substr(i));
    if (length == 0) return i;
    i += length;
  }
  return std::string_view::npos;
}

std::string from_latin1(std::string_view text) {
  std::string utf8;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (code >= 0x80) utf8 += static_cast<char>(0xC0U | (code >> 6U));
    utf8 += static_cast<char>(code >= 0x80 ? 0x80U | (code & 0x3FU) : code);
  }
  return utf8;
}

std::string line_of(std::string_view text, std::size_t position) {
  return fmt::format("line {}", 1 + std::count(text.begin(), text.begin() + position, '\n'));
}

/// The file's text in UTF-8, which names and messages are written in.
std::string read_text(XmlSource& source) {
  std::string text = read_file(source.path);
  if (const std::size_t at = text.find('\0'); at != std::string::npos) {
    throw InputError(Problem{source.name, line_of(text, at), "a byte of value 0", "text in UTF-8"});
  }
  const std::size_t at = find_no_utf8(text);
  if (at == std::string_view::npos) return text;
  source.warnings.push_back({source.name, line_of(text, at),
                             "text that is not UTF-8, which is read as Latin-1", "UTF-8"});
  return from_latin1(text);
}

std::string_view in_words(tinyxml2::XMLError error) {
  switch (error) {
    case tinyxml2::XML_ERROR_EMPTY_DOCUMENT:
      return "no element";
    case tinyxml2::XML_ERROR_PARSING_ATTRIBUTE:
      return "an attribute without quotes or twice";
    case tinyxml2::XML_ERROR_MISMATCHED_ELEMENT:
      return "an element that another one ends";
    case tinyxml2::XML_ERROR_PARSING_COMMENT:
      return "a comment without an end";
    case tinyxml2::XML_ERROR_PARSING_TEXT:
      return "text outside of elements";
    case tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED:
      return "elements nested too deep";
    default:
      return "text that cannot be parsed";
  }
}

}  // namespace

XmlFile::XmlFile(const std::filesystem::path& path, std::string_view root_name)
    : source_(std::make_unique<XmlSource>(XmlSource{path, path.filename().string(), {}, false})),
      document_(std::make_unique<tinyxml2::XMLDocument>()) {
  const std::string text = read_text(*source_);
  if (const std::size_t at = text.find("<!ENTITY"); at != std::string::npos) {
    throw InputError(Problem{source_->name, line_of(text, at), "a declaration of an entity",
                             "text that is written out: entities may grow without end"});
  }
  const tinyxml2::XMLError error = document_->Parse(text.data(), text.size());
  if (error != tinyxml2::XML_SUCCESS) {
    throw InputError(Problem{source_->name,
                             fmt::format("line {}", std::max(1, document_->ErrorLineNum())),
                             std::string(in_words(error)), "well-formed XML"});
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
