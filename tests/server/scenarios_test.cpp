// Scenarios that users send: over HTTP, and with a job.
#include <gmock/gmock.h>

#include <thread>

#include "base/error.h"
#include "tests/server/api_fixture.h"
#include "tests/server/bundles.h"

namespace throng::server {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using throng::testing::packed;
using throng::testing::PackedEntry;
using throng::testing::Packing;

constexpr const char* kMine = R"({"scenario": "mine/yard", "capture": {"to_s": 2}})";
constexpr const char* kBundled = R"({"scenario": "bundle/yard", "capture": {"to_s": 2}})";

class Uploads : public ApiTest {
 protected:
  httplib::Result upload(const std::string& bytes, const std::string& query = "name=mine",
                         const httplib::Headers& headers = {}) const {
    return client().Post("/v1/scenarios?" + query, headers, bytes, "application/zip");
  }

  /// The mistakes in an upload of the yard with these files changed.
  json upload_errors(const std::vector<PackedEntry>& changed) const {
    std::vector<PackedEntry> files = yard_files();
    for (const PackedEntry& entry : changed) {
      const auto same = std::find_if(files.begin(), files.end(), [&](const PackedEntry& file) {
        return file.path == entry.path;
      });
      if (same == files.end()) {
        files.push_back(entry);
      } else {
        *same = entry;
      }
    }
    const httplib::Result answer = upload(packed(Packing::tar, files));
    expect_problem(answer, 400);
    return json::parse(answer->body)["errors"];
  }

  httplib::Result submit_bundled(const std::string& bundle, const std::string& query = "",
                                 const std::string& job = kBundled) const {
    return client().Post(
        "/v1/jobs" + query,
        httplib::MultipartFormDataItems{{"job", job, "", "application/json"},
                                        {"scenario", bundle, "bundle.zip", "application/zip"}});
  }
};

TEST_F(Uploads, AreUsedLikeThoseThatComeWithThrong) {
  SKIP_WITHOUT_PROGRAM();
  const httplib::Result answer = upload(yard_bundle());
  ASSERT_EQ(answer->status, 201) << answer->body;
  EXPECT_EQ(answer->get_header_value("Location"), "/v1/scenarios/mine/yard");
  EXPECT_THAT(json::parse(answer->body)["ids"], ElementsAre("mine/yard"));
  const json all = get_json("/v1/scenarios")["scenarios"];
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0]["id"], "mine/yard");
  EXPECT_EQ(all[0]["uploaded"]["files"], 3);
  EXPECT_EQ(all[1]["uploaded"], nullptr);
  const httplib::Result plan = get("/v1/scenarios/mine/yard?format=svg");
  EXPECT_EQ(plan->get_header_value("Content-Type"), "image/svg+xml");
  EXPECT_THAT(plan->body, HasSubstr("<svg"));
  expect_problem(get("/v1/scenarios/mine/yard?format=png"), 400);
  const httplib::Result job = client().Post("/v1/jobs", kMine, "application/json");
  ASSERT_EQ(job->status, 201);
  const std::string id = json::parse(job->body)["id"];
  const httplib::Result plan_of_job = get("/v1/jobs/" + id + "/plan");
  ASSERT_EQ(plan_of_job->status, 200) << plan_of_job->body;
  EXPECT_EQ(plan_of_job->get_header_value("Content-Type"), "image/svg+xml");
  EXPECT_THAT(plan_of_job->body, HasSubstr("stroke:rgb(54.901961%")) << "the color of drones";
  EXPECT_NE(plan_of_job->body, plan->body) << "the scenario's plan, without the job's drones";
  expect_problem(get("/v1/jobs/nowhere/plan"), 404);
}

TEST_F(Uploads, SurviveARestartAndLieInOneFolderOfTheirOwn) {
  std::vector<PackedEntry> files = yard_files();
  for (PackedEntry& file : files) file.path = "my place/" + file.path;
  ASSERT_EQ(upload(packed(Packing::tar_gz, files))->status, 201);
  ScenarioStore again(data.path(), scenarios.path(), service.confined(), {});
  ASSERT_TRUE(again.find("mine"));
  EXPECT_EQ(again.find("mine")->files, 3U);
  EXPECT_TRUE(fs::exists(again.folder() / "mine/yard.json"));
  EXPECT_TRUE(fs::exists(again.folder() / "yard.json")) << "what comes with throng is linked anew";
}

