#include "scenes/worlds/wear.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace hedgehop::scenes::worlds {

namespace {

using Eigen::Vector2d;

constexpr double kCellM = 5.0;
constexpr double kRepairShare = 0.5;
constexpr double kCutSpread = 0.3;  // of a cell, to each side
constexpr double kBorderM = 0.05;

/// Returns the cuts of an interval into cells of about kCellM, with its ends.
std::vector<double> cuts(double first_m, double last_m, Random& random) {
  const int count = std::max(1, static_cast<int>(std::lround((last_m - first_m) / kCellM)));
  std::vector<double> all{first_m};
  for (int k = 1; k < count; ++k)
    all.push_back(first_m + (last_m - first_m) * (k + uniform(random, -kCutSpread, kCutSpread)) / count);
  all.push_back(last_m);
  return all;
}

/// A part of a texture on a panel.
struct Area {
  mesh::ImageArea image;
  uint32_t texture = 0;
};

/// The plane of a panel: s to the right and t down, m.
class PanelPlane {
 public:
  explicit PanelPlane(const mesh::TexturedPanel& panel)
      : panel_(panel), size_m_(panel.right_m.norm(), panel.down_m.norm()) {}

  const Vector2d& size_m() const { return size_m_; }

  Vertex vertex(const Vector2d& st, const Area& area) const {
    const Vector2d share = st.cwiseQuotient(size_m_);
    const Eigen::Vector3d p_W = panel_.top_left_W + share.x() * panel_.right_m + share.y() * panel_.down_m;
    const Eigen::Vector3d n_W = -panel_.right_m.cross(panel_.down_m).normalized();
    const Vector2d uv(area.image.u0 + share.x() * (area.image.u1 - area.image.u0),
                      area.image.v0 + share.y() * (area.image.v1 - area.image.v0));
    return {p_W.cast<float>(), n_W.cast<float>(), uv.cast<float>(), area.texture};
  }

 private:
  const mesh::TexturedPanel& panel_;
  Vector2d size_m_;
};

/// Returns a random part of a random surface with the markings in place: shifted along the road, in either
/// direction.
Area random_part(const Area& whole, Wear& wear) {
  Area part = whole;
  part.texture = wear.surfaces[static_cast<size_t>(uniform_index(wear.random, static_cast<int>(wear.surfaces.size())))];
  const double shift = uniform(wear.random, 0.0, 1.0);
  part.image.v0 += shift;
  part.image.v1 += shift;
  if (chance(wear.random, 0.5)) {
    std::swap(part.image.u0, part.image.u1);
    std::swap(part.image.v0, part.image.v1);
  }
  return part;
}

/// Triangles of one texture in a plane.
class Sheet {
 public:
  void add(const Vector2d& st, const Vertex& vertex) {
    places_.push_back(st);
    vertices_.push_back(vertex);
  }
  uint32_t size() const { return static_cast<uint32_t>(vertices_.size()); }
  /// Adds a triangle, whatever the order of its corners.
  void join(uint32_t a, uint32_t b, uint32_t c) {
    const Vector2d ab = places_[b] - places_[a], ac = places_[c] - places_[a];
    if (ab.x() * ac.y() - ab.y() * ac.x() > 0.0) std::swap(b, c);  // t points down
    faces_.push_back({a, b, c});
  }
  void finish(mesh::MeshBuilder& mesh) const { mesh.add(vertices_, faces_); }

