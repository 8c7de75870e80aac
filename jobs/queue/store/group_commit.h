// Group commit: changes of many threads share one transaction, so that all changes that arrive
// during a disk sync wait for one further sync only.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <vector>

namespace throng::jobs {

/// Safe to use from many threads. Nothing else may write through the same connection.
class GroupCommit {
 public:
  /// The database must outlive this object.
  explicit GroupCommit(SQLite::Database& database) : database_(database) {}

  /// Runs the change, perhaps on another caller's thread, and returns when it is durable. If
  /// `change` throws, it is rolled back alone and the exception is rethrown here. If the commit
  /// fails, the calls of all changes in it throw.
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
