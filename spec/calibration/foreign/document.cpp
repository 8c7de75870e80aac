#include "spec/calibration/foreign/document.h"

#include <fmt/core.h>
#include <tinyxml2.h>
#include <yaml-cpp/yaml.h>

#include <charconv>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/json/json_text.h"
#include "base/text/utf8.h"
#include "base/text/words.h"

namespace throng::calibrate {

using nlohmann::json;

namespace {

constexpr std::size_t kMaxBytes = 1 << 20;
constexpr int kMaxDepth = 32;
constexpr int kMaxValues = 100'000;

/// A number where the text is one as a whole. Comments and names of other programs may be in other
/// encodings.
json scalar(std::string_view text) {
  const std::string_view word = trimmed(text);
  double value = 0;
  const char* const end = word.data() + word.size();
  const char* const begin = word.data() + (word.starts_with('+') ? 1 : 0);
  const auto [rest, error] = std::from_chars(begin, end, value);
  if (word.empty() || error != std::errc() || rest != end) return with_valid_utf8(word);
  return value;
}

/// Counts values and levels, so that aliases cannot multiply without end.
class YamlReader {
 public:
  explicit YamlReader(const std::string& source) : source_(source) {}

  json value_of(const YAML::Node& node, int depth = 0) {
    if (depth > kMaxDepth || ++values_ > kMaxValues) {
      throw InputError(Problem{source_, "", "a document of too many values or levels",
                               fmt::format("at most {} values", kMaxValues)});
    }
    if (node.IsSequence()) {
      json list = json::array();
      for (const YAML::Node& element : node) list.push_back(value_of(element, depth + 1));
      return list;
    }
    if (node.IsMap()) {
      json object = json::object();
      for (const auto& entry : node) {
        if (!entry.first.IsScalar()) continue;
        object[with_valid_utf8(entry.first.Scalar())] = value_of(entry.second, depth + 1);
      }
      return object;
    }
    return node.IsScalar() ? scalar(node.Scalar()) : json(nullptr);
  }

 private:
  const std::string& source_;
  int values_ = 0;
};

json read_yaml(std::string_view text, const std::string& source) {
  // OpenCV's first line, "%YAML:1.0", is none of YAML's.
  if (text.starts_with("%YAML:")) text.remove_prefix(std::min(text.find('\n'), text.size()));
  try {
    return YamlReader(source).value_of(YAML::Load(std::string(text)));
  } catch (const YAML::Exception& error) {
    throw InputError(Problem{source, fmt::format("line {}", error.mark.line + 1),
                             "what is neither JSON nor YAML nor XML: " + error.msg,
                             "a camera file (docs/calibration.md)"});
  }
}

// OpenCV's lists of numbers are separated by blanks.
json text_of_element(const char* text) {
  if (text == nullptr) return nullptr;
  json list = json::array();
  std::string_view rest = trimmed(text);
  bool is_numbers = true;
  while (!rest.empty()) {
    const auto end = std::min(rest.find_first_of(" \t\r\n"), rest.size());
    list.push_back(scalar(rest.substr(0, end)));
    is_numbers = is_numbers && list.back().is_number();
    rest = trimmed(rest.substr(end));
  }
  if (list.size() == 1) return list[0];
  return is_numbers ? list : json(with_valid_utf8(trimmed(text)));
}

json value_of_element(const tinyxml2::XMLElement& element, const std::string& source, int depth) {
  if (depth > kMaxDepth) {
    throw InputError(Problem{source, "", "elements in too many levels", "a camera file"});
  }
  if (element.FirstChildElement() == nullptr) return text_of_element(element.GetText());
  json object = json::object();
  for (const auto* child = element.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    object[with_valid_utf8(child->Name())] = value_of_element(*child, source, depth + 1);
  }
  return object;
}

json read_xml(std::string_view text, const std::string& source) {
  tinyxml2::XMLDocument document;
  document.Parse(text.data(), text.size());
  if (document.Error() || document.RootElement() == nullptr) {
    throw InputError(Problem{source, fmt::format("line {}", document.ErrorLineNum()),
                             "XML that cannot be read", "well-formed XML"});
  }
  return value_of_element(*document.RootElement(), source, 0);
}

}  // namespace

json read_document(std::string_view text, const std::string& source) {
  if (text.size() > kMaxBytes) {
    throw InputError(Problem{source, "", fmt::format("{} bytes", text.size()),
                             fmt::format("a camera file, of at most {}", kMaxBytes)});
  }
  text = without_byte_order_mark(text);
  const std::string_view start = trimmed(text);
  if (start.starts_with('<')) return read_xml(text, source);
  if (start.starts_with('{')) return parse_json(text, source);
  return read_yaml(text, source);
}

}  // namespace throng::calibrate
