#include "jobs/queue/store/store_rows.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/json/json_text.h"

namespace throng::jobs {

namespace {

/// None where the text is no list of texts: labels only serve to find a job.
std::vector<std::string> parse_labels(const std::string& text) {
  const nlohmann::json labels = parse_json_or_discard(text);
  if (!labels.is_array()) return {};
  std::vector<std::string> known;
  for (const nlohmann::json& label : labels) {
    if (label.is_string()) known.push_back(label);
  }
  return known;
}

}  // namespace

// A damaged row must not hide the others.
JobRow read_row(SQLite::Statement& query) {
  JobRow row;
  row.id = query.getColumn(0).getString();
  row.name = query.getColumn(1).getString();
  const auto state = job_state_named(query.getColumn(2).getString());
  row.is_damaged = !state;
  row.state = state.value_or(JobState::failed);
  row.attempt = query.getColumn(3);
  row.spec_json = query.getColumn(4).getString();
  row.progress_json = query.getColumn(5).getString();
  row.error_json = query.getColumn(6).getString();
  row.created_ms = query.getColumn(7);
  row.started_ms = query.getColumn(8);
  row.ended_ms = query.getColumn(9);
  const std::string kind = query.getColumn(10).getString();
  for (const JobKind known : kJobKinds) {
    if (kind == to_string(known)) row.kind = known;
  }
  row.priority = query.getColumn(11);
  row.labels = parse_labels(query.getColumn(12).getString());
  row.owner = query.getColumn(13).getString();
  row.bytes = query.getColumn(14);
  row.keep = query.getColumn(15).getInt() != 0;
  row.kept_from_ms = query.getColumn(16);
  row.load.people = query.getColumn(17);
  row.sources_json = query.getColumn(18).getString();
  row.planned_bytes = query.getColumn(19);
  row.load.models_mib = query.getColumn(20);
  if (row.is_damaged) {
    const nlohmann::json error = {
        {"kind", "environment"},
        {"message", "the job's row in the store is damaged: it can only be removed"},
        {"problems", nlohmann::json::array()}};
    row.error_json = error.dump();
  }
  return row;
}

std::size_t text_bytes(const JobRow& row) {
  std::size_t bytes = row.name.size() + row.spec_json.size() + row.progress_json.size() +
                      row.error_json.size() + row.waiting_for.size();
  for (const std::string& label : row.labels) bytes += label.size();
  return bytes;
}

std::vector<JobRow> read_rows(SQLite::Statement& query, std::size_t max_text_bytes) {
  std::vector<JobRow> rows;
  for (std::size_t bytes = 0; bytes < max_text_bytes && query.executeStep();) {
    rows.push_back(read_row(query));
    bytes += text_bytes(rows.back());
  }
  return rows;
}

std::optional<JobRow> read_first_row(SQLite::Statement& query) {
  if (!query.executeStep()) return std::nullopt;
  return read_row(query);
}

std::optional<JobRow> find_job(SQLite::Database& database, const std::string& id) {
  SQLite::Statement query(database, fmt::format("SELECT {} FROM job WHERE id = ?", kColumns));
  query.bind(1, id);
  return read_first_row(query);
}

std::optional<JobRow> find_submission(SQLite::Database& database, const std::string& owner,
                                      const std::string& key) {
  SQLite::Statement query(
      database, fmt::format("SELECT {} FROM job WHERE owner = ? AND submission_key = ?", kColumns));
  query.bind(1, owner);
  query.bind(2, key);
  return read_first_row(query);
}

void write_event(SQLite::Database& database, const std::string& job, std::int64_t at_ms,
                 const std::string& type, const std::string& data_json) {
  SQLite::Statement insert(database,
                           "INSERT INTO event (job, at_ms, type, data) VALUES (?, ?, ?, ?)");
  insert.bind(1, job);
  insert.bind(2, at_ms);
  insert.bind(3, type);
  insert.bind(4, data_json);
  insert.exec();
}

std::optional<JobRow> move_to(SQLite::Database& database, JobState next, const JobRow& row,
                              JobEvent event, const std::string& error_json, const ClockMark& now) {
  JobRow changed = row;
  changed.state = next;
  changed.attempt += event == JobEvent::start || event == JobEvent::resume ? 1 : 0;
  if (event == JobEvent::start) changed.started_ms = now.wall_ms;
  changed.ended_ms = is_active(next) ? 0 : now.wall_ms;
  changed.kept_from_ms = is_active(next) ? 0 : now.service_ms;
  changed.error_json = error_json;
  SQLite::Statement update(database,
                           "UPDATE job SET state = ?, attempt = ?, error = ?, started_ms = ?, "
                           "ended_ms = ?, kept_from_ms = ? WHERE id = ? AND state = ? AND "
                           "attempt = ?");
  update.bind(1, std::string(to_string(changed.state)));
  update.bind(2, changed.attempt);
  update.bind(3, changed.error_json);
  update.bind(4, changed.started_ms);
  update.bind(5, changed.ended_ms);
  update.bind(6, changed.kept_from_ms);
  update.bind(7, row.id);
  update.bind(8, std::string(to_string(row.state)));
  update.bind(9, row.attempt);
  if (update.exec() == 0) return std::nullopt;
  const nlohmann::json data = {{"state", to_string(next)}, {"attempt", changed.attempt}};
  write_event(database, row.id, now.wall_ms, std::string(to_string(event)), data.dump());
  return changed;
}

std::optional<ClockMark> clock_mark(SQLite::Database& database) {
  SQLite::Statement query(database, "SELECT service_ms, wall_ms FROM clock_mark");
  if (!query.executeStep()) return std::nullopt;
  return ClockMark{query.getColumn(0), query.getColumn(1)};
}

void save_mark(SQLite::Database& database, const ClockMark& mark) {
  SQLite::Statement save(database, "INSERT OR REPLACE INTO clock_mark VALUES (1, ?, ?)");
  save.bind(1, mark.service_ms);
  save.bind(2, mark.wall_ms);
  save.exec();
}

void insert_job(SQLite::Database& database, const JobRow& row, const NewJob& job) {
  SQLite::Statement insert(
      database,
      "INSERT INTO job (id, name, state, spec, created_ms, kind, priority, labels, submission_key, "
      "submission_hash, owner, people, sources, planned_bytes, models_mib) VALUES (?, ?, 'queued', "
      "?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  insert.bind(1, row.id);
  insert.bind(2, row.name);
  insert.bind(3, row.spec_json);
  insert.bind(4, row.created_ms);
  insert.bind(5, std::string(to_string(row.kind)));
  insert.bind(6, row.priority);
  insert.bind(7, nlohmann::json(row.labels).dump());
  if (!job.key.empty()) insert.bind(8, job.key);
  insert.bind(9, job.hash);
  insert.bind(10, row.owner);
  insert.bind(11, row.load.people);
  insert.bind(12, row.sources_json);
  insert.bind(13, row.planned_bytes);
  insert.bind(14, row.load.models_mib);
  insert.exec();
}

OwnerUsage owner_usage(SQLite::Database& database, const std::string& owner) {
  SQLite::Statement query(database,
                          "SELECT coalesce(sum(state IN ('queued', 'running')), 0), "
                          "coalesce(sum(CASE WHEN state IN ('queued', 'running') THEN max(bytes, "
                          "planned_bytes) ELSE bytes END), 0) FROM job WHERE owner = ?");
  query.bind(1, owner);
  query.executeStep();
  return {query.getColumn(0).getInt64(), query.getColumn(1).getInt64()};
}

std::string over_quota(SQLite::Database& database, const std::string& owner,
                       const OwnerLimits& limits, std::int64_t added_bytes) {
  if (limits.max_active <= 0 && limits.max_bytes <= 0) return "";
  const auto [active, bytes] = owner_usage(database, owner);
  if (limits.max_active > 0 && active >= limits.max_active) {
    return fmt::format("{} of your jobs wait or run, which is as many as this key may have",
                       limits.max_active);
  }
  if (limits.max_bytes > 0 &&
      (bytes >= limits.max_bytes || bytes + added_bytes > limits.max_bytes)) {
    return fmt::format(
        "your jobs take {} bytes of disk, those that wait or run as they are estimated, and this "
        "one "
        "about {} more; this key may have {} beside its live flights: remove some, or ask for less",
        bytes, added_bytes, limits.max_bytes);
  }
  return "";
}

std::string hash_of_submission(SQLite::Database& database, const std::string& id) {
  SQLite::Statement query(database, "SELECT submission_hash FROM job WHERE id = ?");
  query.bind(1, id);
  query.executeStep();
  return query.getColumn(0).getString();
}

}  // namespace throng::jobs
