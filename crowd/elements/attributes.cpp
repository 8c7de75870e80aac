#include "crowd/elements/attributes.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/text/words.h"
#include "crowd/elements/suggest.h"

namespace throng::crowd {

namespace {

template <typename Number>
std::optional<Number> parse(std::string_view text) {
  text = trimmed(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// An integer, which may be written like 10.0.
std::optional<long long> parse_whole(std::string_view text) {
  if (const auto value = parse<long long>(text)) return value;
  constexpr double kExact = 9007199254740992;  // 2^53
  const auto value = parse<double>(text);
  if (!value || std::trunc(*value) != *value || std::abs(*value) > kExact) return std::nullopt;
  return static_cast<long long>(*value);
}

/// Reads the raw attributes of one element and remembers which ones were asked for.
class Reader {
 public:
  explicit Reader(const Element& element)
      : element_(element), given_(element.attributes()), used_(given_.size()) {}

  std::optional<std::string_view> find(const std::string& name) {
    known_.push_back(name);
    for (std::size_t i = 0; i < given_.size(); ++i) {
      if (given_[i].first != name) continue;
      used_[i] = true;
      return given_[i].second;
    }
    return std::nullopt;
  }

  /// The same of a deprecated name, which is not suggested; with a warning.
  std::optional<std::string_view> find_deprecated(std::string_view deprecated,
                                                  std::string_view name) {
    for (std::size_t i = 0; i < given_.size(); ++i) {
      if (given_[i].first != deprecated) continue;
      used_[i] = true;
      element_.warn_attribute(deprecated, "a deprecated name", std::string(name));
      return given_[i].second;
    }
    return std::nullopt;
  }

  std::string_view require(const std::string& name, const std::string& expected) {
    const auto found = find(name);
    if (!found) element_.fail_attribute(name, "nothing", expected);
    return *found;
  }

  double number(const std::string& name, std::string_view given, double min, double max) const {
    const auto value = parse<double>(given);
    if (!value || !std::isfinite(*value) || *value < min || *value > max) {
      element_.fail_attribute(name, in_quotes(given), expected_number("a number", min, max));
    }
    return *value;
  }

  long long integer(const std::string& name, std::string_view given, double min, double max) const {
    const auto value = parse_whole(given);
    if (!value || static_cast<double>(*value) < min || static_cast<double>(*value) > max) {
      element_.fail_attribute(name, in_quotes(given), expected_number("an integer", min, max));
    }
    return *value;
  }

  double require_number(const std::string& name, double min, double max) {
    return number(name, require(name, expected_number("a number", min, max)), min, max);
  }

  void warn_of_the_rest() const {
    for (std::size_t i = 0; i < given_.size(); ++i) {
      if (used_[i]) continue;
      const std::string_view name = given_[i].first;
      const std::vector<std::string_view> known(known_.begin(), known_.end());
      element_.warn_attribute(
          name, "an unknown attribute, which is ignored" + did_you_mean(name, known),
          known_.empty() ? "no attribute" : fmt::format("{}", fmt::join(known_, ", ")));
    }
  }

  static std::string expected_number(std::string_view kind, double min, double max) {
    return fmt::format("{} from {:.6g} to {:.6g}", kind, min, max);
  }

 private:
  const Element& element_;
  std::vector<std::pair<std::string_view, std::string_view>> given_;
  std::vector<bool> used_;
  std::vector<std::string> known_;
};

constexpr double kMaxSeed = std::numeric_limits<std::uint32_t>::max();

/// Nothing when the group is optional and its `dist` is not given.
std::optional<std::string_view> read_kind(const Element& element, Reader& reader,
                                          const AttributeSpec& spec, const std::string& name,
                                          std::span<const std::string_view> kinds) {
  constexpr std::array<std::string_view, 3> kMeanings = {" (constant)", " (uniform)", " (normal)"};
  const auto given = reader.find(name);
  if (!given && spec.presence == Presence::optional) return std::nullopt;
  std::string expected;
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    expected += fmt::format("{}{}{}", i == 0 ? "one of " : ", ", kinds[i],
                            i < kMeanings.size() ? kMeanings[i] : "");
  }
  if (!given) element.fail_attribute(name, "nothing", expected);
  if (std::find(kinds.begin(), kinds.end(), *given) == kinds.end()) {
    element.fail_attribute(name, in_quotes(*given) + did_you_mean(*given, kinds), expected);
  }
  return *given;
}

/// Limits of a distribution that has not the form `c` or `u`: those given, within those of what
/// is sampled; a normal one, which Menge has too, goes on unlimited where none is given.
void read_limits(const Element& element, Reader& reader, const AttributeSpec& spec,
                 Distribution& made) {
  const std::string prefix(spec.name);
  const auto at_least = reader.find(prefix + "at_least");
  const auto at_most = reader.find(prefix + "at_most");
  if (made.kind == Distribution::Kind::normal && !at_least && !at_most) return;
  made.at_least = spec.min;
  made.at_most = spec.max;
  if (at_least) made.at_least = reader.number(prefix + "at_least", *at_least, spec.min, spec.max);
  if (at_most) made.at_most = reader.number(prefix + "at_most", *at_most, made.at_least, spec.max);
  constexpr double kTooFew = 1e-6;
  if (made.share_between_limits() > kTooFew) return;
  element.fail_attribute(
      prefix + (at_most && !at_least ? "at_most" : "at_least"),
      fmt::format("limits of {:.6g} and {:.6g}, between which there is less than one in a million "
                  "of the values",
                  made.at_least, made.at_most),
      "limits about the distribution's middle");
}

std::optional<Distribution> read_distribution(const Element& element, Reader& reader,
                                              const AttributeSpec& spec) {
  const std::string prefix(spec.name);
  const std::span<const DistributionForm> forms = distribution_forms();
  std::vector<std::string_view> words;
  for (const DistributionForm& form : forms) words.push_back(form.word);
  const auto kind = read_kind(element, reader, spec, prefix + "dist", words);
  if (!kind) return std::nullopt;
  const DistributionForm& form =
      *std::find_if(forms.begin(), forms.end(), [&](const auto& f) { return f.word == *kind; });
  const auto read = [&](std::size_t number) {
    const DistributionForm::Parameter& parameter = form.parameters[number];
    return reader.require_number(prefix + std::string(parameter.name),
                                 parameter.is_a_value ? spec.min : parameter.min,
                                 parameter.is_a_value ? spec.max : parameter.max);
  };
  Distribution made;
  made.kind = form.kind;
  made.first = read(0);
  if (form.parameters.size() > 1) made.second = read(1);
  if (form.kind == Distribution::Kind::uniform && made.second < made.first) {
    element.fail_attribute(prefix + "max", fmt::format("{:.6g}", made.second),
                           Reader::expected_number("a number", made.first, spec.max));
  }
  if (form.has_limits) read_limits(element, reader, spec, made);
  const std::string seed_name = prefix + "seed";
  if (const auto seed = reader.find(seed_name)) {
    made.seed = static_cast<std::uint64_t>(reader.integer(seed_name, *seed, 0, kMaxSeed));
  }
  return made;
}

std::optional<Distribution2> read_distribution_2(const Element& element, Reader& reader,
                                                 const AttributeSpec& spec) {
  constexpr std::array<std::string_view, 2> kKinds = {"c", "u"};
  const auto kind = read_kind(element, reader, spec, "dist", kKinds);
  if (!kind) return std::nullopt;
  const auto read = [&](const char* name, double min) {
    return static_cast<float>(reader.require_number(name, min, spec.max));
  };
  if (*kind == "c") {
    const Eigen::Vector2f point(read("x_value", spec.min), read("y_value", spec.min));
    return Distribution2{point, point};
  }
  const Eigen::Vector2f low(read("min_x", spec.min), read("min_y", spec.min));
  const Eigen::Vector2f high(read("max_x", low.x()), read("max_y", low.y()));
  return Distribution2{low, high};
}

bool read_boolean(const Element& element, std::string_view name, std::string_view given) {
  const std::string_view value = trimmed(given);
  if (value == "true") {
    element.warn_attribute(name, "\"true\"",
                           "1 (Menge reads words as 0, and so do compatible runs)");
    return !element.words_are_zero();
  }
  if (value == "false") return false;
  if (const auto number = parse<long long>(value)) return *number != 0;
  element.fail_attribute(name, in_quotes(given), "0, 1, false or true");
}

std::string read_text(const Element& element, const AttributeSpec& spec, std::string_view given) {
  if (given.empty()) element.fail_attribute(spec.name, "an empty text", std::string(spec.help));
  if (!spec.words.empty() &&
      std::find(spec.words.begin(), spec.words.end(), given) == spec.words.end()) {
    element.fail_attribute(spec.name, in_quotes(given) + did_you_mean(given, spec.words),
                           fmt::format("one of {}", fmt::join(spec.words, ", ")));
  }
  return std::string(given);
}

template <typename Type, typename Variant>
const Type& get(const Variant& value) {
  const Type* typed = std::get_if<Type>(&value);
  check(typed != nullptr, "an attribute is read as the type that its table gives it");
  return *typed;
}

}  // namespace

AttributeSpec number(std::string_view name, std::string_view help, double min, double max) {
  return {.name = name, .type = AttributeType::number, .help = help, .min = min, .max = max};
}

AttributeSpec integer(std::string_view name, std::string_view help, double min, double max) {
  return {.name = name, .type = AttributeType::integer, .help = help, .min = min, .max = max};
}

AttributeSpec boolean(std::string_view name, std::string_view help) {
  return {.name = name, .type = AttributeType::boolean, .help = help};
}

AttributeSpec text(std::string_view name, std::string_view help) {
  return {.name = name, .type = AttributeType::text, .help = help};
}

AttributeSpec word(std::string_view name, std::vector<std::string_view> words,
                   std::string_view help) {
  return {.name = name, .type = AttributeType::text, .help = help, .words = std::move(words)};
}

AttributeSpec distribution(std::string_view prefix, std::string_view help, double min, double max) {
  return {
      .name = prefix, .type = AttributeType::distribution, .help = help, .min = min, .max = max};
}

AttributeSpec distribution_2(std::string_view help) {
  return {.name = "", .type = AttributeType::distribution_2, .help = help};
}

AttributeSpec optional(AttributeSpec spec, std::string_view default_text) {
  spec.presence = Presence::optional;
  spec.default_text = default_text;
  return spec;
}

AttributeSpec renamed(AttributeSpec spec, std::string_view deprecated_name) {
  spec.deprecated_name = deprecated_name;
  return spec;
}

Attributes::Attributes(const Element& element, const AttributeTable& table) {
  Reader reader(element);
  for (const AttributeSpec& spec : table) {
    Value& value = values_.emplace_back(spec.name, Value{}).second;
    if (spec.type == AttributeType::distribution) {
      if (const auto made = read_distribution(element, reader, spec)) value = *made;
      continue;
    }
    if (spec.type == AttributeType::distribution_2) {
      if (const auto made = read_distribution_2(element, reader, spec)) value = *made;
      continue;
    }
    std::string name(spec.name);
    auto given = reader.find(name);
    if (!given && !spec.deprecated_name.empty()) {
      given = reader.find_deprecated(spec.deprecated_name, spec.name);
      if (given) name = spec.deprecated_name;
    }
    if (!given && spec.presence == Presence::required) {
      element.fail_attribute(name, "nothing", std::string(spec.help));
    }
    // An empty text is none; that is how Menge's own files say that something is not wanted.
    const bool is_text = spec.type == AttributeType::text;
    if (is_text && spec.presence == Presence::optional && given == "") given.reset();
    if (!given && !spec.default_text.empty()) given = spec.default_text;
    if (!given) continue;
    switch (spec.type) {
      case AttributeType::number:
        value = reader.number(name, *given, spec.min, spec.max);
        break;
      case AttributeType::integer:
        value = reader.integer(name, *given, spec.min, spec.max);
        break;
      case AttributeType::boolean:
        value = read_boolean(element, name, *given);
        break;
      default:
        value = read_text(element, spec, *given);
    }
  }
  reader.warn_of_the_rest();
}

const Attributes::Value& Attributes::value(std::string_view name) const {
  const auto found = std::find_if(values_.begin(), values_.end(),
                                  [&](const auto& entry) { return entry.first == name; });
  check(found != values_.end(), "only attributes of the table are asked for");
  return found->second;
}

bool Attributes::has(std::string_view name) const {
  return !std::holds_alternative<std::monostate>(value(name));
}

double Attributes::number(std::string_view name) const { return get<double>(value(name)); }

long long Attributes::integer(std::string_view name) const { return get<long long>(value(name)); }

bool Attributes::boolean(std::string_view name) const { return get<bool>(value(name)); }

const std::string& Attributes::text(std::string_view name) const {
  return get<std::string>(value(name));
}

const Distribution& Attributes::distribution(std::string_view prefix) const {
  return get<Distribution>(value(prefix));
}

const Distribution2& Attributes::distribution_2() const { return get<Distribution2>(value("")); }

}  // namespace throng::crowd
