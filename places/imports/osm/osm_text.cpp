#include "places/imports/osm/osm_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace throng::imports {

namespace {

constexpr std::string_view kSpaces = " \t\r\n";

bool is_of_history(std::string_view name) {
  constexpr std::array<std::string_view, 5> kNames = {"user", "uid", "changeset", "version",
                                                      "timestamp"};
  return std::find(kNames.begin(), kNames.end(), name) != kNames.end();
}

bool is_coordinate(std::string_view value) {
  double number = 0;
  const auto [rest, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  return error == std::errc() && rest == value.data() + value.size() && std::isfinite(number);
}

// Copies a tag's attributes, those that stay.
void copy_attributes(std::string_view tag, char kind, OsmText& plain) {
  std::int64_t id = 0;
  bool deleted = false;
  for (std::size_t at = tag.find_first_of(kSpaces); at < tag.size();) {
    const std::size_t name_at = tag.find_first_not_of(kSpaces, at);
    const std::size_t equals = tag.find('=', name_at);
    if (name_at == std::string_view::npos || equals == std::string_view::npos) break;
    const std::size_t quote_at = tag.find_first_of("'\"", equals);
    if (quote_at == std::string_view::npos) break;
    const std::size_t end = tag.find(tag[quote_at], quote_at + 1);
    if (end == std::string_view::npos) break;
    const std::string_view name =
        tag.substr(name_at, tag.find_last_not_of(kSpaces, equals - 1) + 1 - name_at);
    const std::string_view value = tag.substr(quote_at + 1, end - quote_at - 1);
    if (name == "id") std::from_chars(value.data(), value.data() + value.size(), id);
    if (name == "action" && value == "delete") deleted = true;
    const bool no_place = (name == "lat" || name == "lon") && !is_coordinate(value);
    if (!is_of_history(name) && !no_place) {
      plain.text += ' ';
      plain.text += tag.substr(name_at, end + 1 - name_at);
    }
    at = end + 1;
  }
  if (deleted) plain.deleted.insert({kind, id});
}

}  // namespace

OsmText plain_osm(std::string_view text) {
  OsmText plain;
  plain.text.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t begin = text.find('<', at);
    plain.text += text.substr(at, begin - at);
    if (begin == std::string_view::npos) break;
    std::size_t end = std::min(text.find('>', begin), text.size());
    const std::string_view tag = text.substr(begin, end - begin);
    const std::size_t name_end = std::min(tag.find_first_of(" \t\r\n/"), tag.size());
    const std::string_view name = tag.substr(0, name_end);
    // A greater-than sign in a value: left to libosmium as it is.
    const bool whole = std::count(tag.begin(), tag.end(), '"') % 2 == 0 &&
                       std::count(tag.begin(), tag.end(), '\'') % 2 == 0;
    if (whole && (name == "<node" || name == "<way" || name == "<relation")) {
      plain.text += name;
      copy_attributes(tag, name[1], plain);
      if (tag.ends_with('/')) plain.text += '/';
    } else {
      plain.text += tag;
    }
    if (end < text.size()) plain.text += '>';
    at = end + 1;
  }
  return plain;
}

}  // namespace throng::imports
