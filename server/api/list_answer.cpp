#include "server/api/list_answer.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "server/catalog/api_json.h"
#include "server/http/http.h"

namespace throng::server {

using nlohmann::json;

// The rows as they come from the store, one of them as JSON, and the text.
constexpr std::int64_t kReservedBytes = 3 * static_cast<std::int64_t>(kMaxPageBytes);

ListAnswer::ListAnswer(AnswerBudget& budget, const char* name)
    : reservation_(budget.reserve(kReservedBytes)), text_(fmt::format("{{\"{}\":[", name)) {}

void ListAnswer::add(const json& row) {
  if (!std::exchange(is_empty_, false)) text_ += ',';
  text_ += dump_text(row);
}

void ListAnswer::send(httplib::Response& response, const std::string& next, const json& more) {
  text_ += "],\"next\":" + (next.empty() ? std::string("null") : dump_text(json(next)));
  for (const auto& [name, value] : more.items()) {
    text_ += fmt::format(",{}:{}", dump_text(json(name)), dump_text(value));
  }
  text_ += '}';
  text_.shrink_to_fit();
  const auto text = std::make_shared<const std::string>(std::move(text_));
  reservation_->shrink(static_cast<std::int64_t>(text->size()));
  response.set_content_provider(
      text->size(), "application/json",
      [text, held = reservation_](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
        return sink.write(text->data() + offset, length);
      });
}

}  // namespace throng::server