 private:
  std::vector<Vector2d> places_;
  std::vector<Vertex> vertices_;
  std::vector<std::array<uint32_t, 3>> faces_;
};

/// Joins one side of a panel to the corners of the cells along it.
void join_side(uint32_t first, uint32_t last, const std::vector<uint32_t>& inner, Sheet& sheet) {
  sheet.join(first, last, inner.back());
  for (size_t k = 1; k < inner.size(); ++k) sheet.join(first, inner[k - 1], inner[k]);
}

void add_repair(const PanelPlane& plane, const std::array<Vector2d, 4>& corners, Wear& wear, mesh::MeshBuilder& mesh) {
  const Vector2d shift(uniform(wear.random, 0.0, 1.0), uniform(wear.random, 0.0, 1.0));
  const int turn = uniform_index(wear.random, 4);
  const double c = std::array{1.0, 0.0, -1.0, 0.0}[static_cast<size_t>(turn)],
               s = std::array{0.0, 1.0, 0.0, -1.0}[static_cast<size_t>(turn)];
  Sheet repair;
  for (const Vector2d& st : corners) {
    Vertex vertex = plane.vertex(st, {{}, wear.repairs});
    vertex.uv =
        (shift + Vector2d(c * st.x() - s * st.y(), s * st.x() + c * st.y()) / wear.repairs_tile_m).cast<float>();
    repair.add(st, vertex);
  }
  repair.join(0, 1, 2);
  repair.join(0, 2, 3);
  repair.finish(mesh);
}

/// Adds the border of a panel, which joins its corners to those of the cells.
void add_border(const PanelPlane& plane, const Area& whole, const std::vector<double>& s, const std::vector<double>& t,
                mesh::MeshBuilder& mesh) {
  Sheet sheet;
  const auto add = [&](double right_m, double down_m) {
    sheet.add({right_m, down_m}, plane.vertex({right_m, down_m}, whole));
    return sheet.size() - 1;
  };
  const double width_m = plane.size_m().x(), length_m = plane.size_m().y();
  add(0.0, 0.0);
  add(width_m, 0.0);
  add(width_m, length_m);
  add(0.0, length_m);
  std::vector<uint32_t> top, bottom, left, right;
  for (const double right_m : s) {
    top.push_back(add(right_m, t.front()));
    bottom.push_back(add(right_m, t.back()));
  }
  for (const double down_m : t) {
    left.push_back(add(s.front(), down_m));
    right.push_back(add(s.back(), down_m));
  }
  join_side(0, 1, top, sheet);
  join_side(3, 2, bottom, sheet);
  join_side(0, 3, left, sheet);
  join_side(1, 2, right, sheet);
  sheet.finish(mesh);
}

}  // namespace

void add_worn(const mesh::TexturedPanel& panel, const mesh::ImageArea& area, double inset_m, Wear& wear,
              mesh::MeshBuilder& mesh) {
  const PanelPlane plane(panel);
  const double width_m = plane.size_m().x(), length_m = plane.size_m().y();
  const Area whole{area, wear.surfaces.front()};
  const double side_m = 2.0 * inset_m < width_m ? inset_m : 0.4 * width_m;
  const std::vector<double> lane = cuts(side_m, width_m - side_m, wear.random),
                            t = cuts(kBorderM, length_m - kBorderM, wear.random);
  std::vector<double> s{kBorderM};
  s.insert(s.end(), lane.begin(), lane.end());
  s.push_back(width_m - kBorderM);
  for (size_t row = 0; row + 1 < t.size(); ++row) {
    const Area stretch = random_part(whole, wear);
    for (size_t column = 0; column + 1 < s.size(); ++column) {
      const std::array<Vector2d, 4> corners{Vector2d(s[column], t[row]), Vector2d(s[column + 1], t[row]),
                                            Vector2d(s[column + 1], t[row + 1]), Vector2d(s[column], t[row + 1])};
      const bool in_lane = column > 0 && column + 2 < s.size();
      if (in_lane && chance(wear.random, kRepairShare)) {
        add_repair(plane, corners, wear, mesh);
        continue;
      }
      Sheet cell;
      for (const Vector2d& st : corners) cell.add(st, plane.vertex(st, stretch));
      cell.join(0, 1, 2);
      cell.join(0, 2, 3);
      cell.finish(mesh);
    }
  }
  add_border(plane, whole, s, t, mesh);
}

}  // namespace hedgehop::scenes::worlds
