#include "crowd/description/menge_files/read.h"

#include <fmt/core.h>
#include <tinyxml2.h>

#include <algorithm>

#include "base/error.h"
#include "base/files/files.h"
#include "base/text/utf8.h"

namespace throng::crowd {

namespace fs = std::filesystem;

namespace {

std::string from_latin1(std::string_view text) {
  std::string utf8;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (code >= 0x80) utf8 += static_cast<char>(0xC0U | (code >> 6U));
    utf8 += static_cast<char>(code >= 0x80 ? 0x80U | (code & 0x3FU) : code);
  }
  return utf8;
}

std::string line_text(std::string_view text, std::size_t position) {
  return fmt::format("line {}", 1 + std::count(text.begin(), text.begin() + position, '\n'));
}

/// The file's text in UTF-8, which names and messages are written in.
std::string read_text(const fs::path& file, Description& read) {
  std::string text = read_file(file);
  if (const std::size_t at = text.find('\0'); at != std::string::npos) {
    throw InputError(Problem{read.name, line_text(text, at), "a byte of value 0", "text in UTF-8"});
  }
  const std::size_t at = find_invalid_utf8(text);
  if (at == std::string_view::npos) return text;
  read.warnings.push_back({read.name, line_text(text, at),
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

/// Without the blanks at its ends.
std::string comment_text(const char* text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const std::string_view all = text;
  const std::size_t from = all.find_first_not_of(kBlanks);
  if (from == std::string_view::npos) return "";
  return std::string(all.substr(from, all.find_last_not_of(kBlanks) + 1 - from));
}

/// The element, and `comment` before it.
Node to_node(const tinyxml2::XMLElement& element, std::string comment) {
  Node node(element.Name());
  node.line = element.GetLineNum();
  node.comment = std::move(comment);
  for (const auto* a = element.FirstAttribute(); a != nullptr; a = a->Next()) {
    node.attributes.emplace_back(a->Name(), a->Value());
  }
  std::string next_comment;
  for (const auto* child = element.FirstChild(); child != nullptr; child = child->NextSibling()) {
    if (child->ToComment() != nullptr) {
      next_comment += (next_comment.empty() ? "" : "\n") + comment_text(child->Value());
    } else if (child->ToElement() != nullptr) {
      node.children.push_back(to_node(*child->ToElement(), std::move(next_comment)));
      next_comment.clear();
    }
  }
  return node;
}

std::string comment_before(const tinyxml2::XMLNode& root) {
  const tinyxml2::XMLNode* before = root.PreviousSibling();
  return before != nullptr && before->ToComment() != nullptr ? comment_text(before->Value()) : "";
}

}  // namespace

Description read_description(const fs::path& file, std::string_view root_name) {
  Description read{Node(std::string(root_name)), file.filename().string(), file.parent_path()};
  const std::string text = read_text(file, read);
  if (const std::size_t at = text.find("<!ENTITY"); at != std::string::npos) {
    throw InputError(Problem{read.name, line_text(text, at), "a declaration of an entity",
                             "text that is written out: entities may grow without end"});
  }
  tinyxml2::XMLDocument document;
  const tinyxml2::XMLError error = document.Parse(text.data(), text.size());
  if (error != tinyxml2::XML_SUCCESS) {
    throw InputError(Problem{read.name,
                             fmt::format("line {}", std::max(1, document.ErrorLineNum())),
                             std::string(in_words(error)), "well-formed XML"});
  }
  const tinyxml2::XMLElement* root = document.RootElement();
  if (root == nullptr) {
    throw InputError(
        Problem{read.name, "line 1", "no element", fmt::format("a root element <{}>", root_name)});
  }
  read.root = to_node(*root, comment_before(*root));
  return read;
}

SceneDescription read_scene(const fs::path& file) {
  return SceneDescription(read_description(file, "Experiment"));
}

BehaviorDescription read_behavior(const fs::path& file) {
  return BehaviorDescription(read_description(file, "BFSM"));
}

}  // namespace throng::crowd
