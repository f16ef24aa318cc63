#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <opencv2/imgcodecs.hpp>

#include "tests/scenes/mesh/gltf_text.h"
#include "tests/scenes/mesh/imported_files.h"

namespace hedgehop::scenes::mesh {
namespace {

using Eigen::Vector3d;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;
using E = std::invalid_argument;

constexpr double kFloatM = 1e-5;  // rounding of coordinates of some m
const Vector3d kNorth = Vector3d::UnitX();

class GltfImport : public ImportedFiles {
 protected:
  // Writes a quad with one material. The heading turns its front, +z, to the south. @param rest  more keys of the file.
  ImportConfig quad(const std::string& material, const std::vector<float>& uvs, const std::string& rest = "") const {
    GltfText gltf;
    const QuadData data;
    const std::string position = gltf.add(data.corners, kFloat, 3), uv = gltf.add(uvs, kFloat, 2),
                      indices = gltf.add(data.indices, kUShort, 1);
    const std::string text =
        gltf.text(kOneNode + ", " + mesh_of("\"POSITION\": " + position + ", \"TEXCOORD_0\": " + uv, indices) +
                  R"(, "materials": [{)" + material + R"(}], "textures": [{"source": 0, "sampler": 0}],
          "images": [{"uri": "image.png"}], "samplers": [{)" +
                  rest + "}]");
    return {.file = write("quad.gltf", text), .heading_rad = std::numbers::pi};
  }

  // Writes an image whose left half is red and whose right half is blue. @param alpha  of the right half.
  void write_image(int alpha = 255) const {
    cv::Mat image(64, 64, CV_8UC4, cv::Scalar(0, 0, 200, 255));
    image.colRange(32, 64) = cv::Scalar(200, 0, 0, alpha);
    cv::imwrite((folder_ / "image.png").string(), image);
  }

  // Returns the hit of a ray to the north that begins 10 m south of the origin. With the front of a quad to the south,
  // model x is east.
  static RayHit seen_at(const Scene& scene, double east_m) { return cast(scene, {-10.0, east_m, -0.01}, kNorth); }
};

const std::string kImage = R"("pbrMetallicRoughness": {"baseColorTexture": {"index": 0}})";

TEST_F(GltfImport, ACubeOfAMirroredNodeIsSeenFromOutside) {
  GltfText gltf;
  const CubeData cube;
  const std::string position = gltf.add(cube.corners, kFloat, 3), indices = gltf.add(cube.indices, kUShort, 1);
  const Scene scene = imported(
      {.file = write(
           "cubes.gltf",
           gltf.text(
               R"("scenes": [{"nodes": [0]}], "nodes": [{"children": [1, 2]}, {"mesh": 0, "translation": [-3, 0, 0]},
         {"mesh": 0, "translation": [3, 0, 0], "scale": [-1, 1, 1]}], )" +
               mesh_of("\"POSITION\": " + position, indices)))});
  // The near faces are at north -1, 9 m from the eye; the far ones, at 11 m, face away.
  EXPECT_NEAR(seen_at(scene, -3.0).distance_m, 9.0, kFloatM);
  EXPECT_NEAR(seen_at(scene, 3.0).distance_m, 9.0, kFloatM);
  EXPECT_THAT(lines_, IsEmpty());
}

TEST_F(GltfImport, TheFrontIsPlusZ) {
  GltfText gltf;
  const QuadData data;
  const std::string position = gltf.add(data.corners, kFloat, 3), indices = gltf.add(data.indices, kUShort, 1);
  const Scene scene = imported(
      {.file = write("quad.gltf",
                     gltf.text(R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "translation": [2, 3, 4]}], )" +
                               mesh_of("\"POSITION\": " + position, indices)))});
  Eigen::AlignedBox3f box;
  for (const Vertex& vertex : scene.meshes.at(0).vertices) box.extend(vertex.p_W);
  // +z is north, and so +x is west.
  EXPECT_LT((box.min() - Eigen::Vector3f(4, -3, -4)).norm(), kFloatM);
  EXPECT_LT((box.max() - Eigen::Vector3f(4, -1, -2)).norm(), kFloatM);
}

