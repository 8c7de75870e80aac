// The description of a route: parameters, body, answers. openapi.json is made of it.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "server/description/value_type.h"

namespace throng::server {

/// A parameter of a request.
struct Parameter {
  enum class Location { query, header, path };

  std::string name;
  ValueType type;
  std::string help = {};
  nlohmann::ordered_json usual = nullptr;  ///< the default; null if there is none
  Location location = Location::query;
  bool is_required = false;
};

/// A form of a body, or of an answer.
struct Content {
  const char* media_type;
  std::optional<ValueType> type = std::nullopt;
  const char* help = "";
};

/// The body of a request.
struct Body {
  std::vector<Content> contents;
  const char* help = "";
  bool is_required = true;
};

/// An answer that is no problem document.
struct Answer {
  int status;
  const char* help;
  std::vector<Content> contents = {};
  const char* header = nullptr;  ///< that comes along
  bool has_parts = false;        ///< whether it has an ETag and can be had in ranges of bytes
};

/// The description of a route. Parameters of its path, and the problems that every such route may
/// have, follow from the route.
struct Operation {
  const char* summary = "";
  const char* help = "";
  const char* tag = "";
  std::vector<Parameter> parameters = {};
  std::optional<Body> body = std::nullopt;
  std::vector<Answer> answers = {};
  std::vector<int> problems = {};  ///< HTTP statuses of other problems
};

/// A JSON body.
Body json_body(ValueType type, const char* help = "", bool is_required = true);
/// A JSON answer.
Answer json_answer(int status, const char* help, ValueType type, const char* header = nullptr);
/// 200 with JSON.
Answer ok(const char* help, ValueType type);
/// 201 with JSON and a Location.
Answer created(const char* help, ValueType type);
/// 204, without a body.
Answer done(const char* help, const char* header = nullptr);
/// 200 in one of the forms.
Answer content(const char* help, std::vector<Content> contents);
/// 200 with a file in one of the forms, or a range of its bytes.
Answer file(const char* help, std::vector<Content> contents);
/// Words for a parameter of the path, whose name determines its values.
Parameter path_part(const char* name, const char* help);

}  // namespace throng::server
