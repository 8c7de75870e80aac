#include "formats/dataset/dataset.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <numeric>

#include "base/error.h"
#include "base/files/files.h"
#include "base/files/path_below.h"
#include "base/files/untrusted_folders.h"
#include "base/json/json_describe.h"
#include "base/json/json_text.h"
#include "spec/sim/airframe.h"

namespace throng::formats {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr const char* kTracksStart = "\"tracks\":[";
constexpr const char* kImagesStart = "\"images\":[";
constexpr const char* kAnnotationsStart = "\"annotations\":[";

template <typename Vector>
Vector read_vector(const json& value) {
  Vector vector;
  for (Eigen::Index i = 0; i < vector.size(); ++i) {
    vector[i] = value.at(static_cast<std::size_t>(i)).get<double>();
  }
  return vector;
}

Eigen::Matrix3d read_matrix(const json& value) {
  Eigen::Matrix3d matrix;
  for (Eigen::Index row = 0; row < 3; ++row) {
    matrix.row(row) = read_vector<Eigen::Vector3d>(value.at(static_cast<std::size_t>(row)));
  }
  return matrix;
}

Box read_box(const json& value) { return {value.at(0), value.at(1), value.at(2), value.at(3)}; }

void read_pose(const json& record, Person& person) {
  person.heading_rad = record.value("heading", 0.0);
  if (const auto box = record.find("box_3d"); box != record.end()) {
    const auto both = read_vector<Eigen::Matrix<double, 6, 1>>(*box);
    person.box_middle = both.head<3>();
    person.box_size = both.tail<3>();
  }
  person.keypoints.clear();
  if (const auto keypoints = record.find("keypoints"); keypoints != record.end()) {
    for (std::size_t i = 0; i + 2 < keypoints->size(); i += 3) {
      person.keypoints.push_back({(*keypoints)[i], (*keypoints)[i + 1], (*keypoints)[i + 2]});
    }
  }
}

std::size_t choose_category(const json& record, const json& track, const ClassOptions& classes) {
  if (classes.by == "none") return 0;
  const json& value =
      classes.by == "state" ? record.at("state") : track.at("attributes").at(classes.by);
  const std::vector<std::string> values = class_values(classes.by);
  const auto found = std::find(values.begin(), values.end(), value.get<std::string>());
  check(found != values.end(), "class_values() lists every value that people have");
  return static_cast<std::size_t>(found - values.begin());
}

/// Index into DatasetInfo::class_names() of a category that is not people's.
std::optional<std::size_t> object_index(const DatasetInfo& info, const json& id) {
  for (std::size_t i = 0; i < info.object_categories.size(); ++i) {
    if (info.object_categories[i].id == id) return info.categories.size() + i;
  }
  return std::nullopt;
}

/// The values that people, drones and vehicles have in common.
Person make_object(json record, std::shared_ptr<const json> track, const ExportOptions& options) {
  Person person;
  record.at("id").get_to(person.id);
  record.at("track_id").get_to(person.track_id);
  person.box = read_box(record.at("bbox"));
  person.amodal = read_box(record.at("bbox_amodal"));
  record.at("segmentation").at("counts").get_to(person.mask);
  record.at("area").get_to(person.area);
  record.at("visibility").get_to(person.visibility);
  person.truncation = record.value("truncation", 0.0);
  person.position = read_vector<Eigen::Vector3d>(record.at("position"));
  person.velocity = read_vector<Eigen::Vector2d>(record.at("velocity"));
  read_pose(record, person);
  person.is_ignored = person.visibility < options.filters.min_visibility ||
                      person.amodal.height < options.filters.min_height_px ||
                      person.truncation > options.filters.max_truncation.value_or(1);
  person.record = std::move(record);
  person.track = std::move(track);
  return person;
}

/// Whether neither contrast in the record reaches the limit; records without any are kept.
bool is_indistinct(const json& record, double min_contrast) {
  const auto difficulty = record.find("difficulty");
  if (min_contrast <= 0 || difficulty == record.end()) return false;
  return std::max(difficulty->at("contrast").get<double>(),
                  difficulty->at("edge_contrast").get<double>()) < min_contrast;
}

Person make_person(json record, std::shared_ptr<const json> track, const ExportOptions& options) {
  Person person = make_object(std::move(record), std::move(track), options);
  if (const json& head = person.record.at("head"); !head.is_null()) {
    person.head = read_vector<Eigen::Vector2d>(head);
  }
  if (const auto box = person.record.find("head_box"); box != person.record.end()) {
    if (!box->is_null()) person.head_box = read_box(*box);
    const json& visibility = person.record.at("head_visibility");
    if (!visibility.is_null()) person.head_visibility = visibility.get<double>();
  }
  person.is_ignored =
      person.is_ignored || is_indistinct(person.record, options.filters.min_contrast);
  person.state = person.record.value("state", "");
  person.category = choose_category(person.record, *person.track, options.classes);
  return person;
}

void read_hidden(const json& record, const FilterOptions& filters, Image& image) {
  image.hidden.clear();
  const auto hidden = record.find("hidden");
  if (hidden == record.end()) return;
  for (const json& person : *hidden) {
    const Box amodal = read_box(person.at("bbox_amodal"));
    image.hidden.push_back({person.at("track_id"), amodal,
                            filters.min_visibility > 0 || amodal.height < filters.min_height_px});
  }
}

void read_image(json record, const DatasetInfo& info, Image& image) {
  record.at("id").get_to(image.id);
  record.at("file_name").get_to(image.file);
  record.at("width").get_to(image.width);
  record.at("height").get_to(image.height);
  record.at("run").get_to(image.run);
  record.at("camera_id").get_to(image.camera);
  record.at("frame").get_to(image.frame);
  record.at("time_s").get_to(image.time_s);
  const json& camera = record.at("camera");
  image.camera_matrix = read_matrix(camera.at("K"));
  image.R = read_matrix(camera.at("R"));
  image.t = read_vector<Eigen::Vector3d>(camera.at("t"));
  image.split = info.split_of(image.run);
  image.people.clear();
  image.objects.clear();
  read_hidden(record, info.options.filters, image);
  image.record = std::move(record);
}

/// Errors of the sensors of those drones whose airframe is known.
std::map<std::string, sim::SensorNoise> read_sensor_noise(const json& drones) {
  std::map<std::string, sim::SensorNoise> noise;
  for (const json& drone : drones.is_array() ? drones : json::array()) {
    if (!drone.is_object() || !drone.contains("id") || !drone.at("id").is_string()) continue;
    const std::string id = drone.at("id");
    const json airframe = drone.value("airframe", json());
    std::vector<Problem> problems;
    if (airframe.is_object()) {
      noise[id] = sim::read_airframe(id, airframe, "", problems).sensors;
    } else if (airframe.is_string()) {
      if (const auto known = sim::find_airframe(airframe.get<std::string>())) {
        noise[id] = known->sensors;
      }
    }
  }
  return noise;
}

}  // namespace