TEST_F(GltfImport, ASingleSidedSurfaceIsVisibleFromItsFrontOnly) {
  const std::vector<float> uvs = QuadData().uvs;
  const Scene single = imported(quad("", uvs));
  EXPECT_NEAR(seen_at(single, 0.3).distance_m, 10.0, kFloatM);
  EXPECT_EQ(cast(single, {10.0, 0.3, -0.01}, -kNorth).distance_m, std::numeric_limits<double>::infinity());
  EXPECT_EQ(single.solids.at(0).polyhedron.faces.size(), 2u);  // an obstacle from both sides
  const Scene both = imported(quad("\"doubleSided\": true", uvs));
  EXPECT_NEAR(cast(both, {10.0, 0.3, -0.01}, -kNorth).distance_m, 10.0, kFloatM);
}

TEST_F(GltfImport, ReadsNormalizedAndQuantizedIntegers) {
  GltfText gltf;
  const std::string position =
      gltf.add(std::vector<int16_t>{-1000, -1000, 0, 1000, -1000, 0, 1000, 1000, 0}, kShort, 3);
  const std::string normal =
      gltf.add(std::vector<int8_t>{0, 0, 127, 0, 0, 127, 0, 0, 127}, kByte, 3, R"(, "normalized": true)");
  const std::string uv =
      gltf.add(std::vector<uint16_t>{0, 65535, 65535, 65535, 65535, 0}, kUShort, 2, R"(, "normalized": true)");
  const std::string indices = gltf.add(std::vector<uint8_t>{0, 1, 2}, kUByte, 1);
  write_image();
  const Scene scene = imported(
      {.file = write(
           "short.gltf",
           gltf.text(
               R"("extensionsUsed": ["KHR_mesh_quantization"], "extensionsRequired": ["KHR_mesh_quantization"],
         "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "scale": [0.002, 0.002, 0.002]}], )" +
               mesh_of("\"POSITION\": " + position + ", \"NORMAL\": " + normal + ", \"TEXCOORD_0\": " + uv, indices) +
               R"(, "materials": [{)" + kImage +
               R"(}], "textures": [{"source": 0}], "images": [{"uri": "image.png"}])"))});
  const Mesh& mesh = scene.meshes.at(0);
  ASSERT_EQ(mesh.vertices.size(), 3u);
  EXPECT_LT((mesh.vertices[2].p_W - Eigen::Vector3f(0, -2, -2)).norm(), kFloatM);
  EXPECT_LT((mesh.vertices[2].n_W - Eigen::Vector3f(1, 0, 0)).norm(), kFloatM);
  EXPECT_LT((mesh.vertices[2].uv - Eigen::Vector2f(1, 0)).norm(), kFloatM);
}

TEST_F(GltfImport, RefusesRequiredExtensionsThatItDoesNotHave) {
  const auto import_of = [&](const std::string& list) {
    const std::string text = R"({"asset": {"version": "2.0"}, "extensionsRequired": [)" + list + "]}";
    return [this, file = write("needs.gltf", text)] { imported({.file = file}); };
  };
  EXPECT_THAT(import_of("\"KHR_mesh_quantization\", \"EXT_meshopt_compression\""),
              ThrowsMessage<E>(HasSubstr("it requires the extension 'EXT_meshopt_compression'; valid: ")));
  EXPECT_THAT(import_of("\"KHR_mesh_quantization\""), ThrowsMessage<E>(HasSubstr("it has no triangles")));
}

TEST_F(GltfImport, MultipliesTheImageByTheBaseColorInLinearLight) {
  cv::imwrite((folder_ / "image.png").string(), cv::Mat(8, 8, CV_8UC3, cv::Scalar(255, 255, 255)));
  const Scene scene = imported(
      quad(R"("pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "baseColorFactor": [0.9, 0.1, 0.5, 1]})",
           QuadData().uvs));
  // sRGB of the linear values: 1.055 x^(1 / 2.4) - 0.055 is 0.9547, 0.3492 and 0.7354.
  EXPECT_EQ(seen_at(scene, 0.3).color, cv::Vec3b(243, 89, 188));
  const Scene plain =
      imported(quad(R"("pbrMetallicRoughness": {"baseColorFactor": [0.9, 0.1, 0.5, 1]})", QuadData().uvs));
  EXPECT_EQ(seen_at(plain, 0.3).color, cv::Vec3b(243, 89, 188));
}

