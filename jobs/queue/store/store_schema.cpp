#include "jobs/queue/store/store_schema.h"

#include <fmt/core.h>

#include <array>

#include "base/error.h"
#include "base/version.h"

namespace throng::jobs {

namespace {

/// Each makes the tables of the next version from those of the one before; the first from nothing.
constexpr std::array kSteps = {
    R"(
CREATE TABLE job (
  id TEXT PRIMARY KEY,
  name TEXT NOT NULL,
  state TEXT NOT NULL CHECK (state IN ('queued', 'running', 'succeeded', 'failed', 'cancelled')),
  attempt INTEGER NOT NULL DEFAULT 0,
  spec TEXT NOT NULL,
  progress TEXT NOT NULL DEFAULT '',
  error TEXT NOT NULL DEFAULT '',
  created_ms INTEGER NOT NULL,
  started_ms INTEGER NOT NULL DEFAULT 0,
  ended_ms INTEGER NOT NULL DEFAULT 0
) WITHOUT ROWID;
CREATE INDEX job_by_state ON job (state, id);
)",
    "ALTER TABLE job ADD COLUMN kind TEXT NOT NULL DEFAULT 'dataset'",
    // Priorities, labels (a JSON list), keys that make a repeated submission one job, and what
    // happened when.
    R"(
ALTER TABLE job ADD COLUMN priority INTEGER NOT NULL DEFAULT 0;
ALTER TABLE job ADD COLUMN labels TEXT NOT NULL DEFAULT '[]';
ALTER TABLE job ADD COLUMN submission_key TEXT;
ALTER TABLE job ADD COLUMN submission_hash TEXT NOT NULL DEFAULT '';
CREATE UNIQUE INDEX job_by_submission_key ON job (submission_key) WHERE submission_key IS NOT NULL;
DROP INDEX IF EXISTS job_by_state;
CREATE INDEX job_by_state ON job (state, priority DESC, id);
CREATE INDEX job_by_kind ON job (kind, id);
CREATE TABLE event (
  seq INTEGER PRIMARY KEY AUTOINCREMENT,
  job TEXT NOT NULL,
  at_ms INTEGER NOT NULL,
  type TEXT NOT NULL,
  data TEXT NOT NULL
);
CREATE INDEX event_by_job ON event (job, seq);
)",
    // Whose jobs they are; keys of submissions are each owner's own.
    R"(
ALTER TABLE job ADD COLUMN owner TEXT NOT NULL DEFAULT '';
DROP INDEX job_by_submission_key;
CREATE UNIQUE INDEX job_by_submission_key ON job (owner, submission_key)
  WHERE submission_key IS NOT NULL;
CREATE INDEX job_by_owner ON job (owner, state);
)",
    // Jobs that ended with some of their runs, how much disk they take, which to keep for good. A
    // column's check cannot be changed in place.
    R"(
CREATE TABLE new_job (
  id TEXT PRIMARY KEY,
  name TEXT NOT NULL,
  state TEXT NOT NULL
    CHECK (state IN ('queued', 'running', 'succeeded', 'partial', 'failed', 'cancelled')),
  attempt INTEGER NOT NULL DEFAULT 0,
  spec TEXT NOT NULL,
  progress TEXT NOT NULL DEFAULT '',
  error TEXT NOT NULL DEFAULT '',
  created_ms INTEGER NOT NULL,
  started_ms INTEGER NOT NULL DEFAULT 0,
  ended_ms INTEGER NOT NULL DEFAULT 0,
  kind TEXT NOT NULL DEFAULT 'dataset',
  priority INTEGER NOT NULL DEFAULT 0,
  labels TEXT NOT NULL DEFAULT '[]',
  submission_key TEXT,
  submission_hash TEXT NOT NULL DEFAULT '',
  owner TEXT NOT NULL DEFAULT '',
  bytes INTEGER NOT NULL DEFAULT 0,
  keep INTEGER NOT NULL DEFAULT 0
) WITHOUT ROWID;
INSERT INTO new_job (id, name, state, attempt, spec, progress, error, created_ms, started_ms,
    ended_ms, kind, priority, labels, submission_key, submission_hash, owner)
  SELECT id, name, state, attempt, spec, progress, error, created_ms, started_ms, ended_ms, kind,
    priority, labels, submission_key, submission_hash, owner FROM job;
