#include "places/imports/sdf/sdf_complaints.h"

#include <fmt/core.h>

#include <map>
#include <regex>
#include <sdf/sdf.hh>

namespace throng::imports {

namespace {

/// The names that a message of libsdformat has in brackets.
std::string quoted_in(const std::string& message) {
  const std::size_t begin = message.find('[');
  const std::size_t end = message.find(']', begin);
  if (end == std::string::npos) return "";
  return message.substr(begin + 1, end - begin - 1);
}

/// The innermost element that an error is about, such as "<size>".
std::string element_in(const sdf::Error& error) {
  const std::string path = error.XmlPath().value_or("");
  const std::string last = path.substr(path.rfind('/') + 1);
  if (!last.empty()) return fmt::format("<{}>", last.substr(0, last.find('[')));
  const std::string& message = error.Message();
  const std::size_t begin = message.find('<');
  const std::size_t end = message.find('>', begin);
  if (end == std::string::npos) return "an element";
  return message.substr(begin, end + 1 - begin);
}

/// The kind of value that an element has.
std::string expected_value(const std::string& element) {
  static const std::map<std::string, std::string> kValues = {
      {"<pose>", "6 numbers"},       {"<size>", "2 or 3 numbers"},
      {"<scale>", "3 numbers"},      {"<radii>", "3 numbers"},
      {"<normal>", "3 numbers"},     {"<direction>", "3 numbers"},
      {"<point>", "2 or 3 numbers"}, {"<radius>", "a number"},
      {"<length>", "a number"},      {"<height>", "a number"},
      {"<width>", "a number"},       {"<mass>", "a number"},
      {"<diffuse>", "4 numbers"},    {"<ambient>", "4 numbers"},
      {"<static>", "true or false"}, {"<cast_shadows>", "true or false"},
      {"<specular>", "4 numbers"},   {"<emissive>", "4 numbers"}};
  const auto found = kValues.find(element);
  return found == kValues.end() ? "a value of its kind, and children that SDF knows"
                                : found->second;
}

/// A name that an element refers to and nothing has; of other errors, that there is one.
Complaint unfit(const sdf::Error& error, const std::string& element) {
  static const std::regex kReference(R"(name\[(.*)\] specified by (\w+) with name\[(.*?)\])");
  const std::string message = error.Message();
  std::smatch said;
  if (!std::regex_search(message, said, kReference)) {
    return {fmt::format("{} that does not fit to the rest", element), "a world as SDF has it",
            Cause::consequence};
  }
  return {fmt::format("\"{}\", to which {} \"{}\" refers, but nothing of that name", said.str(1),
                      said.str(2), said.str(3)),
          "the name of a link, joint, frame or model there"};
}

}  // namespace

Complaint plain_complaint(const sdf::Error& error, const std::string& value) {
  const std::string element = element_in(error);
  const std::string name = quoted_in(error.Message());
  switch (error.Code()) {
    case sdf::ErrorCode::DUPLICATE_NAME:
      return {fmt::format("another element is named \"{}\"", name), "names that differ"};
    case sdf::ErrorCode::RESERVED_NAME:
      return {fmt::format("the name \"{}\"", name), "a name that SDF does not reserve"};
    case sdf::ErrorCode::ATTRIBUTE_MISSING:
      return {fmt::format("{} without an attribute that it must have", element),
              "an attribute name, and type where SDF has one"};
    case sdf::ErrorCode::ATTRIBUTE_INVALID:
    case sdf::ErrorCode::ATTRIBUTE_INCORRECT_TYPE:
      return {fmt::format("an attribute of {} with a value of another kind", element),
              "attributes as SDF has them"};
    case sdf::ErrorCode::ELEMENT_MISSING:
      return {"an element is missing that must be there", "elements as SDF has them"};
    case sdf::ErrorCode::ELEMENT_INVALID:
    case sdf::ErrorCode::ELEMENT_INCORRECT_TYPE:
      return {value.empty() ? fmt::format("{} cannot be read", element)
                            : fmt::format("{} is \"{}\"", element, value),
              expected_value(element)};
    case sdf::ErrorCode::URI_INVALID:
    case sdf::ErrorCode::URI_LOOKUP:
      return {fmt::format("no file for \"{}\"", name),
              "a file in the folders of the world and models (nothing is fetched: see --models)",
              Cause::missing_file};
    case sdf::ErrorCode::FILE_READ:
    case sdf::ErrorCode::DIRECTORY_NONEXISTANT:
      return {fmt::format("\"{}\" cannot be read", name),
              "a model of SDF (model.config names its file)", Cause::missing_file};
    case sdf::ErrorCode::STRING_READ:
      return {"no world or model can be read", "a world of SDF"};
    default:
      return unfit(error, element);
  }
}

}  // namespace throng::imports
