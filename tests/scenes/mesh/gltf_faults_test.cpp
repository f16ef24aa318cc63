#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/scenes/mesh/gltf_text.h"
#include "tests/scenes/mesh/imported_files.h"

namespace hedgehop::scenes::mesh {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using E = std::invalid_argument;

class GltfFaults : public ImportedFiles {};

TEST_F(GltfFaults, RefusesDamagedFiles) {
  GltfText gltf;
  const std::string position = gltf.add(QuadData().corners, kFloat, 3);
  const std::string far = gltf.add(std::vector<uint16_t>{0, 1, 9}, kUShort, 1);
  const auto import_of = [&](const std::string& text) {
    return [this, file = write("bad.gltf", text)] { imported({.file = file}); };
  };
  EXPECT_THAT(import_of(gltf.text(kOneNode + ", " + mesh_of("\"POSITION\": " + position, far))),
              ThrowsMessage<E>(HasSubstr("bad.gltf': an index is out of range")));
  EXPECT_THAT(import_of(gltf.text(kOneNode)), ThrowsMessage<E>(HasSubstr("it has no meshes[0]")));
  EXPECT_THAT(import_of(gltf.text(R"("scenes": [{"nodes": [0]}], "nodes": [{"children": [0]}])")),
              ThrowsMessage<E>(HasSubstr("its nodes[0] has two parents")));
  EXPECT_THAT(import_of(R"({"asset": {"version": "2.0"}, "nodes": 7})"), ThrowsMessage<E>(HasSubstr("bad.gltf': ")));
  EXPECT_THAT(import_of(R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
      "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "buffers": [{"uri": "gone.bin", "byteLength": 36}],
      "bufferViews": [{"buffer": 0, "byteLength": 36}],
      "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}]})"),
              ThrowsMessage<E>(HasSubstr("its buffer 'gone.bin': there is no such file")));
}

TEST_F(GltfFaults, NamesTheElementWithAValueOfAWrongType) {
  const auto import_of = [&](const std::string& rest) {
    const std::string text = R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], )" + rest + "}";
    return [this, file = write("bad.gltf", text)] { imported({.file = file}); };
  };
  const auto fault_of = [](const char* element) {
    return ThrowsMessage<E>(HasSubstr(std::string("its ") + element + " lacks a value or has one of a wrong type"));
  };
  EXPECT_THAT(import_of(R"("nodes": [{"matrix": "unit"}])"), fault_of("nodes[0]"));
  EXPECT_THAT(import_of(R"("nodes": [7])"), fault_of("nodes[0]"));
  EXPECT_THAT(import_of(R"("nodes": [{"mesh": 0}], "meshes": [{}])"), fault_of("meshes[0]"));
  EXPECT_THAT(import_of(R"("nodes": [], "materials": [{}, {"name": 5}])"), fault_of("materials[1]"));
  const char* mesh = R"("nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], )";
  EXPECT_THAT(import_of(mesh + std::string(R"("accessors": [{"type": 3}])")), fault_of("accessors[0]"));
}

TEST_F(GltfFaults, RefusesALargePrimitiveBeforeItReadsIt) {
  // The second primitive has a fault, which is met only if the first one is read.
  const auto import_of = [&](const std::string& first) {
    const std::string text = R"({"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}], "accessors": [
        {"componentType": 5126, "count": 9000000, "type": "VEC3"}, {"componentType": 5125, "count": 3, "type": "SCALAR"},
        {"componentType": 5125, "count": 9000000, "type": "SCALAR"}],
        "meshes": [{"primitives": [)" +
                             first + R"(, {"attributes": {"POSITION": 9}}]}]})";
    return [this, file = write("large.gltf", text)] { imported({.file = file}); };
  };
  const auto triangles = ThrowsMessage<E>(HasSubstr("large.gltf': it has more than 2000000 triangles"));
  EXPECT_THAT(import_of(R"({"attributes": {"POSITION": 0}})"), triangles);
  EXPECT_THAT(import_of(R"({"attributes": {"POSITION": 0}, "indices": 2, "mode": 5})"), triangles);
  EXPECT_THAT(import_of(R"({"attributes": {"POSITION": 0, "NORMAL": 0}, "indices": 1})"),
              ThrowsMessage<E>(HasSubstr("large.gltf': it has more than 6000000 corners")));
  EXPECT_THAT(import_of(R"({"attributes": {"POSITION": 0}, "mode": 0})"),
              ThrowsMessage<E>(HasSubstr("it has no accessors[9]")));
}

TEST_F(GltfFaults, RefusesCornersThatAreNotFinite) {
  GltfText gltf;
  const std::string position = gltf.add(std::vector<float>(9, std::numeric_limits<float>::infinity()), kFloat, 3);
  const std::string indices = gltf.add(std::vector<uint16_t>{0, 1, 2}, kUShort, 1);
  const std::string file =
      write("far.gltf", gltf.text(kOneNode + ", " + mesh_of("\"POSITION\": " + position, indices)));
  EXPECT_THAT([&] { imported({.file = file}); }, ThrowsMessage<E>(HasSubstr("it has corners that are not finite")));
}

TEST_F(GltfFaults, TheVersionOfAnOldFileMayBeANumber) {
  const std::string old = write("old.gltf", R"({"asset": {"version": 1}, "scenes": {}, "nodes": {}})");
  EXPECT_THAT([&] { imported({.file = old}); }, ThrowsMessage<E>(testing::Not(HasSubstr("json.exception"))));
  const std::string binary = write("old.glb", std::string("glTF\1\0\0\0\x14\0\0\0\0\0\0\0\0\0\0\0", 20));
  EXPECT_THAT([&] { imported({.file = binary}); },
              ThrowsMessage<E>(HasSubstr("it is a binary glTF of version 1; valid: version 2")));
}

TEST_F(GltfFaults, RefusesABinaryFileThatIsShorterThanItAnnounces) {
  const auto number = [](uint32_t n) { return std::string(reinterpret_cast<const char*>(&n), sizeof n); };
  const auto fault = [&](uint32_t whole, uint32_t chunk) {
    const std::string file = "glTF" + number(2) + number(whole) + number(chunk) + "JSON";
    const ImportConfig config{.file = write("short.glb", file)};
    try {
      imported(config);
    } catch (const E& error) {
      return std::string(error.what());
    }
    return std::string("read");
  };
  for (const uint32_t huge : {0x7fffffffu, 0xffffffffu, 21u}) {
    EXPECT_THAT(fault(20, huge), HasSubstr("is shorter than its chunks")) << huge;
    EXPECT_THAT(fault(huge, 0), HasSubstr("is shorter than its chunks")) << huge;
  }
}

}  // namespace
}  // namespace hedgehop::scenes::mesh
