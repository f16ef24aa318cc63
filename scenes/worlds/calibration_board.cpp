#include "scenes/worlds/calibration_board.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "scenes/mesh/bodies.h"
#include "scenes/mesh/mesh_builder.h"
#include "scenes/scene_files.h"
#include "scenes/textures/stone_textures.h"
#include "scenes/textures/street_textures.h"
#include "scenes/world_config.h"
#include "sim/fields/bounds.h"
#include "sim/libm/random.h"

namespace hedgehop::scenes::worlds {
namespace {

constexpr uint64_t kBoardGrassStream = 0;  // of the scene's seed
constexpr double kBoardThicknessM = 0.01;
constexpr uint32_t kMeadow = 0, kBoardBlack = 1, kBoardWhite = 2;  // textures

/// The first codes of the family 36h11, after [Olson2011]: 6 x 6 cells from the most significant bit on, row by row; 1
/// is white.
constexpr std::array<uint64_t, AprilGridConfig::kMaxTags> kTagCodes = {
    0xd5d628584, 0xd97f18b49, 0xdd280910e, 0xe479e9c98, 0xebcbca822, 0xf31dab3ac, 0x056a5d085, 0x10652e1d4, 0x22b1dfead,
    0x265ad0472, 0x34fe91b86, 0x3ff962cd5, 0x43a25329a, 0x474b4385f, 0x4e9d243e9, 0x5246149ae, 0x5997f5538, 0x683bb6c4c,
    0x6be4a7211, 0x7e3158eea, 0x81da494af, 0x858339a74, 0x8cd51a5fe, 0x9f21cc2d7, 0xa2cabc89c, 0xadc58d9eb, 0xb16e7dfb0,
    0xb8c05eb3a, 0xd25ef139d, 0xd607e1962, 0xe4aba3076, 0x2dde6a3da, 0x43d40c678, 0x5620be351, 0x64c47fa65, 0x686d7002a,
    0x6c16605ef, 0x6fbf50bb4, 0x8d06d39dc, 0x9f53856b5, 0xadf746dc9, 0xbc9b084dd, 0xd290aa77b, 0xd9e28b305, 0xe4dd5c454,
    0xfad2fe6f2, 0x181a8151a, 0x26be42c2e, 0x2e10237b8, 0x405cd5491, 0x7742eab1c, 0x85e6ac230, 0x8d388cdba, 0x9f853ea93,
    0xc41ea2445, 0xcf1973594, 0x14a34a333, 0x31eacd15b, 0x6c79d2dab, 0x73cbb3935, 0x89c155bd3, 0x8d6a46198, 0x91133675d,
    0xa708d89fb, 0xae5ab9585, 0xb9558a6d4, 0xb98743ab2, 0xd6cec68da, 0x1506bcaef, 0x4becd217a, 0x4f95c273f, 0x658b649dd,
    0xa76c4b1b7, 0xecf621f56, 0x1c8a56a57, 0x3628e92ba, 0x53706c0e2, 0x5e6b3d231, 0x7809cfa94, 0xe97eead6f, 0x5af40604a,
    0x7492988ad, 0xed5994712, 0x5eceaf9ed, 0x7c1632815, 0xc1a0095b4, 0xe9e25d52b, 0x3a6705419,
};

/// A board of cells in the plane of its face: x to the right from its middle, y up, m.
class Board {
 public:
  Board(std::string name, double north_m, double altitude_m, double width_m, double height_m, uint64_t seed)
      : north_m_(north_m), altitude_m_(altitude_m) {
    require(altitude_m >= 0.5 * height_m, "altitude", altitude_m, "at least half the height of the board");
    scene_.name = std::move(name);
    // A sun in the south lights the face.
    scene_.lights.to_sun_W = Eigen::Vector3f(-0.7f, -0.3f, -0.65f).normalized();
    scene_.textures = TextureList(kFixedTexturePx);
    scene_.textures.add([grass_seed = derived_seed(seed, kBoardGrassStream)] {
      return textures::paint_grass(kFixedTexturePx, grass_seed);
    });
    scene_.textures.add([] { return textures::paint_blank(kFixedTexturePx, {0.03f, 0.03f, 0.03f}); });
    scene_.textures.add([] { return textures::paint_blank(kFixedTexturePx, {0.9f, 0.9f, 0.9f}); });
    const double half_m = std::max(width_m, std::abs(north_m)) + 20.0;
    scene_.bounds_NE_m = {Eigen::Vector2d(-half_m, -half_m), Eigen::Vector2d(half_m, half_m)};
    mesh::add_ground(half_m, {kMeadow, textures::kGrassTileM}, mesh_);
    mesh_.begin_instance(scene_.name, SemanticClass::other);
    mesh_.begin_chunk(false);
    const Eigen::AlignedBox3d box_W(
        Eigen::Vector3d(north_m, -0.5 * width_m, -altitude_m - 0.5 * height_m),
        Eigen::Vector3d(north_m + kBoardThicknessM, 0.5 * width_m, -altitude_m + 0.5 * height_m));
    scene_.solids.push_back(mesh::solid_of(scene_.name, box_W));
    const auto sides = mesh::side_panels(box_W);
    for (const size_t side : {0, 1, 3}) mesh_.add(sides[side], {}, kBoardWhite);
    mesh_.add(mesh::top_panel(box_W), {}, kBoardWhite);
    mesh_.add(mesh::bottom_panel(box_W), {}, kBoardWhite);
  }

