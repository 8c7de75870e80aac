// Many threads' changes to a database in one commit: the disk is waited for once for all that came
// while it was busy.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <vector>

namespace throng::jobs {

/// Safe to use from many threads; nobody else may write through the database.
class GroupCommit {
 public:
  explicit GroupCommit(SQLite::Database& database) : database_(database) {}

  /// Runs the change and returns when it is durable. Its exceptions are rethrown here, and then
  /// none of it has happened; others' changes are not touched by that. When the commit itself
  /// fails, all that were in it throw.
  void run(const std::function<void()>& change);

 private:
  struct Waiting {
    const std::function<void()>* change;
    std::exception_ptr error = nullptr;
    bool is_done = false;
  };

  void commit(const std::vector<Waiting*>& group);
  void apply(Waiting& waiting);

  SQLite::Database& database_;
  std::mutex mutex_;
  std::condition_variable done_;
  std::vector<Waiting*> queue_;
  bool is_committing_ = false;
};

}  // namespace throng::jobs