DROP TABLE job;
ALTER TABLE new_job RENAME TO job;
CREATE INDEX job_by_state ON job (state, priority DESC, id);
CREATE INDEX job_by_kind ON job (kind, id);
CREATE INDEX job_by_owner ON job (owner, state);
CREATE INDEX job_by_end ON job (ended_ms) WHERE ended_ms > 0;
CREATE UNIQUE INDEX job_by_submission_key ON job (owner, submission_key)
  WHERE submission_key IS NOT NULL;
)",
    // Indexes of states, labels and names, by all of their parts of three characters; all follow
    // the table by themselves. Numbers have the order of the ids. Since when jobs are kept, and how
    // many people their scenarios have.
    R"(
CREATE TABLE clock_mark (
  id INTEGER PRIMARY KEY CHECK (id = 1),
  service_ms INTEGER NOT NULL,
  wall_ms INTEGER NOT NULL
);
ALTER TABLE job ADD COLUMN kept_from_ms INTEGER NOT NULL DEFAULT 0;
UPDATE job SET kept_from_ms = min(ended_ms, 1000 * CAST(strftime('%s', 'now') AS INTEGER))
  WHERE ended_ms > 0;
DROP INDEX job_by_end;
CREATE INDEX job_by_end ON job (kept_from_ms) WHERE kept_from_ms > 0;
ALTER TABLE job ADD COLUMN people INTEGER NOT NULL DEFAULT 0;
ALTER TABLE job ADD COLUMN number INTEGER;
UPDATE job SET number = ranked.number
  FROM (SELECT id, row_number() OVER (ORDER BY id) AS number FROM job) AS ranked
  WHERE ranked.id = job.id;
CREATE UNIQUE INDEX job_by_number ON job (number);
CREATE INDEX job_by_kind_and_state ON job (kind, state, id);
CREATE VIRTUAL TABLE job_name USING fts5(name, tokenize = 'trigram');
INSERT INTO job_name (rowid, name) SELECT number, name FROM job;
CREATE TABLE job_label (
  label TEXT NOT NULL,
  job TEXT NOT NULL,
  PRIMARY KEY (label, job)
) WITHOUT ROWID;
CREATE INDEX label_by_job ON job_label (job);
INSERT OR IGNORE INTO job_label SELECT label.value, job.id
  FROM job, json_each(CASE WHEN json_valid(labels) THEN labels ELSE '[]' END) AS label;
CREATE TRIGGER job_added AFTER INSERT ON job BEGIN
  UPDATE job SET number = (SELECT coalesce(max(number), 0) + 1 FROM job) WHERE id = new.id;
  INSERT INTO job_name (rowid, name) SELECT number, name FROM job WHERE id = new.id;
  INSERT OR IGNORE INTO job_label SELECT value, new.id
    FROM json_each(CASE WHEN json_valid(new.labels) THEN new.labels ELSE '[]' END);
END;
CREATE TRIGGER job_labeled AFTER UPDATE OF labels ON job BEGIN
  DELETE FROM job_label WHERE job = new.id;
  INSERT OR IGNORE INTO job_label SELECT value, new.id
    FROM json_each(CASE WHEN json_valid(new.labels) THEN new.labels ELSE '[]' END);
END;
CREATE TRIGGER job_removed AFTER DELETE ON job BEGIN
  DELETE FROM job_name WHERE rowid = old.number;
  DELETE FROM job_label WHERE job = old.id;
END;
)",
    // Hashes of the scenarios that a job was resolved from.
    "ALTER TABLE job ADD COLUMN sources TEXT NOT NULL DEFAULT '{}'",
    // Estimated size of a job's files.
    "ALTER TABLE job ADD COLUMN planned_bytes INTEGER NOT NULL DEFAULT 0",
    // Jobs of before load the shipped characters.
    "ALTER TABLE job ADD COLUMN models_mib INTEGER NOT NULL DEFAULT 500",
    // Keys, in another file, may expire since: programs that would accept expired ones do not open
    // this one.
    "-- no change"};

}  // namespace

void prepare_tables(SQLite::Database& database) {
  constexpr int kNewest = static_cast<int>(kSteps.size());
  const int version = database.execAndGet("PRAGMA user_version");
  if (version > kNewest) {
    throw EnvironmentError(
        fmt::format("a newer throng wrote the job store, which has version {}; this program ({}) "
                    "knows up to {}: use the newer one, or restore a backup that is as old",
                    version, kGenerator, kNewest));
  }
  SQLite::Transaction transaction(database);
  for (int step = version; step < kNewest; ++step) {
    database.exec(kSteps[static_cast<std::size_t>(step)]);
  }
  database.exec(fmt::format("PRAGMA user_version = {}", kNewest));
  transaction.commit();
}

}  // namespace throng::jobs
