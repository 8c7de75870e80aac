// Project files: what they say, what they leave out, and what is wrong with them.
#include "crowd/project/project.h"
#include "base/files/resources.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "tests/crowd/crowd_files.h"

namespace throng::crowd {
namespace {

using testing::HasSubstr;

class Projects : public testing::Test {
 protected:
  Projects() {
    folder_.write("s.xml", test::scene_with(test::agent_at(0, 0)));
    folder_.write("b.xml", test::mirror_behavior());
  }

  Project load(const std::string& attributes) {
    return load_project(folder_.write("p.xml", "<Project " + attributes + "/>"));
  }

  Problem caught_problem(const std::string& attributes) {
    try {
      load(attributes);
    } catch (const InputError& error) {
      return error.problems().front();
    }
    ADD_FAILURE() << "accepted: " << attributes;
    return {};
  }

  test::TemporaryFolder folder_;
};

TEST_F(Projects, HaveMengesDefaults) {
  const Project project = load(R"(scene="s.xml" behavior="b.xml" model="orca")");
  EXPECT_EQ(project.scene_file.filename(), "s.xml");
  EXPECT_EQ(project.behavior_file.filename(), "b.xml");
  EXPECT_EQ(project.duration_s, 400);
  EXPECT_EQ(project.options.time_step_s, std::nullopt);
  EXPECT_EQ(project.options.sub_steps, 0);
  EXPECT_EQ(project.options.seed, 1U);
  EXPECT_EQ(project.options.compat, Compat::none);
  EXPECT_EQ(project.options.separation, BodySeparation::automatic);
  EXPECT_TRUE(project.output.empty());
  EXPECT_EQ(project.scb_version, "2.1");
  EXPECT_TRUE(project.warnings.empty());
}

TEST_F(Projects, SayAllOfIt) {
  const Project project = load(
      R"(scene="s.xml" behavior="b.xml" model="orca" view="" output="out/a" scbVersion="2.4"
         duration="12.5" timeStep=".01111111111" subSteps="3" random="77" dumpPath="images"
         compat="huang2016" separation="hard")");
  EXPECT_EQ(project.duration_s, 12.5);
  EXPECT_EQ(project.options.time_step_s, .01111111111);
  EXPECT_EQ(project.options.sub_steps, 3);
  EXPECT_EQ(project.options.seed, 77U);
  EXPECT_EQ(project.options.compat, Compat::huang2016);
  EXPECT_EQ(project.options.separation, BodySeparation::hard);
  EXPECT_EQ(project.output.filename(), "a");
  EXPECT_EQ(project.output.parent_path().filename(), "out");
  EXPECT_EQ(project.scb_version, "2.4");
  EXPECT_TRUE(project.warnings.empty());
}

TEST_F(Projects, RunWithTheirTimeStepAndSubSteps) {
  Simulation crowd =
      load_simulation(load(R"(scene="s.xml" behavior="b.xml" timeStep="0.05" subSteps="4")"));
  EXPECT_DOUBLE_EQ(crowd.dt_s(), 0.05);
  crowd.step();
  EXPECT_NEAR(crowd.time_s(), 0.05, 1e-9);
}

TEST_F(Projects, WarnOfTheClockAndOfUnknownAttributes) {
  const Project project = load(R"(scene="s.xml" behavior="b.xml" random="0" outSamples="3"
    subStep="1")");
  ASSERT_EQ(project.warnings.size(), 3U);
  EXPECT_THAT(project.warnings[0].where, HasSubstr("outSamples"));
  EXPECT_THAT(project.warnings[1].found, HasSubstr("did you mean subSteps?"));
  EXPECT_THAT(project.warnings[2].where, HasSubstr("random"));
  EXPECT_EQ(project.options.seed, 1U);
}

TEST_F(Projects, NameMistakes) {
  EXPECT_THAT(caught_problem(R"(scene="nowhere.xml" behavior="b.xml")").where,
              HasSubstr("attribute \"scene\""));
  EXPECT_THAT(caught_problem(R"(scene="." behavior="b.xml")").found, HasSubstr("no file"));
  EXPECT_THAT(caught_problem("scene=\"" + std::string(1000, 'x') + "\"").found,
              HasSubstr("no file"));
  EXPECT_THAT(caught_problem(R"(scene="s.xml" behavior="b.xml" model="orka")").found,
              HasSubstr("orka"));
  EXPECT_THAT(caught_problem(R"(duration="-1")").where, HasSubstr("duration"));
  EXPECT_THAT(caught_problem(R"(duration="1e300")").where, HasSubstr("duration"));
  EXPECT_THAT(caught_problem(R"(timeStep="1e-9")").where, HasSubstr("timeStep"));
  EXPECT_THAT(caught_problem(R"(subSteps="-2")").where, HasSubstr("subSteps"));
  EXPECT_THAT(caught_problem(R"(random="-5")").where, HasSubstr("random"));
  EXPECT_THAT(caught_problem(R"(scbVersion="3.0")").expected, HasSubstr("2.4"));
  EXPECT_THAT(caught_problem(R"(compat="meng")").found, HasSubstr("did you mean menge?"));
  EXPECT_THROW(load_project("/nowhere/project.xml"), InputError);
  EXPECT_THROW(load_project("/"), InputError);
  EXPECT_THROW(load_simulation(load(R"(behavior="b.xml")")), InputError);
  EXPECT_THROW(load_simulation(load(R"(scene="s.xml")")), InputError);
}

TEST_F(Projects, ReadBackslashesAsFolders) {
  std::filesystem::create_directory(folder_.path() / "sub");
  folder_.write("sub/b2.xml", test::mirror_behavior());
  const Project project = load(R"(scene=".\s.xml" behavior="sub\b2.xml" output="sub\out.scb")");
  EXPECT_TRUE(std::filesystem::exists(project.scene_file)) << project.scene_file;
  EXPECT_EQ(project.behavior_file.parent_path().filename(), "sub");
  EXPECT_EQ(project.output.parent_path().filename(), "sub");
}

TEST_F(Projects, NameEveryMissingFileAndTheFolderThatWasLookedIn) {
  try {
    load(R"(scene="S.xml" behavior="maps\b.xml")");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    ASSERT_EQ(error.problems().size(), 2U);
    EXPECT_THAT(error.problems()[0].expected, HasSubstr(folder_.path().string()));
    EXPECT_THAT(error.problems()[0].expected, HasSubstr("did you mean s.xml?"));
    EXPECT_THAT(error.problems()[1].expected,
                HasSubstr((folder_.path() / "maps").string() + ", which is missing"));
  }
  folder_.write("road.xml",
                R"(<BFSM><GoalSet id="0"><Goal type="point" id="0" x="9" y="0"/></GoalSet>
    <State name="Start" final="0"><GoalSelector type="explicit" goal_set="0" goal="0"/>
    <VelComponent type="road_map" file_name="maps\graph.txt"/></State>
    <State name="End" final="1"/>
    <Transition from="Start" to="End"><Condition type="goal_reached" distance="1"/></Transition>
    </BFSM>)");
  try {
    load_simulation(load(R"(scene="s.xml" behavior="road.xml")"));
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.problems().front().expected, HasSubstr((folder_.path() / "maps").string()));
  }
}

TEST(ProjectFiles, OfMengesExamplesAreRead) {
  const auto examples = source_folder() / "../shared/data/menge_examples";
  if (!std::filesystem::exists(examples)) GTEST_SKIP() << "no examples here";
  for (const auto& entry : std::filesystem::directory_iterator(examples)) {
    if (entry.path().extension() != ".xml") continue;
    const Project project = load_project(entry.path());
    EXPECT_FALSE(project.scene_file.empty()) << entry.path();
  }
}

}  // namespace
}  // namespace throng::crowd
