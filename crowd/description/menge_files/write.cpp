#include "crowd/description/menge_files/write.h"

#include <fmt/core.h>
#include <tinyxml2.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "base/error.h"
#include "base/text/markup.h"
#include "base/text/utf8.h"

namespace throng::crowd {

namespace {

/// Indents by two spaces.
class Printer : public tinyxml2::XMLPrinter {
 public:
  Printer() {
    // Not its own escapes, which leave line ends in values to readers that normalize them.
    const tinyxml2::XMLDocument without_entities(false);
    VisitEnter(without_entities);
  }

 protected:
  void PrintSpace(int depth) override { Print("%*s", 2 * depth, ""); }
};

/// Whether tinyxml2 reads it as a name (XML 1.0, production 5, for ASCII).
bool is_name(const std::string& name) {
  const auto begins = [](unsigned char c) {
    return std::isalpha(c) != 0 || c >= 0x80 || c == '_' || c == ':';
  };
  const auto continues = [&](unsigned char c) {
    return begins(c) || std::isdigit(c) != 0 || c == '-' || c == '.';
  };
  return !name.empty() && begins(static_cast<unsigned char>(name.front())) &&
         std::all_of(name.begin(), name.end(), continues);
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : escaped_markup(text)) {
    if (static_cast<unsigned char>(c) < ' ') {
      out += fmt::format("&#{};", static_cast<int>(c));
    } else {
      out += c;
    }
  }
  return out;
}

/// A comment cannot hold two hyphens in a row, nor end with one.
std::string comment_text(std::string text) {
  for (std::size_t at = text.find("--"); at != std::string::npos; at = text.find("--", at)) {
    text.insert(at + 1, " ");
  }
  return " " + text + " ";
}

/// Points and the like, which stand beside each other on one line.
bool is_compact(const Node& node) {
  return !node.children.empty() &&
         std::all_of(node.children.begin(), node.children.end(), [](const Node& child) {
           return child.children.empty() && child.comment.empty() &&
                  (child.name == "Vertex" || child.name == "At");
         });
}

class Writer {
 public:
  explicit Writer(const Description& description) : description_(&description) {}

  std::string write() {
    printer_.PushHeader(false, true);
    add(description_->root, false);
    return printer_.CStr();
  }

 private:
  void add(const Node& node, bool on_line_of_parent) {
    require_names(node);
    if (!node.comment.empty()) printer_.PushComment(comment_text(node.comment).c_str());
    printer_.OpenElement(node.name.c_str(), on_line_of_parent);
    for (const Attribute& attribute : node.attributes) {
      printer_.PushAttribute(attribute.name.c_str(), escaped(attribute.value).c_str());
    }
    const bool compact = is_compact(node);
    for (const Node& child : node.children) add(child, compact);
    printer_.CloseElement(compact);
  }

  [[noreturn]] void refuse(const Node& node, std::string found, std::string expected) const {
    throw InputError(Problem{description_->name, fmt::format("element <{}>", node.name),
                             std::move(found), std::move(expected)});
  }

  void require_names(const Node& node) const {
    const std::string names = "a name of letters, digits, '_', '-', '.' and ':'";
    if (!is_name(node.name)) refuse(node, fmt::format("the name \"{}\"", node.name), names);
    std::set<std::string_view> known;
    for (const Attribute& attribute : node.attributes) {
      if (!is_name(attribute.name)) {
        refuse(node, fmt::format("an attribute \"{}\"", attribute.name), names);
      }
      if (attribute.value.find('\0') != std::string::npos) {
        refuse(node, fmt::format("a character 0 in \"{}\"", attribute.name), "other characters");
      }
      if (find_invalid_utf8(attribute.value) != std::string::npos) {
        refuse(node, fmt::format("bytes in \"{}\" that are not UTF-8", attribute.name), "UTF-8");
      }
      if (!known.insert(attribute.name).second) {
        refuse(node, fmt::format("the attribute \"{}\" twice", attribute.name),
               "each of them once");
      }
    }
  }

  const Description* description_;
  Printer printer_;
};

}  // namespace

std::string to_xml(const Description& description) { return Writer(description).write(); }

}  // namespace throng::crowd