TEST_F(Uploads, ADryRunLeavesNothing) {
  EXPECT_EQ(upload(yard_bundle(), "name=mine&dry_run")->status, 200);
  EXPECT_EQ(get_json("/v1/scenarios")["scenarios"].size(), 1U);
  EXPECT_TRUE(fs::is_empty(data.path() / "uploads"));
  expect_problem(upload("no archive", "name=mine&dry_run"), 400);
  EXPECT_TRUE(fs::is_empty(data.path() / "uploads"));
}

TEST_F(Uploads, ABlueprintBecomesAScenario) {
  SKIP_WITHOUT_PROGRAM();
  const json blueprint = {
      {"name", "Drawn yard"},
      {"ground", {{"min", {-30, -20}}, {"max", {30, 20}}, {"material", "pavers"}}},
      {"inside", {{"min", {-20, -15}}, {"max", {20, 15}}}},
      {"exits", {{{"id", "east"}, {"from", {15, -2}}, {"to", {15, 2}}}}},
      {"drones", {{{"id", "d1"}, {"start", {0, 0, 20}}, {"yaw_deg", 90}}}},
      {"people", {{"groups", {{{"doing", "leave"}, {"box", {-8, -8, 8, 8}}, {"count", 5}}}}}}};
  const auto send = [&](const json& document, const char* query) {
    return client().Post(std::string("/v1/scenarios?") + query, document.dump(),
                         "application/json");
  };
  const httplib::Result dry = send(blueprint, "name=drawn&dry_run");
  ASSERT_EQ(dry->status, 200) << dry->body;
  EXPECT_TRUE(fs::is_empty(data.path() / "uploads"));
  const httplib::Result answer = send(blueprint, "name=drawn");
  ASSERT_EQ(answer->status, 201) << answer->body;
  EXPECT_THAT(json::parse(answer->body)["ids"], ElementsAre("drawn/place"));
  EXPECT_EQ(get_json("/v1/scenarios/drawn/place")["name"], "Drawn yard");
  EXPECT_EQ(get_json("/v1/scenarios/drawn/place?format=blueprint"), blueprint);
  expect_problem(get("/v1/scenarios/yard?format=blueprint"), 404);
  json wrong = blueprint;
  wrong["people"]["groups"][0]["doing"] = "dance";
  const httplib::Result refused = send(wrong, "name=other&dry_run");
  expect_problem(refused, 400);
  const json error = json::parse(refused->body)["errors"][0];
  EXPECT_EQ(error["pointer"], "/people/groups/0/doing");
  EXPECT_THAT(error["found"].get<std::string>(), HasSubstr("dance"));
  expect_problem(send(blueprint, "name=drawn"), 409);
  expect_problem(send(json::array(), "name=other"), 400);
}

TEST_F(Uploads, NamesAreTakenOnce) {
  ASSERT_EQ(upload(yard_bundle())->status, 201);
  expect_problem(upload(yard_bundle()), 409);
  expect_problem(upload(yard_bundle(), "name=b0123456789abcdef"), 409);
  for (const char* name :
       {"", "name=", "name=A", "name=../x", "name=a/b", "name=a.b", "name=con"}) {
    expect_problem(upload(yard_bundle(), name), 400);
  }
  expect_problem(client().Post("/v1/scenarios?name=x", yard_bundle(), "text/plain"), 415);
}

TEST_F(Uploads, MistakesNameFileElementAndRemedy) {
  SKIP_WITHOUT_PROGRAM();
  json errors = upload_errors(
      {{"behavior.xml", "<BFSM>\n<State name=\"Walk\" final=\"1\"/>\n<Oops/></BFSM>"}});
  EXPECT_EQ(errors[0]["source"], "behavior.xml");
  EXPECT_THAT(errors[0]["pointer"].get<std::string>(), HasSubstr("line 3"));
  testing::Yard unnamed;
  unnamed.scenario["name"] = 3;
  errors = upload_errors({{"yard.json", unnamed.scenario.dump()}});
  EXPECT_EQ(errors[0]["source"], "yard.json");
  errors = upload_errors({{"a.xml", "", AE_IFLNK, "/etc/passwd"}});
  EXPECT_EQ(errors[0]["source"], "bundle");
  testing::Yard walled;
  walled.scenario["exits"][0]["goals"] = json::array({json::array({7, 0})});
  const httplib::Result answer = upload(packed(Packing::zip, yard_files(walled)));
  // It can be used, at the owner's risk.
  ASSERT_EQ(answer->status, 201) << answer->body;
  const json findings = json::parse(answer->body)["findings"];
  ASSERT_FALSE(findings.empty());
  EXPECT_EQ(findings[0]["source"], "yard.json");
  EXPECT_EQ(findings[0]["severity"], "error");
  EXPECT_FALSE(findings[0]["remedy"].get<std::string>().empty());
  expect_problem(upload(packed(Packing::zip, {{"readme.txt", "hello"}}), "name=other"), 400);
}

