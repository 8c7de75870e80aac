#include "formats/merged_ids.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>

#include "annotate/people/coco.h"
#include "base/error.h"
#include "base/files/files.h"
#include "base/files/untrusted_folders.h"
#include "base/json/json_text.h"

namespace throng::formats {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

[[noreturn]] void refuse(const fs::path& file, std::size_t line, std::string_view found) {
  throw InputError({file.string(), fmt::format("line {}", line), std::string(found),
                    "a record that throng wrote"});
}

/// Performs a change of records, and refuses those that this program did not write: no JSON, fields
/// that are missing or of other types. `line` is that of the record when it fails.
template <typename Change>
auto refuse_foreign(const fs::path& file, const std::size_t& line, const Change& change) {
  try {
    return change();
  } catch (const nlohmann::json::exception& error) {
    refuse(file, line, error.what());
  }
}

std::int64_t shifted(std::int64_t id, std::int64_t shift) {
  std::int64_t sum = 0;
  if (__builtin_add_overflow(id, shift, &sum)) {
    throw nlohmann::json::out_of_range::create(501, fmt::format("the id {} is too large", id),
                                               nullptr);
  }
  return sum;
}

std::string shifted_word(std::string_view word, std::int64_t shift) {
  std::int64_t id = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), id);
  const bool is_whole = error == std::errc() && end == word.data() + word.size();
  return is_whole && id >= 0 ? std::to_string(shifted(id, shift)) : std::string(word);
}

/// A CSV in whose columns of these names are track ids, several in a cell with spaces between them.
std::string shifted_csv(const std::string& text, std::size_t& line,
                        std::initializer_list<std::string_view> names, std::int64_t shift) {
  std::string result;
  std::vector<bool> is_shifted;
  std::size_t start = 0;
  while (start < text.size()) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    const bool is_header = ++line == 1;
    std::size_t column = 0;
    std::size_t at = start;
    while (at <= end) {
      const std::size_t stop = std::min(text.find_first_of(", \n", at), end);
      const std::string_view word(text.data() + at, stop - at);
      if (is_header) {
        is_shifted.push_back(std::find(names.begin(), names.end(), word) != names.end());
      }
      const bool changes = !is_header && column < is_shifted.size() && is_shifted[column];
      result += changes ? shifted_word(word, shift) : std::string(word);
      if (stop < end) {
        result += text[stop];
        if (text[stop] == ',') ++column;
      }
      at = stop + 1;
    }
    if (end < text.size()) result += '\n';
    start = end + 1;
  }
  return result;
}

void shift_ids(ordered_json& value, std::int64_t shift) {
  if (value.is_array()) {
    for (ordered_json& id : value) shift_ids(id, shift);
  } else if (value.is_number_integer()) {
    value = shifted(value.get<std::int64_t>(), shift);
  }
}

std::string shifted_lines(const std::string& text, std::size_t& line, std::int64_t shift) {
  std::string result;
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    ++line;
    ordered_json record = parse_ordered_json(std::string_view(text).substr(start, end - start));
    if (record.contains("track_id")) shift_ids(record["track_id"], shift);
    result += record.dump() + "\n";
    start = end + 1;
  }
  return result;
}

/// Ids of the records of one COCO file in the result.
class NewIds {
 public:
  NewIds(const CocoPart& part, std::int64_t image_shift) : part_(part), image_shift_(image_shift) {}

  void rename(std::string_view list, ordered_json& record) const {
    if (record.contains("run")) record["run"] = part_.new_run(record["run"]);
    if (list == "tracks") {
      shift_ids(record.at("id"), part_.track_shift);
    } else if (list == "images") {
      rename_image(record);
    } else {
      shift_ids(record.at("id"), image_shift_ * annotate::kMaxAgentsPerRun);
      shift_ids(record.at("image_id"), image_shift_);
      shift_ids(record.at("track_id"), part_.track_shift);
      if (record.contains("together_with")) shift_ids(record["together_with"], part_.track_shift);
      if (record.contains("difficulty") && record["difficulty"].contains("lookalikes")) {
        shift_ids(record["difficulty"]["lookalikes"], part_.track_shift);
      }
    }
  }

