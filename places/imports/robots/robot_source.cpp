#include "places/imports/robots/robot_source.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "places/imports/robots/urdf_check.h"
#include "places/imports/sdf/description_file.h"
#include "places/imports/sdf/included_files.h"
#include "places/imports/sdf/model_finder.h"
#include "places/imports/sdf/sdf_complaints.h"
#include "places/imports/sdf/sdf_root.h"

namespace throng::imports {

namespace fs = std::filesystem;

namespace {

/// The name of the root element, as far as one can be found.
std::string root_element(const std::string& text) {
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at + 1)) {
    if (at + 1 >= text.size() || text[at + 1] == '?' || text[at + 1] == '!') continue;
    const std::size_t end = text.find_first_of(" \t\r\n/>", at + 1);
    return text.substr(at + 1, end - at - 1);
  }
  return "";
}

/// Whether masses, poses and constants of a robot are right in spite of this error.
bool is_about_looks(const sdf::Error& error) {
  switch (error.Code()) {
    case sdf::ErrorCode::DUPLICATE_NAME:
    case sdf::ErrorCode::URI_LOOKUP:
    case sdf::ErrorCode::URI_INVALID:
    case sdf::ErrorCode::FILE_READ:
    case sdf::ErrorCode::DIRECTORY_NONEXISTANT:
    case sdf::ErrorCode::ELEMENT_MISSING:
    case sdf::ErrorCode::ELEMENT_INVALID:
    case sdf::ErrorCode::ATTRIBUTE_MISSING:
    case sdf::ErrorCode::LINK_INERTIA_INVALID:
    case sdf::ErrorCode::POSE_RELATIVE_TO_INVALID:
    case sdf::ErrorCode::POSE_RELATIVE_TO_CYCLE:
    case sdf::ErrorCode::FRAME_ATTACHED_TO_INVALID:
    case sdf::ErrorCode::JOINT_PARENT_LINK_INVALID:
    case sdf::ErrorCode::JOINT_CHILD_LINK_INVALID:
      return false;
    default:
      return true;
  }
}

double total_mass_kg(const sdf::Model& model) {
  double mass_kg = 0;
  for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
    mass_kg += model.LinkByIndex(i)->Inertial().MassMatrix().Mass();
  }
  for (std::uint64_t i = 0; i < model.ModelCount(); ++i)
    mass_kg += total_mass_kg(*model.ModelByIndex(i));
  return mass_kg;
}

}  // namespace

RobotSource::RobotSource(fs::path file, const LocalFiles& files) : file_(std::move(file)) {
  sdf::Console::Instance()->SetQuiet(true);
  const std::string text = read_description(file_, "a robot (.sdf, .urdf)");
  const std::string root = root_element(text);
  const ModelFinder finder(files, file_);
  if (root == "robot") {
    load_urdf(text, finder.config());
  } else {
    check_included_files(file_, files);
    load_sdf(text, finder.config());
  }
  if (root_.Model() == nullptr) {
    throw InputError({file_.string(), "", root_.WorldCount() > 0 ? "a world" : "no model",
                      root_.WorldCount() > 0
                          ? "one robot (a <model>); `throng scenario import` reads worlds"
                          : "a robot: <sdf> with a <model>, or <robot>"});
  }
}

void RobotSource::load_sdf(const std::string& text, const sdf::ParserConfig& config) {
  text_.emplace(file_.string(), text);
  take_errors(root_.LoadSdfString(text_->text(), config));
}

void RobotSource::load_urdf(const std::string& text, const sdf::ParserConfig& config) {
  UrdfFacts facts = check_urdf(file_.string(), text);
  urdf_lines_ = std::move(facts.lines);
  take_errors(root_.LoadSdfString(text, config));
  if (root_.Model() == nullptr) return;
  const double mass_kg = total_mass_kg(*root_.Model());
  constexpr double kTolerance = 1e-6;
  if (std::abs(mass_kg - facts.mass_kg) > kTolerance * facts.mass_kg) {
    throw InputError({file_.string(), "",
                      fmt::format("{:.6g} kg of {:.6g} kg: the rest hangs from links without "
                                  "<inertial>, which no simulator moves",
                                  mass_kg, facts.mass_kg),
                      "an <inertial> for each link that joints move"});
  }
}

void RobotSource::take_errors(const sdf::Errors& errors) {
  std::vector<Problem> problems;
  Cause cause = Cause::consequence;  // of the problems
  for (const sdf::Error& error : errors) {
    const std::string path = error.FilePath().value_or("");
    int line = error.LineNumber().value_or(0);
    const bool is_own = is_given_text(path);
    if (is_own) line = text_ && line > 0 ? text_->line_of(line) : 0;
    const int own_line = error.LineNumber().value_or(0);
    const Complaint wrong =
        plain_complaint(error, is_own && text_ && own_line > 0 ? text_->value_at(own_line) : "");
    if (is_about_looks(error)) {
      complaints_.push_back({is_own ? file_.string() : path, line, "SDF", wrong.text()});
      continue;
    }
    if (wrong.cause > cause) continue;  // it follows from the others
    if (wrong.cause < cause) problems.clear();
    cause = wrong.cause;
    Problem problem{is_own ? file_.string() : path, line > 0 ? fmt::format("line {}", line) : "",
                    wrong.found, wrong.expected};
    const bool is_known = std::any_of(problems.begin(), problems.end(), [&](const Problem& other) {
      return other.text() == problem.text();
    });
    if (!is_known) problems.push_back(std::move(problem));
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

std::pair<std::string, int> RobotSource::place_of(const sdf::ElementPtr& element) const {
  if (!element) return {file_.string(), 0};
  if (!text_) {  // URDF: the nearest element with a name that the file has
    for (sdf::ElementPtr at = element; at; at = at->GetParent()) {
      if (!at->HasAttribute("name")) continue;
      const auto found = urdf_lines_.find(at->Get<std::string>("name"));
      if (found != urdf_lines_.end()) return {file_.string(), found->second};
    }
    return {file_.string(), 0};
  }
  // The elements in plugins have no lines of their own.
  for (sdf::ElementPtr at = element; at; at = at->GetParent()) {
    if (!at->LineNumber()) continue;
    if (!is_given_text(at->FilePath())) return {at->FilePath(), *at->LineNumber()};
    return {file_.string(), text_->line_of(*at->LineNumber())};
  }
  return {file_.string(), 0};
}

Skipped RobotSource::skipped(const sdf::ElementPtr& element, const std::string& name,
                             const std::string& why) const {
  const auto [file, line] = place_of(element);
  return {file, line, name, why};
}

Problem RobotSource::problem(const sdf::ElementPtr& element, const std::string& found,
                             const std::string& expected) const {
  const auto [file, line] = place_of(element);
  return {file, line > 0 ? fmt::format("line {}", line) : "", found, expected};
}

}  // namespace throng::imports
