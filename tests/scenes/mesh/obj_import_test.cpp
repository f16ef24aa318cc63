#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "scenes/mesh/model.h"
#include "tests/scenes/mesh/imported_files.h"

namespace hedgehop::scenes::mesh {
namespace {

using Eigen::Vector3d;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::ThrowsMessage;
using E = std::invalid_argument;

class ObjImport : public ImportedFiles {
 protected:
  Model read(const std::string& text) const { return read_model(write("a.obj", text), {}); }
  auto reading(const std::string& text) const {
    return [this, text] { read(text); };
  }
};

// The area of all triangles, in the units of the model.
double area_of(const Model& model) {
  double area = 0.0;
  for (const Part& part : model.parts) {
    for (const auto& [a, b, c] : part.body.faces) {
      const std::vector<Vector3d>& corners = part.body.corners;
      area += 0.5 * (corners[b] - corners[a]).cross(corners[c] - corners[a]).norm();
    }
  }
  return area;
}

const std::string kCorners = "v 0 0 0\nv 2 0 0\nv 2 3 0\nv 0 3 0\n";

TEST_F(ObjImport, IndicesMayBeNegativeOrReferToLinesBelow) {
  for (const std::string& text : {kCorners + "f -4 -3 -2 -1\n", "f 1 2 3 4\n" + kCorners,
                                  kCorners.substr(0, 24) + "f -3 -2 -1\nv 0 3 0\nf 1 3 4\n"}) {
    const Model model = read(text);
    ASSERT_THAT(model.parts, SizeIs(1)) << text;
    EXPECT_THAT(model.parts[0].body.faces, SizeIs(2)) << text;
    EXPECT_DOUBLE_EQ(area_of(model), 6.0) << text;
  }
}

TEST_F(ObjImport, LinesMayEndInEveryWayAndContinue) {
  const std::string text = "# a\\b\nv 0 0 0 # corner\nv 2 0 \\\n 0\nv 2 3 0\nv 0 3 0\nf 1 2 \\\n3 4\n";
  std::string windows, old_mac = "v 0 0 0\rv 2 0 0\rv 2 3 0\rv 0 3 0\rf 1 2 3 4\r";
  for (const char c : text) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  for (const std::string& each : {text, windows, old_mac}) EXPECT_DOUBLE_EQ(area_of(read(each)), 6.0);
}

TEST_F(ObjImport, TheLastLineMayEndWithABackslash) {
  for (const std::string ending : {"\\", " \\\n", "\\\r\n", " \\\n\n"}) {
    EXPECT_DOUBLE_EQ(area_of(read(kCorners + "f 1 2 3 4" + ending)), 6.0) << ending;
    EXPECT_DOUBLE_EQ(area_of(read(kCorners + "f 1 2 \\\n3 4" + ending)), 6.0) << ending;
  }
  write("a.mtl", "newmtl red\nKd 1 0 0\\");
  const Model model = read("mtllib a.mtl\n" + kCorners + "usemtl red\nf 1 2 3\n");
  EXPECT_EQ(model.materials.at(model.parts.at(0).material).color, Eigen::Vector3f(1, 0, 0));
}

TEST_F(ObjImport, FacesWithoutNormalsAreFlatAndSmoothCornersAreShared) {
  const std::string fold = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 1\n";
  const Model flat = read(fold + "f 1 2 3\nf 2 1 4\n");
  ASSERT_THAT(flat.parts, SizeIs(1));
  EXPECT_THAT(flat.parts[0].normals, ElementsAre(Vector3d::UnitZ(), Vector3d::UnitZ(), Vector3d::UnitZ(),
                                                 Vector3d::UnitY(), Vector3d::UnitY(), Vector3d::UnitY()));
  const Model smooth = read(fold + "vn 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//2\nf 2//1 1//1 4//2\n");
  EXPECT_THAT(smooth.parts.at(0).body.corners, SizeIs(4));
  EXPECT_EQ(smooth.parts[0].normals.at(0), Vector3d::UnitY());
}

TEST_F(ObjImport, EveryMaterialIsAPartWithItsUpwardImageCoordinates) {
  write("a.mtl", "newmtl red brick\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n");
  const Model model = read("mtllib a.mtl\n" + kCorners +
                           "vt 0.25\nvt 0.5 1\nf 1 2 3\nusemtl red brick\nf 1/1 3/2 4/2\nusemtl blue\nf 2 3 4\n"
                           "usemtl red brick\nf 1 2 4\n");
  ASSERT_THAT(model.parts, SizeIs(3));
  const auto color_of = [&](size_t part) { return model.materials.at(model.parts[part].material).color; };
  EXPECT_EQ(color_of(0), Eigen::Vector3f::Constant(0.6f));
  EXPECT_EQ(color_of(1), Eigen::Vector3f(1, 0, 0));
  EXPECT_EQ(color_of(2), Eigen::Vector3f(0, 0, 1));
  EXPECT_THAT(model.parts[1].body.faces, SizeIs(2));
  EXPECT_EQ(model.parts[1].uvs.at(0), Eigen::Vector2f(0.25f, 1.0f));  // v grows downward
  EXPECT_EQ(model.parts[1].uvs.at(1), Eigen::Vector2f(0.5f, 0.0f));
}

TEST_F(ObjImport, PositionsMayHaveAColorOrAWeight) {
  const Model model = read("v 0 0 0 1 0 0\nv 1 0 0 0 1 0.5\nv 0 1 0 2\nf 1 2 3\n");
  EXPECT_THAT(model.parts.at(0).colors,
              ElementsAre(Eigen::Vector3f(1, 0, 0), Eigen::Vector3f(0, 1, 0.5f), Eigen::Vector3f::Constant(0.6f)));
  EXPECT_DOUBLE_EQ(area_of(model), 0.5);
  EXPECT_THAT(read(kCorners + "f 1 2 3\n").parts.at(0).colors, IsEmpty());
}

TEST_F(ObjImport, ReportsPointsAndLines) {
  for (const char* const line : {"l 1 2", "p 1", "f 1 2", "f 1"}) {
    EXPECT_THAT(read(kCorners + line + "\nf 1 2 3\n").unrendered, ElementsAre("points and lines")) << line;
    EXPECT_THAT([&] { imported({.file = write("a.obj", kCorners + line + "\n")}); },
                ThrowsMessage<E>(HasSubstr("it has no triangles")));
  }
  EXPECT_THAT(read(kCorners + "f\nvp 1\ns 1\ng\no\nf 1 2 3\n").unrendered, IsEmpty());
}

TEST_F(ObjImport, NumbersAreReadInEveryNotation) {
  const Model model = read("v +1.5e+1 -.5E-1 1e-400\nv 0 0 0\nv 0 1 0\nvn -1.#IND 0 1\nf 1//1 2//1 3//1\n");
  EXPECT_EQ(model.parts.at(0).body.corners.at(0), Vector3d(15.0, -0.05, 0.0));
  EXPECT_TRUE(std::isnan(model.parts[0].normals.at(0).x()));  // replaced when the model is placed
  EXPECT_NO_THROW(reading("v 1e400 0 0\nf 1 1 1\n")());
}

TEST_F(ObjImport, RefusesBadLinesWithTheirNumber) {
  EXPECT_THAT(reading("\nv 1 \\\n2\n"), ThrowsMessage<E>(HasSubstr("line 3: fewer than 3 numbers")));
  EXPECT_THAT(reading("v 1 2 x3\n"), ThrowsMessage<E>(HasSubstr("line 1: 'x3' is not a number")));
  EXPECT_THAT(reading("v 1 2 3,5\n"), ThrowsMessage<E>(HasSubstr("line 1: '3,5' is not a number")));
  for (const char* const corner : {"0", "-5", "x", "1/0", "1/2/3/4", "1x", "/1", "1/x", "99999999999"}) {
    EXPECT_THAT(reading(kCorners + "vt 0 0\nf 1 2 " + corner + "\n"),
                ThrowsMessage<E>(HasSubstr("line 6: '" + std::string(corner) + "' is not a corner of a face")));
  }
  EXPECT_THAT(reading(kCorners + "f 1 2 5\n"),
              ThrowsMessage<E>(HasSubstr("its faces refer to positions up to number 5, but it has 4 (v)")));
  EXPECT_THAT(reading(kCorners + "vn 0 0 1\nf 1//1 2//1 3//2\n"),
              ThrowsMessage<E>(HasSubstr("its faces refer to normals up to number 2, but it has 1 (vn)")));
  EXPECT_EQ(read(kCorners + "f 1//1 2//1 3//1\n").parts.at(0).normals.at(0), Vector3d::UnitZ());  // flat
}

TEST_F(ObjImport, ReadsManyCornersAtOnePosition) {
  std::string text = kCorners;
  constexpr int kCount = 20'000;
  for (int i = 0; i < kCount; ++i) text += "vn 0 " + std::to_string(i) + " 1\n";
  for (int i = 1; i <= kCount; ++i) text += "f 1//" + std::to_string(i) + " 2//1 3//1\n";
  const Part part = read(text).parts.at(0);
  EXPECT_THAT(part.body.faces, SizeIs(kCount));
  EXPECT_THAT(part.body.corners, SizeIs(kCount + 2));
}

}  // namespace
}  // namespace hedgehop::scenes::mesh
