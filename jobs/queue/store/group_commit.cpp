#include "jobs/queue/store/group_commit.h"

#include <SQLiteCpp/Savepoint.h>

namespace throng::jobs {

void GroupCommit::run(const std::function<void()>& change) {
  Waiting mine{&change};
  std::unique_lock lock(mutex_);
  queue_.push_back(&mine);
  // The first thread that finds no commit in progress commits for all that wait; later ones join
  // the next.
  done_.wait(lock, [&] { return mine.is_done || !is_committing_; });
  if (!mine.is_done) {
    is_committing_ = true;
    std::vector<Waiting*> group;
    group.swap(queue_);
    lock.unlock();
    commit(group);
    lock.lock();
    is_committing_ = false;
    for (Waiting* waiting : group) waiting->is_done = true;
    done_.notify_all();
  }
  if (mine.error) std::rethrow_exception(mine.error);
}

void GroupCommit::commit(const std::vector<Waiting*>& group) {
  try {
    SQLite::Transaction transaction(database_, SQLite::TransactionBehavior::IMMEDIATE);
    for (Waiting* waiting : group) apply(*waiting);
    transaction.commit();
  } catch (...) {
    for (Waiting* waiting : group) {
      if (!waiting->error) waiting->error = std::current_exception();
    }
  }
}

void GroupCommit::apply(Waiting& waiting) {
  try {
    SQLite::Savepoint savepoint(database_, "change");  // undone unless it is released
    (*waiting.change)();
    savepoint.release();
  } catch (...) {
    waiting.error = std::current_exception();
  }
}

}  // namespace throng::jobs
