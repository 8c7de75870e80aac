#include "skinning/import/rig_names.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"

namespace throng::skinning {
namespace {

/// A rig by the names of its bones in palette order; "" leaves one out.
struct NamedRig {
  const char* program;
  std::array<const char*, kBoneCount> names;
};

const std::array kRigs = {
    NamedRig{"mixamo",
             {"mixamorig:Hips",          "mixamorig:Spine",       "mixamorig:Spine2",
              "mixamorig:Neck",          "mixamorig:Head",        "mixamorig:LeftShoulder",
              "mixamorig:LeftArm",       "mixamorig:LeftForeArm", "mixamorig:LeftHand",
              "mixamorig:RightShoulder", "mixamorig:RightArm",    "mixamorig:RightForeArm",
              "mixamorig:RightHand",     "mixamorig:LeftUpLeg",   "mixamorig:LeftLeg",
              "mixamorig:LeftFoot",      "mixamorig:LeftToeBase", "mixamorig:RightUpLeg",
              "mixamorig:RightLeg",      "mixamorig:RightFoot",   "mixamorig:RightToeBase"}},
    NamedRig{"vrm",
             {"hips",          "spine",         "upperChest",    "neck",          "head",
              "leftShoulder",  "leftUpperArm",  "leftLowerArm",  "leftHand",      "rightShoulder",
              "rightUpperArm", "rightLowerArm", "rightHand",     "leftUpperLeg",  "leftLowerLeg",
              "leftFoot",      "leftToes",      "rightUpperLeg", "rightLowerLeg", "rightFoot",
              "rightToes"}},
    NamedRig{"vroid",
             {"J_Bip_C_Hips",    "J_Bip_C_Spine",    "J_Bip_C_UpperChest", "J_Bip_C_Neck",
              "J_Bip_C_Head",    "J_Bip_L_Shoulder", "J_Bip_L_UpperArm",   "J_Bip_L_LowerArm",
              "J_Bip_L_Hand",    "J_Bip_R_Shoulder", "J_Bip_R_UpperArm",   "J_Bip_R_LowerArm",
              "J_Bip_R_Hand",    "J_Bip_L_UpperLeg", "J_Bip_L_LowerLeg",   "J_Bip_L_Foot",
              "J_Bip_L_ToeBase", "J_Bip_R_UpperLeg", "J_Bip_R_LowerLeg",   "J_Bip_R_Foot",
              "J_Bip_R_ToeBase"}},
    NamedRig{"rigify", {"DEF-pelvis", "DEF-spine",      "DEF-spine.003",   "DEF-neck",
                        "DEF-head",   "DEF-shoulder.L", "DEF-upper_arm.L", "DEF-forearm.L",
                        "DEF-hand.L", "DEF-shoulder.R", "DEF-upper_arm.R", "DEF-forearm.R",
                        "DEF-hand.R", "DEF-thigh.L",    "DEF-shin.L",      "DEF-foot.L",
                        "DEF-toe.L",  "DEF-thigh.R",    "DEF-shin.R",      "DEF-foot.R",
                        "DEF-toe.R"}},
    NamedRig{"makehuman",
             {"pelvis",       "spine05",      "spine01",      "neck01",       "head",
              "clavicle.L",   "upperarm01.L", "lowerarm01.L", "wrist.L",      "clavicle.R",
              "upperarm01.R", "lowerarm01.R", "wrist.R",      "upperleg01.L", "lowerleg01.L",
              "foot.L",       "toe1-1.L",     "upperleg01.R", "lowerleg01.R", "foot.R",
              "toe1-1.R"}},
    NamedRig{"biped", {"Bip01 Pelvis", "Bip01 Spine",      "Bip01 Spine1",     "Bip01 Neck",
                       "Bip01 Head",   "Bip01 L Clavicle", "Bip01 L UpperArm", "Bip01 L Forearm",
                       "Bip01 L Hand", "Bip01 R Clavicle", "Bip01 R UpperArm", "Bip01 R Forearm",
                       "Bip01 R Hand", "Bip01 L Thigh",    "Bip01 L Calf",     "Bip01 L Foot",
                       "Bip01 L Toe0", "Bip01 R Thigh",    "Bip01 R Calf",     "Bip01 R Foot",
                       "Bip01 R Toe0"}},
    NamedRig{"unreal",
             {"pelvis",     "spine_01",   "spine_03", "neck_01",    "head",       "clavicle_l",
              "upperarm_l", "lowerarm_l", "hand_l",   "clavicle_r", "upperarm_r", "lowerarm_r",
              "hand_r",     "thigh_l",    "calf_l",   "foot_l",     "ball_l",     "thigh_r",
              "calf_r",     "foot_r",     "ball_r"}},
    NamedRig{"daz", {"hip",      "abdomen", "chest",   "neck",   "head",     "lCollar", "lShldr",
                     "lForeArm", "lHand",   "rCollar", "rShldr", "rForeArm", "rHand",   "lThigh",
                     "lShin",    "lFoot",   "lToe",    "rThigh", "rShin",    "rFoot",   "rToe"}},
    NamedRig{"smpl",
             {"Pelvis",  "Spine1",  "Spine3",   "Neck",       "Head",    "L_Collar", "L_Shoulder",
              "L_Elbow", "L_Wrist", "R_Collar", "R_Shoulder", "R_Elbow", "R_Wrist",  "L_Hip",
              "L_Knee",  "L_Ankle", "L_Toe",    "R_Hip",      "R_Knee",  "R_Ankle",  "R_Toe"}},
    NamedRig{"synty",
             {"Hips",       "Spine_01",   "Spine_03",   "Neck",       "Head",       "Clavicle_L",
              "Shoulder_L", "Elbow_L",    "Hand_L",     "Clavicle_R", "Shoulder_R", "Elbow_R",
              "Hand_R",     "UpperLeg_L", "LowerLeg_L", "Ankle_L",    "Ball_L",     "UpperLeg_R",
              "LowerLeg_R", "Ankle_R",    "Ball_R"}},
    NamedRig{
        "capture",
        {"Hips",      "LowerBack",   "Spine1",      "Neck",          "Head",        "LeftShoulder",
         "LeftArm",   "LeftForeArm", "LeftHand",    "RightShoulder", "RightArm",    "RightForeArm",
         "RightHand", "LeftUpLeg",   "LeftLeg",     "LeftFoot",      "LeftToeBase", "RightUpLeg",
         "RightLeg",  "RightFoot",   "RightToeBase"}}};

class RigNamesTest : public testing::TestWithParam<NamedRig> {};

RiggedModel make_model(const NamedRig& rig) {
  RiggedModel model;
  model.file = "model.glb";
  model.nodes.push_back({"Root", -1, Eigen::Matrix4f::Identity(), false});
  for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
    const int parent = bone == 0 ? 0 : static_cast<int>(index_from(kParent[bone])) + 1;
    model.nodes.push_back({rig.names[bone], parent, Eigen::Matrix4f::Identity(), true});
  }
  return model;
}

TEST_P(RigNamesTest, AreKnown) {
  const BoneNodes nodes = map_bones(make_model(GetParam()), {}, "x.json");
  for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
    EXPECT_EQ(nodes[bone], static_cast<int>(bone) + 1) << kBoneNames[bone];
  }
}

