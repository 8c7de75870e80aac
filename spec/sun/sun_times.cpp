#include "spec/sun/sun_times.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "base/geometry/angle.h"
#include "base/json/json_describe.h"
#include "base/text/suggest.h"
#include "spec/sun/sun.h"

namespace throng::jobs {

using nlohmann::json;

namespace {

constexpr int kHourMin = 60;
constexpr int kSunNoonMin = 12 * kHourMin;
constexpr double kTwilightDeg = -6;  // civil twilight

struct SunWord {
  std::string_view word;
  int half_day;  ///< -1: before noon, 1: after it, 0: at a time that is always the same
  double elevation_deg;
  int minute;
};

constexpr std::array<SunWord, 6> kSunWords = {{{"midnight", 0, 0, 0},
                                               {"dawn", -1, kTwilightDeg, 0},
                                               {"sunrise", -1, 0, 0},
                                               {"noon", 0, 0, kSunNoonMin},
                                               {"sunset", 1, 0, 0},
                                               {"dusk", 1, kTwilightDeg, 0}}};
std::vector<std::string_view> sun_names() {
  std::vector<std::string_view> names;
  names.reserve(kSunWords.size());
  for (const SunWord& word : kSunWords) names.push_back(word.word);
  return names;
}

constexpr const char* kExpectedTime =
    "a time HH:MM, or midnight, dawn, sunrise, noon, sunset or dusk, also as \"sunset-20min\"";

/// The latitude and the day that the sun is looked at.
struct SunPosition {
  double latitude_deg = kUsualLatitudeDeg;
  int day_of_year = kUsualDayOfYear;
  bool is_sampled = false;  ///< other ones in other runs
};

SunPosition read_position(const json& job) {
  SunPosition position;
  const json none = json::object();
  const auto part = [&](const char* key) {
    const auto found = job.find(key);
    return found != job.end() && found->is_object() ? *found : none;
  };
  const json environment = part("environment");
  const json randomize = part("randomize");
  const auto read = [&](const char* key, auto& value) {
    const auto found = environment.find(key);
    const bool is_given = found != environment.end();
    if (is_given && found->is_number())
      value = found->template get<std::decay_t<decltype(value)>>();
    position.is_sampled = position.is_sampled || (is_given && found->is_object()) ||
                          randomize.contains(fmt::format("environment.{}", key));
  };
  read("latitude_deg", position.latitude_deg);
  read("day_of_year", position.day_of_year);
  return position;
}

/// The minute of the day at which the sun passes an elevation; nothing where it does not. The
/// elevation falls from noon to midnight.
std::optional<int> find_minute(const SunWord& word, const SunPosition& position) {
  const auto elevation_deg = [&](double hours) {
    return sun_at(hours, position.latitude_deg, position.day_of_year).elevation_rad / kDegree;
  };
  double high_h = 12;
  double low_h = 24;
  if (elevation_deg(high_h) < word.elevation_deg || elevation_deg(low_h) > word.elevation_deg) {
    return std::nullopt;
  }
  while (low_h - high_h > 1e-6) {
    const double middle_h = 0.5 * (high_h + low_h);
    (elevation_deg(middle_h) >= word.elevation_deg ? high_h : low_h) = middle_h;
  }
  return kSunNoonMin + word.half_day * static_cast<int>(std::lround((high_h - 12) * kHourMin));
}

class SunTimes {
 public:
  SunTimes(const SunPosition& position, std::vector<Problem>& problems)
      : position_(position), problems_(problems) {}

  /// Resolves the text, or those of a distribution's list.
  void resolve(json& value, const std::string& pointer) {
    if (value.is_string()) return resolve_text(value, pointer);
    if (!value.is_object()) return;
    for (auto part = value.begin(); part != value.end(); ++part) {
      json& list = part.value();
      for (std::size_t i = 0; list.is_array() && i < list.size(); ++i) {
        if (list[i].is_string()) {
          resolve_text(list[i], fmt::format("{}/{}/{}", pointer, part.key(), i));
        }
      }
    }
  }

 private:
  void resolve_text(json& value, const std::string& pointer) {
    static const std::regex kForm("([A-Za-z_]+) ?(?:([+-]|\u2212) ?([0-9]{1,5}) ?(min|h))?");
    const std::string text = value.get<std::string>();
    // Numbers are times; the schema says what is wrong with others.
    constexpr std::size_t kMaxLength = 40;
    if (text.empty() || text.size() > kMaxLength) return;
    if (std::isdigit(static_cast<unsigned char>(text[0])) != 0) return;
    const auto refuse = [&](std::string expected) {
      problems_.push_back({"", pointer, describe(value), std::move(expected)});
    };
    std::smatch parts;
    const bool is_form = std::regex_match(text, parts, kForm);
    const std::string name = is_form ? parts[1].str() : text.substr(0, text.find_first_of(" +-"));
    const auto word = std::find_if(kSunWords.begin(), kSunWords.end(),
                                   [&](const SunWord& one) { return one.word == name; });
    if (!is_form || word == kSunWords.end())
      return refuse(kExpectedTime + did_you_mean(name, sun_names()));
    if (word->half_day != 0 && position_.is_sampled) {
      return refuse("a time HH:MM, noon or midnight, since the latitude or the day is sampled");
    }
    const std::optional<int> minute =
        word->half_day == 0 ? word->minute : find_minute(*word, position_);
    if (!minute) return refuse(never_there(*word));
    int time = *minute;
    if (parts[3].matched) {
      const int offset = std::stoi(parts[3]) * (parts[4] == "h" ? kHourMin : 1);
      time += parts[2] == "+" ? offset : -offset;
    }
    if (time < 0 || time >= 2 * kSunNoonMin) {
      return refuse(fmt::format("a time of the same day: {} is at {}", name, time_text(*minute)));
    }
    value = time_text(time);
  }

  std::string never_there(const SunWord& word) const {
    const double noon_rad = sun_at(12, position_.latitude_deg, position_.day_of_year).elevation_rad;
    return fmt::format(
        "a time HH:MM: at latitude {:g} on day {} there is no {}, the sun stays {} {} all day",
        position_.latitude_deg, position_.day_of_year, word.word,
        noon_rad / kDegree < word.elevation_deg ? "below" : "above",
        word.elevation_deg < 0 ? "6 degrees below the horizon" : "the horizon");
  }

  static std::string time_text(int minute) {
    return fmt::format("{:02}:{:02}", minute / kHourMin, minute % kHourMin);
  }

  SunPosition position_;
  std::vector<Problem>& problems_;
};

}  // namespace

void resolve_sun_times(json& job, std::vector<Problem>& problems) {
  if (!job.is_object()) return;
  SunTimes times(read_position(job), problems);
  constexpr std::array kFields = {std::pair{"environment", "time_of_day"},
                                  std::pair{"randomize", "environment.time_of_day"}};
  for (const auto& [part, key] : kFields) {
    const auto found = job.find(part);
    if (found == job.end() || !found->is_object() || !found->contains(key)) continue;
    times.resolve((*found)[key], fmt::format("/{}/{}", part, key));
  }
}

}  // namespace throng::jobs
