#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <ostream>
#include <sstream>
#include <string>

#include "tests/sim/cli/ask.h"
#include "tests/sim/record/temporary_folder.h"

namespace hedgehop::sim::cli {
namespace {

using testing::HasSubstr;

const std::string kConfigs = HEDGEHOP_SOURCE_DIR "/configs/";

/// Returns a vehicle file with one changed text.
std::string changed(const std::string& vehicle, const std::string& from, const std::string& to) {
  std::ifstream stream(kConfigs + "vehicles/" + vehicle + ".yaml");
  std::string text = (std::ostringstream() << stream.rdbuf()).str();
  const size_t place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from << " is not in " << vehicle;
  if (place != std::string::npos) text.replace(place, from.size(), to);
  return text;
}

struct Bad {
  std::string name, vehicle, from, to, reason;
  friend std::ostream& operator<<(std::ostream& out, const Bad& bad) { return out << bad.name; }
};
class BadVehicle : public testing::TestWithParam<Bad> {};

TEST_P(BadVehicle, IsRejectedInOneLineWithTheReason) {
  const Bad& bad = GetParam();
  const TemporaryFolder folder;
  const std::string file = folder.path() / "vehicle.yaml";
  std::ofstream(file) << changed(bad.vehicle, bad.from, bad.to);
  for (const std::string& command : {"trim " + file, "linearize " + file,
                                     "run " + kConfigs + "garratt2009_room_0_light.yaml --no-video --set vehicle.use=" +
                                         file + " --out " + folder.path().string() + "/out"}) {
    const Answer answer = ask(command);
    EXPECT_EQ(answer.status, kBadInput) << command;
    EXPECT_THAT(answer.text, HasSubstr(bad.reason)) << command;
    EXPECT_EQ(answer.text.find('\n'), answer.text.size() - 1) << command << " says:\n" << answer.text;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Files, BadVehicle,
    testing::Values(Bad{"NegativeMass", "xcell_60", "mass: 8.2 ", "mass: -8.2 ", "mass.mass"},
                    Bad{"TooHeavy", "xcell_60", "mass: 8.2 ", "mass: 80.0 ", "weighs 784.8"},
                    Bad{"TailTooWeak", "xcell_60", "lowest: -20.0, highest: 20.0", "lowest: -20.0, highest: 5.0",
                        "the tail collective must be 11."},
                    Bad{"UnstableServo", "xcell_60", "damping: 0.5118", "damping: -0.5", "servos.collective.damping"},
                    Bad{"InertiaOfNoBody", "xcell_60", "[0.18, 0.34, 0.28]", "[0.18, 0.34, 0.68]",
                        "mass.inertia': is not that of a rigid body"},
                    Bad{"NegativeMassOfAMulticopter", "hummingbird", "mass: 0.716", "mass: -0.716", "mass.mass"},
                    Bad{"BladeInertiaInKgCm2", "xcell_60", "blade_inertia: 0.038", "blade_inertia: 380",
                        "380 kg cm2 is 0.038 kg m2"},
                    Bad{"RotorInertiaInGCm2", "hummingbird", "inertia: 7.67e-6", "inertia: 76.7",
                        "76.7 g cm2 is 7.67e-06 kg m2"},
                    Bad{"InertiaOfNoBodyAtItsLine", "xcell_60", "[0.18, 0.34, 0.28]", "[0.18, 0.34, 0.68]",
                        "vehicle.yaml:11:12: '"},
                    Bad{"MaxRpm", "hummingbird", "highest_speed: 838", "max_rpm: 8000", "did you mean 'highest_rpm'?"},
                    Bad{"ArmInMillimeters", "hummingbird", "length: 0.17", "length: 170", "170 mm is 0.17 m"},
                    Bad{"ThrustPerRpm2", "hummingbird", "thrust: 8.54858e-6", "thrust: 9.37e-8",
                        "9.37e-08 N per rpm2 is 8.544e-06 N s2"},
                    Bad{"MulticopterTooHeavy", "hummingbird", "mass: 0.716", "mass: 3.0", "cannot lift the vehicle"}),
    [](const auto& bad) { return bad.param.name; });

TEST(GoodVehicle, IsTrimmed) {
  const Answer answer = ask("trim " + kConfigs + "vehicles/xcell_60.yaml --speed 0:8:4");
  EXPECT_EQ(answer.status, 0) << answer.text;
}

}  // namespace
}  // namespace hedgehop::sim::cli
