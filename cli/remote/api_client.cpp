#include "cli/remote/api_client.h"

#include <fmt/core.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <thread>

#include "base/error.h"
#include "base/files/files.h"
#include "base/json/json_text.h"
#include "base/resource_exhaustion.h"
#include "server/http/http.h"

namespace throng::cli {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr const char* kUsualUrl = "http://127.0.0.1:8080";
constexpr time_t kConnectS = 10;
constexpr time_t kReadS = 90;  // longer than the longest ?wait_s=

std::string variable(const char* name, const char* otherwise) {
  const char* value = std::getenv(name);
  return value == nullptr || *value == '\0' ? otherwise : value;
}

/// Text of a problem document, one line per error.
std::vector<Problem> problems_in(const httplib::Response& response, const std::string& url) {
  const json document = parse_json_or_discard(response.body);
  std::vector<Problem> problems;
  if (document.is_object()) problems = read_problems(document.value("errors", json::array()));
  if (problems.empty()) {
    const std::string detail = document.is_object() ? document.value("detail", "") : "";
    problems.push_back(
        {url, "", detail.empty() ? fmt::format("HTTP status {}", response.status) : detail, ""});
  }
  return problems;
}

bool is_success(int status) { return status >= 200 && status < 300; }

}  // namespace

std::vector<Problem> read_problems(const json& list) {
  std::vector<Problem> problems;
  for (const json& error : list) {
    problems.push_back({error.value("source", ""), error.value("pointer", ""),
                        error.value("found", ""), error.value("expected", "")});
  }
  return problems;
}

struct ApiClient::Connection {
  Connection(const std::string& server, std::string path) : client(server), base(std::move(path)) {
    client.set_connection_timeout(kConnectS);
    client.set_read_timeout(kReadS);
    client.set_keep_alive(true);
    client.set_tcp_nodelay(true);
    const std::string key = variable("THRONG_KEY", "");
    if (!key.empty()) headers.emplace("Authorization", "Bearer " + key);
  }

  httplib::Client client;
  std::string base;  ///< path of a proxy below which the service lies, or ""
  httplib::Headers headers;
};

ApiClient::ApiClient() : url_(variable("THRONG_URL", kUsualUrl)) {
  while (url_.ends_with('/')) url_.pop_back();
  static const std::regex kUrl(R"((https?://[^/?#\s]+)((?:/[^?#\s]*)?))");
  std::smatch parts;
  if (!std::regex_match(url_, parts, kUrl)) {
    throw InputError(Problem{
        "environment variable THRONG_URL", "", '"' + url_ + '"',
        fmt::format("an http or https URL such as {} or https://example.org/throng", kUsualUrl)});
  }
  connection_ = std::make_unique<Connection>(parts[1].str(), parts[2].str());
}

ApiClient::~ApiClient() = default;

namespace {

/// Why no answer came: what there is to mend, or "" where nothing listens.
std::string failure(httplib::Error error) {
  switch (error) {
    case httplib::Error::Connection:
      return "";
    case httplib::Error::SSLConnection:
      return ": it does not speak TLS; expected an address that begins with http:// if the service "
             "is not behind a proxy that does";
    case httplib::Error::SSLLoadingCerts:
      return ": the certificates of this machine cannot be read";
    case httplib::Error::SSLServerVerification:
      return ": no authority that this machine trusts has signed its certificate";
    case httplib::Error::Read:
      return ": the connection ended before the answer; a service with TLS needs an address that "
             "begins with https://";
    case httplib::Error::ConnectionTimeout:
      return ": it does not answer in time";
    default:
      return ": " + httplib::to_string(error);
  }
}

const httplib::Response& checked(const httplib::Result& result, const std::string& url,
                                 const std::string& path) {
  if (!result) {
    throw EnvironmentError(
        fmt::format("cannot reach {}{} (is `throng serve` running? The environment variable "
                    "THRONG_URL sets the address)",
                    url, failure(result.error())));
  }
  if (is_success(result->status)) return *result;
  constexpr int kServersFault = 500;
  if (result->status >= kServersFault) {
    throw EnvironmentError(problems_in(*result, url + path).front().text());
  }
  constexpr int kNotFound = 404;
  if (result->status == kNotFound) throw NotFound(problems_in(*result, url));
  constexpr int kConflict = 409;
  if (result->status == kConflict) throw Conflict(problems_in(*result, url));
  throw InputError(problems_in(*result, url));
}

}  // namespace

