#include "tests/scenes/mesh/imported_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <opencv2/imgcodecs.hpp>

namespace hedgehop::scenes::mesh {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;
using testing::ThrowsMessage;
using E = std::invalid_argument;

using MeshImport = ImportedFiles;

// A quad 2 wide and 3 high, 1 in front of the model's origin (z = -1), y up, facing the origin.
const std::string kQuad = R"(mtllib quad.mtl
v -1 0 -1
v 1 0 -1
v 1 3 -1
v -1 3 -1
vt 0 0
vt 1 0
vt 1 1
vt 0 1
usemtl paint
f 1/1 2/2 3/3 4/4
)";

TEST_F(MeshImport, PlacesAQuadAtItsPositionAndHeading) {
  const std::string file = write("quad.obj", kQuad);
  write("quad.mtl", "newmtl paint\nKd 1 0 0\n");
  const Scene scene = imported({.file = file,
                                .name = "sheet",
                                .kind = SemanticClass::wall,
                                .north_m = 10.0,
                                .east_m = 20.0,
                                .altitude_m = 1.0,
                                .heading_rad = std::numbers::pi / 2,
                                .scale = 2.0});
  // Heading east: the model's front (-z) is east, its right (x) is south.
  const Mesh& mesh = scene.meshes.at(0);
  ASSERT_EQ(mesh.indices.size(), 12u);  // both sides of two triangles
  ASSERT_EQ(mesh.instances.size(), 1u);
  EXPECT_EQ(mesh.instances[0].name, "sheet");
  EXPECT_EQ(mesh.instances[0].kind, SemanticClass::wall);
  Eigen::AlignedBox3f box;
  for (const Vertex& vertex : mesh.vertices) {
    box.extend(vertex.p_W);
    EXPECT_NEAR(std::abs(vertex.n_W.y()), 1.0f, 1e-5f);  // z of the model is west
    const bool is_top = vertex.p_W.z() < -4.0f, is_right = vertex.p_W.x() < 10.0f;
    EXPECT_NEAR(vertex.uv.x(), is_right ? 1.0 : 0.0, 1e-6);
    EXPECT_NEAR(vertex.uv.y(), is_top ? 0.0 : 1.0, 1e-6);  // row 0 on top
  }
  EXPECT_LT((box.min() - Eigen::Vector3f(8, 22, -7)).norm(), 1e-5f);
  EXPECT_LT((box.max() - Eigen::Vector3f(12, 22, -1)).norm(), 1e-5f);
  EXPECT_EQ(scene.textures.images().at(1).at<cv::Vec3b>(5, 5), cv::Vec3b(255, 0, 0));
  ASSERT_EQ(scene.solids.size(), 1u);
  EXPECT_EQ(scene.solids[0].shape, Solid::Shape::surface);
  EXPECT_EQ(scene.solids[0].polyhedron.faces.size(), 2u);
}

TEST_F(MeshImport, ReportsItsSizeAndDoubtsTheScale) {
  const std::string file = write("flat.obj", "v 0 0 0\nv 4 0 0\nv 0 3 0\nf 1 2 3\n");
  imported({.file = file});
  EXPECT_EQ(size_line_, "'" + file + "': 0 x 4 x 3 m (north, east, up)");
  imported({.file = file, .scale = 1000.0});
  EXPECT_THAT(size_line_, ::testing::EndsWith("0 x 4000 x 3000 m (north, east, up), over 1 km; check its 'scale'"));
  imported({.file = file, .scale = 1e-3});
  EXPECT_THAT(size_line_, ::testing::EndsWith("0 x 0.004 x 0.003 m (north, east, up), below 1 cm; check its 'scale'"));
}

// Returns whether the normals of all triangles agree with their winding, and how many triangles face a point.
std::pair<bool, int> seen_from(const Mesh& mesh, const Eigen::Vector3f& eye_W) {
  bool agree = true;
  int seen = 0;
  for (size_t i = 0; i < mesh.indices.size(); i += 3) {
    const std::array corners{mesh.vertices[mesh.indices[i]], mesh.vertices[mesh.indices[i + 1]],
                             mesh.vertices[mesh.indices[i + 2]]};
    const Eigen::Vector3f across = (corners[1].p_W - corners[0].p_W).cross(corners[2].p_W - corners[0].p_W);
    for (const Vertex& corner : corners) agree = agree && across.dot(corner.n_W) > 0.0f;
    seen += across.dot(eye_W - corners[0].p_W) > 0.0f ? 1 : 0;
  }
  return {agree, seen};
}