TEST_F(GltfImport, RendersVertexColors) {
  GltfText gltf;
  const QuadData data;
  const std::string position = gltf.add(data.corners, kFloat, 3), indices = gltf.add(data.indices, kUShort, 1),
                    color = gltf.add(std::vector<float>{1, 0, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0}, kFloat, 3);
  const Scene scene =
      imported({.file = write("colors.gltf",
                              gltf.text(kOneNode + ", " +
                                        mesh_of("\"POSITION\": " + position + ", \"COLOR_0\": " + color, indices))),
                .heading_rad = std::numbers::pi});
  EXPECT_EQ(seen_at(scene, -0.98).color, cv::Vec3b(255, 0, 0));
  EXPECT_EQ(seen_at(scene, 0.98).color, cv::Vec3b(0, 0, 255));
  EXPECT_THAT(lines_, IsEmpty());
}

TEST_F(GltfImport, TransformsImageCoordinates) {
  write_image();
  const Scene scene = imported(quad(R"("pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "extensions":
    {"KHR_texture_transform": {"scale": [4, 2], "offset": [0.25, 0], "rotation": 1.5707963267948966}}}})",
                                    QuadData().uvs));
  // The rotation takes (u, v) to (v, -u), as the matrix of the extension's text.
  const Mesh& mesh = scene.meshes.at(0);
  EXPECT_LT((mesh.vertices[0].uv - Eigen::Vector2f(2.25f, 0.0f)).norm(), kFloatM);   // of (0, 1)
  EXPECT_LT((mesh.vertices[2].uv - Eigen::Vector2f(0.25f, -4.0f)).norm(), kFloatM);  // of (1, 0)
}

TEST_F(GltfImport, UsesTheSecondImageCoordinates) {
  write_image();
  GltfText gltf;
  const QuadData data;
  const std::string position = gltf.add(data.corners, kFloat, 3), indices = gltf.add(data.indices, kUShort, 1),
                    first = gltf.add(std::vector<float>(8, 0.1f), kFloat, 2), second = gltf.add(data.uvs, kFloat, 2);
  const Scene scene = imported(
      {.file = write(
           "second.gltf",
           gltf.text(kOneNode + ", " +
                     mesh_of("\"POSITION\": " + position + ", \"TEXCOORD_0\": " + first + ", \"TEXCOORD_1\": " + second,
                             indices) +
                     R"(, "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "texCoord": 1}}}],
         "textures": [{"source": 0}], "images": [{"uri": "image.png"}])")),
       .heading_rad = std::numbers::pi});
  EXPECT_EQ(seen_at(scene, -0.5).color, kRed);
  EXPECT_EQ(seen_at(scene, 0.5).color, kBlue);
}

TEST_F(GltfImport, ClampsAndMirrorsImages) {
  write_image();
  const std::vector<float> thrice{-1, 1, 2, 1, 2, 0, -1, 0};  // u from -1 to 2
  const double kOneImageM = 2.0 / 3.0;
  const auto colors = [&](const std::string& sampler) {
    const Scene scene = imported(quad(kImage, thrice, sampler));
    std::vector<cv::Vec3b> seen;
    for (const double u : {-0.75, -0.25, 0.25, 0.75, 1.25, 1.75}) {
      seen.push_back(seen_at(scene, -1.0 + (u + 1.0) * kOneImageM).color);
    }
    return seen;
  };
  EXPECT_THAT(colors(""), ElementsAre(kRed, kBlue, kRed, kBlue, kRed, kBlue));
  EXPECT_THAT(colors("\"wrapS\": 33071"), ElementsAre(kRed, kRed, kRed, kBlue, kBlue, kBlue));
  EXPECT_THAT(colors("\"wrapS\": 33648"), ElementsAre(kBlue, kRed, kRed, kBlue, kBlue, kRed));
}

TEST_F(GltfImport, CutsOutTheHolesOfAnAlphaMask) {
  write_image(100);
  const Scene opaque = imported(quad(kImage, QuadData().uvs));
  EXPECT_EQ(seen_at(opaque, 0.5).color, kBlue);
  const Scene scene = imported(quad("\"alphaMode\": \"MASK\", " + kImage, QuadData().uvs));
  EXPECT_NEAR(seen_at(scene, -0.02).distance_m, 10.0, kFloatM);
  EXPECT_EQ(seen_at(scene, 0.02).distance_m, std::numeric_limits<double>::infinity());
  double area_m2 = 0.0;  // of the obstacle
  const Polyhedron& body = scene.solids.at(0).polyhedron;
  for (const auto& [a, b, c] : body.faces) {
    area_m2 += 0.5 * (body.corners[b] - body.corners[a]).cross(body.corners[c] - body.corners[a]).norm();
  }
  EXPECT_NEAR(area_m2, 2.0, kFloatM);
  // Alpha 100 / 255 is 0.39.
  const Scene low = imported(quad(R"("alphaMode": "MASK", "alphaCutoff": 0.3, )" + kImage, QuadData().uvs));
  EXPECT_EQ(seen_at(low, 0.5).color, kBlue);
}

