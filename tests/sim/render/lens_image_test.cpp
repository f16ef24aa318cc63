#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>

#include "tests/sim/render/ray_caster.h"
#include "tests/sim/render/small_world.h"
#include "tests/sim/render/tested_renderer.h"
#include "tests/sim/render/whole_fisheye.h"
#include "tests/vision/camera/random_lenses.h"

/// Images of lenses that are composed of several pinhole images.
namespace hedgehop::sim {
namespace {

using vision::camera::Camera;

// A gradient in all directions reveals every seam.
TEST(LensImage, SkyHasNoSeams) {
  SmallWorld world;
  world.scene.sky = {.horizon = {1.0f, 0.1f, 0.5f}, .zenith = {0.0f, 0.9f, 0.6f}};
  Renderer renderer = make_renderer(world.scene);
  const Camera camera = fisheye(300, 260, 195);
  std::mt19937_64 random(203);
  cv::Mat color;
  double worst = 0.0;
  for (int trial = 0; trial < 6; ++trial) {
    const CameraView view{camera, random_pose(random, 10.0, 10.0, 1.5), ImageChannel::color};
    renderer.draw(view, color);
    for (int row = 0; row < color.rows; ++row) {
      for (int col = 0; col < color.cols; ++col) {
        const Eigen::Vector3d ray_W = view.X_WC.linear() * camera.unit_ray(Eigen::Vector2d(col, row)).value();
        const double up = std::max(0.0, -ray_W.z());
        for (int c = 0; c < 3; ++c) {
          const double horizon = 255.0 * static_cast<double>(world.scene.sky.horizon[c]);
          const double zenith = 255.0 * static_cast<double>(world.scene.sky.zenith[c]);
          worst = std::max(worst, std::abs(color.at<cv::Vec3b>(row, col)[c] - (horizon + up * (zenith - horizon))));
        }
      }
    }
  }
  EXPECT_LE(worst, 1.5);
}

TEST(LensImage, IsEmptyOutsideTheImageCircle) {
  SmallWorld world;
  Renderer renderer = make_renderer(world.scene);
  vision::camera::FisheyeLens lens{60, 60, 99.5, 99.5};
  lens.limit_rad = 1.5;  // 90 px
  const Camera camera(200, 200, lens);
  cv::Mat color, depth, labels;
  const Eigen::Isometry3d X_WC = look_at({0, 0, -5}, {1, 0, -5});
  renderer.draw({camera, X_WC, ImageChannel::color}, color);
  renderer.draw({camera, X_WC, ImageChannel::depth}, depth);
  renderer.draw({camera, X_WC, ImageChannel::labels}, labels);
  for (int row = 0; row < 200; ++row) {
    for (int col = 0; col < 200; ++col) {
      const bool inside = std::hypot(col - 99.5, row - 99.5) < 90.0;
      ASSERT_EQ(color.at<cv::Vec3b>(row, col) != cv::Vec3b(), inside) << col << ", " << row;
      ASSERT_EQ(std::isnan(depth.at<float>(row, col)), !inside) << col << ", " << row;
      ASSERT_EQ(labels.at<int>(row, col), 0);
    }
  }
}

// Compares each pixel with the pixel of the undistorted image on the same ray.
TEST(LensImage, ADistortedImageEqualsTheUndistortedOneAlongTheSameRays) {
  const SmallWorld city = small_city(6, 204);
  Renderer renderer = make_renderer(city.scene);
  const vision::camera::PinholeCamera straight = vision::camera::PinholeCamera::from_fov(320, 240, 1.1);
  vision::camera::PinholeLens lens{straight.focal_x_px, straight.focal_y_px, straight.center_u_px,
                                   straight.center_v_px};
  lens.k1 = -0.2;
  lens.k2 = 0.05;
  lens.p1 = 2e-3;
  const Camera camera(320, 240, lens);
  cv::Mat bent, expected_depth, depth;
  renderer.draw({camera, look_at({-60, 3, -8}, {0, 0, -8}), ImageChannel::depth}, bent);
  renderer.draw({straight, look_at({-60, 3, -8}, {0, 0, -8}), ImageChannel::depth}, expected_depth);
  int compared = 0, different = 0;
  for (int row = 0; row < 240; ++row) {
    for (int col = 0; col < 320; ++col) {
      const auto ray = camera.unit_ray(Eigen::Vector2d(col, row));
      const auto there = straight.project(*ray);
      const int u = static_cast<int>(std::lround(there->x())), v = static_cast<int>(std::lround(there->y()));
      if (u < 0 || v < 0 || u >= 320 || v >= 240) continue;
      ++compared;
      // The nearest pixel of the undistorted image. Slanted surfaces differ slightly over half a pixel.
      const float a = bent.at<float>(row, col), b = expected_depth.at<float>(v, u);
      different += a == b || std::abs(a / b - 1.0f) < 0.03f ? 0 : 1;
    }
  }
  EXPECT_GT(compared, 60'000);
  EXPECT_LT(different, compared / 40);  // at edges
}

TEST(LensImage, DepthEqualsRayCastingOfBoxesAndGround) {
  constexpr double kRelative = 1e-4;
  constexpr double kEdgePx =
      1.5;  // half a pixel of a face, whose resolution may differ from that of the image, and a margin of 1 px
  std::mt19937_64 random(205);
  SmallWorld world;
  RayCaster cast;
  cast.ground_half_m = 300.0;
  for (int i = 0; i < 40; ++i) {
    const Eigen::Vector3d center(uniform(random, -60, 60), uniform(random, -60, 60), uniform(random, -30, -5));
    const Eigen::Vector3d half(uniform(random, 0.5, 8), uniform(random, 0.5, 8), uniform(random, 0.5, 5));
    const Eigen::AlignedBox3f box_W((center - half).cast<float>(), (center + half).cast<float>());
    world.add_box(box_W);
    cast.boxes_W.push_back(box_W.cast<double>());
  }
  world.add_ground(300.0f, 4);
  Renderer renderer = make_renderer(world.scene);
  cv::Mat depth, labels;
  size_t compared = 0, surfaces = 0;
  double worst = 0.0;
  for (int trial = 0; trial < 12; ++trial) {
    const Camera camera = trial % 3 == 0   ? fisheye(220, 200, 195)
                          : trial % 3 == 1 ? vision::random_distorted_pinhole(random)
                                           : vision::random_fisheye(random);
    CameraView view{camera, random_pose(random, 60.0, 30.0, 1.0), ImageChannel::depth};
    const auto inside = [&](const auto& box) { return box.exteriorDistance(view.X_WC.translation()) < 0.3; };
    if (std::ranges::any_of(cast.boxes_W, inside)) continue;
    renderer.draw(view, depth);
    view.channel = ImageChannel::labels;
    renderer.draw(view, labels);
    for (int row = trial % 2; row < depth.rows; row += 2) {
      for (int col = trial % 2; col < depth.cols; col += 2) {
        const std::optional<Hit> hit = clear_hit(cast, view, col, row, kEdgePx);
        if (!hit) continue;
        const auto depth_m = static_cast<double>(depth.at<float>(row, col));
        ++compared;
        if (hit->face < 0) {
          ASSERT_EQ(depth_m, std::numeric_limits<double>::infinity())
              << "trial " << trial << ": " << col << ", " << row;
          ASSERT_EQ(labels.at<int>(row, col), 0);
          continue;
        }
        ++surfaces;
        const bool z = std::holds_alternative<vision::camera::PinholeLens>(camera.lens);
        const double relative = depth_m / (z ? hit->z_m : hit->distance_m);
        ASSERT_NEAR(relative, 1.0, kRelative) << "trial " << trial << ": " << col << ", " << row;
        worst = std::max(worst, std::abs(relative - 1.0));
        if (hit->body() > 0) {
          ASSERT_EQ(labels.at<int>(row, col), hit->body());
        } else {
          ASSERT_GT(labels.at<int>(row, col), 40);
        }
      }
    }
  }
  RecordProperty("worst_relative_1e9", std::to_string(1e9 * worst));
  EXPECT_GT(compared, 50'000u);
  EXPECT_GT(surfaces, 20'000u);
}

/// Returns the mean square difference between an image and the average of a much finer one, 0..255^2.
double coarseness(Renderer& renderer, const Camera& camera, const Camera& fine, const Eigen::Isometry3d& X_WC) {
  cv::Mat image, fine_image, mean;
  renderer.draw({camera, X_WC, ImageChannel::grey}, image);
  renderer.draw({fine, X_WC, ImageChannel::grey}, fine_image);
  cv::resize(fine_image, mean, image.size(), 0, 0, cv::INTER_AREA);
  const double norm = cv::norm(image, mean, cv::NORM_L2);
  return norm * norm / static_cast<double>(image.total());
}

// Blur and aliasing together must not be much larger than for a pinhole.
TEST(LensImage, ErrorIsAtMost25PercentLargerThanForAPinhole) {
  SmallWorld city = small_city(6, 206);
  city.scene.textures = std::vector<cv::Mat>(city.scene.textures.size(), noise_image(256, 207));
  Renderer renderer = make_renderer(city.scene);
  std::mt19937_64 random(208);
  double of_pinhole = 0.0, of_fisheye = 0.0;
  for (int trial = 0; trial < 10; ++trial) {
    const Eigen::Isometry3d X_WC = look_at({uniform(random, -60, 60), uniform(random, -60, 60), -45.0},
                                           {uniform(random, -60, 60), uniform(random, -60, 60), 0.0});
    of_pinhole += coarseness(renderer, vision::camera::PinholeCamera::from_fov(240, 240, 1.2),
                             vision::camera::PinholeCamera::from_fov(1440, 1440, 1.2), X_WC);
    of_fisheye += coarseness(renderer, fisheye(240, 240, 190), fisheye(1440, 1440, 190), X_WC);
  }
  RecordProperty("pinhole_rms_levels", std::to_string(std::sqrt(of_pinhole / 10)));
  RecordProperty("fisheye_rms_levels", std::to_string(std::sqrt(of_fisheye / 10)));
  EXPECT_LT(std::sqrt(of_fisheye / of_pinhole), 1.25);
}

}  // namespace
}  // namespace hedgehop::sim