namespace {

// The server that answers is not necessarily throng.
json answer_json(const std::string& body, const std::string& path) {
  try {
    return parse_json(body, path);
  } catch (const InputError& error) {
    throw EnvironmentError(fmt::format("the answer cannot be read: {}", error.what()));
  }
}

}  // namespace

json ApiClient::get(const std::string& path) { return answer_json(get_text(path), path); }

std::string ApiClient::get_text(const std::string& path) {
  return checked(connection_->client.Get(connection_->base + path, connection_->headers), url_,
                 path)
      .body;
}

std::string ApiClient::wait_for_text(const std::string& path,
                                     const std::function<bool()>& should_continue) {
  constexpr int kAccepted = 202;
  while (true) {
    const httplib::Response answer = checked(
        connection_->client.Get(connection_->base + path, connection_->headers), url_, path);
    if (answer.status != kAccepted) return answer.body;
    if (!should_continue()) throw Cancelled();
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
}

json ApiClient::post(const std::string& path, const std::string& body,
                     const std::pair<std::string, std::string>& header) {
  httplib::Headers headers = connection_->headers;
  if (!header.first.empty()) headers.insert(header);
  return answer_json(
      checked(connection_->client.Post(connection_->base + path, headers, body, "application/json"),
              url_, path)
          .body,
      path);
}

json ApiClient::upload(const std::string& path, const std::string& bytes, const std::string& type) {
  return answer_json(
      checked(connection_->client.Post(connection_->base + path, connection_->headers, bytes, type),
              url_, path)
          .body,
      path);
}

json ApiClient::post_form(const std::string& path, const std::vector<Part>& parts,
                          const std::pair<std::string, std::string>& header) {
  httplib::Headers headers = connection_->headers;
  if (!header.first.empty()) headers.insert(header);
  httplib::MultipartFormDataItems items;
  items.reserve(parts.size());
  for (const Part& part : parts) {
    items.push_back({part.name, part.bytes, part.file_name, part.type});
  }
  return answer_json(
      checked(connection_->client.Post(connection_->base + path, headers, items), url_, path).body,
      path);
}

void ApiClient::remove(const std::string& path) {
  checked(connection_->client.Delete(connection_->base + path, connection_->headers), url_, path);
}

void ApiClient::cancel(const std::string& path) {
  try {
    post(path + "/cancel");
  } catch (const Conflict&) {
    const json state = get(path)["state"];
    if (state == "queued" || state == "running") throw;
  }
}

bool ApiClient::download(const std::string& path, const fs::path& file, const OnBytes& on_bytes) {
  const fs::path part = file.string() + ".part";
  const fs::path tag_file = file.string() + ".part.etag";  // of what the part is a part of
  std::int64_t done = 0;
  httplib::Headers headers = connection_->headers;
  if (fs::exists(part) && fs::exists(tag_file) && fs::file_size(part) > 0) {
    done = static_cast<std::int64_t>(fs::file_size(part));
    headers.emplace("Range", fmt::format("bytes={}-", done));
    headers.emplace("If-Range", read_file(tag_file));
  }
  std::ofstream out;
  std::int64_t total = 0;
  bool goes_on = true;
  std::string refusal;
  const auto begin = [&](const httplib::Response& response) {
    if (!is_success(response.status)) return true;  // the body says why
    if (response.status != 206) done = 0;
    total = done + std::stoll(response.get_header_value("Content-Length"));
    write_file_atomically(tag_file, response.get_header_value("ETag"));
    out.open(part, std::ios::binary | (done > 0 ? std::ios::app : std::ios::trunc));
    if (!out) throw_write_error(part, errno);
    return true;
  };
  const auto add = [&](const char* data, std::size_t count) {
    if (!out.is_open()) {
      refusal.append(data, count);
      return true;
    }
    out.write(data, static_cast<std::streamsize>(count));
    if (!out) throw_write_error(part, errno);
    done += static_cast<std::int64_t>(count);
    goes_on = on_bytes(done, total);
    return goes_on;
  };
  httplib::Result result = connection_->client.Get(connection_->base + path, headers, begin, add);
  if (out.is_open()) {
    out.close();
    if (!out) throw_write_error(part, errno);
  }
  if (!goes_on) return false;
  if (result && result->status == 416) {
    // The part is complete, or belongs to another file: start again.
    fs::remove(part);
    fs::remove(tag_file);
    return download(path, file, on_bytes);
  }
  if (result) result->body = refusal;
  checked(result, url_, path);
  if (done != total) {
    throw EnvironmentError(fmt::format("{} of {} bytes came; the same again goes on", done, total));
  }
  fs::rename(part, file);
  fs::remove(tag_file);
  return true;
}

}  // namespace throng::cli
