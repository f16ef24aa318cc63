#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "scenes/mesh/sdf_reader.h"
#include "tests/scenes/mesh/imported_files.h"

namespace hedgehop::scenes::mesh {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;
using testing::ThrowsMessage;
using Error = std::invalid_argument;

const Vector3d kToNorth = Vector3d::UnitX(), kToEast = Vector3d::UnitY(), kStraightDown = Vector3d::UnitZ();

class SdfWorlds : public ImportedFiles {
 protected:
  static std::string link(const std::string& geometry, const std::string& more = "") {
    const std::string shape = "<geometry>" + geometry + "</geometry>" + more;
    return "<link name='link'><visual name='v'>" + shape + "</visual><collision name='c'>" + shape +
           "</collision></link>";
  }
  static std::string model(const std::string& name, const std::string& pose, const std::string& contents) {
    return "<model name='" + name + "'><pose>" + pose + "</pose>" + contents + "</model>";
  }
  Scene world(const std::string& contents) {
    const std::string file = write("w.sdf", "<sdf version='1.7'><world name='w'>" + contents + "</world></sdf>");
    return imported({.file = file});
  }
  static std::string box(const std::string& size) { return "<box><size>" + size + "</size></box>"; }
};

TEST_F(SdfWorlds, XIsEastYIsNorthAndZIsUp) {
  // 2 m (x) by 4 m (y) by 6 m (z) around x 10, y 20, z 5.
  const Scene scene = world(model("box", "10 20 5 0 0 0", link(box("2 4 6"))));
  EXPECT_NEAR(cast(scene, {0.0, 10.5, -5.5}, kToNorth).distance_m, 18.0, 1e-5);
  EXPECT_NEAR(cast(scene, {20.5, 0.0, -5.5}, kToEast).distance_m, 9.0, 1e-5);
  EXPECT_NEAR(cast(scene, {20.5, 10.5, -50.0}, kStraightDown).distance_m, 42.0, 1e-5);
  ASSERT_EQ(scene.solids.size(), 1u);
  EXPECT_EQ(scene.solids[0].name, "box");
  const Eigen::AlignedBox3d bounds = bounds_W(scene.solids[0]);
  EXPECT_TRUE(bounds.min().isApprox(Vector3d(18.0, 9.0, -8.0)));
  EXPECT_TRUE(bounds.max().isApprox(Vector3d(22.0, 11.0, -2.0)));
}

TEST_F(SdfWorlds, PosesOfModelsLinksAndShapesFollowEachOther) {
  // The model turns x to y (north). 3 m along the link's x and 1 m along the shape's x are then north.
  const std::string quarter = std::to_string(std::numbers::pi / 2.0);
  const std::string shapes =
      "<link name='l'><pose>3 0 0 0 0 0</pose><visual name='v'><pose>1 0 0 0 0 0</pose><geometry>" + box("2 2 2") +
      "</geometry></visual></link>";
  const Scene scene = world(model("turned", "0 10 2 0 0 " + quarter, shapes));
  EXPECT_NEAR(cast(scene, {0.0, 0.1, -2.1}, kToNorth).distance_m, 13.0, 1e-5);
  EXPECT_TRUE(scene.solids.empty());  // it has no collision shape
}

TEST_F(SdfWorlds, APoseMayBeRelativeToAFrame) {
  const std::string frames =
      "<frame name='f'><pose relative_to='g'>0 2 0 0 0 0</pose></frame><frame name='g'><pose>0 5 0 0 0 "
      "0</pose></frame>";
  const std::string shape = "<link name='l'><pose relative_to='f'>0 3 0 0 0 0</pose><visual name='v'><geometry>" +
                            box("2 2 2") + "</geometry></visual></link>";
  EXPECT_NEAR(cast(world(model("m", "0 0 1 0 0 0", frames + shape)), {0.0, 0.1, -1.1}, kToNorth).distance_m, 9.0, 1e-5);
  const std::string lost = "<link name='l'><pose relative_to='h'>0 3 0 0 0 0</pose><visual name='v'/></link>";
  EXPECT_THAT([&] { world(model("m", "0 0 1 0 0 0", lost)); },
              ThrowsMessage<Error>(
                  HasSubstr("<pose> is relative to 'h', which is no link, frame, joint or model in the same model")));
  const std::string circle =
      "<frame name='f'><pose relative_to='g'/></frame><frame name='g'><pose relative_to='f'/></frame>"
      "<link name='l'><pose relative_to='f'/><visual name='v'/></link>";
  EXPECT_THAT([&] { world(model("m", "", circle)); }, ThrowsMessage<Error>(HasSubstr("relative to each other")));
}

TEST_F(SdfWorlds, PosesAreThoseOfLibsdformat) {
  const std::string text =
      "<sdf version='1.9'><world name='w'><model name='m'>"
      "<frame name='f'><pose relative_to='g'>0 2 0.5 0.3 0 0</pose></frame>"
      "<frame name='g' attached_to='b'><pose>0.4 0 0 0 0 0.7</pose></frame>"
      "<link name='a'><pose relative_to='f'>0.1 3 0 0 -0.2 0</pose><collision name='c'><pose>0 0 1 0.5 0 0</pose>"
      "<geometry><box><size>1 2 3</size></box></geometry></collision></link>"
      "<link name='b'><pose degrees='true'>1 0 0 90 0 45</pose><collision name='c'>"
      "<pose rotation_format='quat_xyzw'>0 1 0 0 0 0.3826834 0.9238795</pose>"
      "<geometry><sphere><radius>1</radius></sphere></geometry></collision></link>"
      "<model name='n'><pose relative_to='a'>0 0 2 0 0 1</pose><link name='l'><collision name='c'>"
      "<geometry><sphere><radius>1</radius></sphere></geometry></collision></link></model></model></world></sdf>";
  const SdfWorld read = read_sdf(write("w.sdf", text));
  ASSERT_EQ(read.shapes.size(), 3u);
  const auto expect = [](const SdfShape& shape, const Vector3d& position, const Eigen::Quaterniond& rotation) {
    EXPECT_LT((shape.pose.translation() - position).norm(), 3e-6) << shape.name;
    EXPECT_LT(rotation.angularDistance(Eigen::Quaterniond(shape.pose.linear())), 3e-6) << shape.name;
  };
  // SemanticPose().Resolve() of libsdformat 12.3
  expect(read.shapes[0], {0.787304, -3.497707, 3.436644}, {0.201869, 0.897077, 0.154169, 0.361572});
  expect(read.shapes[1], {1.0, 0.0, 1.0}, {0.5, 0.707107, 0.0, 0.5});
  expect(read.shapes[2], {1.473853, -4.135277, 3.087137}, {0.180176, 0.747683, -0.340181, 0.541094});
}

TEST_F(SdfWorlds, ReadsCylindersAndSpheres) {
  const std::string quarter = std::to_string(std::numbers::pi / 2.0);
  const std::string tube = "<cylinder><radius>1</radius><length>6</length></cylinder>",
                    globe = "<sphere><radius>2</radius></sphere>";
  const Scene scene =
      world(model("tube", "0 20 4 " + quarter + " 0 0", link(tube)) + model("globe", "30 20 4 0 0 0", link(globe)));
  // The roll lays the tube's axis along y (north).
  EXPECT_NEAR(cast(scene, {0.0, 0.0, -4.0}, kToNorth).distance_m, 17.0, 1e-4);
  EXPECT_NEAR(cast(scene, {20.0, -10.0, -4.0}, kToEast).distance_m, 9.0, 0.01);
  EXPECT_NEAR(cast(scene, {0.0, 30.0, -4.0}, kToNorth).distance_m, 18.0, 0.02);
  ASSERT_EQ(scene.solids.size(), 2u);
  EXPECT_EQ(scene.solids[0].shape, Solid::Shape::cylinder);
  EXPECT_TRUE(scene.solids[0].half_extents_m.isApprox(Vector3d(1.0, 1.0, 3.0)));
  EXPECT_NEAR(std::abs(scene.solids[0].X_WS.linear().col(2).x()), 1.0, 1e-6);
  EXPECT_EQ(scene.solids[1].shape, Solid::Shape::sphere);
  EXPECT_TRUE(scene.solids[1].half_extents_m.isApprox(Vector3d::Constant(2.0)));
}

TEST_F(SdfWorlds, TheGroundPlaneIsThatOfTheScene) {
  const std::string plane = "<plane><normal>0 0 1</normal><size>10 10</size></plane>";
  const std::string planes = model("ground", "", link(plane)) + model("roof", "0 0 8 0 0 0", link(plane));
  const Scene scene = world(planes);
  EXPECT_THAT(lines_.at(0), HasSubstr("left out: 2 plane (the scene has a ground)"));
  ASSERT_EQ(scene.solids.size(), 1u);
  EXPECT_EQ(scene.solids[0].name, "roof");
  EXPECT_NEAR(cast(scene, {0.5, 0.7, -20.0}, kStraightDown).distance_m, 12.0, 1e-5);
}

TEST_F(SdfWorlds, IncludesModelsByPathWithTheirMeshes) {
  write("models/crate/meshes/crate.obj", "v 0 0 0\nv 2 0 0\nv 0 0 2\nv 0 2 0\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n");
  const std::string shape = link("<mesh><uri>model://crate/meshes/crate.obj</uri><scale>1 1 3</scale></mesh>");
  write("models/crate/model.sdf", "<sdf version='1.6'><model name='crate'>" + shape + "</model></sdf>");
  const Scene scene = world(
      "<include><uri>model://crate</uri><name>crate_7</name><pose>0 10 0 0 0 0</pose></include>"
      "<include><uri>model://crate</uri><pose>5 10 0 0 0 0</pose></include>");
  EXPECT_NEAR(cast(scene, {10.1, 0.1, -20.0}, kStraightDown).distance_m, 20.0 - 3.0 * 1.8, 1e-4);
  ASSERT_EQ(scene.solids.size(), 2u);
  EXPECT_EQ(scene.solids[0].name, "crate_7");
  EXPECT_EQ(scene.solids[1].name, "crate");
  EXPECT_EQ(mesh_files(folder_ / "w.sdf").size(), 3u);  // with the model and its mesh, once
}

TEST_F(SdfWorlds, ThePoseOfAnIncludeReplacesThatOfItsModel) {
  write("inner/model.sdf", "<sdf version='1.7'>" + model("inner", "0 12 0.5 0 0 0", link(box("4 4 1"))) + "</sdf>");
  const std::string included = "<include><uri>inner</uri>", at_20 = "<pose>0 20 0.5 0 0 0</pose></include>";
  const auto wall_m = [&](const std::string& contents) {
    return cast(world(contents), {0.0, 0.1, -0.5}, kToNorth).distance_m;
  };
  EXPECT_NEAR(wall_m(included + at_20), 18.0, 1e-5);
  EXPECT_NEAR(wall_m(included + "</include>"), 10.0, 1e-5);
  EXPECT_NEAR(wall_m(model("outer", "0 3 0 0 0 0", included + at_20)), 21.0, 1e-5);
  EXPECT_NEAR(wall_m(model("outer", "0 3 0 0 0 0", included + "</include>")), 13.0, 1e-5);
}

TEST_F(SdfWorlds, NamesOfIncludedModelsBeginWithTheModelThatIncludesThem) {
  write("inner/model.sdf", "<sdf version='1.7'>" + model("inner", "", link(box("1 1 1"))) + "</sdf>");
  const std::string file = write(
      "w.sdf",
      "<sdf version='1.7'><world name='w'>" +
          model("outer", "", "<include><uri>inner</uri></include><include><uri>inner</uri><name>b</name></include>") +
          "</world></sdf>");
  const SdfWorld read = read_sdf(file);
  ASSERT_EQ(read.shapes.size(), 4u);
  EXPECT_EQ(read.shapes[0].name, "outer::inner::link::v");
  EXPECT_EQ(read.shapes[2].name, "outer::b::link::v");
}

TEST_F(SdfWorlds, ListsTheElementsThatItLeavesOut) {
  world("<light name='sun'/><light name='lamp'/><physics/>" +
        model("m", "",
              "<plugin name='p'/>" + link(box("1 1 1")) +
                  "<link name='x'><visual name='v'><geometry><heightmap/></geometry></visual></link>"));
  EXPECT_THAT(lines_.at(0), HasSubstr("left out: 1 geometry heightmap, 2 light, 1 physics, 1 plugin"));
}

TEST_F(SdfWorlds, RefusesFaultsInOneLine) {
  const auto fails = [this](const std::string& contents, const std::string& why) {
    EXPECT_THAT([&] { world(contents); }, ThrowsMessage<Error>(HasSubstr(why))) << contents;
  };
  fails(model("m", "", link(box("1 nan 1"))), "w.sdf': <size>");
  fails(model("m", "", link(box("1 1"))), "<size> expects 3 numbers, got 2");
  fails(model("m", "", link(box("1 -1 1"))), "the size of <box> must be above 0");
  fails(model("m", "1 2 3", link(box("1 1 1"))), "<pose> expects 6 numbers, got 3");
  fails("<include><uri>model://missing</uri></include>", "<uri> 'model://missing': there is no such file");
  fails("<include><uri>w.sdf</uri></include>", "nested deeper than 20 levels");
  fails("", "it has no shapes");
  EXPECT_THAT([&] { imported({.file = write("x.sdf", "<sdf><wor")}); },
              ThrowsMessage<Error>(HasSubstr("it is not XML")));
  EXPECT_THAT([&] { imported({.file = write("y.world", "<robot/>")}); },
              ThrowsMessage<Error>(HasSubstr("it has no element <sdf>")));
}

}  // namespace
}  // namespace hedgehop::scenes::mesh