TEST_F(MeshImport, FacesOutwardForEveryWinding) {
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";
  const std::string outward = "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  const std::string inward = "f 1 2 3 4\nf 8 7 6 5\nf 5 6 2 1\nf 6 7 3 2\nf 7 8 4 3\nf 8 5 1 4\n";
  for (const std::string& faces : {outward, inward}) {
    const Scene scene = imported({.file = write("cube.obj", corners + faces)});
    const Mesh& mesh = scene.meshes.at(0);
    EXPECT_EQ(mesh.indices.size(), 36u);
    EXPECT_EQ(seen_from(mesh, {9.0f, 0.5f, -0.5f}), std::pair(true, 2)) << faces;
    EXPECT_EQ(seen_from(mesh, {-0.5f, 0.5f, -0.5f}), std::pair(true, 0)) << faces;  // from inside
  }
  // Without its top the cube is open: both sides of ten triangles.
  const Scene open = imported({.file = write("open.obj", corners + outward.substr(0, outward.rfind("f ")))});
  EXPECT_EQ(open.meshes.at(0).indices.size(), 60u);
  EXPECT_TRUE(seen_from(open.meshes.at(0), {9.0f, 0.5f, -0.5f}).first);
}

TEST_F(MeshImport, WithoutCollisionHasNoSolidsAndMapsZUp) {
  const std::string file = write("quad.obj", kQuad);
  write("quad.mtl", "newmtl paint\nKd 1 0 0\n");
  const Scene scene = imported({.file = file, .up = ImportConfig::Up::z, .collide = ImportConfig::Collide::none});
  EXPECT_TRUE(scene.solids.empty());
  Eigen::AlignedBox3f box;
  for (const Vertex& vertex : scene.meshes.at(0).vertices) box.extend(vertex.p_W);
  EXPECT_LT((box.min() - Eigen::Vector3f(0, -1, 1)).norm(), 1e-5f);
  EXPECT_LT((box.max() - Eigen::Vector3f(3, 1, 1)).norm(), 1e-5f);
}

TEST_F(MeshImport, MapsItsImageUpright) {
  cv::Mat image(8, 8, CV_8UC3, cv::Scalar(0, 0, 200));  // red, as OpenCV writes it
  image.rowRange(0, 4) = cv::Scalar(200, 0, 0);         // its upper half is blue
  cv::imwrite((folder_ / "flag.png").string(), image);
  const std::string file = write("quad.obj", kQuad);
  write("quad.mtl", "newmtl paint\nmap_Kd flag.png\n");
  const Scene scene = imported({.file = file});
  ASSERT_EQ(scene.textures.images().at(1).size(), cv::Size(64, 64));
  EXPECT_EQ(scene.textures.images().at(1).at<cv::Vec3b>(10, 30), cv::Vec3b(0, 0, 200));
  EXPECT_EQ(scene.textures.images().at(1).at<cv::Vec3b>(50, 30), cv::Vec3b(200, 0, 0));
}

TEST_F(MeshImport, ReadsGltf) {
  // One triangle (0,0,0), (1,0,0), (0,1,0): three float triples, little endian, in base 64.
  const std::string file = write("triangle.gltf", R"({"asset": {"version": "2.0"}, "scene": 0,
 "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "translation": [0, 0, -4]}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}],
 "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
  const Scene scene = imported({.file = file});
  Eigen::AlignedBox3f box;
  for (const Vertex& vertex : scene.meshes.at(0).vertices) box.extend(vertex.p_W);
  EXPECT_LT((box.min() - Eigen::Vector3f(-4, -1, -1)).norm(), 1e-5f);
  EXPECT_LT((box.max() - Eigen::Vector3f(-4, 0, 0)).norm(), 1e-5f);
}

TEST_F(MeshImport, ReportsTheReasonForUnreadableFiles) {
  const auto refused = [this](const std::string& file) { return [this, file] { imported({.file = file}); }; };
  EXPECT_THAT(refused((folder_ / "none.obj").string()),
              ThrowsMessage<E>(HasSubstr("none.obj': there is no such file")));
  EXPECT_THAT(refused(write("broken.gltf", "{\"asset\": ")), ThrowsMessage<E>(HasSubstr("broken.gltf': ")));
  EXPECT_THAT(refused(write("notes.txt", "no mesh")), ThrowsMessage<E>(HasSubstr("notes.txt': ")));
  EXPECT_THAT(refused(write("empty.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n")), ThrowsMessage<E>(HasSubstr("empty.obj': ")));
  write("quad.mtl", "newmtl paint\nmap_Kd gone.png\n");
  EXPECT_THAT(refused(write("quad.obj", kQuad)),
              ThrowsMessage<E>(HasSubstr("its image 'gone.png': there is no such file")));
}

}  // namespace
}  // namespace hedgehop::scenes::mesh