json webdataset_sample(const Image& image, const DatasetInfo& info) {
  json sample = image.record;
  sample["annotations"] = json::array();
  const auto add = [&](const Person& object, const std::string& category) {
    json& record = sample["annotations"].emplace_back(*object.track);
    record.erase("run");
    record.update(object.record);
    record["category"] = category;
    if (object.is_ignored) record["ignored"] = true;
  };
  const std::vector<std::string> names = info.class_names();
  for (const Person& person : image.people) add(person, names.at(person.category));
  for (const Person& object : image.objects) add(object, names.at(object.category));
  return sample;
}

std::string Image::scenario() const {
  const auto drawn = record.find("drawn");
  if (drawn == record.end() || !drawn->is_object()) return "";
  const auto scenario = drawn->find("scenario");
  return scenario == drawn->end() || !scenario->is_string() ? "" : scenario->get<std::string>();
}

std::string Image::stem() const { return fmt::format("{}-{}-{:06}", run, camera, frame); }

bool DatasetInfo::has(annotate::GroundTruth kind) const {
  return annotate::holds(annotations, kind);
}

std::vector<std::string> DatasetInfo::class_names() const {
  std::vector<std::string> names = categories;
  for (const annotate::ObjectCategory& category : object_categories) {
    names.emplace_back(category.name);
  }
  return names;
}

world::SemanticClass DatasetInfo::surface_material(const Person& object) const {
  return object_categories.at(object.category - categories.size()).surface;
}

