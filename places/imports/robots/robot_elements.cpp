#include "places/imports/robots/robot_elements.h"

#include <fmt/core.h>

#include <cmath>
#include <locale>
#include <sstream>
#include <vector>

namespace throng::imports {

namespace {

/// The numbers of a text; none if there is anything else in it.
std::vector<double> parse_numbers(const std::string& text) {
  std::istringstream in(text);
  in.imbue(std::locale::classic());
  std::vector<double> numbers;
  for (double number = 0; in >> number;) numbers.push_back(number);
  if (!in.eof()) return {};
  for (const double number : numbers) {
    if (!std::isfinite(number)) return {};
  }
  return numbers;
}

}  // namespace

std::string read_attribute(const sdf::ElementPtr& element, const std::string& name) {
  return element->HasAttribute(name) ? element->Get<std::string>(name) : "";
}

std::string text_in(const sdf::ElementPtr& element, const std::string& name) {
  if (!element->HasElement(name)) return "";
  return element->GetElement(name)->Get<std::string>();
}

std::optional<double> number_in(const RobotSource& source, const sdf::ElementPtr& element,
                                const std::string& name) {
  if (!element->HasElement(name)) return std::nullopt;
  const std::string text = text_in(element, name);
  const std::vector<double> numbers = parse_numbers(text);
  if (numbers.size() != 1) {
    throw InputError(source.problem(element->GetElement(name),
                                    fmt::format("<{}>{}</{}>", name, text, name), "a number"));
  }
  return numbers.front();
}

std::optional<Eigen::Vector3d> axes_in(const RobotSource& source, const sdf::ElementPtr& element,
                                       const std::string& name) {
  if (!element->HasElement(name)) return std::nullopt;
  const std::string text = text_in(element, name);
  const std::vector<double> numbers = parse_numbers(text);
  if (numbers.size() == 1) return Eigen::Vector3d::Constant(numbers.front());
  if (numbers.size() == 3) return Eigen::Vector3d(numbers.data());
  throw InputError(source.problem(element->GetElement(name),
                                  fmt::format("<{}>{}</{}>", name, text, name),
                                  "one number, or three"));
}

}  // namespace throng::imports
