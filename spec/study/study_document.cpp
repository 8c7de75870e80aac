#include "spec/study/study_document.h"

#include <set>
#include <string_view>
#include <utility>

#include "base/json/field_table.h"
#include "base/text/control_characters.h"
#include "base/text/portable_name.h"
#include "base/text/words.h"
#include "spec/job/job_spec.h"

namespace throng::study {

using fields::at;
using fields::FieldLocation;
using fields::FieldTable;
using nlohmann::json;
using nlohmann::ordered_json;

namespace {

constexpr double kMaxRunS = 7200;  // of a job

fields::Values one_line() { return fields::raw({{"type", "string"}, {kOneLine, true}}); }

/// Part of a job, which is checked with it.
template <typename Object>
void add_part(FieldTable<Object>& table, const char* path, const char* type, json Object::*member,
              const char* help) {
  table.add_read(
      path, fields::raw({{"type", type}}),
      [member](Object& object, const json& value, const FieldLocation&) { object.*member = value; },
      help);
}

const FieldTable<ReferenceDocument>& reference_fields() {
  static const FieldTable<ReferenceDocument> table = [] {
    FieldTable<ReferenceDocument> fields;
    fields.add("speed_mps", "Speed", "m/s", fields::numbers(0.1, 20),
               at(&ReferenceDocument::speed_mps), "Speed of everybody.");
    fields::Values rates =
        fields::raw({{"type", "array"}, {"items", fields::numbers(0, 1000).rules}});
    rates.expected = "one number for each exit";
    fields
        .add_read(
            "capacity_per_s", std::move(rates),
            [](ReferenceDocument& reference, const json& value, const FieldLocation& place) {
              fields::set_value(value, reference.capacity_per_s);
              reference.capacity_pointer = place.pointer;
            },
            "Mean flow of each exit; default: 1.3 per meter of its width.")
        .titled("Exit capacities")
        .measured_in("people/s");
    return fields;
  }();
  return table;
}

const FieldTable<CaseDocument>& case_fields() {
  static const FieldTable<CaseDocument> table = [] {
    FieldTable<CaseDocument> fields;
    fields
        .add("id", "", "", fields::names(), at(&CaseDocument::id),
             "An identifier: letters, digits, '_' and '-'.")
        .required();
    fields.add("title", "Title", "", one_line(), at(&CaseDocument::title), "Name for people.");
    fields
        .add("scenario", "Scenario", "", fields::raw({{"type", "string"}}),
             at(&CaseDocument::scenario), "Id of a scenario with a crowd.")
        .required();
    fields::Values exits =
        fields::raw({{"type", "array"}, {"items", {{"type", "string"}}}}, "a list of ids of exits");
    fields
        .add("close", "Closed exits", "", std::move(exits), at(&CaseDocument::closed_exits),
             "Ids of exits of a blueprint that are closed from the start, as by \"open\": false.")
        .without_default();
    add_part(fields, "crowd", "object", &CaseDocument::crowd,
             "The crowd, as in a job (docs/reference/job.md).");
    fields.add("alarm_s", "Alarm", "s", fields::numbers(0, kMaxRunS), at(&CaseDocument::alarm_s),
               "Time of the alarm; default: the scenario's.");
    fields.add("duration_s", "Duration", "s", fields::numbers(1, kMaxRunS),
               at(&CaseDocument::duration_s), "Length of a run.");
    fields
        .add_read(
            "reference", fields::object_with(reference_fields().schema()),
            [](CaseDocument& one, const json& value, const FieldLocation& place) {
              reference_fields().read_checked(value, one.reference, place);
            },
            "Speed and capacities of the reference time.")
        .renamed_from("bound");
    return fields;
  }();
  return table;
}

const FieldTable<PolicyDocument>& policy_fields() {
  static const FieldTable<PolicyDocument> table = [] {
    FieldTable<PolicyDocument> fields;
    fields
        .add("id", "", "", fields::names(), at(&PolicyDocument::id),
             "An identifier: letters, digits, '_' and '-'.")
        .required();
    fields.add("title", "Title", "", one_line(), at(&PolicyDocument::title), "Name for people.");
    add_part(fields, "drones", "array", &PolicyDocument::drones,
             "The drones, as in a job (docs/reference/job.md). A policy without them, or with an "
             "empty list, flies none, whether the scenario has drones or not.");
    return fields;
  }();
  return table;
}

/// Ids are names of folders, on Windows and macOS without regard to case.
template <typename Item>
void check_ids(const std::vector<Item>& items, const FieldLocation& list) {
  std::set<std::string> seen;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::string& id = items[i].id;
    if (id.empty()) continue;
    const FieldLocation place = list.below(i).below("id");
    const std::string found = "\"" + id + "\"";
    if (!seen.insert(lower_case(id)).second) {
      place.reject(found, "an id that nothing else here has");
    }
    if (is_device_name(id)) place.reject(found, "an id that can be a folder's name on Windows");
  }
}

void add_lists(FieldTable<StudyDocument>& table) {
  table
      .add_list("cases", case_fields(), at(&StudyDocument::cases),
                "Scenarios and their conditions.", 1)
      .titled("Cases")
      .checked([](const StudyDocument& study, const json& /*list*/, const FieldLocation& place) {
        check_ids(study.cases, place);
      })
      .required();
  table
      .add_list("policies", policy_fields(), at(&StudyDocument::policies),
                "Guidance methods; default: one without drones.", 1)
      .titled("Policies")
      .checked([](const StudyDocument& study, const json& /*list*/, const FieldLocation& place) {
        check_ids(*study.policies, place);
      });
}

FieldTable<StudyDocument> make_fields() {
  FieldTable<StudyDocument> table;
  table.add_schema_name();
  table.add("name", "Name", "", one_line(), at(&StudyDocument::name), "Name for people.");
  table.add("seed", "Seed", "", fields::integers(0, scenarios::kMaxSeed), at(&StudyDocument::seed),
            "Seed of all runs.");
  table.add("runs", "Runs of each", "", fields::integers(1, jobs::kMaxJobRuns),
            at(&StudyDocument::runs),
            "Number of runs of each case and policy; the run of one number has the same seed in "
            "all of them.");
  table.add("baseline", "Baseline", "", fields::names(), at(&StudyDocument::baseline),
            "Id of the policy that the others are compared with; default: the first one.");
  table.add("baseline_case", "Baseline case", "", fields::names(),
            at(&StudyDocument::baseline_case),
            "Id of the case that the others are compared with; default: the first one where there "
            "are no policies, else none.");
  fields::Values horizons = fields::lists(2, 2, fields::numbers(1, kMaxRunS).rules);
  horizons.rules["x-parts"] = {"shorter", "longer"};
  horizons.expected = "two times, the shorter one first";
  table.add("horizons_s", "Horizons", "s", std::move(horizons), at(&StudyDocument::horizons_s),
            "The two times up to which restricted means are taken, the shorter one first. "
            "Default: all the time from the alarm to the end of the run, and 150 s or half of "
            "that time, whichever is shorter.");
  add_lists(table);
  return table;
}

const FieldTable<StudyDocument>& study_fields() {
  static const FieldTable<StudyDocument> table = make_fields();
  return table;
}

}  // namespace

StudyDocument read_study_document(const json& document, const std::string& source,
                                  std::vector<Problem>& problems) {
  StudyDocument study;
  study_fields().read_checked(document, study, {"", source, problems});
  return study;
}

ordered_json study_schema(ordered_json crowd, ordered_json drones) {
  ordered_json schema = fields::document_schema(
      "throng study", "Cases times policies times seeds, simulated without images (docs/study.md).",
      study_fields().schema());
  const auto refer = [&](const char* list, const char* part, ordered_json definition) {
    schema["properties"][list]["items"]["properties"][part] = {
        {"$ref", std::string("#/definitions/") + part}};
    schema["definitions"][part] = std::move(definition);
  };
  refer("cases", "crowd", std::move(crowd));
  refer("policies", "drones", std::move(drones));
  return schema;
}

}  // namespace throng::study