TEST_F(Uploads, NoFileOutsideTheBundleIsRead) {
  SKIP_WITHOUT_PROGRAM();
  const std::string outside = (scenarios.path() / "yard_scene.xml").string();
  json scenario = testing::Yard().scenario;
  scenario["crowd"]["scene"] = outside;
  json errors = upload_errors({{"yard.json", scenario.dump()}});
  EXPECT_EQ(errors[0]["pointer"], "/crowd/scene");
  EXPECT_THAT(errors[0]["found"].get<std::string>(), HasSubstr("elsewhere"));
  scenario["crowd"]["scene"] = "../../../../../../etc/passwd";
  errors = upload_errors({{"yard.json", scenario.dump()}});
  EXPECT_THAT(errors[0]["found"].get<std::string>(), HasSubstr("elsewhere"));

  const std::string scene = yard_files()[0].bytes;
  const auto with = [&](const std::string& element) {
    std::string text = scene;
    text.insert(text.find("<Experiment version=\"2.0\">") + 26, element);
    return text;
  };
  for (const char* element : {R"(<Elevation type="height_field" file_name="/etc/hostname"/>)",
                              R"(<Elevation type="nav_mesh" file_name="../../../x"/>)",
                              R"(<ObstacleSet type="nav_mesh" class="1" file_name="/etc/x"/>)"}) {
    errors = upload_errors({{"scene.xml", with(element)}});
    EXPECT_EQ(errors[0]["source"], "scene.xml") << element;
    EXPECT_THAT(errors[0]["found"].get<std::string>(), HasSubstr("elsewhere")) << element;
  }
  // A file of the bundle that names one outside.
  errors = upload_errors(
      {{"scene.xml", with(R"(<Elevation type="height_field" file_name="a.ht"/>)")},
       {"a.ht", R"(<HeightField file_name="/etc/hostname" cell_size="1" vert_scale="1"/>)"}});
  EXPECT_EQ(errors[0]["source"], "a.ht");
  EXPECT_THAT(errors[0]["found"].get<std::string>(), HasSubstr("elsewhere"));
}

TEST_F(Uploads, MeshesNameNoFileOutsideTheBundle) {
  SKIP_WITHOUT_PROGRAM();
  const jobs::TemporaryFolder elsewhere;
  write_file_atomically(elsewhere.path() / "points.bin",
                        std::string(36, '\0') + std::string(36, 'x'));
  json scenario = testing::Yard().scenario;
  scenario["meshes"] = json::array({{{"file", "a.gltf"}, {"position", {0, 0, 0}}}});
  const auto gltf = [&](const std::string& uri) {
    return json{{"asset", {{"version", "2.0"}}},
                {"scene", 0},
                {"scenes", {{{"nodes", {0}}}}},
                {"nodes", {{{"mesh", 0}}}},
                {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}}}},
                {"accessors",
                 {{{"bufferView", 0},
                   {"componentType", 5126},
                   {"count", 3},
                   {"type", "VEC3"},
                   {"min", {0, 0, 0}},
                   {"max", {1, 1, 1}}}}},
                {"bufferViews", {{{"buffer", 0}, {"byteLength", 36}}}},
                {"buffers", {{{"uri", uri}, {"byteLength", 36}}}}}
        .dump();
  };
  const json errors = upload_errors({{"yard.json", scenario.dump()},
                                     {"a.gltf", gltf((elsewhere.path() / "points.bin").string())}});
  EXPECT_EQ(errors[0]["source"], "a.gltf");
  std::vector<PackedEntry> files = yard_files();
  files.back().bytes = scenario.dump();
  files.push_back({"a.gltf", gltf("points.bin")});
  const std::vector<float> corners = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  files.push_back({"points.bin", std::string(reinterpret_cast<const char*>(corners.data()), 36)});
  const httplib::Result fine = upload(packed(Packing::tar, files));
  EXPECT_EQ(fine->status, 201) << fine->body;
}

