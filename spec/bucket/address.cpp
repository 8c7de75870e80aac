#include "spec/bucket/address.h"

#include <fmt/core.h>

#include <algorithm>

#include "base/error.h"

namespace throng::bucket {

namespace {

constexpr std::string_view kScheme = "s3://";
constexpr std::string_view kExpected =
    "s3://BUCKET/PREFIX: a bucket's name, and segments of letters, digits, '.', '_', '-' and '='";
// A key has 1024 bytes; the rest of them is for the names of files.
constexpr std::size_t kMaxPrefixBytes = 512;

bool is_small(char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); }

bool is_in_segment(char c) {
  return is_small(c) || (c >= 'A' && c <= 'Z') || c == '.' || c == '_' || c == '-' || c == '=';
}

/// By the rules of general purpose buckets.
bool is_bucket(std::string_view name) {
  constexpr std::size_t kMin = 3;
  constexpr std::size_t kMax = 63;
  if (name.size() < kMin || name.size() > kMax) return false;
  if (!is_small(name.front()) || !is_small(name.back())) return false;
  if (name.find("..") != std::string_view::npos) return false;
  const bool is_ip = std::all_of(name.begin(), name.end(),
                                 [](char c) { return c == '.' || (c >= '0' && c <= '9'); }) &&
                     std::count(name.begin(), name.end(), '.') == 3;
  return !is_ip && std::all_of(name.begin(), name.end(),
                               [](char c) { return is_small(c) || c == '.' || c == '-'; });
}

bool is_segment(std::string_view text) {
  return !text.empty() && text != "." && text != ".." &&
         std::all_of(text.begin(), text.end(), &is_in_segment);
}

bool is_prefix(std::string_view text) {
  if (text.size() > kMaxPrefixBytes) return false;
  while (true) {
    const std::size_t end = text.find('/');
    if (!is_segment(text.substr(0, end))) return false;
    if (end == std::string_view::npos) return true;
    text.remove_prefix(end + 1);
  }
}

}  // namespace

std::string Address::text() const {
  return prefix.empty() ? fmt::format("{}{}", kScheme, bucket)
                        : fmt::format("{}{}/{}", kScheme, bucket, prefix);
}

std::string Address::key_of(std::string_view path) const {
  return prefix.empty() ? std::string(path) : fmt::format("{}/{}", prefix, path);
}

bool Address::is_within(const Address& other) const {
  if (bucket != other.bucket) return false;
  return other.prefix.empty() || prefix == other.prefix || prefix.starts_with(other.prefix + "/");
}

Address parse_address(std::string_view text, const std::string& source,
                      const std::string& pointer) {
  const auto refuse = [&](const std::string& found) {
    throw InputError(Problem{source, pointer, found, std::string(kExpected)});
  };
  if (text.find('@') != std::string_view::npos) {
    refuse("an address with a user or password in it");
  }
  if (!text.starts_with(kScheme)) refuse(fmt::format("\"{}\"", text));
  std::string_view rest = text.substr(kScheme.size());
  if (rest.ends_with('/')) rest.remove_suffix(1);
  const std::size_t end = rest.find('/');
  Address address;
  address.bucket = rest.substr(0, end);
  if (end != std::string_view::npos) address.prefix = rest.substr(end + 1);
  if (!is_bucket(address.bucket)) refuse(fmt::format("the bucket \"{}\"", address.bucket));
  if (end != std::string_view::npos && !is_prefix(address.prefix)) {
    refuse(fmt::format("the prefix \"{}\"", address.prefix));
  }
  return address;
}

}  // namespace throng::bucket
