#include "server/description/openapi.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "base/text/words.h"

namespace throng::server {

using nlohmann::ordered_json;

namespace {

constexpr const char* kProblemAnswer = "#/components/responses/Problem";

/// Words for {id}, by the path before it.
constexpr std::array<std::pair<std::string_view, const char*>, 6> kIds = {
    {{"/v1/jobs/", "Id of the job."},
     {"/v1/calibrations/", "Id of the calibration."},
     {"/v1/studies/", "Id of the study."},
     {"/v1/live/", "Id of the flight."},
     {"/v1/keys/", "Id of the key."},
     {"/v1/webhooks/", "Id of the webhook."}}};

const char* id_help(std::string_view path) {
  for (const auto& [prefix, help] : kIds) {
    if (path.starts_with(prefix)) return help;
  }
  return "Id.";
}

std::string path_help(const PathParameter& part, std::string_view path) {
  if (part.name == "id") return id_help(path);
  if (part.name == "n") return "Number of the run, from 0.";
  return part.is_rest ? "Path, which may contain slashes." : "Name.";
}

ValueType path_type(const PathParameter& part) {
  if (part.name == "n") return at_least(0);
  if (part.is_rest) return "string";
  return fields::texts_like(fmt::format("^{}$", part.pattern), "");
}

/// A parameter of the path, with the route's own words if it has some.
Parameter described(const PathParameter& part, const Route& route) {
  const auto& own = route.says.parameters;
  const auto found = std::find_if(own.begin(), own.end(), [&](const Parameter& parameter) {
    return parameter.location == Parameter::Location::path && parameter.name == part.name;
  });
  Parameter parameter = {std::string(part.name),      path_type(part),
                         path_help(part, route.path), nullptr,
                         Parameter::Location::path,   true};
  if (found != own.end()) parameter.help = found->help;
  return parameter;
}

/// The parameters of the path, then all others.
std::vector<Parameter> all_parameters(const Route& route) {
  std::vector<Parameter> all;
  for (const PathParameter& part : path_parameters(route.path)) {
    all.push_back(described(part, route));
  }
  for (const Parameter& parameter : route.says.parameters) {
    if (parameter.location != Parameter::Location::path) all.push_back(parameter);
  }
  const auto& answers = route.says.answers;
  const bool has_parts = std::any_of(answers.begin(), answers.end(),
                                     [](const Answer& answer) { return answer.has_parts; });
  if (has_parts) {
    all.push_back({"Range", "string",
                   "One range of bytes; other ranges are answered with the whole content.", nullptr,
                   Parameter::Location::header});
  }
  return all;
}

const char* location_name(Parameter::Location location) {
  if (location == Parameter::Location::path) return "path";
  return location == Parameter::Location::query ? "query" : "header";
}

ordered_json parameters_json(const Route& route) {
  ordered_json list = ordered_json::array();
  for (const Parameter& parameter : all_parameters(route)) {
    ordered_json value = {{"name", parameter.name}, {"in", location_name(parameter.location)}};
    if (parameter.is_required) value["required"] = true;
    value["description"] = parameter.help;
    value["schema"] = parameter.usual.is_null()
                          ? parameter.type.schema()
                          : with_default(parameter.type, parameter.usual).schema();
    list.push_back(std::move(value));
  }
  return list;
}

ordered_json contents_json(const std::vector<Content>& contents) {
  ordered_json value = ordered_json::object();
  for (const Content& content : contents) {
    ordered_json& form = value[content.media_type] = ordered_json::object();
    if (content.type) form["schema"] = content.type->schema();
    if (*content.help != '\0') form["schema"]["description"] = content.help;
  }
  return value;
}

ordered_json answer_json(const Answer& answer) {
  ordered_json value = {{"description", answer.help}};
  if (!answer.contents.empty()) value["content"] = contents_json(answer.contents);
  if (answer.header != nullptr) value["headers"][answer.header]["schema"]["type"] = "string";
  return value;
}

/// Statuses of problem documents: who may ask, what is asked for, what is sent.
std::set<int> problem_statuses(const Route& route) {
  std::set<int> statuses(route.says.problems.begin(), route.says.problems.end());
  if (route.scope != Scope::anybody) statuses.merge(std::set{400, 401, 403, 429, 503});
  const bool has_parameters = std::string_view(route.path).find('{') != std::string_view::npos;
  if (has_parameters) statuses.insert(404);
  if (route.says.body) statuses.merge(std::set{400, 413, 415});
  return statuses;
}

ordered_json answers_json(const Route& route) {
  std::map<int, ordered_json> answers;
  std::set<int> problems = problem_statuses(route);
  for (const Answer& answer : route.says.answers) {
    answers[answer.status] = answer_json(answer);
    if (!answer.has_parts) continue;
    std::vector<Content> parts;
    parts.reserve(answer.contents.size());
    for (const Content& whole : answer.contents) parts.push_back({whole.media_type});
    answers[206] = answer_json({206, "The requested range of bytes.", parts});
    answers[304] = answer_json({304, "The content is that of the ETag in If-None-Match."});
    problems.insert(416);
  }
  for (const int status : problems) answers[status]["$ref"] = kProblemAnswer;
  ordered_json value = ordered_json::object();
  for (auto& [status, answer] : answers) value[std::to_string(status)] = std::move(answer);
  return value;
}

ordered_json operation_json(const Route& route) {
  const Operation& operation = route.says;
  ordered_json value = {{"summary", operation.summary}};
  if (*operation.help != '\0') value["description"] = operation.help;
  value["tags"] = {operation.tag};
  if (route.scope == Scope::anybody) value["security"] = ordered_json::array();
  ordered_json parameters = parameters_json(route);
  if (!parameters.empty()) value["parameters"] = std::move(parameters);
  if (operation.body) {
    ordered_json& body = value["requestBody"];
    if (*operation.body->help != '\0') body["description"] = operation.body->help;
    body["required"] = operation.body->is_required;
    body["content"] = contents_json(operation.body->contents);
  }
  value["responses"] = answers_json(route);
  return value;
}

}  // namespace

ordered_json openapi_document(std::span<const Route> routes,
                              const std::vector<NamedSchema>& schemas) {
  ordered_json document = {
      {"openapi", "3.1.0"},
      {"security", {{{"key", ordered_json::array()}}}},
      {"info",
       {{"title", "throng"},
        {"version", "1"},
        {"description",
         "Synthetic crowd datasets as jobs. Everything that goes wrong is answered with a problem "
         "document."}}},
      {"paths", ordered_json::object()},
      {"components",
       {{"securitySchemes",
         {{"key",
           {{"type", "http"},
            {"scheme", "bearer"},
            {"description",
             "`throng keys create` makes keys; no request needs one while there are none."}}}}},
        {"schemas", ordered_json::object()},
        {"responses",
         {{"Problem", answer_json({0,
                                   "The errors and their positions.",
                                   {{"application/problem+json", "Problem"}}})}}}}}};
  for (const Route& route : routes) {
    document["paths"][route.path][lower_case(to_string(route.method))] = operation_json(route);
  }
  for (const NamedSchema& schema : schemas) {
    ordered_json& value = document["components"]["schemas"][schema.name] = schema.type.schema();
    if (*schema.help != '\0') value["description"] = schema.help;
  }
  return document;
}

}  // namespace throng::server
