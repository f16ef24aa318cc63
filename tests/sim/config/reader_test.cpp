#include "sim/config/reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sample_config.h"
#include "tests/sim/config/input_files.h"

namespace hedgehop::sim {
namespace {

using sample::Sample;
using testing::ElementsAre;

/// The one fault of a file.
std::string fault(const std::string& text) {
  Folder folder;
  Folder::write("a.yaml", text);
  const std::vector<std::string> faults = faults_of([] { load_struct<Sample>("a.yaml"); });
  EXPECT_EQ(faults.size(), 1u) << text;
  return faults.empty() ? "" : faults[0];
}

Sample read(const std::string& text) {
  Folder folder;
  Folder::write("a.yaml", text);
  return load_struct<Sample>("a.yaml");
}

TEST(Reader, UnknownKey) {
  EXPECT_EQ(fault("mass: 3\nrotor:\n  radius: 1\n  blade_cnt: 3\n"),
            "a.yaml:4:3: unknown key 'blade_cnt' in 'rotor'; did you mean 'blade_count'? allowed: blade_count, radius");
  EXPECT_EQ(fault("shape: {type: round, side: 3}"),
            "a.yaml:1:22: unknown key 'side' in 'shape'; allowed: type, radius");
}

TEST(Reader, MissingKey) {
  EXPECT_EQ(fault("mass: 3\nshape: {type: square}\n"), "a.yaml:2:8: missing key 'side' in 'shape': side (m)");
  EXPECT_EQ(fault("shape: {radius: 3}"), "a.yaml:1:8: missing key 'type' in 'shape'; allowed: round, square");
}

TEST(Reader, WrongType) {
  EXPECT_EQ(fault("mass: abc"), "a.yaml:1:7: 'mass' expects a number in kg, got 'abc'");
  EXPECT_EQ(fault("mass: '3'"), "a.yaml:1:7: 'mass' expects a number in kg, got the text '3'");
  EXPECT_EQ(fault("mass: [3]"), "a.yaml:1:7: 'mass' expects a number in kg, got a list");
  EXPECT_EQ(fault("mass:\nname: x"), "a.yaml:1:1: 'mass' expects a number in kg, got an empty value");
  EXPECT_EQ(fault("whole: 3.5"), "a.yaml:1:8: 'whole' expects a whole number, got '3.5'");
  EXPECT_EQ(fault("on: yes"), "a.yaml:1:5: 'on' expects true or false, got 'yes'");
  EXPECT_EQ(fault("name: {a: b}"), "a.yaml:1:7: 'name' expects a text, got a map");
  EXPECT_EQ(fault("rotor: 3"), "a.yaml:1:8: 'rotor' expects a map of keys, got '3'");
  EXPECT_EQ(fault("rotors: {radius: 3}"), "a.yaml:1:9: 'rotors' expects a list, got a map");
  EXPECT_EQ(fault("gains: [1, x]"), "a.yaml:1:12: 'gains.1' expects a number, got 'x'");
  EXPECT_EQ(fault("size: [1, 2, 3]"), "a.yaml:1:7: 'size' expects a list of 2 numbers, got 3");
  EXPECT_EQ(fault("color: [grey]"), "a.yaml:1:8: 'color' expects one of: grey, color, got a list");
}

TEST(Reader, NotFinite) {
  EXPECT_EQ(fault("mass: .nan"), "a.yaml:1:7: 'mass': must be finite, got .nan");
  EXPECT_EQ(fault("trim: -.inf"), "a.yaml:1:7: 'trim': must be finite, got -.inf");
  EXPECT_EQ(fault("size: [1, 1e999]"), "a.yaml:1:11: 'size.1': must be finite, got 1e999");
}

TEST(Reader, OutOfBounds) {
  EXPECT_EQ(fault("mass: 0"), "a.yaml:1:7: 'mass': must be > 0 kg, got 0");
  EXPECT_EQ(fault("mass: 100"), "a.yaml:1:7: 'mass': must be < 100 kg, got 100");
  EXPECT_EQ(fault("tilt: 60.5"), "a.yaml:1:7: 'tilt': must be <= 60 deg, got 60.5");
  EXPECT_EQ(fault("rotor: {blade_count: 0}"), "a.yaml:1:22: 'rotor.blade_count': must be >= 1, got 0");
  EXPECT_EQ(fault("gains: [1, -1]"), "a.yaml:1:12: 'gains.1': must be >= 0, got -1");
  EXPECT_EQ(fault("delay: -1"), "a.yaml:1:8: 'delay': must be >= 0 s, got -1");
  EXPECT_EQ(fault("whole: 2147483648"),
            "a.yaml:1:8: 'whole': must be between -2147483648 and 2147483647, got 2147483648");
  EXPECT_EQ(fault("rotor: {blade_count: 999999999999999999999}"),
            "a.yaml:1:22: 'rotor.blade_count': must be <= 8, got 999999999999999999999");
  EXPECT_EQ(fault("rotor: {blade_count: -9999999999}"),
            "a.yaml:1:22: 'rotor.blade_count': must be >= 1, got -9999999999");
  EXPECT_EQ(fault("seed: -1"), "a.yaml:1:7: 'seed': must be between 0 and 18446744073709551615, got -1");
}

TEST(Reader, UnknownChoice) {
  EXPECT_EQ(fault("color: gray"),
            "a.yaml:1:8: unknown choice 'gray' for 'color'; did you mean 'grey'? allowed: grey, color");
  EXPECT_EQ(fault("shapes:\n- {check: rond}"),
            "a.yaml:2:11: unknown choice 'rond' for 'shapes.0.check'; did you mean 'round'? allowed: round, square");
}

TEST(Reader, ListsEveryFaultInTheOrderOfTheFile) {
  Folder folder;
  Folder::write("a.yaml", "seed: x\nrotor: {radius: .nan}\nmas: 1\nmass: -1\nmass: 1\n");
  EXPECT_THAT(faults_of([] { load_struct<Sample>("a.yaml"); }),
              ElementsAre("a.yaml:1:7: 'seed' expects a whole number, got 'x'",
                          "a.yaml:2:17: 'rotor.radius': must be finite, got .nan",
                          testing::StartsWith("a.yaml:3:1: unknown key 'mas' in the scenario; did you mean 'mass'?"),
                          "a.yaml:4:7: 'mass': must be > 0 kg, got -1",
                          "a.yaml:5:1: duplicate key 'mass' in the scenario; first at line 4"));
}

TEST(Reader, ReadsEveryKind) {
  const Sample sample = read(
      "{mass: 3, tilt: 30, rate: 180, whole: -4, large: 9000000000, seed: 18446744073709551615, on: false, name: 5,"
      " color: color, rotor: {radius: 2}, rotors: [{}, {blade_count: 3}], gains: [], words: [a, 'b c'], size: [3, 4],"
      " lever: [0, 90, 180], delay: 0.5, tail: ~, shape: {type: square, side: 4}, shapes: [{check: round}]}");
  EXPECT_EQ(sample.mass_kg, 3.0);
  EXPECT_DOUBLE_EQ(sample.tilt_rad, 0.52359877559829887);
  EXPECT_DOUBLE_EQ(sample.rate_radps, 3.1415926535897932);
  EXPECT_EQ(sample.whole, -4);
  EXPECT_EQ(sample.large, 9000000000);
  EXPECT_EQ(sample.seed, UINT64_MAX);
  EXPECT_FALSE(sample.on);
  EXPECT_EQ(sample.name, "5");
  EXPECT_EQ(sample.color, sample::Color::color);
  EXPECT_EQ(sample.rotor.radius_m, 2.0);
  EXPECT_EQ(sample.rotor.blade_count, 2);
  ASSERT_EQ(sample.rotors.size(), 2u);
  EXPECT_EQ(sample.rotors[1].blade_count, 3);
  EXPECT_TRUE(sample.gains.empty());
  EXPECT_THAT(sample.words, ElementsAre("a", "b c"));
  EXPECT_EQ(sample.size_m, Eigen::Vector2d(3.0, 4.0));
  EXPECT_DOUBLE_EQ(sample.lever_rad.z(), 3.1415926535897932);
  EXPECT_EQ(sample.delay_s, 0.5);
  EXPECT_FALSE(sample.tail);
  EXPECT_EQ(std::get<sample::Square>(sample.shape).side_m, 4.0);
  EXPECT_EQ(sample.shapes.size(), 1u);
}

}  // namespace
}  // namespace hedgehop::sim
