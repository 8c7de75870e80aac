// API keys and their permissions. They are stored in a file of their own, so that `throng keys`
// works while a server runs. Only hashes of the keys are stored.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace throng::server {

/// Priorities of jobs range from -kMaxPriority to kMaxPriority; administrators may use all of them.
inline constexpr int kMaxPriority = 100;

/// Permissions of a caller; each includes those before it.
enum class Scope : std::uint8_t {
  anybody,  ///< health checks only
  read,     ///< read access
  submit,   ///< submit jobs and change the own ones
  admin     ///< see and change all jobs, keys and webhooks
};

std::string_view to_string(Scope scope);
/// The scope named read, submit or admin; std::nullopt for any other text.
std::optional<Scope> scope_named(std::string_view name);

/// Sender of a request.
struct Caller {
  std::string key_id;  ///< "" if no keys are required
  Scope scope = Scope::anybody;
  int max_active = 0;          ///< max number of queued and running jobs; 0: unlimited
  std::int64_t max_bytes = 0;  ///< max size of all jobs' files; 0: unlimited
  int max_priority = 0;        ///< max priority of their jobs
};

/// A key as stored; the limits are those of Caller.
struct KeyRow {
  std::string id;
  std::string name;
  Scope scope = Scope::read;
  int max_active = 0;
  std::int64_t max_bytes = 0;
  int max_priority = 0;
  std::int64_t created_ms = 0;  ///< Unix time
  std::int64_t revoked_ms = 0;  ///< Unix time; 0: valid
  std::int64_t expires_ms = 0;  ///< Unix time from which on callers are refused; 0: never
};

/// The names that is_key_name() accepts, for messages.
inline constexpr const char* kKeyNameRule = "a name of 1 to 100 bytes without control characters";
/// Whether a text may name a key in lists.
bool is_key_name(std::string_view text);

/// Whether a text may be used as a key that was not made by create(): 32 to 128 characters of a
/// bearer token (RFC 6750).
bool is_own_key(std::string_view text);

/// The file of keys. Safe to use from many threads and processes. All members throw
/// EnvironmentError.
class Keys {
 public:
  /// Opens or creates the file in the folder `data`; only the file's owner may read it.
  explicit Keys(const std::filesystem::path& data);
  ~Keys();
  Keys(const Keys&) = delete;
  Keys& operator=(const Keys&) = delete;

  /// Creates a key and returns its text, which is not stored and cannot be retrieved later.
  std::string create(const std::string& name, Scope scope, int max_active = 0,
                     std::int64_t max_bytes = 0, int max_priority = 0, std::int64_t expires_ms = 0);
  /// Adds the given key, for which is_own_key() must hold.
  void add(const std::string& name, Scope scope, const std::string& token);
  std::vector<KeyRow> list() const;
  /// The row of a key, revoked, expired or not; nothing if the key is unknown.
  std::optional<KeyRow> row_of(std::string_view token) const;
  /// Revokes a key. Returns false if there is no valid key with this id.
  bool revoke(const std::string& id);

  /// Whether a key has ever been created; from then on, every caller needs one.
  bool are_needed() const;
  /// The caller with this key; std::nullopt if the key is unknown, was revoked or has expired. If
  /// no keys are required, every caller is an administrator.
  std::optional<Caller> caller_of(std::string_view token) const;
  /// Why caller_of() returns no caller for a key, for its sender.
  std::string refusal_of(std::string_view token) const;
  /// Whether a caller may still be served: for answers that go on for long. False once the key was
  /// revoked or has expired, and for callers without a key once keys are required.
  bool is_valid(const Caller& caller) const;

 private:
  struct File;
  std::unique_ptr<File> file_;
};

}  // namespace throng::server
