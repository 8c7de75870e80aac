#include "server/http/answer_budget.h"

#include "server/http/http_error.h"

namespace throng::server {

void AnswerBudget::Reservation::shrink(std::int64_t bytes) {
  {
    const std::lock_guard lock(budget_.mutex_);
    if (bytes >= bytes_) return;
    budget_.used_ -= bytes_ - bytes;
    bytes_ = bytes;
  }
  budget_.freed_.notify_all();
}

std::shared_ptr<AnswerBudget::Reservation> AnswerBudget::reserve(std::int64_t bytes) {
  std::unique_lock lock(mutex_);
  if (!freed_.wait_for(lock, patience_, [&] { return used_ + bytes <= max_bytes_; })) {
    throw HttpError{503, "too many large answers are under way; try again"};
  }
  used_ += bytes;
  return std::make_shared<Reservation>(*this, bytes);
}

}  // namespace throng::server