Split DatasetInfo::split_of(const std::string& run) const {
  const SplitOptions& splits = options.splits;
  if (const auto named = splits.runs.find(run); named != splits.runs.end()) return named->second;
  std::size_t index = 0;
  std::size_t count = 0;
  for (const std::string& other : runs) {
    if (splits.runs.contains(other)) continue;
    if (other == run) index = count;
    ++count;
  }
  const double all = std::accumulate(splits.share.begin(), splits.share.end(), 0.0);
  double end = 0;
  for (std::size_t i = 0; i < splits.share.size(); ++i) {
    end += splits.share[i] / all * static_cast<double>(count);
    if (static_cast<double>(index) < std::round(end)) return static_cast<Split>(i);
  }
  return Split::train;
}

std::vector<Split> DatasetInfo::splits() const {
  std::vector<Split> used;
  for (const Split split : {Split::train, Split::val, Split::test}) {
    if (std::any_of(runs.begin(), runs.end(),
                    [&](const std::string& run) { return split_of(run) == split; })) {
      used.push_back(split);
    }
  }
  return used;
}

namespace {

/// Run names have three digits or more: run000.
bool is_run_name(std::string_view text) {
  constexpr std::size_t kDigitsFrom = 3;
  constexpr std::size_t kMinSize = 6;
  return text.size() >= kMinSize && text.starts_with("run") &&
         text.find_first_not_of("0123456789", kDigitsFrom) == std::string_view::npos;
}

/// A list of the manifest whose members become names of files and folders.
struct NamedList {
  const char* pointer;
  const char* member;  ///< of each entry; "": the entry itself
  bool (*is_good)(std::string_view name);
  const char* expected;
};

constexpr std::array kNamedLists = {
    NamedList{"/files", "path", is_path_below, "the path of a file below the dataset's folder"},
    NamedList{"/runs", "run", is_run_name, "the name of a run, such as run000"},
    NamedList{"/job/drones", "id", is_path_part, "an id that is no path"},
    NamedList{"/job/outputs/formats", "", is_path_part, "the name of a format"}};

void check_names(const json& manifest, const std::string& source) {
  constexpr std::size_t kMaxProblems = 20;
  std::vector<Problem> problems;
  for (const NamedList& list : kNamedLists) {
    const json::json_pointer place(list.pointer);
    const json entries = manifest.contains(place) ? manifest.at(place) : json();
    if (!entries.is_array()) continue;
    const json::json_pointer member(*list.member == '\0' ? "" : fmt::format("/{}", list.member));
    for (std::size_t i = 0; i < entries.size() && problems.size() < kMaxProblems; ++i) {
      if (!entries[i].contains(member)) continue;
      const json& name = entries[i].at(member);
      if (name.is_string() && list.is_good(name.get_ref<const std::string&>())) continue;
      problems.push_back({source, (place / i / member).to_string(), describe(name), list.expected});
    }
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

}  // namespace

json read_manifest(const fs::path& root) {
  const fs::path file = root / "manifest.json";
  if (!fs::is_regular_file(file)) {
    const fs::path below = root / "dataset";  // of a job's folder
    const bool is_job = fs::is_regular_file(below / file.filename());
    throw InputError({root.string(), "", "no manifest.json",
                      is_job ? "a finished dataset, as " + below.string() : "a finished dataset"});
  }
  distrust_folders_in(root);
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    if (!entry.is_symlink()) continue;
    throw InputError({entry.path().string(), "", "a link", "a file or folder of the dataset"});
  }
  json manifest = parse_json(read_file(file), file.string(), kOwnJsonLimits);
  check_names(manifest, file.string());
  return manifest;
}

InputError bad_manifest(const fs::path& root, const json::exception& error) {
  const std::string_view text = error.what();  // "[json.exception.type_error.302] type must be..."
  const auto end = text.find("] ");
  return InputError({(root / "manifest.json").string(), "",
                     std::string(end == std::string_view::npos ? text : text.substr(end + 2)),
                     "the manifest that throng wrote"});
}

namespace {

ExportOptions read_export_options(const json& outputs) {
  ExportOptions options;
  const json filters = outputs.value("filters", json::object());
  options.filters.min_visibility = filters.value("min_visibility", 0.0);
  options.filters.min_height_px = filters.value("min_height_px", 0.0);
  options.filters.min_contrast = filters.value("min_contrast", 0.0);
  if (filters.contains("max_truncation")) {
    options.filters.max_truncation = filters["max_truncation"].get<double>();
  }
  options.webdataset.shard_mb =
      outputs.value("webdataset", json::object()).value("shard_mb", options.webdataset.shard_mb);
  const json splits = outputs.value("splits", json::object());
  for (std::size_t i = 0; i < kSplitNames.size(); ++i) {
    const std::string name(kSplitNames.at(i));
    options.splits.share.at(i) = splits.value(name, options.splits.share.at(i));
    for (const int run : splits.value(name + "_runs", std::vector<int>{})) {
      options.splits.runs[fmt::format("run{:03}", run)] = static_cast<Split>(i);
    }
  }
  const json classes = outputs.value("classes", json::object());
  options.classes.by = classes.value("by", options.classes.by);
  for (const std::string& name : classes.value("names", std::vector<std::string>{})) {
    add_class_name(name, "", options.classes);
  }
  return options;
}

}  // namespace

ExportOptions export_options(const fs::path& root, const json& manifest) {
  try {
    return read_export_options(manifest.at("job").at("outputs"));
  } catch (const json::exception& error) {
    throw bad_manifest(root, error);
  }
}

DatasetInfo describe_dataset(const fs::path& root, const json& manifest,
                             const ExportOptions& options) {
  DatasetInfo info;
  info.root = root;
  info.options = options;
  try {
    const json& job = manifest.at("job");
    job.at("name").get_to(info.name);
    manifest.at("generator").get_to(info.generator);
    info.seed = job.value("seed", info.seed);
    const json& capture = job.at("capture");
    capture.at("rate_hz").get_to(info.rate_hz);
    capture.at("from_s").get_to(info.from_s);
    constexpr double kSlack = 1e-9;
    info.frames_per_camera =
        1 +
        static_cast<std::int64_t>(std::floor(
            (capture.at("to_s").get<double>() - capture.at("from_s").get<double>()) * info.rate_hz +
            kSlack));
    for (const json& run : manifest.at("runs")) info.runs.push_back(run.at("run"));
    if (const auto id = job.find("scenario"); id != job.end() && id->is_string()) {
      info.scenario = id->get<std::string>();
    }
    const json& outputs = job.at("outputs");
    outputs.at("annotations").get_to(info.annotations);
    info.count_areas = outputs.value("counts", info.count_areas);
    info.field_cells_m =
        outputs.value("fields", json::object()).value("cells_m", info.field_cells_m);
    info.object_categories = annotate::object_categories(
        job.value("drones", json::array()).size() > 1, info.has(annotate::GroundTruth::vehicles));
    info.formats = outputs.value("formats", info.formats);
    info.density_sigma_px =
        outputs.value("density", json::object()).value("sigma_px", info.density_sigma_px);
  } catch (const json::exception& error) {
    throw bad_manifest(root, error);
  }
  const json drones = manifest.at("job").value("drones", json());
  info.sensor_noise = read_sensor_noise(drones);
  info.has_images = !drones.is_array() || !drones.empty();
  for (const std::string& value : class_values(options.classes.by)) {
    const auto renamed = options.classes.names.find(value);
    info.categories.push_back(renamed == options.classes.names.end() ? value : renamed->second);
  }
  return info;
}

void check_images_have_labels(const DatasetInfo& info) {
  if (!info.has_images || info.has(annotate::GroundTruth::coco)) return;
  throw InputError({info.root.string(), "", "no COCO annotations",
                    "a dataset whose job has coco among outputs.annotations"});
}

/// The records of one array of the COCO file: one per line.
class DatasetReader::Lines {
 public:
  Lines(fs::path path, const std::string& start)
      : path_(std::move(path)), file_(open_stream(path_)) {
    if (!file_) throw EnvironmentError(fmt::format("cannot read {}", path_.string()));
    while (std::getline(file_, line_)) {
      ++number_;
      if (line_ == start) return;
    }
    throw InputError({path_.string(), "", "no line " + start, "a COCO file that throng wrote"});
  }

