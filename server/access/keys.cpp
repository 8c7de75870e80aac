#include "server/access/keys.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/core.h>
#include <openssl/crypto.h>

#include <array>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files/files.h"
#include "base/files/hash.h"
#include "base/text/control_characters.h"
#include "base/text/utf8.h"
#include "server/access/private_database.h"
#include "server/access/random_text.h"
#include "server/catalog/api_json.h"
#include "server/catalog/unix_time.h"

namespace throng::server {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kPrefix = "throng_";
constexpr std::size_t kIdLength = 8;
constexpr std::size_t kSecretLength = 32;  // of 5 bits each

constexpr const char* kTable = R"(
CREATE TABLE IF NOT EXISTS key (
  id TEXT PRIMARY KEY,
  name TEXT NOT NULL,
  hash TEXT NOT NULL,
  scope TEXT NOT NULL,
  max_active INTEGER NOT NULL DEFAULT 0,
  max_bytes INTEGER NOT NULL DEFAULT 0,
  max_priority INTEGER NOT NULL DEFAULT 0,
  created_ms INTEGER NOT NULL,
  revoked_ms INTEGER NOT NULL DEFAULT 0,
  expires_ms INTEGER NOT NULL DEFAULT 0
) WITHOUT ROWID
)";
/// Version 1: keys may expire, which a program that does not know of it would not see.
constexpr int kVersion = 1;

constexpr const char* kColumns =
    "id, name, scope, max_active, max_bytes, max_priority, created_ms, revoked_ms, expires_ms";

bool is_made_here(std::string_view token) {
  return token.starts_with(kPrefix) &&
         token.size() == kPrefix.size() + kIdLength + 1 + kSecretLength;
}

/// The id is a part of the keys that are made here; that of others comes from their hash.
std::string key_id(std::string_view token, const std::string& hash) {
  return is_made_here(token) ? std::string(token.substr(kPrefix.size(), kIdLength))
                             : hash.substr(0, kIdLength);
}

/// Takes as long whatever the difference.
bool equals_in_constant_time(const std::string& a, const std::string& b) {
  return a.size() == b.size() && CRYPTO_memcmp(a.data(), b.data(), a.size()) == 0;
}

Scope parse_scope(const std::string& name) {
  const auto scope = scope_named(name);
  check(scope.has_value(), "the table holds known scopes only");
  return *scope;
}

KeyRow read_key(SQLite::Statement& query) {
  return {query.getColumn(0).getString(),
          query.getColumn(1).getString(),
          parse_scope(query.getColumn(2).getString()),
          query.getColumn(3).getInt(),
          query.getColumn(4).getInt64(),
          query.getColumn(5).getInt(),
          query.getColumn(6).getInt64(),
          query.getColumn(7).getInt64(),
          query.getColumn(8).getInt64()};
}

/// Whether callers are served with the key.
bool is_in_use(const KeyRow& key) {
  return key.revoked_ms == 0 && (key.expires_ms == 0 || unix_ms_now() < key.expires_ms);
}

fs::path prepared(const fs::path& data) {
  make_folders(data);
  return data / "keys.sqlite";
}

void set_up(SQLite::Database& database) {
  database.exec(kTable);
  // Columns that earlier versions did not have.
  for (const char* column : {"max_bytes", "max_priority", "expires_ms"}) {
    SQLite::Statement known(database,
                            "SELECT count(*) FROM pragma_table_info('key') WHERE name = ?");
    known.bind(1, column);
    known.executeStep();
    if (known.getColumn(0).getInt() > 0) continue;
    database.exec(fmt::format("ALTER TABLE key ADD COLUMN {} INTEGER NOT NULL DEFAULT 0", column));
  }
}

}  // namespace

struct Keys::File : PrivateDatabase {
  using PrivateDatabase::PrivateDatabase;

  /// The row's id and time follow from the token and the clock.
  void insert(const KeyRow& row, const std::string& token) {
    const std::string hash = sha256_hex(token);
    with([&](SQLite::Database& database) {
      SQLite::Statement insert(database,
                               "INSERT INTO key (id, name, hash, scope, max_active, created_ms, "
                               "max_bytes, max_priority, expires_ms) "
                               "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)");
      insert.bind(1, key_id(token, hash));
      insert.bind(2, row.name);
      insert.bind(3, hash);
      insert.bind(4, std::string(to_string(row.scope)));
      insert.bind(5, row.max_active);
      insert.bind(6, unix_ms_now());
      insert.bind(7, row.max_bytes);
      insert.bind(8, row.max_priority);
      insert.bind(9, row.expires_ms);
      insert.exec();
    });
  }
};

