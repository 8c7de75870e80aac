// An answer with a list of rows, written row by row within a budget of bytes.
#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "server/http/answer_budget.h"
#include "server/http/http_fwd.h"

namespace throng::server {

/// Size at which a page of a list ends; the rest follows on the next page.
inline constexpr std::size_t kMaxPageBytes = 4 << 20;

/// {"NAME": [rows], "next": cursor or null}. Holds its part of the budget until it has been sent.
class ListAnswer {
 public:
  /// Throws HttpError 503 if there are too many such answers.
  ListAnswer(AnswerBudget& budget, const char* name);

  void add(const nlohmann::json& row);
  /// Whether no more rows may be added.
  bool is_full() const { return text_.size() >= kMaxPageBytes; }
  /// Sends the list. `next` is the cursor of the next page; "" if there is none. `more` holds
  /// further members of the answer.
  void send(httplib::Response& response, const std::string& next, const nlohmann::json& more);

 private:
  std::shared_ptr<AnswerBudget::Reservation> reservation_;
  std::string text_;
  bool is_empty_ = true;
};

}  // namespace throng::server