  /// The next record; null at the array's end.
  json next() {
    if (!std::getline(file_, line_)) fail("the end of the file", "a record or the array's end");
    ++number_;
    if (line_.starts_with(']')) return nullptr;
    if (line_.ends_with(',')) line_.pop_back();
    json record = parse_json_or_discard(line_);
    if (!record.is_object()) fail("no JSON object", "a record");
    return record;
  }

  [[noreturn]] void fail(std::string found, std::string expected) const {
    throw InputError(
        {path_.string(), fmt::format("line {}", number_), std::move(found), std::move(expected)});
  }

 private:
  fs::path path_;
  std::ifstream file_;
  std::string line_;
  std::size_t number_ = 0;
};

/// The tracks of one run at a time.
class DatasetReader::Tracks {
 public:
  explicit Tracks(const fs::path& path) : lines_(path, kTracksStart) { advance(); }

  /// Goes on to a run's tracks; never back.
  void enter(const std::string& run, const std::vector<std::string>& runs) {
    const auto at = std::find(runs.begin(), runs.end(), run);
    if (at == runs.end() || at - runs.begin() <= run_) return;
    run_ = at - runs.begin();
    of_run_.clear();
    for (; !waiting_.is_null() && last_ / annotate::kTrackIdsPerRun <= run_; advance()) {
      if (last_ / annotate::kTrackIdsPerRun < run_) continue;
      const std::int64_t id = last_;
      of_run_.emplace_hint(of_run_.end(), id, std::make_shared<json>(std::move(waiting_)));
    }
  }

