#include "places/imports/sdf/sdf_root.h"

#include <fmt/core.h>
#include <tinyxml2.h>

#include <algorithm>
#include <sdf/sdf.hh>
#include <set>
#include <string>
#include <utility>

#include "base/error.h"
#include "places/imports/sdf/description_file.h"
#include "places/imports/sdf/included_files.h"
#include "places/imports/sdf/model_finder.h"
#include "places/imports/sdf/sdf_complaints.h"
#include "places/imports/sdf/sdf_names.h"
#include "places/imports/sdf/sdf_numbers.h"

namespace throng::imports {

namespace fs = std::filesystem;

namespace {

constexpr int kMaxTakenOut = 50;  // libsdformat takes up to a quarter of a second for each

bool is_loaded(const sdf::Root& root) { return root.WorldCount() > 0 || root.Model() != nullptr; }

// Follows from another complaint, is said again where poses are resolved, or loses nothing here.
bool is_noise(const sdf::Error& error) {
  switch (error.Code()) {
    case sdf::ErrorCode::MODEL_WITHOUT_LINK:
    case sdf::ErrorCode::JOINT_CHILD_LINK_INVALID:
    case sdf::ErrorCode::JOINT_PARENT_LINK_INVALID:
    case sdf::ErrorCode::JOINT_PARENT_SAME_AS_CHILD:
    case sdf::ErrorCode::FRAME_ATTACHED_TO_INVALID:
    case sdf::ErrorCode::FRAME_ATTACHED_TO_CYCLE:
    case sdf::ErrorCode::FRAME_ATTACHED_TO_GRAPH_ERROR:
    case sdf::ErrorCode::POSE_RELATIVE_TO_INVALID:
    case sdf::ErrorCode::POSE_RELATIVE_TO_CYCLE:
    case sdf::ErrorCode::POSE_RELATIVE_TO_GRAPH_ERROR:
      return true;
    default:
      return error.Message() == "Failed to load a world." ||
             error.Message().find("<script>") != std::string::npos;
  }
}

class RootLoader {
 public:
  RootLoader(const fs::path& file, const LocalFiles& files, std::vector<Skipped>& skipped)
      : file_(file),
        skipped_(skipped),
        text_(file.string(), read_description(file, "a world of SDF")),
        finder_(files, file) {
    check_included_files(file, files);
    make_names_unique(text_, file, files);
  }

  SdfText load(sdf::Root& root) {
    sdf::Console::Instance()->SetQuiet(true);
    take_out_odd_numbers();
    sdf::Errors errors = load_once(root);
    for (int i = 0; i < kMaxTakenOut && !is_loaded(root); ++i) {
      if (!take_out_first(errors)) break;
      errors = load_once(root);
    }
    if (!is_loaded(root)) reject(errors);
    list(errors);
    return std::move(text_);
  }

 private:
  sdf::Errors load_once(sdf::Root& root) {
    root = sdf::Root();
    try {
      return root.LoadSdfString(text_.text(), finder_.config());
    } catch (const std::exception&) {
      throw InputError(
          {file_.string(), "", "a value that libsdformat cannot take", "a world of SDF"});
    }
  }

  void take_out_odd_numbers() {
    for (int i = 0; i < kMaxTakenOut; ++i) {
      tinyxml2::XMLDocument document;
      const std::string& text = text_.text();
      if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) return;
      const OddNumber odd = find_odd_number(*document.RootElement());
      const int line = text_.line_of(odd.line);
      const auto part = odd.line > 0 ? text_.take_out(odd.line) : std::nullopt;
      if (!part) return;
      skipped_.push_back({file_.string(), line, part->name,
                          fmt::format("{} is \"{}\"; expected numbers, in meters without unit",
                                      odd.element, odd.value)});
    }
  }

  Complaint complaint(const sdf::Error& error) const {
    const bool is_own = is_given_text(error.FilePath().value_or(""));
    const int line = error.LineNumber().value_or(0);
    return plain_complaint(error, is_own && line > 0 ? text_.value_at(line) : "");
  }

  std::pair<std::string, int> place_of(const sdf::Error& error) const {
    const std::string path = error.FilePath().value_or("");
    const int line = error.LineNumber().value_or(0);
    if (!is_given_text(path)) return {path, line};
    return {file_.string(), line > 0 ? text_.line_of(line) : 0};
  }

  // The first complaint is about the innermost element.
  bool take_out_first(const sdf::Errors& errors) {
    for (const sdf::Error& error : errors) {
      if (!is_given_text(error.FilePath().value_or("")) || !error.LineNumber()) continue;
      const Complaint wrong = complaint(error);
      const int line = text_.line_of(*error.LineNumber());
      const auto part = text_.take_out(*error.LineNumber());
      if (!part) continue;
      skipped_.push_back({file_.string(), line, part->name, wrong.text()});
      return true;
    }
    return false;
  }

  [[noreturn]] void reject(const sdf::Errors& errors) const {
    std::vector<Problem> problems;
    for (const sdf::Error& error : errors) {
      const auto [file, line] = place_of(error);
      // The last one quotes the whole text.
      if (line == 0 && !problems.empty()) continue;
      const Complaint wrong = complaint(error);
      problems.push_back(
          {file, line > 0 ? fmt::format("line {}", line) : "", wrong.found, wrong.expected});
    }
    if (problems.empty()) problems.push_back({file_.string(), "", "no world", "a world of SDF"});
    throw InputError(std::move(problems));
  }

  void list(const sdf::Errors& errors) {
    std::set<std::string> said;
    for (const sdf::Error& error : errors) {
      if (is_noise(error)) continue;
      const auto [file, line] = place_of(error);
      const bool is_own = is_given_text(error.FilePath().value_or("")) && line > 0;
      const std::string label = is_own ? text_.label_at(*error.LineNumber()) : "";
      Skipped skipped{file, line, label.empty() ? "SDF" : label, complaint(error).text()};
      if (said.insert(skipped.text()).second) skipped_.push_back(std::move(skipped));
    }
  }

  const fs::path& file_;
  std::vector<Skipped>& skipped_;
  SdfText text_;
  ModelFinder finder_;
};

}  // namespace

SdfText load_root(const fs::path& file, const LocalFiles& files, sdf::Root& root,
                  std::vector<Skipped>& skipped) {
  return RootLoader(file, files, skipped).load(root);
}

bool is_given_text(const std::string& path) { return path.empty() || path == "<data-string>"; }

}  // namespace throng::imports
