#include <gtest/gtest.h>

#include <algorithm>

#include "tests/sim/render/small_world.h"
#include "tests/sim/render/tested_renderer.h"

namespace hedgehop::sim {
namespace {

const vision::camera::PinholeCamera kShadowCamera{320, 320, 200, 200, 159.5, 159.5};
constexpr uint8_t kLit = 255, kShaded = 102;  // white, times 1 and 0.4

/// White ground and a box on it. Ambient light and sun together give the ground its full albedo.
SmallWorld box_on_ground(const Eigen::AlignedBox3f& box_W, const Eigen::Vector3f& to_sun_W) {
  SmallWorld world;
  world.scene.lights = {.ambient = 0.4f, .sun = 0.6f / -to_sun_W.z(), .to_sun_W = to_sun_W};
  world.add_ground(40.0f, 4);
  world.add_box(box_W);
  return world;
}

Eigen::Vector3f random_sun(std::mt19937_64& random) {
  const double turn = uniform(random, -3.14, 3.14), up = uniform(random, 0.6, 1.3);
  return Eigen::Vector3d(std::cos(up) * std::cos(turn), std::cos(up) * std::sin(turn), -std::sin(up)).cast<float>();
}

/// Returns the length of the ray from a point to the sun within a box expanded by `margin_m`; negative if it misses the
/// box.
double length_in_box(const Eigen::Vector3d& p_W, const Eigen::Vector3d& to_sun_W, const Eigen::AlignedBox3f& box_W,
                     double margin_m) {
  double enter = 0.0, leave = 1e9;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (box_W.min()[axis] - margin_m - p_W[axis]) / to_sun_W[axis];
    const double b = (box_W.max()[axis] + margin_m - p_W[axis]) / to_sun_W[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return leave - enter;
}

TEST(Shadows, OfABoxOnTheGroundHaveTheShapeOfItsProjection) {
  std::mt19937_64 random(71);
  const Eigen::Isometry3d X_WC = look_at({0, 0, -30}, {0, 0, 0});
  for (int trial = 0; trial < 8; ++trial) {
    const Eigen::Vector3d half(uniform(random, 1.0, 3.0), uniform(random, 1.0, 3.0), uniform(random, 1.0, 3.0));
    const Eigen::AlignedBox3f box_W(Eigen::Vector3d(-half.x(), -half.y(), -2.0 * half.z()).cast<float>(),
                                    Eigen::Vector3d(half.x(), half.y(), 0.0).cast<float>());
    const Eigen::Vector3f to_sun_W = random_sun(random);
    const SmallWorld world = box_on_ground(box_W, to_sun_W);
    Renderer renderer = make_renderer(world.scene, Culling::frustum_and_horizon, Shadows::sun);
    cv::Mat grey, depth;
    renderer.draw({kShadowCamera, X_WC, ImageChannel::grey}, grey);
    renderer.draw({kShadowCamera, X_WC, ImageChannel::depth}, depth);
    int shaded = 0;
    double error_m2 = 0.0, drawn_m2 = 0.0;
    const double pixel_m2 = std::pow(30.0 / 200.0, 2);
    for (int v = 0; v < grey.rows; ++v) {
      for (int u = 0; u < grey.cols; ++u) {
        if (depth.at<float>(v, u) < 29.999f) continue;  // the box itself
        const Eigen::Vector3d p_W =
            X_WC * (30.0 * kShadowCamera.ray_at_unit_depth({u, v}) / kShadowCamera.ray_at_unit_depth({u, v}).z());
        const auto hit = [&](double margin_m) {
          return length_in_box(p_W, to_sun_W.cast<double>(), box_W, margin_m) > 0.0;
        };
        const uint8_t level = grey.at<uint8_t>(v, u);
        constexpr double kTexelsM =
            0.03;  // a box of 6 m has texels of about 5 mm; those of a slanted roof are shifted by two
        if (hit(-kTexelsM)) {
          EXPECT_NEAR(level, kShaded, 1) << u << " " << v;
          ++shaded;
        } else if (!hit(kTexelsM)) {
          EXPECT_NEAR(level, kLit, 1) << u << " " << v;
        }
        error_m2 += pixel_m2 * ((kLit - level) / double{kLit - kShaded} - (hit(0.0) ? 1.0 : 0.0));
        drawn_m2 += pixel_m2 * (hit(0.0) ? 1.0 : 0.0);
      }
    }
    EXPECT_GT(shaded, 100);
    EXPECT_NEAR(error_m2 / drawn_m2, 0.0, 0.01);
  }
}

constexpr double kHalfM = 4.0;  // of a cube on the ground

/// Returns the distance of a point on the cube from the next edge, projected along the light, in texels of the widened
/// map.
double edge_texels(const Eigen::Vector3d& p_W, const Eigen::Vector3d& to_sun_W) {
  constexpr double kTexelM = 0.12;
  const Eigen::Array3d from_middle = p_W.array() + Eigen::Array3d(0, 0, kHalfM);
  Eigen::Array3d inside_m = kHalfM - from_middle.abs();
  Eigen::Index face = 0;
  inside_m.minCoeff(&face);
  const double cosine = std::copysign(to_sun_W[face], to_sun_W[face] * from_middle[face]);
  inside_m[face] = 2.0 * kHalfM;
  return inside_m.minCoeff() * std::max(cosine, 0.0) / kTexelM;
}

// Next to an edge, a texel may show the other face, whose depth changes more per texel.
TEST(Shadows, DarkenNoSunlitFace) {
  std::mt19937_64 random(72);
  int compared = 0;
  for (int trial = 0; trial < 10; ++trial) {
    SmallWorld world;
    const Eigen::Vector3f to_sun_W = random_sun(random);
    world.scene.lights = {.ambient = 0.3f, .sun = 0.7f, .to_sun_W = to_sun_W};
    const auto half = static_cast<float>(kHalfM);
    world.add_box({Eigen::Vector3f(-half, -half, -2 * half), Eigen::Vector3f(half, half, 0)});
    world.add_quad({300, 300, -20}, {1, 0, 0}, {0, 0, 1});  // widens the map and thus its texels
    Renderer plain = make_renderer(world.scene);
    Renderer shaded = make_renderer(world.scene, Culling::frustum_and_horizon, Shadows::sun);
    for (int view = 0; view < 4; ++view) {
      const double turn = uniform(random, -3.14, 3.14);
      const Eigen::Isometry3d X_WC = look_at({14 * std::cos(turn), 14 * std::sin(turn), -12}, {0, 0, -4});
      cv::Mat without, with, depth;
      plain.draw({kShadowCamera, X_WC, ImageChannel::grey}, without);
      shaded.draw({kShadowCamera, X_WC, ImageChannel::grey}, with);
      shaded.draw({kShadowCamera, X_WC, ImageChannel::depth}, depth);
      for (int v = 0; v < depth.rows; ++v) {
        for (int u = 0; u < depth.cols; ++u) {
          const Eigen::Vector3d ray_C = kShadowCamera.ray_at_unit_depth({u, v});
          const Eigen::Vector3d p_W = X_WC * (depth.at<float>(v, u) / ray_C.z() * ray_C);
          if (!p_W.allFinite() || p_W.norm() > 20.0 || edge_texels(p_W, to_sun_W.cast<double>()) < 2.0) continue;
          EXPECT_NEAR(with.at<uint8_t>(v, u), without.at<uint8_t>(v, u), 1) << u << " " << v;
          ++compared;
        }
      }
    }
  }
  EXPECT_GT(compared, 100000);
}

TEST(Shadows, FallOnMovingObstaclesThatCastNone) {
  SmallWorld world = box_on_ground({Eigen::Vector3f(-3, -3, -10), Eigen::Vector3f(3, 3, 0)}, {0.6f, 0.0f, -0.8f});
  SmallWorld slab;
  slab.add_box({Eigen::Vector3f(-1, -1, -1), Eigen::Vector3f(1, 1, 0)});
  scenes::WaypointMotion way;
  way.points = {{.north_m = -9.4}, {.north_m = -30.0}};
  world.scene.movers.push_back({"slab", slab.scene.meshes.front(), {}, way});
  Renderer renderer = make_renderer(world.scene, Culling::frustum_and_horizon, Shadows::sun);
  const auto level_at = [&](double north_m, double t_s) {
    cv::Mat grey;
    renderer.draw({kShadowCamera, look_at({north_m, 0, -30}, {north_m, 0, 0}), ImageChannel::grey, t_s}, grey);
    return grey.at<uint8_t>(160, 160);
  };
  // The south edge of the roof, 10 m high at -3 m, shades the ground up to -10.5 m and the top of the slab up to -9.75
  // m.
  EXPECT_NEAR(level_at(-9.4, 0.0), kShaded, 1);
  EXPECT_NEAR(level_at(-10.1, 0.7), kLit, 1);
  EXPECT_NEAR(level_at(-10.1, 20.6), kShaded, 1);  // the ground, after the slab has moved away
  EXPECT_NEAR(level_at(-30.0, 20.6), kLit, 1);
  EXPECT_NEAR(level_at(-31.4, 20.6), kLit, 1);  // the ground at the position of a shadow of the slab
}

}  // namespace
}  // namespace hedgehop::sim
