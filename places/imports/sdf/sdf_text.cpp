#include "places/imports/sdf/sdf_text.h"

#include <fmt/core.h>
#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "places/imports/parts/xml_words.h"

namespace throng::imports {

namespace {

// The end of a tag; greater-than signs may stand in quotes.
std::size_t end_of_tag(const std::string& text, std::size_t at) {
  char quote = 0;
  for (; at < text.size(); ++at) {
    const char c = text[at];
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '>') {
      return at + 1;
    }
  }
  return text.size();
}

std::size_t after(const std::string& text, std::string_view mark, std::size_t from) {
  const std::size_t found = text.find(mark, from);
  return found == std::string::npos ? text.size() : found + mark.size();
}

std::string attribute_name_in(const std::string& tag) {
  for (const std::string_view mark : {" name=\"", " name='"}) {
    const std::size_t at = tag.find(mark);
    if (at == std::string::npos) continue;
    const std::size_t begin = at + mark.size();
    const std::size_t end = tag.find(mark.back(), begin);
    if (end != std::string::npos) return tag.substr(begin, end - begin);
  }
  return "";
}

std::string without_line_ends(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::string escaped(const std::string& name) {
  std::string text;
  for (const char c : name) {
    switch (c) {
      case '&':
        text += "&amp;";
        break;
      case '<':
        text += "&lt;";
        break;
      case '"':
        text += "&quot;";
        break;
      case '\'':
        text += "&apos;";
        break;
      default:
        text += c;
    }
  }
  return text;
}

bool holds_parts(const std::string& name) {
  constexpr std::array<std::string_view, 4> kHolders = {"sdf", "world", "model", "link"};
  return std::find(kHolders.begin(), kHolders.end(), name) != kHolders.end();
}

}  // namespace

SdfText::SdfText(const std::string& name, const std::string& text) {
  int line = 1;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = std::min(text.find('<', at), text.size());
    if (end > at) {
      text_ += without_line_ends(text.substr(at, end - at));
    } else if (text.compare(at, 4, "<!--") == 0) {
      end = after(text, "-->", at);
    } else if (text.compare(at, 9, "<![CDATA[") == 0) {
      end = after(text, "]]>", at);
      text_ += without_line_ends(text.substr(at, end - at));
    } else if (text.compare(at, 2, "<?") == 0) {
      end = after(text, "?>", at);
    } else {
      end = end_of_tag(text, at);
      add_tag(without_line_ends(text.substr(at, end - at)), line);
    }
    line += static_cast<int>(std::count(text.begin() + static_cast<std::ptrdiff_t>(at),
                                        text.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
    at = end;
  }
  tinyxml2::XMLDocument document;
  if (document.Parse(text_.data(), text_.size()) != tinyxml2::XML_SUCCESS) {
    throw InputError({name, fmt::format("line {}", line_of(document.ErrorLineNum())),
                      tinyxml_fault(document.ErrorID()), "a world of SDF (XML)"});
  }
  const char* root = document.RootElement() == nullptr ? "" : document.RootElement()->Name();
  if (std::string_view(root) != "sdf") {
    throw InputError({name, fmt::format("line {}", elements_.empty() ? 1 : elements_.front().line),
                      fmt::format("<{}>", root),
                      "<sdf>: a world of SDF 1.3 or later (URDF and Gazebo's older worlds are "
                      "converted by `gz sdf`)"});
  }
}

void SdfText::add_tag(const std::string& tag, int line) {
  if (tag.starts_with("<!")) return;
  if (tag.starts_with("</")) {
    text_ += tag;
    return close();
  }
  text_ += '\n';
  const std::size_t name_end = std::min(tag.find_first_of(" \t\r/>"), tag.size());
  Element element{tag.substr(1, name_end - 1), "", text_.size(), 0, line, open_};
  const std::string called = attribute_name_in(tag);
  element.label = called.empty() ? fmt::format("<{}>", element.name)
                                 : fmt::format("{} {}", element.name, called);
  text_ += tag;
  elements_.push_back(std::move(element));
  open_ = static_cast<int>(elements_.size()) - 1;
  if (tag.ends_with("/>")) close();
}

void SdfText::close() {
  if (open_ < 0) return;  // not well formed
  Element& element = elements_[static_cast<std::size_t>(open_)];
  element.end = text_.size();
  open_ = element.parent;
}

int SdfText::line_of(int line) const {
  if (elements_.empty()) return 1;
  const int last = static_cast<int>(elements_.size());
  return elements_[static_cast<std::size_t>(std::clamp(line - 1, 1, last) - 1)].line;
}

std::string SdfText::path_of(int element) const {
  std::string path;
  for (int at = element; at >= 0; at = elements_[static_cast<std::size_t>(at)].parent) {
    const Element& one = elements_[static_cast<std::size_t>(at)];
    if (one.name == "world" || one.name == "sdf") break;
    path = path.empty() ? one.label : one.label + "/" + path;
  }
  return path;
}

const SdfText::Element* SdfText::element_at(int line) const {
  const int index = line - 2;
  if (index < 0 || index >= static_cast<int>(elements_.size())) return nullptr;
  return &elements_[static_cast<std::size_t>(index)];
}

std::string SdfText::label_at(int line) const {
  return element_at(line) == nullptr ? "" : path_of(line - 2);
}

std::string SdfText::value_at(int line) const {
  const Element* element = element_at(line);
  if (element == nullptr) return "";
  const std::size_t begin = end_of_tag(text_, element->begin);
  const std::size_t end = std::min(text_.find('<', begin), text_.size());
  constexpr std::size_t kMaxShown = 60;
  const std::string value = text_.substr(begin, end - begin);
  const std::size_t first = value.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return "";
  return value.substr(first, std::min(value.find_last_not_of(" \t\r\n") + 1 - first, kMaxShown));
}

void SdfText::replace(std::size_t at, std::size_t count, const std::string& with) {
  text_.replace(at, count, with);
  for (Element& element : elements_) {
    if (element.begin >= at + count) element.begin += with.size() - count;
    if (element.end >= at + count) element.end += with.size() - count;
  }
}

void SdfText::set_name_attribute(int line, const std::string& name) {
  const Element* element = element_at(line);
  if (element == nullptr) return;
  const std::size_t end = end_of_tag(text_, element->begin);
  for (const std::string_view mark : {" name=\"", " name='"}) {
    const std::size_t at = text_.find(mark, element->begin);
    if (at >= end) continue;
    const std::size_t begin = at + mark.size();
    return replace(begin, text_.find(mark.back(), begin) - begin, escaped(name));
  }
}

void SdfText::set_name_element(int line, const std::string& name) {
  const Element* element = element_at(line);
  if (element == nullptr) return;
  const auto child = std::find_if(elements_.begin(), elements_.end(), [&](const Element& one) {
    return one.parent == line - 2 && one.name == "name";
  });
  if (child == elements_.end()) {
    return replace(end_of_tag(text_, element->begin), 0,
                   fmt::format("<name>{}</name>", escaped(name)));
  }
  const std::size_t begin = end_of_tag(text_, child->begin);
  replace(begin, std::min(text_.find('<', begin), text_.size()) - begin, escaped(name));
}

std::optional<SdfText::Part> SdfText::take_out(int line) {
  int at = line - 2;
  if (at < 0 || at >= static_cast<int>(elements_.size())) return std::nullopt;
  // Without its pose a body would be elsewhere.
  for (;;) {
    const Element& element = elements_[static_cast<std::size_t>(at)];
    if (element.parent < 0) return std::nullopt;
    const Element& holder = elements_[static_cast<std::size_t>(element.parent)];
    if (holds_parts(holder.name) && element.name != "pose" && element.name != "static") break;
    at = element.parent;
  }
  const Element& part = elements_[static_cast<std::size_t>(at)];
  const bool whole =
      part.name == "world" || elements_[static_cast<std::size_t>(part.parent)].name == "sdf";
  if (whole || part.end <= part.begin) return std::nullopt;
  for (std::size_t i = part.begin; i < part.end; ++i) {
    if (text_[i] != '\n') text_[i] = ' ';
  }
  return Part{path_of(at), part.line};
}

}  // namespace throng::imports
