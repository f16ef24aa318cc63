#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <limits>
#include <opencv2/imgcodecs.hpp>

#include "scenes/generators.h"
#include "tests/scenes/mesh/imported_files.h"

namespace hedgehop::scenes::terrain {
namespace {

using Eigen::Vector3d;
using mesh::cast;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// A field of a TIFF.
struct TiffField {
  uint16_t tag, type;
  uint32_t count;
  std::string bytes;
};

template <class T>
TiffField field(uint16_t tag, uint16_t type, const std::vector<T>& values) {
  std::string bytes(values.size() * sizeof(T), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return {tag, type, static_cast<uint32_t>(values.size()), bytes};
}

/// Returns a little-endian TIFF of floats in one strip, with more fields: geo keys and GDAL's value without data.
std::string tiff_of(const cv::Mat_<float>& heights, std::vector<TiffField> fields) {
  const auto bytes = [](const auto& value) { return std::string(reinterpret_cast<const char*>(&value), sizeof value); };
  const uint32_t size = static_cast<uint32_t>(heights.total() * 4);
  fields.insert(fields.begin(),
                {field<uint32_t>(256, 4, {static_cast<uint32_t>(heights.cols)}),
                 field<uint32_t>(257, 4, {static_cast<uint32_t>(heights.rows)}), field<uint32_t>(258, 4, {32}),
                 field<uint32_t>(259, 4, {1}), field<uint32_t>(262, 4, {1}), field<uint32_t>(273, 4, {8}),
                 field<uint32_t>(277, 4, {1}), field<uint32_t>(278, 4, {static_cast<uint32_t>(heights.rows)}),
                 field<uint32_t>(279, 4, {size}), field<uint32_t>(339, 4, {3})});
  std::string data(reinterpret_cast<const char*>(heights.data), size), entries;
  for (const TiffField& f : fields) {
    entries += bytes(f.tag) + bytes(f.type) + bytes(f.count);
    if (f.bytes.size() <= 4) {
      entries += f.bytes + std::string(4 - f.bytes.size(), '\0');
    } else {
      entries += bytes(static_cast<uint32_t>(8 + data.size()));
      data += f.bytes + std::string(f.bytes.size() % 2, '\0');
    }
  }
  return "II" + bytes(uint16_t{42}) + bytes(static_cast<uint32_t>(8 + data.size())) + data +
         bytes(static_cast<uint16_t>(fields.size())) + entries + bytes(uint32_t{0});
}

/// A plane over the plan, which the triangles between its samples represent exactly. Its samples are multiples of 1/4.
constexpr double height_m(double east_m, double north_m) { return 500.0 + 0.25 * east_m - 0.5 * north_m; }

class Terrain : public mesh::ImportedFiles {
 protected:
  static TiffField keys(uint16_t model_type, uint16_t raster_type) {
    return field<uint16_t>(34735, 3, {1, 1, 0, 2, 1024, 0, 1, model_type, 1025, 0, 1, raster_type});
  }
  /// A map of 5 x 4 samples of the plane, whose northwest corner is at east 448,260 m and north 5,262,010 m.
  std::string georeferenced(uint16_t model_type = 1, uint16_t raster_type = 1) const {
    const double to_middle = raster_type == 1 ? 0.5 : 0.0;
    cv::Mat_<float> heights(4, 5);
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < 5; ++column)
        heights(row, column) = static_cast<float>(height_m(4.0 * (column + to_middle), -4.0 * (row + to_middle)));
    }
    return tiff_of(
        heights, {field<double>(33550, 12, {4.0, 4.0, 0.0}),
                  field<double>(33922, 12, {0.0, 0.0, 0.0, 448260.0, 5262010.0, 0.0}), keys(model_type, raster_type)});
  }
  Scene open(worlds::OpenConfig config, TerrainConfig terrain) const {
    config.texture_size_px = 64;
    config.added.terrain = std::move(terrain);
    return make_scene(config, 1);
  }
  /// The altitude of the surface, from a vertical ray; not finite over a hole.
  static double altitude_m(const Scene& scene, double north_m, double east_m) {
    return 1000.0 - cast(scene, {north_m, east_m, -1000.0}, Vector3d::UnitZ()).distance_m;
  }
};

class GeoTiff : public Terrain {
  void SetUp() override {
    if (!HEDGEHOP_READS_TIFF) GTEST_SKIP() << "this build reads no TIFF (Debian: apt install libtiff-dev)";
  }
};

TEST_F(GeoTiff, HasItsPlaceAndHeightsRelativeToTheOrigin) {
  worlds::OpenConfig config;
  config.added.origin_ENU = {448260.0, 5262010.0, 510.0};
  for (const uint16_t raster_type : {uint16_t{1}, uint16_t{2}}) {  // pixel is area, pixel is point
    const std::string file = write("utm.tif", georeferenced(1, raster_type));
    const Scene scene = open(config, {.heightmap = file});
    EXPECT_FALSE(scene.has_ground);
    for (const auto& [north_m, east_m] : {std::pair{-3.0, 5.0}, {-9.5, 12.25}, {-7.75, 3.5}})
      EXPECT_NEAR(altitude_m(scene, north_m, east_m), height_m(east_m, north_m) - 510.0, 1e-4) << raster_type;
    // The first sample is half a cell from the corner if a pixel is an area.
    EXPECT_EQ(std::isfinite(altitude_m(scene, -1.0, 1.0)), raster_type == 2);
  }
}

TEST_F(GeoTiff, FeetBecomeMeters) {
  constexpr uint16_t kMeter = 9001, kFoot = 9002, kUsSurveyFoot = 9003;
  // 5 x 4 samples of 1000 in all units; the northwest corner is at east 400 and north 100.
  const auto corner_of = [this](uint16_t horizontal, uint16_t vertical) {
    const TiffField units =
        field<uint16_t>(34735, 3, {1, 1, 0, 3, 1024, 0, 1, 1, 3076, 0, 1, horizontal, 4099, 0, 1, vertical});
    worlds::OpenConfig config;
    const std::string file = write(
        "unit.tif",
        tiff_of(cv::Mat_<float>(4, 5, 1000.0f), {field<double>(33550, 12, {10.0, 20.0, 0.0}),
                                                 field<double>(33922, 12, {0.5, 0.5, 0.0, 400.0, 100.0, 0.0}), units}));
    const Scene scene = open(config, {.heightmap = file});
    return bounds_W(scene.solids.at(0));
  };
  const auto expect = [&](uint16_t horizontal, uint16_t vertical, double to_m, double height_to_m) {
    const Eigen::AlignedBox3d bounds = corner_of(horizontal, vertical);
    constexpr double kFloatM = 1e-3;
    EXPECT_NEAR(bounds.max().x(), 100.0 * to_m, kFloatM);
    EXPECT_NEAR(bounds.min().x(), 40.0 * to_m, kFloatM);
    EXPECT_NEAR(bounds.min().y(), 400.0 * to_m, kFloatM);
    EXPECT_NEAR(bounds.max().y(), 440.0 * to_m, kFloatM);
    EXPECT_NEAR(bounds.min().z(), -1000.0 * height_to_m, kFloatM);
  };
  constexpr double kFootM = 0.3048, kUsSurveyFootM = 0.304800609601219;
  expect(kMeter, kMeter, 1.0, 1.0);
  expect(kFoot, kMeter, kFootM, 1.0);
  expect(kMeter, kFoot, 1.0, kFootM);
  expect(kUsSurveyFoot, kUsSurveyFoot, kUsSurveyFootM, kUsSurveyFootM);
  EXPECT_THAT([&] { corner_of(9005, kMeter); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("its coordinates have the unit 9005; valid: 9001 (m)")));
  EXPECT_THAT([&] { corner_of(kMeter, 9005); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("its heights have the unit 9005; valid: 9001 (m)")));
}

TEST_F(GeoTiff, ThePixelScaleIsAboveZero) {
  const double inf = std::numeric_limits<double>::infinity();
  for (const auto& scale : std::vector<std::vector<double>>{{0.0, 4.0, 0.0}, {4.0, -4.0, 0.0}, {inf, 4.0, 0.0}}) {
    const std::string file =
        write("scale.tif", tiff_of(cv::Mat_<float>(4, 5, 0.0f), {field<double>(33550, 12, scale)}));
    EXPECT_THAT([&] { open({}, {.heightmap = file}); },
                ThrowsMessage<std::invalid_argument>(
                    testing::AllOf(HasSubstr("its pixel scale is "), HasSubstr("; valid: finite and above 0"))));
  }
}

TEST_F(GeoTiff, SolidsHaveTheSurfaceOfTheImages) {
  worlds::OpenConfig config;
  config.added.origin_ENU = {448260.0, 5262010.0, 510.0};
  const Scene scene = open(config, {.heightmap = write("utm.tif", georeferenced())});
  ASSERT_EQ(scene.solids.size(), 1u);
  EXPECT_EQ(scene.solids[0].polyhedron.faces.size(), 2u * 4u * 3u);
  for (const Vector3d& p_W : scene.solids[0].polyhedron.corners)
    EXPECT_NEAR(-p_W.z(), height_m(p_W.y(), p_W.x()) - 510.0, 1e-6);
}

TEST_F(Terrain, APngScalesFromLowToHighAroundItsMiddle) {
  cv::Mat_<uint16_t> grey(3, 3, uint16_t{0});
  grey(0, 2) = 65535;  // in the northeast
  cv::imwrite((folder_ / "map.png").string(), grey);
  const Scene scene = open({}, {.heightmap = (folder_ / "map.png").string(),
                                .spacing_m = 10.0,
                                .low_m = -30.0,
                                .high_m = -10.0,
                                .north_m = 100.0});
  EXPECT_NEAR(altitude_m(scene, 109.999, 9.999), -10.0, 0.01);
  EXPECT_NEAR(altitude_m(scene, 90.5, -9.5), -30.0, 1e-4);
  EXPECT_TRUE(std::isinf(altitude_m(scene, 89.5, 0.0)));
}

TEST_F(GeoTiff, CellsWithoutDataAreHoles) {
  cv::Mat_<float> heights(3, 3, -5.0f);
  heights(0, 0) = -9999.0f;
  const std::string text = "-9999";
  const std::string file =
      write("hole.tif", tiff_of(heights, {field<char>(42113, 2, std::vector<char>(text.c_str(), text.c_str() + 6))}));
  const Scene scene = open({}, {.heightmap = file, .spacing_m = 2.0});
  EXPECT_TRUE(std::isinf(altitude_m(scene, 1.0, -1.1)));
  EXPECT_NEAR(altitude_m(scene, -1.0, -1.1), -5.0, 1e-5);
}

TEST_F(GeoTiff, ReadsCompressedTiffsOfIntegers) {
  cv::Mat_<int16_t> heights(300, 40, int16_t{-12});  // several strips
  cv::imwrite((folder_ / "packed.tif").string(), heights, {cv::IMWRITE_TIFF_COMPRESSION, 5});
  const Scene scene = open({}, {.heightmap = (folder_ / "packed.tif").string(), .spacing_m = 1.0});
  EXPECT_NEAR(altitude_m(scene, 149.3, 3.3), -12.0, 1e-5);
  EXPECT_NEAR(altitude_m(scene, -149.3, 3.3), -12.0, 1e-5);
}

TEST_F(GeoTiff, FaultsAreOneLine) {
  const auto fails = [this](const TerrainConfig& config, const std::string& why) {
    EXPECT_THAT([&] { open({}, config); }, ThrowsMessage<std::invalid_argument>(HasSubstr(why))) << config.heightmap;
  };
  fails({}, "terrain.heightmap: is required");
  fails({.heightmap = "none.tif"}, "terrain.heightmap: 'none.tif': there is no such file");
  fails({.heightmap = write("degrees.tif", georeferenced(2))}, "its coordinates are degrees; valid: a projection in");
  fails({.heightmap = write("far.tif", georeferenced())},
        "its middle is 448270 m east and 5262002 m north; subtract it with scene.origin");
  const std::string short_tiepoints =
      tiff_of(cv::Mat_<float>(4, 5, 0.0f),
              {field<double>(33550, 12, {4.0, 4.0, 0.0}), field<uint16_t>(33922, 3, {0, 0, 0, 1, 2, 0})});
  fails({.heightmap = write("short.tif", short_tiepoints)},
        "its tag ModelTiepoint has 16-bit integers; valid: 64-bit floats");
  const std::string infinite_tiepoint =
      tiff_of(cv::Mat_<float>(4, 5, 0.0f),
              {field<double>(33550, 12, {4.0, 4.0, 0.0}),
               field<double>(33922, 12, {0.0, 0.0, 0.0, std::numeric_limits<double>::infinity(), 0.0, 0.0})});
  fails({.heightmap = write("infinite.tif", infinite_tiepoint)}, "its tiepoint is not finite");
  fails({.heightmap = write("text.tif", "no image"), .spacing_m = 1.0}, "it is no PNG and no TIFF");
  std::string cut = georeferenced();
  cut.resize(60);
  fails({.heightmap = write("cut.tif", cut)}, "cut.tif': it ");
  cv::imwrite((folder_ / "large.tif").string(), cv::Mat_<float>(4, 600, 0.0f));
  fails({.heightmap = (folder_ / "large.tif").string(), .spacing_m = 1.0},
        "it has 600 x 4 samples; valid: 2 x 2 to 512");
  cv::imwrite((folder_ / "color.png").string(), cv::Mat(4, 4, CV_8UC3, cv::Scalar(1, 2, 3)));
  fails({.heightmap = (folder_ / "color.png").string(), .spacing_m = 1.0}, "a heightmap is a grey PNG of 8 or 16 bit");
  cv::imwrite((folder_ / "grey.png").string(), cv::Mat(4, 4, CV_8UC1, cv::Scalar(1)));
  fails({.heightmap = (folder_ / "grey.png").string()}, "terrain.spacing: is required without a GeoTIFF");
  fails({.heightmap = (folder_ / "grey.png").string(), .spacing_m = 1.0}, "terrain.high: must be greater than 'low'");
}

TEST_F(Terrain, WithoutGroundAWorldHasNoGroundTriangles) {
  worlds::WallConfig config;
  config.texture_size_px = 64;
  EXPECT_LT(cast(make_scene(config, 1), {5.0, 5.0, -3.0}, Vector3d::UnitZ()).distance_m, 3.1);
  config.added.ground = SceneAdditions::Ground::none;
  const Scene scene = make_scene(config, 1);
  EXPECT_FALSE(scene.has_ground);
  EXPECT_TRUE(std::isinf(cast(scene, {5.0, 5.0, -3.0}, Vector3d::UnitZ()).distance_m));
  EXPECT_TRUE(std::isfinite(cast(scene, {0.0, 0.1, -3.0}, Vector3d::UnitX()).distance_m));  // the wall
  for (const Mesh& mesh : scene.meshes) {
    for (const Chunk& chunk : mesh.chunks) EXPECT_FALSE(chunk.fills_box_to_ground);
  }
}

TEST_F(Terrain, TheOriginOfASceneIsThatOfItsImports) {
  if (!HEDGEHOP_READS_MESHES) GTEST_SKIP() << "this build reads no meshes (Debian: apt install libassimp-dev)";
  const std::string file =
      write("far.obj", "v 448262 5262012 511\nv 448263 5262012 511\nv 448262 5262013 511\nf 1 2 3\n");
  worlds::OpenConfig config;
  config.texture_size_px = 64;
  config.added.origin_ENU = {448260.0, 5262010.0, 510.0};
  config.added.imports = {{.file = file, .up = mesh::ImportConfig::Up::z}};
  EXPECT_NEAR(altitude_m(make_scene(config, 1), 2.1, 2.1), 1.0, 1e-5);
  config.added.imports[0].origin_ENU = Vector3d(448262.0, 5262012.0, 508.0);
  EXPECT_NEAR(altitude_m(make_scene(config, 1), 0.1, 0.1), 3.0, 1e-5);
}

}  // namespace
}  // namespace hedgehop::scenes::terrain