 private:
  void rename_image(ordered_json& image) const {
    shift_ids(image.at("id"), image_shift_);
    for (auto& [key, value] : image.items()) {
      if (!key.ends_with("_file") && key != "file_name") continue;
      if (value.is_string()) value = renamed(value.get<std::string>());
    }
    // People who are hidden in the image.
    for (auto& [key, value] : image.items()) {
      if (!value.is_array()) continue;
      for (ordered_json& item : value) {
        if (item.is_object() && item.contains("track_id")) {
          shift_ids(item["track_id"], part_.track_shift);
        }
      }
    }
  }

  std::string renamed(const std::string& file) const {
    fs::path path;
    for (const fs::path& step : fs::path(file)) {
      path /= part_.new_run(step.stem().string()) + step.extension().string();
    }
    return path.generic_string();
  }

  const CocoPart& part_;
  std::int64_t image_shift_;
};

/// Lines of a COCO file that throng wrote: a header, and lists with a record in each line.
class Lines {
 public:
  explicit Lines(const fs::path& path) : path_(path), file_(open_stream(path)) {}

  std::string next() {
    std::string line;
    if (!std::getline(file_, line)) refuse(path_, number_, "the end of the file");
    ++number_;
    return line;
  }
  const std::size_t& number() const { return number_; }

 private:
  fs::path path_;
  std::ifstream file_;
  std::size_t number_ = 0;
};

constexpr std::array<std::string_view, 3> kLists = {"tracks", "images", "annotations"};

std::string make_header(Lines& lines, const std::string& description) {
  std::string header;
  for (std::string line = lines.next(); line != "\"tracks\":["; line = lines.next()) {
    header += line + "\n";
  }
  // {"info":{"description":"...", is the first line.
  const std::size_t end = header.find(",\n");
  ordered_json info = parse_ordered_json(header.substr(0, end) + "}");
  info["info"]["description"] = description;
  const std::string first = info.dump();
  return first.substr(0, first.size() - 1) + header.substr(end);
}

}  // namespace

std::optional<std::string> with_shifted_tracks(const fs::path& file, const std::string& kind,
                                               std::int64_t shift) {
  const std::string ending = file.extension().string();
  if (shift == 0) return std::nullopt;
  std::size_t line = 0;
  return refuse_foreign(file, line, [&]() -> std::optional<std::string> {
    if (kind == "actions") return shifted_csv(read_file(file), line, {"track_id", "other"}, shift);
    if (kind == "counts" && ending == ".csv") {
      return shifted_csv(read_file(file), line, {"entered", "left"}, shift);
    }
    if (kind == "events") return shifted_lines(read_file(file), line, shift);
    if (kind == "trajectories" && ending == ".json") {
      line = 1;
      ordered_json people = parse_ordered_json(read_file(file));
      shift_ids(people.at("track_ids"), shift);
      return people.dump() + "\n";
    }
    return std::nullopt;
  });
}

void join_coco_files(const std::vector<CocoPart>& parts, const std::string& description,
                     const fs::path& output) {
  std::vector<Lines> lines;
  lines.reserve(parts.size());
  for (const CocoPart& part : parts) lines.emplace_back(part.file);
  StagedFile joined(output);
  std::string header;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::string own = refuse_foreign(parts[i].file, lines[i].number(),
                                           [&] { return make_header(lines[i], description); });
    if (i == 0) header = own;
    if (own != header) refuse(parts[i].file, 1, "other categories than the first dataset's");
  }
  joined.write(header);
  std::vector<std::int64_t> image_shift(parts.size(), 0);
  for (const std::string_view list : kLists) {
    joined.write(fmt::format("\"{}\":[", list));
    std::string_view before = "\n";
    std::int64_t max_image = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (list == "images") image_shift[i] = max_image;
      const NewIds ids(parts[i], image_shift[i]);
      for (std::string line = lines[i].next(); !line.starts_with(']'); line = lines[i].next()) {
        if (line.ends_with(',')) line.pop_back();
        const std::string renamed = refuse_foreign(parts[i].file, lines[i].number(), [&] {
          ordered_json record = parse_ordered_json(line);
          ids.rename(list, record);
          if (list == "images") max_image = std::max(max_image, record["id"].get<std::int64_t>());
          return record.dump();
        });
        joined.write(before);
        joined.write(renamed);
        before = ",\n";
      }
      if (list != kLists.back()) lines[i].next();  // the beginning of the next list
    }
    joined.write(list == kLists.back() ? "\n]}\n" : "\n],\n");
  }
  joined.commit();
}

}  // namespace throng::formats
