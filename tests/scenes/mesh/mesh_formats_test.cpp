#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>

#include "scenes/mesh/orientation.h"
#include "tests/scenes/mesh/gltf_text.h"
#include "tests/scenes/mesh/imported_files.h"

namespace hedgehop::scenes::mesh {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;
using testing::ThrowsMessage;
using E = std::invalid_argument;

using MeshFormats = ImportedFiles;

Eigen::AlignedBox3f bounds(const Scene& scene) {
  Eigen::AlignedBox3f box;
  for (const Vertex& vertex : scene.meshes.at(0).vertices) box.extend(vertex.p_W);
  return box;
}

// A cube from -1 to 1 around a center. @param inward  the orientation of its faces. @param first  its first corner.
std::string cube(const Vector3d& center, double half, bool inward, int first) {
  std::string text;
  for (int k = 0; k < 8; ++k) {
    text += "v";
    for (const int axis : {0, 1, 2}) text += " " + std::to_string(center[axis] + ((k >> axis & 1) != 0 ? half : -half));
    text += "\n";
  }
  for (std::array<int, 4> face :
       {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    if (inward) std::swap(face[1], face[3]);
    text += "f";
    for (const int corner : face) text += " " + std::to_string(corner + first);
    text += "\n";
  }
  return text;
}

TEST_F(MeshFormats, TheOrientationIsThatOfEachConnectedBody) {
  const std::string file = write("cubes.obj", cube({-3, 0, 0}, 1, false, 1) + cube({3, 0, 0}, 1, true, 9));
  const Scene scene = imported({.file = file});
  for (const double east_m : {-3.0, 3.0}) {
    EXPECT_NEAR(cast(scene, {-10.0, east_m + 0.1, 0.2}, Vector3d::UnitX()).distance_m, 9.0, 1e-5) << east_m;
  }
  EXPECT_EQ(scene.meshes.at(0).indices.size(), 2u * 36u);
}

TEST_F(MeshFormats, TheWallOfACavityStaysVisibleFromInside) {
  const std::string file = write("room.obj", cube({0, 0, 0}, 3, false, 1) + cube({0, 0, 0}, 2, true, 9));
  const Scene scene = imported({.file = file});
  EXPECT_NEAR(cast(scene, {0.0, 0.1, 0.2}, Vector3d::UnitX()).distance_m, 2.0, 1e-5);
  EXPECT_NEAR(cast(scene, {-10.0, 0.1, 0.2}, Vector3d::UnitX()).distance_m, 7.0, 1e-5);
}

// Compares the search in a tree with a comparison of all pairs. It does not protect the speed.
TEST(FacingOfFaces, AnInwardCubeIsACavityIfAnOutwardCubeContainsIt) {
  constexpr int kCubes = 400;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> place(-10.0, 10.0), size(0.05, 5.0);
  const CubeData cube;
  for (const Vector3d& spread : {Vector3d(1, 0.2, 0.1), Vector3d(0.1, 1, 0.2), Vector3d(0, 0, 1)}) {
    Polyhedron mesh;
    std::vector<Eigen::AlignedBox3d> boxes;
    std::vector<bool> inward;
    for (int k = 0; k < kCubes; ++k) {
      const Vector3d center = spread.cwiseProduct(Vector3d(place(random), place(random), place(random)));
      const double half = size(random) * size(random) / 10.0;
      boxes.emplace_back(center - Vector3d::Constant(half), center + Vector3d::Constant(half));
      inward.push_back(random() % 2 == 0);
      const auto first = static_cast<uint32_t>(mesh.corners.size());
      for (size_t i = 0; i < cube.corners.size(); i += 3)
        mesh.corners.emplace_back(center + half * Vector3d(cube.corners[i], cube.corners[i + 1], cube.corners[i + 2]));
      for (size_t i = 0; i < cube.indices.size(); i += 3) {
        mesh.faces.push_back({first + cube.indices[i], first + cube.indices[i + 1], first + cube.indices[i + 2]});
        if (inward.back()) std::swap(mesh.faces.back()[1], mesh.faces.back()[2]);
      }
    }
    const std::vector<Facing> facing = facing_of_faces(mesh);
    int cavities = 0;
    for (size_t k = 0; k < boxes.size(); ++k) {
      bool is_cavity = false;
      for (size_t i = 0; i < boxes.size(); ++i) is_cavity |= inward[k] && !inward[i] && boxes[i].contains(boxes[k]);
      cavities += is_cavity ? 1 : 0;
      EXPECT_EQ(facing[12 * k], inward[k] && !is_cavity ? Facing::inward : Facing::outward) << k;
    }
    EXPECT_GT(cavities, 20);
    EXPECT_LT(cavities, std::ranges::count(inward, true));
  }
}

TEST_F(MeshFormats, SubtractsTheOriginOfGeoreferencedCoordinatesInDoublePrecision) {
  const Vector3d p(448262.25, 5262012.75, 512.4);
  const ImportConfig config{.file = write("utm.obj", cube(p, 1.5, false, 1)),
                            .north_m = 9.0,
                            .origin_ENU = Vector3d(448260.0, 5262010.0, 510.0),
                            .up = ImportConfig::Up::z};
  const Eigen::AlignedBox3f box = bounds(imported(config));
  // North 9 + 2.75, east 2.25, up 2.4, each +- 1.5. A float of 5,262,012 has steps of 0.5 m.
  constexpr float kRounding = 1e-5f;
  EXPECT_LT((box.min() - Eigen::Vector3f(10.25f, 0.75f, -3.9f)).norm(), kRounding);
  EXPECT_LT((box.max() - Eigen::Vector3f(13.25f, 3.75f, -0.9f)).norm(), kRounding);
  EXPECT_THAT([&] { imported({.file = config.file, .up = ImportConfig::Up::z}); },
              ThrowsMessage<E>(HasSubstr("it has corners farther than 100 km from the origin; 'origin' can be")));
}

TEST_F(MeshFormats, ReadsStl) {
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 1\nvertex 2 0 1\nvertex 0 3 1\nendloop\nendfacet\n";
  const std::string file = write("a.stl", "solid a\n" + facet + "endsolid a\n");
  const Eigen::AlignedBox3f box = bounds(imported({.file = file, .up = ImportConfig::Up::z}));
  EXPECT_LT((box.min() - Eigen::Vector3f(0, 0, -1)).norm(), 1e-6f);
  EXPECT_LT((box.max() - Eigen::Vector3f(3, 2, -1)).norm(), 1e-6f);
  EXPECT_THAT([&] { imported({.file = write("empty.stl", "solid a\nendsolid a\n")}); },
              ThrowsMessage<E>(HasSubstr("empty.stl': it has no triangles")));
}

TEST_F(MeshFormats, ReadsPlyWithItsColors) {
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const std::string data = "-1 -1 0 255 0 0\n1 -1 0 255 0 0\n0 2 0 0 0 255\n3 0 1 2\n";
  const Scene scene = imported({.file = write("a.ply", header + data)});
  EXPECT_EQ(cast(scene, {-10.0, 0.0, 0.98}, Vector3d::UnitX()).color, cv::Vec3b(255, 0, 0));
  EXPECT_EQ(cast(scene, {-10.0, 0.0, -1.95}, Vector3d::UnitX()).color, cv::Vec3b(0, 0, 255));
  const std::string empty_face = header + data.substr(0, data.rfind("3 0 1 2")) + "0\n";
  EXPECT_THAT([&] { imported({.file = write("empty.ply", empty_face)}); }, ThrowsMessage<E>(HasSubstr("empty.ply': ")));
  const std::string vast = header.substr(0, header.find("vertex 3")) + "vertex 4000000000" +
                           header.substr(header.find("vertex 3") + 8) + data;
  EXPECT_THAT([&] { imported({.file = write("vast.ply", vast)}); },
              ThrowsMessage<E>(HasSubstr("it has fewer bytes than elements")));
}

/// The importer would reserve 8 bytes per announced value.
TEST_F(MeshFormats, RefusesPlyWithListsLongerThanTheFile) {
  using namespace std::string_literals;
  const auto header = [](const std::string& format, const std::string& count) {
    return "ply\r\nformat " + format +
           " 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n" +
           "element face 2\nproperty uchar flags\nproperty list " + count + " uint8 vertex_indices\nend_header\n";
  };
  const auto with_text = [&](const std::string& counts) {
    return header("ascii", "uchar") + "\n-1 -1 90000\n1 -1 0\n0 2 0\n7 3 0 1 2\n7 " + counts + "\n";
  };
  const auto with_bytes = [&](const std::string& format, const std::string& counts) {
    const bool is_little = format == "binary_little_endian";
    const std::string zero(4, '\0'), one = is_little ? "\0\0\x80\x3f"s : "\x3f\x80\0\0"s;
    const std::string corners = zero + zero + zero + one + zero + zero + zero + one + zero;
    const std::string face = is_little ? "\7\3\0\0\0\0\1\2"s : "\7\0\0\0\3\0\1\2"s;
    return header(format, "int") + corners + face + "\7" + counts;
  };
  const std::string little = "binary_little_endian", big = "binary_big_endian";
  EXPECT_NO_THROW(imported({.file = write("text.ply", with_text("3 2 1 0"))}));
  EXPECT_NO_THROW(imported({.file = write("little.ply", with_bytes(little, "\3\0\0\0\2\1\0"s))}));
  EXPECT_NO_THROW(imported({.file = write("big.ply", with_bytes(big, "\0\0\0\3\2\1\0"s))}));
  for (const std::string& text :
       {with_text("400000000 2 1 0"), with_text("-3 2 1 0"), with_bytes(little, "\3\0\0\x10\2\1\0"s),
        with_bytes(little, "\xff\xff\xff\xff\2\1\0"s), with_bytes(big, "\x10\0\0\3\2\1\0"s)}) {
    EXPECT_THAT([&] { imported({.file = write("long.ply", text)}); },
                ThrowsMessage<E>(HasSubstr("element 'face' has a list of more values than the file has bytes")));
  }
  for (const auto& [element, fault] : {std::pair{"vertex", "it has the element 'vertex' twice"},
                                       {"face", "it has the element 'face' twice"},
                                       {"tristrips", "it has triangle strips; valid: faces"}}) {
    std::string text = header("ascii", "uchar");
    text.insert(text.find("end_header"), "element "s + element + " 2\nproperty list int int vertex_indices\n");
    EXPECT_THAT([&] { imported({.file = write("twice.ply", text)}); }, ThrowsMessage<E>(HasSubstr(fault)));
  }
  for (const char* count : {"uchar8", "float", "list", "\3uchar"}) {
    EXPECT_THAT([&] { imported({.file = write("type.ply", header("ascii", count))}); },
                ThrowsMessage<E>(HasSubstr("its header is not that of a PLY")));
  }
}

// A triangle from (0, 0, 100) to (200, 0, 100) and (0, 300, 100), z up, in cm.
const std::string kCollada = R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="0.01" name="centimeter"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g" name="g"><mesh>
<source id="p"><float_array id="pa" count="9">0 0 100 200 0 100 0 300 100</float_array><technique_common>
<accessor source="#pa" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s" name="s"><node id="n" name="n"><instance_geometry url="#g"/></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>
)";

TEST_F(MeshFormats, ReadsColladaWithItsUnitAndAxis) {
  const Eigen::AlignedBox3f box = bounds(imported({.file = write("a.dae", kCollada)}));
  // 2 m east, 3 m north, 1 m up.
  EXPECT_LT((box.min() - Eigen::Vector3f(0, 0, -1)).norm(), 1e-5f);
  EXPECT_LT((box.max() - Eigen::Vector3f(3, 2, -1)).norm(), 1e-5f);
  EXPECT_THAT([&] { imported({.file = write("a.dae", kCollada), .up = ImportConfig::Up::z}); },
              ThrowsMessage<E>(HasSubstr("a.dae': a DAE file states its own up axis")));
  std::string deep = kCollada;
  for (int i = 0; i < 1000; ++i) deep += "<node>";
  EXPECT_THAT([&] { imported({.file = write("deep.dae", deep)}); },
              ThrowsMessage<E>(HasSubstr("its XML is nested deeper than 200")));
  EXPECT_THAT([&] { imported({.file = write("empty.dae", "<?xml version=\"1.0\"?><COLLADA/>")}); },
              ThrowsMessage<E>(HasSubstr("empty.dae': it has no triangles")));
}

// The importer itself would read past the array, or through a null pointer.
TEST_F(MeshFormats, RefusesColladaWhoseArraysAreTooShort) {
  const auto refuses = [&](const std::string& text, const std::string& by) {
    std::string changed = kCollada;
    changed.replace(changed.find(text), text.size(), by);
    EXPECT_THAT([&] { imported({.file = write("short.dae", changed)}); },
                ThrowsMessage<E>(HasSubstr("short.dae': an <accessor> reads more numbers than")))
        << by;
  };
  refuses(R"(count="9")", "");
  refuses(R"(count="9">0 0 100)", R"(count="6">)");
  refuses(R"(count="3" stride="3")", R"(count="4" stride="3")");
  refuses(R"(count="3" stride="3")", R"(count="3" stride="4")");
  refuses(R"(count="3" stride="3")", R"(count="3" stride="3" offset="1")");
  std::string names = kCollada;
  for (size_t at = 0; (at = names.find("float_array", at)) != std::string::npos;) names.replace(at, 11, "Name_array");
  EXPECT_THAT([&] { imported({.file = write("names.dae", names)}); },
              ThrowsMessage<E>(HasSubstr("names.dae': an <accessor> reads more numbers than")));
}

}  // namespace
}  // namespace hedgehop::scenes::mesh
