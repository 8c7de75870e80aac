// Text in XML, HTML and Markdown.
#pragma once

#include <string>
#include <string_view>

namespace throng {

/// Escapes the five special characters of XML and HTML.
inline std::string escaped_markup(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&apos;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

/// Escapes what Markdown and HTML in it take for more than text, for one line of Markdown.
inline std::string escaped_markdown(std::string_view text) {
  std::string escaped;
  for (const char c : escaped_markup(text)) {
    constexpr std::string_view kMarks = "\\`*_[]|~#!$";
    if (kMarks.find(c) != std::string_view::npos) escaped += '\\';
    escaped += c;
  }
  return escaped;
}

}  // namespace throng
