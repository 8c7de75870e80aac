import os, shutil, subprocess
os.chdir("/work/75a")
exec(open("/tmp/base_edit.py").read().split("h = ")[0])
for f in ["document_values.h","document_values.cpp","exit_fields.h","exit_fields.cpp","scenario_fields.h","scenario_fields.cpp","scenario_parts.h","scenario_parts.cpp","scenario.cpp","ground.h","ground_fields.h","ground_fields.cpp","disasters.h","disasters.cpp","disaster_fields.h","disaster_fields.cpp","props.h","props.cpp","prop_fields.h","prop_fields.cpp"]:
    shutil.copy("/tmp/wn/"+f,"world/"+f)
os.remove("world/ground.cpp")
for f in ["extended_document.cpp","json_reader.h","json_reader.cpp","CMakeLists.txt"]: shutil.copy("/tmp/wn2/"+f,"world/"+f)
shutil.copy("/tmp/wn2/people.cpp","world/scenarios/blueprint/people.cpp")
shutil.copy("/tmp/wn2/schema_test.cpp","tests/world/scenarios/schema_test.cpp")
shutil.copy("base/schemas/scenario.schema.json","/tmp/old_scenario.schema.json")
os.remove("base/schemas/scenario.schema.json")
t="base/json/field_table.h"
sub(t,'''  /// Marks an object without default; the''','''  Field& measured_in(std::string name) {
    unit = std::move(name);
    return *this;
  }
  /// Marks an object without default; the''')
sub(t,'''  /// Adds the fields of a part of the object, with the prefix `path`.
''','''  /// Adds the fields of a part of the object, with the prefix `path`; "": without a prefix.
''')
sub(t,'''      field.path = path + "/" + other.path;''','''      field.path = path.empty() ? other.path : path + "/" + other.path;''')
h="base/schemas/schemas.h"
sub(h,"enum class Kind { scenario, blueprint,","enum class Kind { blueprint,")
sub(h,"std::array<Entry, 6>","std::array<Entry, 5>")
sub(h,"Those of jobs\n// and airframes are made","Those of jobs,\n// scenarios and airframes are made")
c="base/schemas/schemas.cpp"
sub(c,"std::array<Entry, 6>","std::array<Entry, 5>",2)
sub(c,"extern const std::string_view kScenarioSchema;\n","")
sub(c,'      {Kind::scenario, "scenario", embedded::kScenarioSchema},\n',"")
sub(c,"    case Kind::scenario:\n      return compiled<Kind::scenario>();\n","")
sub("base/CMakeLists.txt","ITEMS Scenario Blueprint Study","ITEMS Blueprint Study")
p="spec/documents/published_schemas.cpp"
sub(p,'std::array<Made, 2> kMade = {{{"job", job}, {"airframe", airframe}}};','std::array<Made, 3> kMade = {\n    {{"job", job}, {"scenario", world::scenario_schema}, {"airframe", airframe}}};')
sub(p,'#include "spec/sim/airframe_fields.h"\n','#include "spec/sim/airframe_fields.h"\n#include "world/scenario_fields.h"\n')
sub("scripts/reference_pages.py",'"base/schemas/scenario.schema.json"','"world/scenario_fields.cpp"')
