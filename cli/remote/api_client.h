// Client of the HTTP API for the command line. $THRONG_URL is the server's address, $THRONG_KEY the
// key.
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

/// Parses the problems in a response: [{"pointer", "found", "expected", "source"?}].
std::vector<Problem> read_problems(const nlohmann::json& list);

/// The server has no such resource (404).
struct NotFound : InputError {
  using InputError::InputError;
};

/// The request is not possible in the state of the resource (409).
struct Conflict : InputError {
  using InputError::InputError;
};

/// Use from one thread at a time. All requests throw InputError if the server refuses the request,
/// and EnvironmentError if the server cannot be reached or has failed.
class ApiClient {
 public:
  /// Throws InputError if $THRONG_URL is no http or https URL.
  ApiClient();
  ~ApiClient();
  ApiClient(const ApiClient&) = delete;
  ApiClient& operator=(const ApiClient&) = delete;

  const std::string& url() const { return url_; }

  nlohmann::json get(const std::string& path);
  std::string get_text(const std::string& path);
  /// Polls a resource until the server has created it. Throws Cancelled once `should_continue`
  /// returns false.
  std::string wait_for_text(const std::string& path, const std::function<bool()>& should_continue);
  /// Sends a JSON body. `header` is an additional header field, as name and value.
  nlohmann::json post(const std::string& path, const std::string& body = "",
                      const std::pair<std::string, std::string>& header = {});
  /// A part of a form.
  struct Part {
    std::string name;
    std::string file_name;  ///< "" for none
    std::string type;       ///< media type
    std::string bytes;
  };
  nlohmann::json upload(const std::string& path, const std::string& bytes, const std::string& type);
  nlohmann::json post_form(const std::string& path, const std::vector<Part>& parts,
                           const std::pair<std::string, std::string>& header = {});
  void remove(const std::string& path);
  /// Cancels the job or study at `path`; has no effect if it has just ended.
  void cancel(const std::string& path);

  /// Receives the bytes so far and in total; returns false to stop the download.
  using OnBytes = std::function<bool(std::int64_t done, std::int64_t total)>;

  /// Downloads to a file that appears once it is complete. Resumes the partial file of an earlier
  /// attempt ("FILE.part") if the server still has the same file. Returns false if `on_bytes`
  /// stopped the download.
  bool download(const std::string& path, const std::filesystem::path& file,
                const OnBytes& on_bytes);

 private:
  struct Connection;
  std::string url_;
  std::unique_ptr<Connection> connection_;
};

}  // namespace throng::cli
