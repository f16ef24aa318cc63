#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "scenes/mesh/image_file.h"
#include "tests/scenes/mesh/imported_files.h"

namespace hedgehop::scenes::mesh {
namespace {

using Eigen::Vector3d;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;
using E = std::invalid_argument;

// A quad 2 wide and 2 high at the origin, x right and y up. @param library  its first line.
std::string quad(const std::string& library = "mtllib quad.mtl") {
  return library + R"(
v -1 -1 0
v 1 -1 0
v 1 1 0
v -1 1 0
vt 0 0
vt 1 0
vt 1 1
vt 0 1
usemtl paint
f 1/1 2/2 3/3 4/4
)";
}

class ObjMaterial : public ImportedFiles {
 protected:
  // Writes an image whose left half is red and whose right half is blue.
  void write_image(const std::string& name) const {
    cv::Mat image(64, 64, CV_8UC3, cv::Scalar(0, 0, 200));
    image.colRange(32, 64) = cv::Scalar(200, 0, 0);
    std::filesystem::create_directories((folder_ / name).parent_path());
    cv::imwrite((folder_ / name).string(), image);
  }
  Scene with(const std::string& statement) {
    write("quad.mtl", "newmtl paint\n" + statement + "\n");
    return imported({.file = write("quad.obj", quad())});
  }
  // Returns the color at a place of the quad, seen from the south.
  static cv::Vec3b color_at(const Scene& scene, double east_m) {
    return cast(scene, {-10.0, east_m, -0.01}, Vector3d::UnitX()).color;
  }
};

TEST_F(ObjMaterial, AMissingFileOrMaterialIsAnError) {
  EXPECT_THAT([&] { imported({.file = write("quad.obj", quad())}); },
              ThrowsMessage<E>(HasSubstr("quad.obj': its material file 'quad.mtl': there is no such file")));
  write("quad.mtl", "newmtl other\nKd 1 0 0\n");
  EXPECT_THAT([&] { imported({.file = write("quad.obj", quad())}); },
              ThrowsMessage<E>(HasSubstr("its material 'paint' is in no material file; it names 'quad.mtl'")));
  EXPECT_THAT([&] { imported({.file = write("quad.obj", quad(""))}); },
              ThrowsMessage<E>(HasSubstr("its material 'paint' is in no material file; it names none (mtllib)")));
}

TEST_F(ObjMaterial, TextsMayBeginWithTheMarkOfUtf8) {
  const std::string mark = "\xef\xbb\xbf";
  write("quad.mtl", mark + "newmtl paint\nKd 1 0 0\n");
  const Scene scene = imported({.file = write("quad.obj", mark + quad())});
  EXPECT_EQ(color_at(scene, 0.5), cv::Vec3b(255, 0, 0));
}

TEST_F(ObjMaterial, CoordinatesMayBeginWithTheirPoint) {
  const std::string file = write("dots.obj", "v .5 -.25e1 0.\nv 1.5 +.75 .0\nv -.5e-001 2 .125\nf 1 2 3\n");
  Eigen::AlignedBox3f box;
  const Scene scene = imported({.file = file});
  for (const Vertex& vertex : scene.meshes.at(0).vertices) box.extend(vertex.p_W);
  // x is east, y is up, and z is south.
  EXPECT_LT((box.min() - Eigen::Vector3f(-0.125f, -0.05f, -2.0f)).norm(), 1e-6f);
  EXPECT_LT((box.max() - Eigen::Vector3f(0.0f, 1.5f, 2.5f)).norm(), 1e-6f);
}

TEST_F(ObjMaterial, KeywordsOfExtensionsHaveNoEffect) {
  EXPECT_EQ(color_at(with("Kd 1 0 0\naniso 0.7\nanisor 0.8\nPr 0.2\nmap_Pr roughness.tex"), 0.5), cv::Vec3b(255, 0, 0));
  EXPECT_THAT(lines_, IsEmpty());
}

TEST_F(ObjMaterial, RefusesFilesWithoutVisibleFacesWithTheReason) {
  const auto import_of = [&](const std::string& text) {
    return [this, file = write("bad.obj", text)] { imported({.file = file}); };
  };
  const std::string corners = "v 0 0 0\nv 1 2 3\nv -1 -2 -3\nv 0 1 0\n";
  const std::string utf16("\xfe\xff\0v\0 \0001", 8);
  EXPECT_THAT(import_of(utf16), ThrowsMessage<E>(HasSubstr("bad.obj': it is text in UTF-16; valid: UTF-8")));
  EXPECT_THAT(import_of(corners), ThrowsMessage<E>(HasSubstr("it has no triangles")));
  EXPECT_THAT(import_of(corners + "f 1 2 3\n"), ThrowsMessage<E>(HasSubstr("its triangles have no area")));
  EXPECT_THAT(import_of(corners + "vn 0 0 1\nf 1/1/1 2/1/1 4/1/1\n"),
              ThrowsMessage<E>(HasSubstr("its faces refer to image coordinates, but it has none (vt)")));
  EXPECT_NO_THROW(import_of(corners + "vn 0 0 1\nf 1//1 2//1 4//1\n")());
}

TEST_F(ObjMaterial, ImagesAreFoundByTheRulesOfTheFormat) {
  for (const auto& [statement, file] : {std::pair{"map_Kd textures\\wall tex.png", "textures/wall tex.png"},
                                        {"map_Kd 50%25.png", "50%25.png"},
                                        {"map_Kd a%20b.png", "a b.png"},
                                        {"map_Kd C:\\work\\base name.png", "base name.png"},
                                        {"map_Kd a\\ b.png", "a b.png"},
                                        {"map_Kd -colorspace sRGB -texres 64 a.png", "a.png"},
                                        {"map_Kd /absent/base.png", "base.png"}}) {
    write_image(file);
    EXPECT_EQ(color_at(with(statement), -0.5), kRed) << statement;
    EXPECT_EQ(mesh_files(folder_ / "quad.obj").count(folder_ / file), 1u) << statement;
    std::filesystem::remove(folder_ / file);
  }
  write_image("fuse.png");
  EXPECT_EQ(file_named("fuse.png \r", {folder_}, true), folder_ / "fuse.png");  // as a PLY's comment can end
}

TEST_F(ObjMaterial, ImagesAreRelativeToTheMaterialFile) {
  write_image("materials/near.png");
  write("materials/quad.mtl", "newmtl paint\nmap_Kd near.png\n");
  const Scene scene = imported({.file = write("quad.obj", quad("mtllib materials\\quad.mtl"))});
  EXPECT_EQ(color_at(scene, 0.5), kBlue);
  write("my materials.mtl", "newmtl paint\nKd 1 0 0\n");
  write("others.mtl", "");
  const Scene red = imported({.file = write("quad.obj", quad("mtllib others.mtl my\\ materials.mtl"))});
  EXPECT_EQ(color_at(red, 0.5), cv::Vec3b(255, 0, 0));
}

TEST_F(ObjMaterial, AMissingImageDiffersFromADamagedOne) {
  EXPECT_THAT([&] { with("map_Kd gone.png"); },
              ThrowsMessage<E>(HasSubstr("its image 'gone.png': there is no such file")));
  write("broken.png", "no image");
  EXPECT_THAT([&] { with("map_Kd broken.png"); },
              ThrowsMessage<E>(HasSubstr("its image 'broken.png': it cannot be decoded as PNG, JPEG, BMP, TGA")));
  cv::imwrite((folder_ / "wide.png").string(), cv::Mat(1, 8193, CV_8UC3, cv::Scalar(0, 0, 0)));
  EXPECT_THAT([&] { with("map_Kd wide.png"); },
              ThrowsMessage<E>(HasSubstr("its image 'wide.png': it has 8193 x 1 px; valid: at most 8192 x 8192")));
}

TEST_F(ObjMaterial, ReportsImagesThatAreReduced) {
  cv::imwrite((folder_ / "large.png").string(), cv::Mat(96, 128, CV_8UC3, cv::Scalar(0, 0, 0)));
  with("map_Kd large.png");
  ASSERT_EQ(lines_.size(), 1u);
  EXPECT_THAT(lines_[0],
              HasSubstr("quad.obj': image 'large.png' of 128 x 96 px is reduced to 64 x 64 px (texture_size)"));
  write_image("small.png");
  with("map_Kd small.png");
  EXPECT_THAT(lines_, IsEmpty());
}

TEST_F(ObjMaterial, AppliesTheOptionsOfItsImage) {
  write_image("map.png");
  const auto colors = [&](const std::string& options) {
    const Scene scene = with("map_Kd " + options + " map.png");
    std::vector<cv::Vec3b> seen;
    for (const double east_m : {-0.75, -0.25, 0.25, 0.75}) seen.push_back(color_at(scene, east_m));
    return seen;
  };
  EXPECT_THAT(colors("-blendu on -bm 0.5"), ElementsAre(kRed, kRed, kBlue, kBlue));
  EXPECT_THAT(colors("-s 2 1 1"), ElementsAre(kRed, kBlue, kRed, kBlue));
  EXPECT_THAT(colors("-o 0.5"), ElementsAre(kBlue, kBlue, kRed, kRed));
  EXPECT_THAT(colors("-o 0.5 0 0 -clamp on"), ElementsAre(kBlue, kBlue, kBlue, kBlue));
}

TEST_F(ObjMaterial, CutsOutTheHolesOfAnOpacityMap) {
  write_image("map.png");
  cv::Mat opacity(64, 64, CV_8UC1, cv::Scalar(255));
  opacity.rowRange(0, 32) = 0;  // the upper half
  cv::imwrite((folder_ / "opacity.png").string(), opacity);
  const Scene scene = with("map_Kd map.png\nmap_d opacity.png");
  EXPECT_NEAR(cast(scene, {-10.0, 0.5, 0.02}, Vector3d::UnitX()).distance_m, 10.0, 1e-5);
  EXPECT_EQ(cast(scene, {-10.0, 0.5, -0.02}, Vector3d::UnitX()).distance_m, std::numeric_limits<double>::infinity());
}

TEST_F(ObjMaterial, ReportsUnrenderedFeatures) {
  with("d 0.4\nmap_Bump bumps.png\nKd 0.2 0.4 0.6");
  ASSERT_EQ(lines_.size(), 1u);
  EXPECT_THAT(lines_[0], HasSubstr("quad.obj': not rendered: bump maps, transparency of material 'paint'"));
}

}  // namespace
}  // namespace hedgehop::scenes::mesh
