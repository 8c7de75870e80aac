#include "jobs/bucket/access.h"

#include <curl/curl.h>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <string_view>

#include "base/error.h"
#include "base/files/untrusted_folders.h"
#include "base/text/words.h"

namespace throng::bucket {

namespace fs = std::filesystem;

namespace {

using Values = std::map<std::string, std::string, std::less<>>;

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

fs::path file_named(const char* name, const char* in_home) {
  if (const std::string path = variable(name); !path.empty()) return path;
  const std::string home = variable("HOME");
  return home.empty() ? fs::path() : fs::path(home) / ".aws" / in_home;
}

/// Adds the values of a section of a file; those that are there stay. Nothing if there is no file.
void add_section(const fs::path& path, std::string_view section, Values& values) {
  std::ifstream file = open_stream(path);
  bool is_in_section = false;
  for (std::string line; std::getline(file, line);) {
    const std::string_view text = trimmed(line);
    if (text.empty() || text.front() == '#' || text.front() == ';') continue;
    if (text.front() == '[') {
      is_in_section = trimmed(text.substr(1, text.find(']') - 1)) == section;
      continue;
    }
    const std::size_t equals = text.find('=');
    if (!is_in_section || equals == std::string::npos) continue;
    values.emplace(trimmed(text.substr(0, equals)), trimmed(text.substr(equals + 1)));
  }
}

/// The profile's values.
Values profile_values() {
  std::string profile = variable("AWS_PROFILE");
  if (profile.empty()) profile = "default";
  Values values;
  add_section(file_named("AWS_SHARED_CREDENTIALS_FILE", "credentials"), profile, values);
  add_section(file_named("AWS_CONFIG_FILE", "config"),
              profile == "default" ? profile : "profile " + profile, values);
  return values;
}

std::string first_nonempty(std::initializer_list<std::string> texts) {
  const auto found = std::find_if(texts.begin(), texts.end(),
                                  [](const std::string& text) { return !text.empty(); });
  return found == texts.end() ? "" : *found;
}

void check_endpoint(const std::string& endpoint) {
  const auto refuse = [](const std::string& found) {
    throw InputError(Problem{"AWS_ENDPOINT_URL", "", found,
                             "a URL such as https://objects.example.org, without a user, password, "
                             "query or fragment"});
  };
  // The text may hold a password, and is not repeated.
  if (endpoint.find_first_of("@?# ") != std::string::npos) refuse("a URL with other parts");
  const std::unique_ptr<CURLU, decltype(&curl_url_cleanup)> url(::curl_url(), &curl_url_cleanup);
  const bool is_web = endpoint.starts_with("http://") || endpoint.starts_with("https://");
  if (!is_web || ::curl_url_set(url.get(), CURLUPART_URL, endpoint.c_str(), 0) != CURLUE_OK) {
    refuse(fmt::format("\"{}\"", endpoint));
  }
}

void check_word(const std::string& text, const char* name) {
  const bool is_plain =
      std::all_of(text.begin(), text.end(), [](unsigned char c) { return c > ' ' && c < 0x7F; });
  if (is_plain) return;
  throw InputError(Problem{name, "", "a value with blanks or other characters",
                           "letters, digits and punctuation of ASCII"});
}

}  // namespace

Access read_access() {
  Values profile = profile_values();
  Access access;
  access.key_id = variable("AWS_ACCESS_KEY_ID");
  access.secret = variable("AWS_SECRET_ACCESS_KEY");
  access.token = variable("AWS_SESSION_TOKEN");
  // Keys belong together: half of one source and half of the other fit nowhere.
  if (access.key_id.empty() && access.secret.empty()) {
    access.key_id = profile["aws_access_key_id"];
    access.secret = profile["aws_secret_access_key"];
    access.token = profile["aws_session_token"];
  }
  access.endpoint = first_nonempty(
      {variable("AWS_ENDPOINT_URL_S3"), variable("AWS_ENDPOINT_URL"), profile["endpoint_url"]});
  access.region =
      first_nonempty({variable("AWS_REGION"), variable("AWS_DEFAULT_REGION"), profile["region"]});
  if (access.key_id.empty() || access.secret.empty()) {
    throw EnvironmentError(
        fmt::format("there are no credentials for the object store: set AWS_ACCESS_KEY_ID and "
                    "AWS_SECRET_ACCESS_KEY, or write {} (docs/publishing.md)",
                    file_named("AWS_SHARED_CREDENTIALS_FILE", "credentials").string()));
  }
  if (!access.endpoint.empty()) check_endpoint(access.endpoint);
  while (access.endpoint.ends_with('/')) access.endpoint.pop_back();
  if (access.region.empty() && !access.endpoint.empty()) access.region = "us-east-1";
  if (access.region.empty()) {
    throw EnvironmentError(
        "the object store's region is not known: set AWS_REGION, or AWS_ENDPOINT_URL for a store "
        "that is not Amazon's (docs/publishing.md)");
  }
  check_word(access.key_id, "AWS_ACCESS_KEY_ID");
  check_word(access.secret, "AWS_SECRET_ACCESS_KEY");
  check_word(access.token, "AWS_SESSION_TOKEN");
  check_word(access.region, "AWS_REGION");
  return access;
}

std::string url_of_bucket(const Access& access, const Address& address) {
  if (!access.endpoint.empty()) return fmt::format("{}/{}", access.endpoint, address.bucket);
  const char* domain = access.region.starts_with("cn-") ? "amazonaws.com.cn" : "amazonaws.com";
  const std::string host = fmt::format("s3.{}.{}", access.region, domain);
  const bool has_dots = address.bucket.find('.') != std::string::npos;
  return has_dots ? fmt::format("https://{}/{}", host, address.bucket)
                  : fmt::format("https://{}.{}", address.bucket, host);
}

}  // namespace throng::bucket