  /// That of somebody of the run; an empty object if there is none.
  std::shared_ptr<const json> find(std::int64_t id) const {
    static const auto kNone = std::make_shared<const json>(json::object());
    const auto found = of_run_.find(id);
    return found == of_run_.end() ? kNone : found->second;
  }

 private:
  void advance() {
    waiting_ = lines_.next();
    if (waiting_.is_null()) return;
    const auto id = waiting_.find("id");
    if (id == waiting_.end() || !id->is_number_integer() || *id <= last_) {
      lines_.fail(waiting_.value("id", json()).dump(), "an id above those before");
    }
    last_ = *id;
  }

  Lines lines_;
  json waiting_;
  std::int64_t last_ = -1;  ///< id of the one that waits
  std::int64_t run_ = -1;
  std::map<std::int64_t, std::shared_ptr<const json>> of_run_;
};

DatasetReader::DatasetReader(const DatasetInfo& info)
    : info_(&info),
      tracks_(std::make_unique<Tracks>(info.root / kCocoFile)),
      images_(std::make_unique<Lines>(info.root / kCocoFile, kImagesStart)),
      annotations_(std::make_unique<Lines>(info.root / kCocoFile, kAnnotationsStart)) {
  waiting_ = annotations_->next();
}

DatasetReader::~DatasetReader() = default;

void DatasetReader::check_names_of(const Image& image) const {
  const std::vector<std::string>& runs = info_->runs;
  if (!is_path_below(image.file)) {
    images_->fail(describe(image.file), "the path of a file below the dataset's folder");
  }
  if (std::find(runs.begin(), runs.end(), image.run) == runs.end()) {
    images_->fail(describe(image.run), "a run of the manifest");
  }
  if (!is_path_part(image.camera)) images_->fail(describe(image.camera), "the id of a camera");
}

bool DatasetReader::next(Image& image) {
  json record = images_->next();
  if (record.is_null()) {
    if (!waiting_.is_null()) annotations_->fail("an annotation", "no more after the last image's");
    return false;
  }
  const Lines* at = images_.get();
  try {
    read_image(std::move(record), *info_, image);
    check_names_of(image);
    at = annotations_.get();
    tracks_->enter(image.run, info_->runs);
    while (!waiting_.is_null() && waiting_.at("image_id") == image.id) {
      std::shared_ptr<const json> track = tracks_->find(waiting_.at("track_id"));
      if (const auto category = object_index(*info_, waiting_.at("category_id"))) {
        image.objects.push_back(make_object(std::move(waiting_), std::move(track), info_->options));
        image.objects.back().category = *category;
      } else {
        image.people.push_back(make_person(std::move(waiting_), std::move(track), info_->options));
      }
      waiting_ = annotations_->next();
    }
  } catch (const json::exception& error) {
    at->fail(error.what(), "a record that throng wrote");
  }
  return true;
}

}  // namespace throng::formats
