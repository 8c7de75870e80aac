// API keys: who may do what. They lie in a file of their own in the data folder, so that
// `throng keys` works beside a running server. Of a key only a hash is kept.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace throng::server {

/// Jobs have priorities from -kMaxPriority to this; administrators may give them any.
inline constexpr int kMaxPriority = 100;

/// Permissions of a caller; each includes those before it.
enum class Scope : std::uint8_t {
  anybody,  ///< nothing but ask whether the service lives
  read,     ///< look at everything
  submit,   ///< queue jobs and change one's own
  admin     ///< change everybody's
};

std::string_view to_string(Scope scope);
/// read, submit or admin; nothing for any other word.
std::optional<Scope> scope_named(std::string_view name);

/// Sender of a request.
struct Caller {
  std::string key_id;  ///< "" where no keys are needed
  Scope scope = Scope::anybody;
  int max_active = 0;          ///< jobs that may wait or run at once; 0: any number
  std::int64_t max_bytes = 0;  ///< disk that their jobs may take; 0: any
  int max_priority = 0;        ///< of their jobs
};

struct KeyRow {
  std::string id;
  std::string name;
  Scope scope = Scope::read;
  int max_active = 0;
  std::int64_t max_bytes = 0;
  int max_priority = 0;
  std::int64_t created_ms = 0;  ///< Unix time
  std::int64_t revoked_ms = 0;  ///< 0: it is good
};

/// Whether somebody may use this text as a key of their own making: 32 to 128 characters of a
/// bearer token (RFC 6750).
bool is_own_key(std::string_view text);

/// Safe to use from many threads, and by many processes at once. Throws EnvironmentError.
class Keys {
 public:
  /// Opens or creates the file in the data folder, which only its owner may read.
  explicit Keys(const std::filesystem::path& data);
  ~Keys();
  Keys(const Keys&) = delete;
  Keys& operator=(const Keys&) = delete;

  /// Makes a key and returns what the caller has to send: it can never be asked for again.
  std::string create(const std::string& name, Scope scope, int max_active = 0,
                     std::int64_t max_bytes = 0, int max_priority = 0);
  /// Adds a key that the caller has chosen, for which is_own_key() holds.
  void add(const std::string& name, Scope scope, const std::string& token);
  std::vector<KeyRow> list() const;
  /// False when there is no good key of this id.
  bool revoke(const std::string& id);

  /// Whether a key has ever been made: from then on every caller needs one.
  bool are_needed() const;
  /// Owner of the key; nothing when the key is invalid. If no keys are required, everybody is an
  /// administrator.
  std::optional<Caller> caller_of(std::string_view token) const;

 private:
  struct File;
  std::unique_ptr<File> file_;
};

}  // namespace throng::server
