// The HTTP API as the command line's clients use it: $THRONG_URL is its address, $THRONG_KEY with
// which key.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/error.h"

namespace throng::cli {

/// Mistakes as the API lists them: [{"pointer", "found", "expected", "source"?}].
std::vector<Problem> read_problems(const nlohmann::json& list);

/// The server has no such resource (404).
struct NotFound : InputError {
  using InputError::InputError;
};

/// The resource is not in a state for this (409).
struct Conflict : InputError {
  using InputError::InputError;
};

/// Answers that are no success are thrown: InputError for errors that the server finds in the
/// request, EnvironmentError when the server cannot be reached or has failed.
class ApiClient {
 public:
  /// Throws InputError when $THRONG_URL is no http or https URL.
  ApiClient();
  ~ApiClient();
  ApiClient(const ApiClient&) = delete;
  ApiClient& operator=(const ApiClient&) = delete;

  const std::string& url() const { return url_; }

  nlohmann::json get(const std::string& path);
  std::string get_text(const std::string& path);
  /// Polls a resource that takes a while to be created. Throws Cancelled once `should_continue` is
  /// false.
  std::string wait_for_text(const std::string& path, const std::function<bool()>& should_continue);
  /// `headers` besides the usual ones, as name and value.
  nlohmann::json post(const std::string& path, const std::string& body = "",
                      const std::pair<std::string, std::string>& header = {});
  /// Sends a file of its own type, or the parts of a form: name, file name (or ""), type, bytes.
  struct Part {
    std::string name;
    std::string file_name;
    std::string type;
    std::string bytes;
  };
  nlohmann::json upload(const std::string& path, const std::string& bytes, const std::string& type);
  nlohmann::json post_form(const std::string& path, const std::vector<Part>& parts,
                           const std::pair<std::string, std::string>& header = {});
  void remove(const std::string& path);
  /// Cancels the job or study at `path`. One that has ended stays as it is: it may end at any
  /// moment.
  void cancel(const std::string& path);

  /// Called with the bytes that are there and those there will be; false ends the download.
  using OnBytes = std::function<bool(std::int64_t done, std::int64_t total)>;

  /// Downloads into a file that appears when it is complete. A partial file of an earlier attempt
  /// ("FILE.part") is resumed, if the server still has the same file. False when `on_bytes` has
  /// ended it.
  bool download(const std::string& path, const std::filesystem::path& file,
                const OnBytes& on_bytes);

 private:
  struct Connection;
  std::string url_;
  std::unique_ptr<Connection> connection_;
};

}  // namespace throng::cli