TEST_F(GltfImport, ReportsUnrenderedFeaturesInOneLine) {
  write_image(100);
  imported(quad(R"("name": "glass", "alphaMode": "BLEND", "emissiveFactor": [1, 0, 0], )" + kImage, QuadData().uvs));
  ASSERT_EQ(lines_.size(), 1u);
  EXPECT_THAT(lines_[0],
              HasSubstr("quad.gltf': not rendered: emission, transparency of material 'glass' (alphaMode BLEND)"));
}

TEST_F(GltfImport, ReadsTenThousandNodes) {
  GltfText gltf;
  const QuadData data;
  const std::string position = gltf.add(data.corners, kFloat, 3), indices = gltf.add(data.indices, kUShort, 1);
  std::string nodes, roots;
  constexpr int kNodes = 10'000;
  for (int i = 0; i < kNodes; ++i) {
    const std::string comma = i == 0 ? "" : ", ";
    nodes += comma + R"({"mesh": 0, "translation": [)" + std::to_string(3 * (i % 100)) + ", 0, " +
             std::to_string(i / 100) + "]}";
    roots += comma + std::to_string(i);
  }
  const Scene scene =
      imported({.file = write("city.gltf", gltf.text(R"("scenes": [{"nodes": [)" + roots + R"(]}], "nodes": [)" +
                                                     nodes + "], " + mesh_of("\"POSITION\": " + position, indices)))});
  EXPECT_EQ(scene.meshes.at(0).indices.size(), size_t{6} * kNodes);
}

// Returns a sheet of 2 x side x side triangles as a binary glTF.
std::string sheet(uint32_t side) {
  const auto bytes_of = [](const auto& value) { return std::string(reinterpret_cast<const char*>(&value), 4); };
  std::string data;
  for (uint32_t i = 0; i <= side; ++i) {
    for (uint32_t j = 0; j <= side; ++j) {
      for (const uint32_t value : {i, 0u, j}) data += bytes_of(0.5f * static_cast<float>(value));
    }
  }
  const size_t positions = data.size();
  for (uint32_t i = 0; i < side; ++i) {
    for (uint32_t j = 0; j < side; ++j) {
      const uint32_t a = i * (side + 1) + j, b = a + 1, c = a + side + 1, d = c + 1;
      for (const uint32_t index : {a, b, c, b, d, c}) data += bytes_of(index);
    }
  }
  const auto text = [](size_t n) { return std::to_string(n); };
  std::string json =
      R"({"asset": {"version": "2.0"}, )" + kOneNode +
      R"(, "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
      "buffers": [{"byteLength": )" +
      text(data.size()) + R"(}], "bufferViews": [{"buffer": 0, "byteLength": )" + text(positions) +
      R"(}, {"buffer": 0, "byteOffset": )" + text(positions) + R"(, "byteLength": )" + text(data.size() - positions) +
      R"(}], "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": )" +
      text((side + 1) * (side + 1)) + R"(}, {"bufferView": 1, "componentType": 5125, "type": "SCALAR", "count": )" +
      text(size_t{6} * side * side) + "}]}";
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const auto number = [&](size_t n) { return bytes_of(static_cast<uint32_t>(n)); };
  return "glTF" + number(2) + number(28 + json.size() + data.size()) + number(json.size()) + "JSON" + json +
         number(data.size()) + std::string("BIN\0", 4) + data;
}

TEST_F(GltfImport, ReadsAMillionTriangles) {
  const Scene scene = imported({.file = write("sheet.glb", sheet(708))});
  ASSERT_EQ(scene.solids.size(), 1u);
  EXPECT_EQ(scene.solids[0].polyhedron.faces.size(), 1'002'528u);
}

}  // namespace
}  // namespace hedgehop::scenes::mesh
