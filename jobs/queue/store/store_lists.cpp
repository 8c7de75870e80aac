#include <fmt/core.h>
#include <fmt/ranges.h>

#include "base/text/utf8.h"
#include "jobs/queue/store/store_connections.h"
#include "jobs/queue/store/store_rows.h"

namespace throng::jobs {

namespace {

// The index of names knows parts of at least so many characters.
constexpr std::size_t kMinIndexedPart = 3;

/// Whether full-text search can look for the part: it ends at a zero byte.
bool has_indexed_part(const JobFilter& filter) {
  return character_count(filter.name_part) >= kMinIndexedPart &&
         filter.name_part.find('\0') == std::string::npos;
}

/// A text as a phrase of SQLite's full-text search.
std::string fts_phrase(const std::string& text) {
  std::string phrase = "\"";
  for (const char c : text) phrase += c == '"' ? std::string("\"\"") : std::string(1, c);
  return phrase + '"';
}

/// The rows of a list: in each case an index that has the order of the list.
struct Source {
  std::string tables;
  std::string order;  ///< column
  std::string where;
};

/// Columns of rows whose jobs, which may be large, are not needed.
std::string columns_without_spec() {
  constexpr std::string_view kSpec = "job.spec";
  std::string columns = kColumns;
  return columns.replace(columns.find(kSpec), kSpec.size(), "''");
}

Source filter_source(const JobFilter& filter) {
  const bool has_label = !filter.label.empty();
  const char* compared = filter.oldest_first ? ">" : "<";
  if (!filter.name_part.empty()) {
    // Names alone are soon read; rows hold whole jobs.
    Source source{"job_name CROSS JOIN job ON job.number = job_name.rowid", "job_name.rowid",
                  has_indexed_part(filter) ? " AND job_name MATCH :name"
                                           : " AND instr(lower(job_name.name), lower(:name)) > 0"};
    if (!filter.after.empty()) {
      source.where += fmt::format(
          " AND job_name.rowid {0}= (SELECT number FROM job WHERE id {0} :after ORDER BY id {1} "
          "LIMIT 1)",
          compared, filter.oldest_first ? "ASC" : "DESC");
    }
    if (has_label) {
      source.where +=
          " AND EXISTS (SELECT 1 FROM job_label WHERE label = :label AND job_label.job = job.id)";
    }
    return source;
  }
  Source source{"job", "job.id", ""};
  if (has_label) {
    source = {"job_label CROSS JOIN job ON job.id = job_label.job", "job_label.job",
              " AND job_label.label = :label"};
  }
  if (!filter.after.empty()) {
    source.where += fmt::format(" AND {} {} :after", source.order, compared);
  }
  return source;
}

}  // namespace

std::string list_query(const JobFilter& filter) {
  const Source source = filter_source(filter);
  std::string where = "job.kind = :kind" + source.where;
  if (filter.visible_to) {
    where += fmt::format(
        " AND job.id IN (SELECT id FROM job WHERE owner = :viewer UNION SELECT job FROM job_label "
        "WHERE label = '{}')",
        kSharedLabel);
  }
  if (!filter.states.empty()) {
    std::vector<std::string> names;
    for (const JobState state : filter.states)
      names.push_back(fmt::format("'{}'", to_string(state)));
    // An index has the order of one state's jobs, but not of several states'.
    where += names.size() == 1
                 ? fmt::format(" AND job.state = {}", names[0])
                 : fmt::format(
                       " AND job.id IN (SELECT id FROM job WHERE kind = :kind AND state IN ({}))",
                       fmt::join(names, ", "));
  }
  const std::string columns = filter.with_spec ? kColumns : columns_without_spec();
  return fmt::format("SELECT {} FROM {} WHERE {} ORDER BY {} {} LIMIT :limit", columns,
                     source.tables, where, source.order, filter.oldest_first ? "ASC" : "DESC");
}

std::optional<JobRow> Store::get(const std::string& id) const {
  return connections_->read([&](SQLite::Database& database) {
    SQLite::Statement query(database, fmt::format("SELECT {} FROM job WHERE id = ?", kColumns));
    query.bind(1, id);
    return read_first_row(query);
  });
}

std::vector<JobRow> Store::list(const JobFilter& filter) const {
  return connections_->read([&](SQLite::Database& database) {
    SQLite::Statement query(database, list_query(filter));
    query.bind(":kind", std::string(to_string(filter.kind)));
    if (!filter.after.empty()) query.bind(":after", filter.after);
    if (!filter.label.empty()) query.bind(":label", filter.label);
    if (has_indexed_part(filter)) {
      query.bind(":name", fts_phrase(filter.name_part));
    } else if (!filter.name_part.empty()) {
      query.bind(":name", filter.name_part);
    }
    if (filter.visible_to) query.bind(":viewer", *filter.visible_to);
    query.bind(":limit", filter.limit);
    return read_rows(query, filter.max_text_bytes);
  });
}

std::map<JobState, std::int64_t> Store::count() const {
  return connections_->read([&](SQLite::Database& database) {
    std::map<JobState, std::int64_t> counts;
    for (const JobState state : kJobStates) counts[state] = 0;
    SQLite::Statement query(database, "SELECT state, count(*) FROM job GROUP BY state");
    while (query.executeStep()) {
      const auto state = job_state_named(query.getColumn(0).getString());
      counts[state.value_or(JobState::failed)] += query.getColumn(1).getInt64();
    }
    return counts;
  });
}

std::vector<OwnerCount> Store::count_by_owner() const {
  return connections_->read([&](SQLite::Database& database) {
    SQLite::Statement query(database,
                            "SELECT owner, state, count(*) FROM job WHERE state IN ('queued', "
                            "'running') GROUP BY owner, state ORDER BY count(*) DESC, owner");
    std::vector<OwnerCount> counts;
    while (query.executeStep()) {
      counts.push_back({query.getColumn(0).getString(),
                        job_state_named(query.getColumn(1).getString()).value_or(JobState::queued),
                        query.getColumn(2).getInt64()});
    }
    return counts;
  });
}

std::vector<JobRow> Store::startable() const {
  return connections_->read([&](SQLite::Database& database) {
    SQLite::Statement running(
        database, fmt::format("SELECT {} FROM job WHERE state = 'running' ORDER BY id", kColumns));
    std::vector<JobRow> rows = read_rows(running);
    SQLite::Statement queued(
        database,
        fmt::format("SELECT {} FROM job WHERE id IN (SELECT id FROM (SELECT id, row_number() OVER "
                    "(PARTITION BY owner ORDER BY priority DESC, id) AS place FROM job WHERE state "
                    "= 'queued') WHERE place = 1) ORDER BY priority DESC, id",
                    kColumns));
    for (JobRow& row : read_rows(queued)) rows.push_back(std::move(row));
    return rows;
  });
}

std::vector<JobRow> Store::ended(int limit) const {
  return connections_->read([&](SQLite::Database& database) {
    SQLite::Statement query(database,
                            fmt::format("SELECT {} FROM job WHERE kept_from_ms > 0 AND keep = 0 "
                                        "ORDER BY kept_from_ms LIMIT ?",
                                        columns_without_spec()));
    query.bind(1, limit);
    return read_rows(query);
  });
}

std::int64_t Store::total_bytes() const {
  return connections_->read([&](SQLite::Database& database) -> std::int64_t {
    SQLite::Statement query(database, "SELECT coalesce(sum(bytes), 0) FROM job");
    query.executeStep();
    return query.getColumn(0);
  });
}

}  // namespace throng::jobs
