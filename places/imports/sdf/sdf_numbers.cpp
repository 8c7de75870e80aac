#include "places/imports/sdf/sdf_numbers.h"

#include <fmt/core.h>
#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

namespace throng::imports {

namespace {

constexpr std::string_view kBlanks = " \t\r\n";

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string one_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    const bool blank = kBlanks.find(c) != std::string_view::npos;
    if (!blank) line += c;
    if (blank && !line.empty() && line.back() != ' ') line += ' ';
  }
  if (line.ends_with(' ')) line.pop_back();
  return line;
}

/// Whether text consists of numbers only, some of them with commas.
bool has_number_commas(std::string_view text) {
  constexpr std::string_view kOfNumbers = "0123456789+-.,eE \t\r\n";
  return text.find(',') != std::string_view::npos &&
         text.find_first_not_of(kOfNumbers) == std::string_view::npos &&
         std::any_of(text.begin(), text.end(), is_digit);
}

/// The numbers with points, if each of them has one comma at most, between digits.
std::string with_points(const std::string& text) {
  std::string points = text;
  for (std::size_t at = points.find(','); at != std::string::npos; at = points.find(',', at + 1)) {
    const bool inside = at > 0 && at + 1 < points.size() && is_digit(points[at + 1]);
    const std::size_t end = std::min(points.find(' ', at), points.size());
    const std::string_view rest = std::string_view(points).substr(at + 1, end - at - 1);
    if (!inside || rest.find_first_of(",.") != std::string_view::npos) return "";
    points[at] = '.';
  }
  return points;
}

/// Whether a text consists of numbers with blanks between; infinite ones are refused later.
bool is_numbers(std::string_view text) {
  for (std::size_t at = text.find_first_not_of(kBlanks); at < text.size();
       at = text.find_first_not_of(kBlanks, at)) {
    const std::size_t end = std::min(text.find_first_of(kBlanks, at), text.size());
    std::string_view token = text.substr(at, end - at);
    if (token.starts_with('+')) token.remove_prefix(1);
    double value = 0;
    const auto [rest, error] = std::from_chars(token.data(), token.data() + token.size(), value);
    if (error == std::errc::invalid_argument || rest != token.data() + token.size()) return false;
    at = end;
  }
  return true;
}

bool holds_meters(std::string_view name) {
  constexpr std::array<std::string_view, 9> kNames = {"pose",  "size",  "radius", "length", "scale",
                                                      "radii", "point", "normal", "height"};
  return std::find(kNames.begin(), kNames.end(), name) != kNames.end();
}

bool holds_words(std::string_view name) {
  constexpr std::array<std::string_view, 10> kWords = {
      "name",   "uri",   "filename",    "type",   "topic",
      "parent", "child", "description", "author", "plugin"};
  return name.find(':') != std::string_view::npos ||
         std::find(kWords.begin(), kWords.end(), name) != kWords.end();
}

std::string element_path(const tinyxml2::XMLElement& element) {
  std::string path = fmt::format("<{}>", element.Name());
  for (const auto* node = element.Parent(); node != nullptr; node = node->Parent()) {
    const tinyxml2::XMLElement* holder = node->ToElement();
    const char* name = holder == nullptr ? nullptr : holder->Attribute("name");
    if (name == nullptr) continue;
    if (std::string_view(holder->Name()) == "world") break;
    path = fmt::format("{} {}/{}", holder->Name(), name, path);
  }
  return path;
}

Problem comma_problem(const tinyxml2::XMLElement& element, const std::string& file,
                      const std::string& of, const char* text) {
  const std::string found = one_line(text);
  const std::string points = with_points(found);
  const std::string expected = "decimal points, and blanks between numbers";
  return {file, fmt::format("line {}", element.GetLineNum()),
          fmt::format("{}{}: \"{}\"", of, element_path(element), found),
          points.empty() ? expected : fmt::format("{}: \"{}\"", expected, points)};
}

}  // namespace

void find_number_commas(const tinyxml2::XMLElement& element, const std::string& file,
                        std::vector<Problem>& problems) {
  if (holds_words(element.Name())) return;
  for (const auto* one = element.FirstAttribute(); one != nullptr; one = one->Next()) {
    if (holds_words(one->Name()) || !has_number_commas(one->Value())) continue;
    problems.push_back(
        comma_problem(element, file, fmt::format("attribute {} of ", one->Name()), one->Value()));
  }
  const char* const text = element.GetText();
  if (text != nullptr && has_number_commas(text)) {
    problems.push_back(comma_problem(element, file, "", text));
  }
  for (const auto* child = element.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    find_number_commas(*child, file, problems);
  }
}

OddNumber find_odd_number(const tinyxml2::XMLElement& element) {
  if (holds_words(element.Name())) return {};
  const char* const text = element.GetText();
  const bool is_leaf = element.FirstChildElement() == nullptr;
  if (is_leaf && text != nullptr && holds_meters(element.Name()) && !is_numbers(text)) {
    return {element.GetLineNum(), fmt::format("<{}>", element.Name()), one_line(text)};
  }
  for (const auto* child = element.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    OddNumber found = find_odd_number(*child);
    if (found.line > 0) return found;
  }
  return {};
}

}  // namespace throng::imports