TEST_F(Uploads, AreRemovedByTheirOwnerAndNotInUse) {
  const std::string one = keys.create("one", Scope::submit);
  const std::string other = keys.create("other", Scope::submit);
  const auto as = [](const std::string& key) {
    return httplib::Headers{{"Authorization", "Bearer " + key}};
  };
  expect_problem(upload(yard_bundle(), "name=mine", as(keys.create("reader", Scope::read))), 403);
  expect_problem(upload(yard_bundle()), 401);
  ASSERT_EQ(upload(yard_bundle(), "name=mine", as(one))->status, 201);
  expect_problem(client().Delete("/v1/scenarios/mine", as(other)), 403);
  expect_problem(client().Delete("/v1/scenarios/yard", as(one)), 404);
  expect_problem(client().Delete("/v1/scenarios/mine/yard", as(one)), 404);
  {
    Gate gate(executor);
    const httplib::Result job = client().Post("/v1/jobs", as(one), kMine, "application/json");
    ASSERT_EQ(job->status, 201);
    expect_problem(client().Delete("/v1/scenarios/mine", as(one)), 409);
    gate.open();
    const std::string self = "/v1/jobs/" + json::parse(job->body)["id"].get<std::string>();
    EXPECT_TRUE(
        wait_until([&] { return json::parse(get(self, as(one))->body)["state"] == "succeeded"; }));
  }
  EXPECT_EQ(client().Delete("/v1/scenarios/mine", as(one))->status, 204);
  expect_problem(client().Delete("/v1/scenarios/mine", as(one)), 404);
  expect_problem(client().Post("/v1/jobs", as(one), kMine, "application/json"), 400);
  EXPECT_FALSE(fs::exists(data.path() / "uploads/mine"));
}

TEST_F(Uploads, AJobGoesOnOnlyWithTheScenariosThatItWasResolvedFrom) {
  const std::string one = keys.create("one", Scope::submit);
  const std::string other = keys.create("other", Scope::submit);
  const auto as = [](const std::string& key) {
    return httplib::Headers{{"Authorization", "Bearer " + key}};
  };
  ASSERT_EQ(upload(yard_bundle(), "name=mine", as(one))->status, 201);
  Gate gate(executor);
  const httplib::Result job = client().Post("/v1/jobs", as(one), kMine, "application/json");
  ASSERT_EQ(job->status, 201) << job->body;
  const std::string id = json::parse(job->body)["id"];
  const auto post = [&](const std::string& what) {
    return client().Post("/v1/jobs/" + id + what, as(one), "", "application/json");
  };
  ASSERT_TRUE(wait_until([&] { return gate.somebody_waits(); }));
  {
    const std::jthread canceller([&] { EXPECT_EQ(post("/cancel")->status, 200); });
    ASSERT_TRUE(reaches(service, id, jobs::JobState::cancelled));
    gate.open();
  }
  ASSERT_EQ(client().Delete("/v1/scenarios/mine", as(one))->status, 204);
  const httplib::Result gone = post("/retry");
  expect_problem(gone, 409);
  EXPECT_THAT(gone->body, HasSubstr("removed since the job was submitted"));

  // Another place of the same name, of somebody else.
  testing::Yard larger;
  larger.scenario["name"] = "Another yard";
  ASSERT_EQ(upload(packed(Packing::zip, yard_files(larger)), "name=mine", as(other))->status, 201);
  const httplib::Result changed = post("/retry");
  expect_problem(changed, 409);
  EXPECT_THAT(changed->body, HasSubstr("changed since the job was submitted"));

  // The same files again are the same place.
  ASSERT_EQ(client().Delete("/v1/scenarios/mine", as(other))->status, 204);
  ASSERT_EQ(upload(yard_bundle(), "name=mine", as(one))->status, 201);
  EXPECT_EQ(post("/retry")->status, 200);
}

TEST_F(Uploads, AJobThatRunsIsRefusedOnceItsScenarioHasChanged) {
  ASSERT_EQ(upload(yard_bundle())->status, 201);
  const jobs::JobRow row = service.queue().submit({json::parse(kMine)}).row;
  jobs::JobRow other = row;
  other.sources_json = R"({"mine":"0"})";
  service.uploads().require_same_sources(row);
  EXPECT_THROW(service.uploads().require_same_sources(other), InputError);
}

