#include "server/webhooks/webhooks.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <SQLiteCpp/Savepoint.h>
#include <fmt/core.h>
#include <openssl/evp.h>
#include <openssl/hmac.h>

#include <array>
#include <chrono>
#include <nlohmann/json.hpp>
#include <random>

#include "base/error.h"
#include "base/files/files.h"
#include "base/json/json_text.h"
#include "server/access/private_database.h"

namespace throng::server {

namespace fs = std::filesystem;

namespace {

constexpr const char* kWebhookTables = R"(
CREATE TABLE IF NOT EXISTS webhook (
  id TEXT PRIMARY KEY,
  url TEXT NOT NULL,
  events TEXT NOT NULL,
  secret TEXT NOT NULL,
  created_ms INTEGER NOT NULL,
  after INTEGER NOT NULL,
  failing_since_ms INTEGER NOT NULL DEFAULT 0,
  failures INTEGER NOT NULL DEFAULT 0,
  enabled INTEGER NOT NULL DEFAULT 1
) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS delivery (
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  webhook TEXT NOT NULL,
  event INTEGER NOT NULL,
  type TEXT NOT NULL,
  at_ms INTEGER NOT NULL,
  attempt INTEGER NOT NULL,
  status INTEGER NOT NULL,
  error TEXT NOT NULL,
  took_ms INTEGER NOT NULL
);
CREATE INDEX IF NOT EXISTS delivery_by_webhook ON delivery (webhook, number);
)";

constexpr int kKeptDeliveries = 1000;  // per webhook

std::string random_hex(int words) {
  std::random_device random;
  std::string text;
  for (int i = 0; i < words; ++i) text += fmt::format("{:08x}", random());
  return text;
}

Webhook read_webhook(SQLite::Statement& query) {
  Webhook webhook;
  webhook.id = query.getColumn(0).getString();
  webhook.url = query.getColumn(1).getString();
  webhook.events =
      parse_own_json(query.getColumn(2).getString(), "a webhook").get<std::vector<std::string>>();
  webhook.secret = query.getColumn(3).getString();
  webhook.created_ms = query.getColumn(4);
  webhook.after = query.getColumn(5);
  webhook.failing_since_ms = query.getColumn(6);
  webhook.failures = query.getColumn(7);
  webhook.enabled = query.getColumn(8).getInt() != 0;
  return webhook;
}

void log_delivery(SQLite::Database& database, const std::string& webhook,
                  const Delivery& delivery) {
  SQLite::Statement insert(database,
                           "INSERT INTO delivery (webhook, event, type, at_ms, attempt, status, "
                           "error, took_ms) VALUES (?, ?, ?, ?, ?, ?, ?, ?)");
  insert.bind(1, webhook);
  insert.bind(2, delivery.event);
  insert.bind(3, delivery.type);
  insert.bind(4, delivery.at_ms);
  insert.bind(5, delivery.attempt);
  insert.bind(6, delivery.status);
  insert.bind(7, delivery.error);
  insert.bind(8, delivery.took_ms);
  insert.exec();
  SQLite::Statement forget(database,
                           "DELETE FROM delivery WHERE webhook = :webhook AND number <= (SELECT "
                           "number FROM delivery WHERE webhook = :webhook ORDER BY number DESC "
                           "LIMIT 1 OFFSET :kept)");
  forget.bind(":webhook", webhook);
  forget.bind(":kept", kKeptDeliveries);
  forget.exec();
}

}  // namespace

struct Webhooks::File : PrivateDatabase {
  using PrivateDatabase::PrivateDatabase;
};

Webhooks::Webhooks(const fs::path& data) {
  make_folders(data);
  try {
    file_ = std::make_unique<File>(data / "webhooks.sqlite", "webhooks", 1,
                                   [](SQLite::Database& database) {
                                     database.exec("PRAGMA journal_mode = WAL");
                                     database.exec(kWebhookTables);
                                   });
  } catch (const SQLite::Exception& failure) {
    throw EnvironmentError(fmt::format("webhooks in {}: {}", data.string(), failure.what()));
  }
}

Webhooks::~Webhooks() = default;

