#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "sim/config/config_tree.h"
#include "sim/config/input_error.h"
#include "sim/export/formats.h"

namespace hedgehop::sim {
namespace {

TEST(EurocFiles, AnyRoleIsTheCommentOfItsSensor) {
  for (const std::string role : {"left", "a: b #1", "\"quoted\"", "[1]"}) {
    SensorRecord record;
    RecordedCamera& camera = record.cameras.emplace_back();
    camera.role = role;
    camera.lens.distortion.assign(8, 0.0);
    int found = 0;
    for (const DataFile& file : euroc_files(record)) {
      if (file.name != "mav0/cam0/sensor.yaml") continue;
      ++found;
      ErrorList errors("sensor");
      const Node sensor = parse_yaml(file.text, "sensor.yaml", errors);
      EXPECT_TRUE(errors.empty()) << file.text;
      ASSERT_NE(sensor.find("comment"), nullptr) << file.text;
      EXPECT_EQ(sensor.find("comment")->text, role);
      EXPECT_EQ(file.text.find("comment: left\n") != std::string::npos, role == "left");
    }
    EXPECT_EQ(found, 1);
  }
}

TEST(KittiFiles, ADistortedLensIsRefusedWithARemedy) {
  SensorRecord record;
  record.cameras.emplace_back().lens.distortion = {0.1, 0.0, 0.0, 0.0, 0.0};
  EXPECT_THAT([&] { kitti_files(record); }, testing::ThrowsMessage<InputError>(testing::HasSubstr("state fov")));
}

}  // namespace
}  // namespace hedgehop::sim
