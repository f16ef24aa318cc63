#include "sim/render/tiles/box_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "sim/render/tiles/box_camera.h"
#include "sim/render/tiles/box_queue.h"
#include "sim/render/tiles/frame_memory.h"

namespace hedgehop::sim::tiles {
namespace {

/// Returns boxes like those of a town: 3 to 20 m wide, on the ground, within some distance north and east.
std::vector<Eigen::AlignedBox3f> random_boxes(size_t count, float extent_m, std::mt19937_64& random) {
  std::uniform_real_distribution<float> place(-extent_m, extent_m), size(3.0f, 20.0f);
  std::vector<Eigen::AlignedBox3f> boxes;
  for (size_t i = 0; i < count; ++i) {
    const Eigen::Vector3f low(place(random), place(random), -size(random));
    boxes.emplace_back(low, Eigen::Vector3f(low.x() + size(random), low.y() + size(random), 0.0f));
  }
  return boxes;
}

Eigen::AlignedBox3f box_of_lane(const EightBoxes& boxes, size_t lane) {
  return {Eigen::Vector3f(boxes.low_m[0][lane], boxes.low_m[1][lane], boxes.low_m[2][lane]),
          Eigen::Vector3f(boxes.high_m[0][lane], boxes.high_m[1][lane], boxes.high_m[2][lane])};
}

/// Counts the boxes below a node and expects them to be in the boxes of their ancestors.
void visit(const BoxTree& tree, uint32_t index, const Eigen::AlignedBox3f& parent,
           const std::vector<Eigen::AlignedBox3f>& boxes, std::vector<int>& found) {
  const BoxTree::Node& node = tree.nodes()[index];
  for (size_t lane = 0; lane < 8; ++lane) {
    if ((node.lanes >> lane & 1) == 0) continue;
    const Eigen::AlignedBox3f box = box_of_lane(node.boxes_W, lane);
    EXPECT_TRUE(parent.contains(box));
    if ((node.children[lane] & BoxTree::kLeaf) == 0) {
      visit(tree, node.children[lane], box, boxes, found);
      continue;
    }
    const uint32_t leaf = tree.leaves()[node.children[lane] & ~BoxTree::kLeaf];
    EXPECT_TRUE(box.isApprox(boxes[leaf], 0.0f));
    ++found[leaf];
  }
}

TEST(BoxTree, HasEachBoxOnceInTheBoxesOfItsAncestors) {
  std::mt19937_64 random(1);
  const Eigen::AlignedBox3f everything(Eigen::Vector3f::Constant(-1e6f), Eigen::Vector3f::Constant(1e6f));
  for (const size_t count : {1, 2, 7, 8, 9, 65, 1000}) {
    std::vector<Eigen::AlignedBox3f> boxes = random_boxes(count, 2000.0f, random);
    if (count > 8) std::fill(boxes.begin(), boxes.begin() + 5, boxes.front());  // equal centers
    std::vector<int> found(count);
    visit(BoxTree(boxes), 0, everything, boxes, found);
    EXPECT_EQ(std::ranges::count(found, 1), static_cast<std::ptrdiff_t>(count));
  }
  EXPECT_TRUE(BoxTree().nodes().empty());
  EXPECT_TRUE(BoxTree(std::vector<Eigen::AlignedBox3f>{}).nodes().empty());
}

TEST(BoxQueue, ReturnsAllEntriesFromNearToFarWithinSixPercent) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<float> octaves(0.0f, 13.0f);  // 1 m to 8 km
  std::vector<float> distances_m{0.0f, 0.5f};
  while (distances_m.size() < 500) distances_m.push_back(std::exp2(octaves(random)));
  BoxQueue queue;
  for (uint32_t i = 0; i < distances_m.size(); ++i) queue.push(i, 0, {}, distances_m[i] * distances_m[i]);
  std::vector<int> found(distances_m.size());
  float farthest_m = 1.0f;  // the order of nearer ones is arbitrary
  while (!queue.empty()) {
    const uint32_t i = queue.pop().child;
    ++found[i];
    EXPECT_GT(1.061f * std::max(1.0f, distances_m[i]), farthest_m);
    farthest_m = std::max(farthest_m, distances_m[i]);
  }
  EXPECT_EQ(std::ranges::count(found, 1), static_cast<std::ptrdiff_t>(found.size()));
}

/// The oracle projects random points of the boxes in double precision.
TEST(BoxTree, ReportsEachBoxThatAnEmptyImageShowsAndItsPixels) {
  constexpr double kNearM = 0.05, kFocalPx = 100.0, kCenterPx = 99.5;
  constexpr int kSizePx = 200;
  const PinholeImage lens{kFocalPx, kFocalPx, 1.0 / kFocalPx, 1.0 / kFocalPx, kCenterPx, kCenterPx, kSizePx, kSizePx};
  const Kernels& kernels = chosen_kernels();
  FrameMemory memory(1);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int shown = 0, left_out = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const double extent_m = std::pow(10.0, 1.0 + 2.7 * unit(random));
    const Eigen::Vector3d eye(extent_m * (2.0 * unit(random) - 1.0), extent_m * (2.0 * unit(random) - 1.0), -10.0);
    const Eigen::Matrix3d R_CW =
        Eigen::Quaterniond(unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5)
            .normalized()
            .toRotationMatrix();
    ViewPose pose{};
    for (int i = 0; i < 3; ++i) {
      pose.p_m[i] = eye[i];
      for (int k = 0; k < 3; ++k) pose.R_CW[3 * i + k] = R_CW(i, k);
    }
    const std::vector<Eigen::AlignedBox3f> boxes = random_boxes(8, static_cast<float>(extent_m), random);
    const BoxTree tree(boxes);
    const BoxTree::Node& node = tree.nodes().front();
    EightViews views{};
    const uint32_t seen =
        kernels.see(memory.begin(lens, 1), box_camera(lens, pose, kNearM), node.boxes_W, node.lanes, false, views);
    for (size_t lane = 0; lane < 8; ++lane) {
      const bool is_seen = (seen >> lane & 1) != 0;
      left_out += is_seen ? 0 : 1;
      const Eigen::AlignedBox3f box = box_of_lane(node.boxes_W, lane);
      for (int sample = 0; sample < 200; ++sample) {
        const Eigen::Vector3d share(unit(random), unit(random), unit(random));
        const Eigen::Vector3d p_W = box.min().cast<double>() + share.cwiseProduct(box.sizes().cast<double>());
        const Eigen::Vector3d p_C = R_CW * (p_W - eye);
        if (p_C.z() < kNearM) continue;
        const double u = kFocalPx * p_C.x() / p_C.z() + kCenterPx, v = kFocalPx * p_C.y() / p_C.z() + kCenterPx;
        // A pixel center counts if the point is on it, within the rounding of the test's own shift.
        const Eigen::Vector2d pixel(std::round(u), std::round(v));
        const double last = kSizePx - 1;
        if (pixel.minCoeff() < 0.0 || pixel.maxCoeff() > last) continue;
        const Eigen::Vector3d moved_C =
            p_C.z() * Eigen::Vector3d((pixel.x() - kCenterPx) / kFocalPx, (pixel.y() - kCenterPx) / kFocalPx, 1.0);
        const Eigen::Vector3d moved_W = R_CW.transpose() * moved_C + eye;
        if (!Eigen::AlignedBox3d(box.cast<double>()).contains(moved_W)) continue;
        ++shown;
        ASSERT_TRUE(is_seen) << "trial " << trial;
        const PixelBox& around = views.pixels[lane];
        if (std::isinf(around.nearest)) continue;  // it crosses the near plane
        ASSERT_TRUE(around.left <= pixel.x() && pixel.x() <= around.right);
        ASSERT_TRUE(around.top <= pixel.y() && pixel.y() <= around.bottom);
        ASSERT_GE(static_cast<double>(around.nearest) * moved_C.z(), 1.0);
      }
    }
  }
  EXPECT_GT(shown, 1000);
  EXPECT_GT(left_out, 300);  // most boxes are behind the camera or next to the image
}

}  // namespace
}  // namespace hedgehop::sim::tiles