Webhook Webhooks::create(const std::string& url, const std::vector<std::string>& events,
                         std::string secret, std::int64_t after) {
  Webhook webhook;
  webhook.id = random_hex(2);
  webhook.url = url;
  webhook.events = events;
  constexpr int kWordsOfSecret = 8;
  webhook.secret = secret.empty() ? random_hex(kWordsOfSecret) : std::move(secret);
  webhook.created_ms = std::chrono::duration_cast<std::chrono::milliseconds>(
                           std::chrono::system_clock::now().time_since_epoch())
                           .count();
  webhook.after = after;
  file_->with([&](SQLite::Database& database) {
    SQLite::Statement insert(database,
                             "INSERT INTO webhook (id, url, events, secret, created_ms, after) "
                             "VALUES (?, ?, ?, ?, ?, ?)");
    insert.bind(1, webhook.id);
    insert.bind(2, webhook.url);
    insert.bind(3, nlohmann::json(webhook.events).dump());
    insert.bind(4, webhook.secret);
    insert.bind(5, webhook.created_ms);
    insert.bind(6, webhook.after);
    insert.exec();
  });
  return webhook;
}

std::vector<Webhook> Webhooks::list() const {
  return file_->with([](SQLite::Database& database) {
    SQLite::Statement query(database,
                            "SELECT id, url, events, secret, created_ms, after, failing_since_ms, "
                            "failures, enabled FROM webhook ORDER BY created_ms, id");
    std::vector<Webhook> webhooks;
    while (query.executeStep()) webhooks.push_back(read_webhook(query));
    return webhooks;
  });
}

std::optional<Webhook> Webhooks::get(const std::string& id) const {
  for (Webhook& webhook : list()) {
    if (webhook.id == id) return std::move(webhook);
  }
  return std::nullopt;
}

bool Webhooks::remove(const std::string& id) {
  return file_->with([&](SQLite::Database& database) {
    SQLite::Transaction transaction(database);
    SQLite::Statement webhook(database, "DELETE FROM webhook WHERE id = ?");
    webhook.bind(1, id);
    const bool was_there = webhook.exec() > 0;
    SQLite::Statement deliveries(database, "DELETE FROM delivery WHERE webhook = ?");
    deliveries.bind(1, id);
    deliveries.exec();
    transaction.commit();
    return was_there;
  });
}

bool Webhooks::enable(const std::string& id, bool enabled, std::int64_t after) {
  return file_->with([&](SQLite::Database& database) {
    SQLite::Statement update(database,
                             "UPDATE webhook SET enabled = ?, after = ?, failures = 0, "
                             "failing_since_ms = 0 WHERE id = ?");
    update.bind(1, enabled ? 1 : 0);
    update.bind(2, after);
    update.bind(3, id);
    return update.exec() > 0;
  });
}

void Webhooks::settle(const Webhook& webhook, const std::optional<Delivery>& delivery) {
  file_->with([&](SQLite::Database& database) {
    SQLite::Transaction transaction(database);
    SQLite::Statement update(database,
                             "UPDATE webhook SET after = max(after, ?), failing_since_ms = ?, "
                             "failures = ?, enabled = ? WHERE id = ?");
    update.bind(1, webhook.after);
    update.bind(2, webhook.failing_since_ms);
    update.bind(3, webhook.failures);
    update.bind(4, webhook.enabled ? 1 : 0);
    update.bind(5, webhook.id);
    if (update.exec() > 0 && delivery) log_delivery(database, webhook.id, *delivery);
    transaction.commit();
  });
}

std::vector<Delivery> Webhooks::deliveries(const std::string& id, int limit) const {
  return file_->with([&](SQLite::Database& database) {
    SQLite::Statement query(database,
                            "SELECT event, type, at_ms, attempt, status, error, took_ms FROM "
                            "delivery WHERE webhook = ? ORDER BY number DESC LIMIT ?");
    query.bind(1, id);
    query.bind(2, limit);
    std::vector<Delivery> rows;
    while (query.executeStep()) {
      rows.push_back({query.getColumn(0).getInt64(), query.getColumn(1).getString(),
                      query.getColumn(2).getInt64(), query.getColumn(3).getInt(),
                      query.getColumn(4).getInt(), query.getColumn(5).getString(),
                      query.getColumn(6).getInt64()});
    }
    return rows;
  });
}

std::string sign_body(const std::string& secret, std::int64_t unix_s, const std::string& body) {
  const std::string text = fmt::format("{}.{}", unix_s, body);
  std::array<unsigned char, EVP_MAX_MD_SIZE> bytes{};
  unsigned int length = 0;
  const auto* data = reinterpret_cast<const unsigned char*>(text.data());  // as OpenSSL wants it
  const auto* made = HMAC(EVP_sha256(), secret.data(), static_cast<int>(secret.size()), data,
                          text.size(), bytes.data(), &length);
  check(made != nullptr, "HMAC-SHA256 of bytes in memory cannot fail");
  std::string hex;
  for (unsigned int i = 0; i < length; ++i) hex += fmt::format("{:02x}", bytes[i]);
  return fmt::format("t={},v1={}", unix_s, hex);
}

}  // namespace throng::server
