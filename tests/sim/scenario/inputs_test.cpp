#include "sim/scenario/inputs.h"

#include <gmock/gmock.h>

#include "sim/scenario/flight_parts.h"
#include "tests/sim/config/input_files.h"

namespace hedgehop::sim {
namespace {

using ::testing::IsSupersetOf;

std::vector<std::string> names_of(const Inputs& inputs) {
  std::vector<std::string> names;
  for (const auto& [name, hash] : inputs) names.push_back(name);
  return names;
}

TEST(Sha256, IsThatOfTheStandard) {
  const Folder folder;
  Folder::write("abc", "abc");
  // FIPS 180-4, its example of one block.
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256("none"), "missing");
  EXPECT_EQ(sha256("."), "missing");
}

TEST(Inputs, HoldEveryFileThatAFlightDependsOn) {
  const Folder folder;
  const std::filesystem::path deep = "far/deep/er";  // four folders below the folder of the source
  Folder::write("far/base.yaml",
                "use: " HEDGEHOP_SOURCE_DIR "/configs/garratt2009_room_0_light.yaml\nrig: {use: rig.yaml}\n");
  Folder::write("far/rig.yaml", "cameras: []\n");
  Folder::write("far/wing.yaml", "module: go_to_goal\n");
  Folder::write("far/deep/er/t.obj",
                "mtllib t.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n");
  Folder::write("far/deep/er/t.mtl", "newmtl m\nmap_Kd t.ppm\n");
  Folder::write("far/deep/er/t.ppm", "P3 1 1 255\n9 8 7\n");
  Folder::write("far/deep/er/s.yaml",
                "use: ../../base.yaml\nname: s\nvelocimeter: {enabled: false}\n"
                "goal: {north: 5, east: 0, altitude: 1}\nchecks: [{check: no_collision}]\n"
                "scene: {imports: [{file: t.obj, collide: none}]}\n");
  const std::vector<std::string> overrides{"avoidance.use=../../wing.yaml"};
  const Inputs inputs = load_flight(deep / "s.yaml", overrides).inputs;
  EXPECT_THAT(names_of(inputs),
              IsSupersetOf({"s.yaml", "t.obj", "t.mtl", "t.ppm", "../../base.yaml", "../../rig.yaml", "../../wing.yaml",
                            HEDGEHOP_SOURCE_DIR "/configs/garratt2009_room_0_light.yaml"}));
  for (const auto& [name, hash] : inputs) EXPECT_EQ(hash, sha256(deep / name)) << name;
}

}  // namespace
}  // namespace hedgehop::sim
