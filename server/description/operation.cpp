#include "server/description/operation.h"

namespace throng::server {

Body json_body(ValueType type, const char* help, bool is_required) {
  return {{{"application/json", std::move(type), help}}, "", is_required};
}

Answer json_answer(int status, const char* help, ValueType type, const char* header) {
  return {status, help, {{"application/json", std::move(type)}}, header};
}

Answer ok(const char* help, ValueType type) { return json_answer(200, help, std::move(type)); }

Answer created(const char* help, ValueType type) {
  return json_answer(201, help, std::move(type), "Location");
}

Answer done(const char* help, const char* header) { return {204, help, {}, header}; }

Answer content(const char* help, std::vector<Content> contents) {
  return {200, help, std::move(contents)};
}

Answer file(const char* help, std::vector<Content> contents) {
  return {200, help, std::move(contents), nullptr, true};
}

Parameter path_part(const char* name, const char* help) {
  return {name, "string", help, nullptr, Parameter::Location::path, true};
}

}  // namespace throng::server