  /// Adds a rectangle of the face, by its lower left corner.
  void add(double x_m, double y_m, double width_m, double height_m, uint32_t texture) {
    mesh_.add({.top_left_W = {north_m_, x_m, -altitude_m_ - y_m - height_m},
               .right_m = {0.0, width_m, 0.0},
               .down_m = {0.0, 0.0, height_m}},
              {}, texture);
  }

  Scene finish() {
    scene_.meshes.push_back(mesh_.finish());
    return std::move(scene_);
  }

 private:
  double north_m_, altitude_m_;
  Scene scene_;
  mesh::MeshBuilder mesh_{"opaque"};
};

/// Adds the cells of a tag, by its lower left corner.
void add_tag(const AprilGridConfig& c, uint64_t code, double x_m, double y_m, Board& board) {
  constexpr int64_t kCells = 6;
  const int64_t side = kCells + 2 * c.border;
  const double cell_m = c.tag_m / static_cast<double>(side);
  for (int64_t row = 0; row < side; ++row) {
    for (int64_t col = 0; col < side; ++col) {
      const int64_t code_row = row - c.border, code_col = col - c.border;
      const bool inside = code_row >= 0 && code_row < kCells && code_col >= 0 && code_col < kCells;
      const bool is_white = inside && ((code >> (kCells * kCells - 1 - kCells * code_row - code_col)) & 1U) != 0;
      board.add(x_m + static_cast<double>(col) * cell_m, y_m + static_cast<double>(side - 1 - row) * cell_m, cell_m,
                cell_m, is_white ? kBoardWhite : kBoardBlack);
    }
  }
}

}  // namespace

Scene make_checkerboard(const CheckerboardConfig& c, uint64_t seed) {
  fields::require_bounds(c);
  // Squares across, with the margin.
  const int64_t columns = c.columns + 3, rows = c.rows + 3;
  const double width_m = c.square_m * static_cast<double>(columns), height_m = c.square_m * static_cast<double>(rows);
  Board board(std::string(CheckerboardConfig::kName), c.north_m, c.altitude_m, width_m, height_m, seed);
  for (int64_t row = 0; row < rows; ++row) {
    for (int64_t col = 0; col < columns; ++col) {
      const bool in_margin = row == 0 || col == 0 || row == rows - 1 || col == columns - 1;
      const bool is_black = !in_margin && (row + col) % 2 == 0;
      board.add(c.square_m * static_cast<double>(col) - 0.5 * width_m,
                0.5 * height_m - c.square_m * static_cast<double>(row + 1), c.square_m, c.square_m,
                is_black ? kBoardBlack : kBoardWhite);
    }
  }
  return board.finish();
}

Scene make_aprilgrid(const AprilGridConfig& c, uint64_t seed) {
  fields::require_bounds(c);
  require(c.columns * c.rows <= AprilGridConfig::kMaxTags, "rows", static_cast<double>(c.rows),
          "at most 88 tags in all");
  const double gap_m = c.spacing * c.tag_m, pitch_m = c.tag_m + gap_m;
  // The gaps around the tags belong to the board, and a margin of the same width.
  const double width_m = pitch_m * static_cast<double>(c.columns) + 3.0 * gap_m;
  const double height_m = pitch_m * static_cast<double>(c.rows) + 3.0 * gap_m;
  Board board(std::string(AprilGridConfig::kName), c.north_m, c.altitude_m, width_m, height_m, seed);
  const auto x_of = [&](int64_t col) { return -0.5 * width_m + gap_m + pitch_m * static_cast<double>(col); };
  const auto y_of = [&](int64_t row) { return -0.5 * height_m + gap_m + pitch_m * static_cast<double>(row); };
  for (int64_t row = 0; row <= c.rows; ++row) {
    for (int64_t col = 0; col <= c.columns; ++col) {
      const double x_m = x_of(col), y_m = y_of(row);
      board.add(x_m, y_m, gap_m, gap_m, kBoardBlack);
      if (col < c.columns) board.add(x_m + gap_m, y_m, c.tag_m, gap_m, kBoardWhite);
      if (row < c.rows) board.add(x_m, y_m + gap_m, gap_m, c.tag_m, kBoardWhite);
      if (col == c.columns || row == c.rows) continue;
      add_tag(c, kTagCodes[static_cast<size_t>(row * c.columns + col)], x_m + gap_m, y_m + gap_m, board);
    }
  }
  // The margin.
  board.add(-0.5 * width_m, -0.5 * height_m, width_m, gap_m, kBoardWhite);
  board.add(-0.5 * width_m, 0.5 * height_m - gap_m, width_m, gap_m, kBoardWhite);
  board.add(-0.5 * width_m, -0.5 * height_m + gap_m, gap_m, height_m - 2.0 * gap_m, kBoardWhite);
  board.add(0.5 * width_m - gap_m, -0.5 * height_m + gap_m, gap_m, height_m - 2.0 * gap_m, kBoardWhite);
  return board.finish();
}

}  // namespace hedgehop::scenes::worlds