TEST_F(Uploads, HaveABoundTogether) {
  UploadLimits limits;
  limits.max_uploads = 1;
  ScenarioStore store(data.path() / "small", scenarios.path(), service.confined(), limits);
  ScenarioStore::Staged first = store.stage("one", yard_bundle(), "");
  store.publish(first);
  ScenarioStore::Staged second = store.stage("two", yard_bundle(), "");
  EXPECT_THROW(store.publish(second), UploadsFull);
  EXPECT_TRUE(store.remove("one"));
  EXPECT_EQ(store.publish(second).name, "two");
}

TEST_F(Uploads, OneKeyLeavesRoomForOthers) {
  UploadLimits limits;
  limits.max_uploads_of_key = 2;
  ScenarioStore store(data.path() / "small", scenarios.path(), service.confined(), limits);
  const auto publish = [&](const std::string& name, const std::string& owner) {
    ScenarioStore::Staged staged = store.stage(name, yard_bundle(), owner);
    store.publish(staged);
  };
  publish("one", "a");
  publish("two", "a");
  EXPECT_THROW(publish("three", "a"), QuotaError);
  publish("three", "b");
  EXPECT_TRUE(store.remove("one"));
  publish("four", "a");
  limits.max_bytes = 5 * store.find("two")->bytes;
  ScenarioStore narrow(data.path() / "narrow", scenarios.path(), service.confined(), limits);
  ScenarioStore::Staged first = narrow.stage("one", yard_bundle(), "a");
  narrow.publish(first);
  ScenarioStore::Staged second = narrow.stage("two", yard_bundle(), "a");
  EXPECT_THROW(narrow.publish(second), QuotaError);
}

TEST_F(Uploads, ABundleThatComesWithAJobLivesAsLongAsItsJobs) {
  const std::string bundle = yard_bundle();
  const std::string name = bundle_name(bundle);
  const httplib::Result first = submit_bundled(bundle);
  ASSERT_EQ(first->status, 201) << first->body;
  const json job = json::parse(first->body);
  EXPECT_EQ(job["job"]["scenario"], name + "/yard");
  const httplib::Result second = submit_bundled(bundle);
  ASSERT_EQ(second->status, 201);
  EXPECT_EQ(get_json("/v1/scenarios")["scenarios"].size(), 1U) << "it is of no use to others";
  EXPECT_EQ(client().Delete("/v1/jobs/" + job["id"].get<std::string>())->status, 204);
  EXPECT_TRUE(fs::exists(data.path() / "uploads" / name));
  EXPECT_EQ(
      client().Delete("/v1/jobs/" + json::parse(second->body)["id"].get<std::string>())->status,
      204);
  EXPECT_FALSE(fs::exists(data.path() / "uploads" / name));
}

TEST_F(Uploads, ABundleOfARefusedJobDoesNotStay) {
  const std::string bundle = yard_bundle();
  expect_problem(submit_bundled(bundle, "", R"({"scenario": "bundle/yard", "runs": 0})"), 400);
  expect_problem(submit_bundled(bundle, "", R"({"scenario": "yard"})"), 400);
  expect_problem(submit_bundled(bundle, "", R"({"scenario": "bundle/other"})"), 400);
  expect_problem(submit_bundled("x"), 400);
  const httplib::Result dry = submit_bundled(bundle, "?dry_run");
  EXPECT_EQ(dry->status, 200) << dry->body;
  EXPECT_TRUE(fs::is_empty(data.path() / "uploads"));
  expect_problem(client().Post("/v1/jobs", httplib::MultipartFormDataItems{{"scenario", bundle, "",
                                                                            "application/zip"}}),
                 400);
  const httplib::Result plain = client().Post(
      "/v1/jobs", httplib::MultipartFormDataItems{{"job", kJob, "", "application/json"}});
  EXPECT_EQ(plain->status, 201);
}

TEST_F(Uploads, BundlesWithoutAJobAreDroppedAtTheStart) {
  const std::string bundle = yard_bundle();
  {
    ScenarioStore store(data.path() / "two", scenarios.path(), service.confined(), {});
    ScenarioStore::Staged staged = store.stage(bundle_name(bundle), bundle, "");
    store.publish(staged);
    ScenarioStore::Staged kept = store.stage("kept", bundle, "");
    store.publish(kept);
  }
  ServiceOptions two = options();
  two.data = data.path() / "two";
  Service second(two, executor);
  EXPECT_EQ(second.uploads().scenarios().list().size(), 1U);
  EXPECT_TRUE(second.uploads().scenarios().find("kept"));
}

}  // namespace
}  // namespace throng::server