std::string_view to_string(Scope scope) {
  constexpr std::array<std::string_view, 4> kNames = {"anybody", "read", "submit", "admin"};
  return kNames[static_cast<std::size_t>(scope)];
}

std::optional<Scope> scope_named(std::string_view name) {
  for (const Scope scope : {Scope::read, Scope::submit, Scope::admin}) {
    if (to_string(scope) == name) return scope;
  }
  return std::nullopt;
}

bool is_key_name(std::string_view text) {
  constexpr std::size_t kMaxLength = 100;
  return !text.empty() && text.size() <= kMaxLength && is_utf8(text) &&
         !has_control_characters(text);
}

bool is_own_key(std::string_view text) {
  constexpr std::size_t kMinLength = 32;
  constexpr std::size_t kMaxLength = 128;
  constexpr std::string_view kCharacters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~+/=";
  return text.size() >= kMinLength && text.size() <= kMaxLength &&
         text.find_first_not_of(kCharacters) == std::string_view::npos;
}

Keys::Keys(const fs::path& data) {
  const fs::path path = prepared(data);
  try {
    file_ = std::make_unique<File>(path, "API keys", kVersion, set_up);
  } catch (const SQLite::Exception& error) {
    throw EnvironmentError(fmt::format("API keys in {}: {}", path.string(), error.what()));
  }
}

Keys::~Keys() = default;

std::string Keys::create(const std::string& name, Scope scope, int max_active,
                         std::int64_t max_bytes, int max_priority, std::int64_t expires_ms) {
  std::string token =
      fmt::format("{}{}_{}", kPrefix, random_text(kIdLength), random_text(kSecretLength));
  file_->insert({"", name, scope, max_active, max_bytes, max_priority, 0, 0, expires_ms}, token);
  return token;
}

void Keys::add(const std::string& name, Scope scope, const std::string& token) {
  check(is_own_key(token), "the caller has checked the key");
  file_->insert({"", name, scope}, token);
}

std::vector<KeyRow> Keys::list() const {
  return file_->with([](SQLite::Database& database) {
    SQLite::Statement query(database,
                            fmt::format("SELECT {} FROM key ORDER BY created_ms, id", kColumns));
    std::vector<KeyRow> rows;
    while (query.executeStep()) rows.push_back(read_key(query));
    return rows;
  });
}

std::optional<KeyRow> Keys::row_of(std::string_view token) const {
  if (!is_made_here(token) && !is_own_key(token)) return std::nullopt;
  const std::string hash = sha256_hex(token);
  return file_->with([&](SQLite::Database& database) -> std::optional<KeyRow> {
    SQLite::Statement query(database,
                            fmt::format("SELECT {}, hash FROM key WHERE id = ?", kColumns));
    query.bind(1, key_id(token, hash));
    if (!query.executeStep() ||
        !equals_in_constant_time(query.getColumn("hash").getString(), hash)) {
      return std::nullopt;
    }
    return read_key(query);
  });
}

bool Keys::revoke(const std::string& id) {
  return file_->with([&](SQLite::Database& database) {
    SQLite::Statement update(database,
                             "UPDATE key SET revoked_ms = ? WHERE id = ? AND revoked_ms = 0");
    update.bind(1, unix_ms_now());
    update.bind(2, id);
    return update.exec() > 0;
  });
}

bool Keys::are_needed() const {
  return file_->with([](SQLite::Database& database) {
    return database.execAndGet("SELECT EXISTS (SELECT 1 FROM key)").getInt() != 0;
  });
}

bool Keys::is_valid(const Caller& caller) const {
  if (caller.key_id.empty()) return !are_needed();
  return file_->with([&](SQLite::Database& database) {
    SQLite::Statement query(database, fmt::format("SELECT {} FROM key WHERE id = ?", kColumns));
    query.bind(1, caller.key_id);
    return query.executeStep() && is_in_use(read_key(query));
  });
}

std::optional<Caller> Keys::caller_of(std::string_view token) const {
  if (!are_needed()) return Caller{"", Scope::admin, 0, 0, kMaxPriority};
  const std::optional<KeyRow> key = row_of(token);
  if (!key || !is_in_use(*key)) return std::nullopt;
  const int max_priority = key->scope >= Scope::admin ? kMaxPriority : key->max_priority;
  return Caller{key->id, key->scope, key->max_active, key->max_bytes, max_priority};
}

std::string Keys::refusal_of(std::string_view token) const {
  const std::optional<KeyRow> key = row_of(token);
  const bool has_expired = key && key->revoked_ms == 0 && !is_in_use(*key);
  return has_expired
             ? fmt::format("this key expired at {}", time_json(key->expires_ms).get<std::string>())
             : "this key is not known, or was revoked";
}

}  // namespace throng::server
