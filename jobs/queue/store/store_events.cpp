#include <fmt/core.h>

#include "jobs/queue/store/store_connections.h"
#include "jobs/queue/store/store_rows.h"

namespace throng::jobs {

void Store::record_event(const JobRow& row, const std::string& type, const std::string& data_json) {
  connections_->write([&] {
    const auto now = find_job(connections_->writer, row.id);
    if (!now || now->state != row.state || now->attempt != row.attempt) return;
    write_event(connections_->writer, row.id, clock_(), type, data_json);
  });
}

std::vector<EventRow> Store::events(const std::string& job, std::int64_t after, int limit) const {
  return connections_->read([&](SQLite::Database& database) {
    SQLite::Statement query(
        database, fmt::format("SELECT seq, job, at_ms, type, data FROM event WHERE seq > :after {} "
                              "ORDER BY seq LIMIT :limit",
                              job.empty() ? "" : "AND job = :job"));
    query.bind(":after", after);
    query.bind(":limit", limit);
    if (!job.empty()) query.bind(":job", job);
    constexpr std::size_t kMaxBytes = 1 << 20;
    std::vector<EventRow> rows;
    for (std::size_t bytes = 0; bytes < kMaxBytes && query.executeStep();
         bytes += rows.back().data_json.size()) {
      rows.push_back({query.getColumn(0).getInt64(), query.getColumn(1).getString(),
                      query.getColumn(2).getInt64(), query.getColumn(3).getString(),
                      query.getColumn(4).getString()});
    }
    return rows;
  });
}

std::int64_t Store::last_event() const {
  return connections_->read([&](SQLite::Database& database) -> std::int64_t {
    SQLite::Statement query(database, "SELECT coalesce(max(seq), 0) FROM event");
    query.executeStep();
    return query.getColumn(0);
  });
}

int Store::forget_events(std::int64_t before_ms) {
  int forgotten = 0;
  connections_->write([&] {
    SQLite::Statement remove(connections_->writer,
                             "DELETE FROM event WHERE type = 'removed' AND at_ms < ?");
    remove.bind(1, before_ms);
    forgotten = remove.exec();
  });
  return forgotten;
}

}  // namespace throng::jobs
