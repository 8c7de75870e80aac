#include "crowd/elements/element.h"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>

#include "base/files/confine.h"
#include "crowd/elements/named_file.h"
#include "crowd/elements/suggest.h"

namespace throng::crowd {

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kMaxShown = 60;
  std::string out = "\"";
  for (const char c : text.substr(0, kMaxShown)) out += (c >= ' ' && c <= '~') ? c : '?';
  if (text.size() > kMaxShown) out += "...";
  return out + "\"";
}

std::string_view Element::name() const { return node_->name; }

std::vector<Element> Element::children() const {
  std::vector<Element> all;
  all.reserve(node_->children.size());
  for (const Node& child : node_->children) all.emplace_back(child, *reading_);
  return all;
}

std::vector<std::pair<std::string_view, std::string_view>> Element::attributes() const {
  std::vector<std::pair<std::string_view, std::string_view>> all;
  all.reserve(node_->attributes.size());
  for (const Attribute& a : node_->attributes) all.emplace_back(a.name, a.value);
  return all;
}

bool Element::words_are_zero() const { return reading_->words_are_zero_; }

std::optional<std::string_view> Element::attribute(std::string_view name) const {
  const std::string* value = node_->find(name);
  return value != nullptr ? std::optional<std::string_view>(*value) : std::nullopt;
}

Element Element::only_child(std::string_view expected) const {
  const std::vector<Element> all = children();
  if (all.size() != 1 || all.front().name() != expected) {
    fail(fmt::format("{} child elements{}", all.size(),
                     all.empty() ? "" : fmt::format(", the first <{}>", all.front().name())),
         fmt::format("exactly one <{}>", expected));
  }
  return all.front();
}

void Element::require_no_children() const {
  const std::vector<Element> all = children();
  if (!all.empty()) all.front().fail_unknown("no child element");
}

Problem Element::problem(std::string found, std::string expected) const {
  const std::string name_text = in_quotes(name());
  std::string element = name_text.substr(1, name_text.size() - 2);
  const bool in_file = node_->line > 0;
  constexpr std::size_t kMaxShown = 3;  // attributes, which tell elements without lines apart
  for (std::size_t i = 0; !in_file && i < std::min(kMaxShown, node_->attributes.size()); ++i) {
    const Attribute& attribute = node_->attributes[i];
    element += fmt::format(" {}={}", attribute.name, in_quotes(attribute.value));
  }
  return {reading_->description_->name,
          in_file ? fmt::format("line {}, element <{}>", node_->line, element)
                  : fmt::format("built in code, element <{}>", element),
          std::move(found), std::move(expected)};
}

Problem Element::attribute_problem(std::string_view attribute, std::string found,
                                   std::string expected) const {
  Problem what = problem(std::move(found), std::move(expected));
  what.where += ", attribute " + in_quotes(attribute);
  return what;
}

void Element::fail(std::string found, std::string expected) const {
  throw InputError(problem(std::move(found), std::move(expected)));
}

void Element::fail_attribute(std::string_view attribute, std::string found,
                             std::string expected) const {
  throw InputError(attribute_problem(attribute, std::move(found), std::move(expected)));
}

void Element::fail_unknown(std::string expected) const {
  std::string found = "an element that is not known here";
  found += did_you_mean(name(), names_in_brackets(expected));
  fail(std::move(found), std::move(expected));
}

void Element::warn(std::string found, std::string expected) const {
  add_warning(problem(std::move(found), std::move(expected)));
}

void Element::warn_attribute(std::string_view attribute, std::string found,
                             std::string expected) const {
  add_warning(attribute_problem(attribute, std::move(found), std::move(expected)));
}

/// Once, also of an element that is read several times in a row.
void Element::add_warning(Problem warning) const {
  constexpr std::ptrdiff_t kInARow = 64;
  std::vector<Problem>& all = reading_->warnings_;
  const auto last = all.end() - std::min(kInARow, std::ssize(all));
  const bool is_known = std::any_of(last, all.end(), [&](const Problem& known) {
    return known.where == warning.where && known.found == warning.found;
  });
  if (!is_known) all.push_back(std::move(warning));
}

TextFile Element::text_file(std::string_view file_name) const {
  const auto& files = reading_->description_->files;
  const auto known = files.find(std::string(file_name));
  if (known == files.end()) return existing_file(file_name);
  return {reading_->description_->folder / file_name, &known->second};
}

std::filesystem::path Element::file_beside(std::string_view file_name) const {
  std::filesystem::path path = named_file(reading_->description_->folder, file_name);
  if (!Confinement::allows(path)) {
    fail(fmt::format("the file {}, which lies elsewhere", in_quotes(file_name)),
         "a file that came with the scenario");
  }
  return path;
}

std::filesystem::path Element::existing_file(std::string_view file_name) const {
  std::filesystem::path path = file_beside(file_name);
  if (!is_file(path)) {
    fail(fmt::format("the file {}, which is no file", in_quotes(file_name)),
         describe_missing_file(path));
  }
  return path;
}

namespace {

/// The first attribute that an element has twice, or null. XML has none; what is built in code may.
const Attribute* find_attribute_twice(const Node& node) {
  const std::vector<Attribute>& all = node.attributes;
  for (auto one = all.begin(); one != all.end(); ++one) {
    const auto is_same = [&](const Attribute& earlier) { return earlier.name == one->name; };
    if (std::any_of(all.begin(), one, is_same)) return &*one;
  }
  return nullptr;
}

void require_attributes_once(const Element& element, const Node& node, Reading& reading) {
  if (const Attribute* const again = find_attribute_twice(node)) {
    element.fail_attribute(again->name, "it twice", "each attribute once");
  }
  for (const Node& child : node.children) {
    require_attributes_once(Element(child, reading), child, reading);
  }
}

}  // namespace

Reading::Reading(const Description& description, std::string_view root_name, bool words_are_zero)
    : description_(&description), words_are_zero_(words_are_zero), warnings_(description.warnings) {
  if (description.root.name != root_name) {
    root().fail_unknown(fmt::format("the root <{}>", root_name));
  }
  require_attributes_once(root(), description.root, *this);
}

}  // namespace throng::crowd