INSTANTIATE_TEST_SUITE_P(Programs, RigNamesTest, testing::ValuesIn(kRigs),
                         [](const auto& rig_info) { return std::string(rig_info.param.program); });

TEST(RigNames, HandlesOfAnimatorsAreNoBones) {
  RiggedModel model = make_model(kRigs[0]);
  model.nodes.insert(model.nodes.begin() + 1,
                     {"LeftFoot_IK", 0, Eigen::Matrix4f::Identity(), false});
  for (std::size_t i = 3; i < model.nodes.size(); ++i) ++model.nodes[i].parent;
  const BoneNodes nodes = map_bones(model, {}, "x.json");
  EXPECT_EQ(model.nodes[static_cast<std::size_t>(nodes[index_from(Bone::left_foot)])].name,
            "mixamorig:LeftFoot");
}

// Rigs such as SMPL's without its collars, with a spine of one bone, and Synty's.
TEST(RigNames, WithoutCollarBonesTheShoulderIsTheUpperArm) {
  for (const NamedRig& rig : kRigs) {
    const std::string program = rig.program;
    if (program != "smpl" && program != "synty" && program != "daz") continue;
    RiggedModel model = make_model(rig);
    for (const Bone collar : {Bone::left_clavicle, Bone::right_clavicle}) {
      const std::size_t node = index_from(collar) + 1;
      model.nodes[node + 1].parent = model.nodes[node].parent;
      model.nodes[node].name = "Strap";
    }
    const BoneNodes nodes = map_bones(model, {}, "x.json");
    for (const Bone bone : {Bone::left_upper_arm, Bone::right_upper_arm, Bone::left_forearm}) {
      EXPECT_EQ(nodes[index_from(bone)], static_cast<int>(index_from(bone)) + 1) << program;
    }
    EXPECT_EQ(nodes[index_from(Bone::left_clavicle)], -1);
  }
}

TEST(RigNames, TheUsersNamesComeFirst) {
  RiggedModel model = make_model(kRigs[0]);
  model.nodes.push_back({"Skull", 5, Eigen::Matrix4f::Identity(), true});
  const BoneNodes nodes = map_bones(model, {{"head", "Skull"}}, "x.json");
  EXPECT_EQ(nodes[index_from(Bone::head)], static_cast<int>(model.nodes.size()) - 1);
}

// Exporters write the name of the character before each bone, with or without a sign between them.
TEST(RigNames, AnyCommonPrefixIsPassedOver) {
  for (const char* prefix : {"Hero_Rig:", "Granny", "npc07.", "Left Behind "}) {
    RiggedModel model = make_model(kRigs[1]);
    for (std::size_t i = 1; i < model.nodes.size(); ++i) {
      model.nodes[i].name = prefix + model.nodes[i].name;
    }
    model.nodes.push_back({"Tail", 1, Eigen::Matrix4f::Identity(), true});
    const BoneNodes nodes = map_bones(model, {}, "x.json");
    for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
      EXPECT_EQ(nodes[bone], static_cast<int>(bone) + 1) << prefix << kBoneNames[bone];
    }
  }
}

TEST(RigNames, NothingIsListedWhereNoBoneIsLeft) {
  NamedRig rig = kRigs[0];
  RiggedModel model = make_model(rig);
  const std::size_t foot = index_from(Bone::left_foot);
  model.nodes[foot + 1].name = "mixamorig:LeftUpLeg_end";
  model.nodes[foot + 1].deforms = false;
  try {
    map_bones(model, {}, "x.json");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("/bones/left_foot"));
    EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("not recognized")));
  }
}

TEST(RigNames, SimilarNamesAreFound) {
  EXPECT_EQ(most_similar("head", {"tf_hood_a", "tf_hood_b", "tf_hood_c", "tf_haed", "tf_arm_x",
                                  "tf_arm_y", "tf_leg_x", "tf_leg_y"}),
            "tf_haed");
  EXPECT_EQ(most_similar("left_thigh", {"Head", "thigh_left", "Left-Tigh", "Tail"}), "Left-Tigh");
  EXPECT_EQ(most_similar("left_thigh", {}), "");
}

}  // namespace
}  // namespace throng::skinning
