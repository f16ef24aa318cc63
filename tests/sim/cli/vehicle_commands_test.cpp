#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "tests/sim/cli/ask.h"
#include "tests/sim/record/temporary_folder.h"

namespace hedgehop::sim::cli {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using Json = nlohmann::json;

const std::string kVehicles = HEDGEHOP_SOURCE_DIR "/configs/vehicles/";

/// A file that describes a vehicle.
class VehicleFile {
 public:
  explicit VehicleFile(const std::string& text) { std::ofstream(path()) << text; }
  std::string path() const { return (folder_.path() / "vehicle.yaml").string(); }

 private:
  TemporaryFolder folder_;
};

VehicleFile weak_collective() {
  return VehicleFile("use: " + kVehicles + "xcell_60.yaml\nservos: {collective: {lowest: -2, highest: 8.5}}\n");
}

TEST(Trim, MarksRowsBeyondTheControlStopsAndPrintsMargins) {
  const VehicleFile vehicle = weak_collective();
  const Answer answer = ask("trim " + vehicle.path() + " --speed 0:28:14");
  EXPECT_EQ(answer.status, 0);
  EXPECT_THAT(answer.text, AllOf(HasSubstr("margin"), HasSubstr("  beyond: theta_c"), HasSubstr("limit 8.5 deg"),
                                 HasSubstr("not flyable, at 28 m/s")));
  const Json rows = Json::parse(ask("trim " + vehicle.path() + " --speed 0:28:14 --json 2>/dev/null #").text);
  EXPECT_EQ(rows[0]["within_limits"], true);
  EXPECT_GT(rows[0]["margin_percent"]["theta_c"].get<double>(), 0.0);
  EXPECT_EQ(rows[2]["within_limits"], false);
  EXPECT_LT(rows[2]["margin_percent"]["theta_c"].get<double>(), 0.0);
}

// The named speed has a steady flight, and one a little faster has none.
TEST(Trim, WithoutSteadyFlightNamesTheFastest) {
  const std::string vehicle = kVehicles + "artis.yaml";
  const Answer answer = ask("trim " + vehicle + " --speed 60");
  EXPECT_EQ(answer.status, 2);
  const std::string before = "no steady flight at 60 m/s; a trim exists up to about ";
  const size_t at = answer.text.find(before);
  ASSERT_NE(at, std::string::npos) << answer.text;
  const double fastest_mps = std::stod(answer.text.substr(at + before.size()));
  EXPECT_THAT(answer.text, HasSubstr(", but is not flyable there: beyond theta_c "));
  EXPECT_EQ(ask("trim " + vehicle + " --speed " + std::to_string(fastest_mps - 0.1)).status, 0);
  EXPECT_EQ(ask("trim " + vehicle + " --speed " + std::to_string(fastest_mps + 0.2)).status, 2);
}

TEST(Trim, RefusesAFigureAsThePage) {
  const TemporaryFolder folder;
  const Answer answer = ask("trim " + kVehicles + "s900.yaml --plot " + folder.path().string() + "/trim.svg");
  EXPECT_EQ(answer.status, kBadInput);
  EXPECT_THAT(answer.text, HasSubstr("trim.svg' would be written as .html"));
}

TEST(Trim, RefusesAPageBelowAFile) {
  const VehicleFile file("");
  const Answer answer = ask("trim " + kVehicles + "s900.yaml --plot " + file.path() + "/trim.html");
  EXPECT_EQ(answer.status, kBadInput);
  EXPECT_THAT(answer.text, HasSubstr("vehicle.yaml: cannot write results: "));
}

TEST(Linearize, PrintsNamesOfModesUnitsAndEigenvectors) {
  const Answer answer = ask("linearize " + kVehicles + "xcell_60.yaml --speed 12");
  EXPECT_EQ(answer.status, 0);
  for (const char* part :
       {"phugoid", "Dutch roll", "spiral", "heave subsidence", "du/dt [m/s2]", "[rad/s]", "eigenvector"}) {
    EXPECT_THAT(answer.text, HasSubstr(part));
  }
  const Json json = Json::parse(ask("linearize " + kVehicles + "xcell_60.yaml --speed 12 --json").text);
  EXPECT_EQ(json["A_units"][0][0], "(m/s2)/(m/s)");
  EXPECT_EQ(json["modes"][0]["eigenvector"].size(), json["states"].size());
}

TEST(Linearize, ReportsATrimBeyondTheStops) {
  EXPECT_THAT(ask("linearize " + weak_collective().path() + " --speed 28").text, HasSubstr("beyond the limits"));
}

TEST(Step, PrintsTheFullModelNextToTheLinearOneAndWritesAPage) {
  const TemporaryFolder folder;
  const std::string page = folder.path() / "plots/step.html";  // in a missing folder
  const std::string command = "step " + kVehicles + "xcell_60.yaml --input longitudinal --size 0.2deg";
  const Answer answer = ask(command + " --duration 2 --plot " + page);
  EXPECT_EQ(answer.status, 0);
  EXPECT_THAT(answer.text, AllOf(HasSubstr("q [deg/s]"), HasSubstr("linear"), HasSubstr("q: peak")));
  EXPECT_TRUE(std::filesystem::exists(page));
  const Json json = Json::parse(ask(command + " --shape doublet --duration 2 --json").text);
  EXPECT_EQ(json["t_s"].size(), json["states"]["q"].size());
}

TEST(Step, RejectsOtherControlsUnitsAndSizesBeyondTheStops) {
  const std::string command = "step " + kVehicles + "xcell_60.yaml ";
  EXPECT_THAT(ask(command + "--input pedal --size 1deg").text, HasSubstr("collective, lateral, longitudinal, tail"));
  EXPECT_THAT(ask(command + "--input tail --size 1").text, HasSubstr("in deg or rad, such as 1deg"));
  EXPECT_THAT(ask(command + "--input tail --size 1N").text, HasSubstr("in deg or rad"));
  const Answer beyond = ask(command + "--input longitudinal --size 9deg");
  EXPECT_EQ(beyond.status, kBadInput);
  EXPECT_THAT(beyond.text, HasSubstr("beyond the stops -8 and 8 deg"));
}

TEST(Identify, PrintsTheIdentifiedResponseNextToTheLinearModel) {
  const Answer answer = ask("identify " + kVehicles + "xcell_60.yaml --input lateral --from 1 --duration 40");
  EXPECT_EQ(answer.status, 0);
  EXPECT_THAT(answer.text, AllOf(HasSubstr("p per lateral"), HasSubstr("coherence"), HasSubstr("mismatch")));
  EXPECT_THAT(ask("identify " + kVehicles + "xcell_60.yaml --input lateral --from 0.1 --duration 40").text,
              HasSubstr("four periods"));
}

TEST(Units, ARotorSpeedInRpmIsRecognizedAtItsPlace) {
  const std::string rotor = "use: " + kVehicles + "gtmax.yaml\nmain_rotor: {radius: 1.54, ";
  const VehicleFile wrong(rotor + "speed: 870}\n");
  const Answer answer = ask("trim " + wrong.path());
  EXPECT_EQ(answer.status, kBadInput);
  EXPECT_THAT(
      answer.text,
      AllOf(HasSubstr(wrong.path() + ":2:"),
            HasSubstr("870: tip speed 1340 m/s, faster than sound; 870 rpm is 91.1 rad/s; did you mean `rpm: 870`?")));
  const auto trimmed = [&rotor](const std::string& speed) {
    return Json::parse(ask("trim " + VehicleFile(rotor + speed + "}\n").path() + " --json").text);
  };
  const Json by_rpm = trimmed("rpm: 870"), by_speed = trimmed("speed: 91.106186954104");
  EXPECT_NEAR(by_rpm[0]["theta_c"].get<double>(), by_speed[0]["theta_c"].get<double>(), 1e-9);
}

}  // namespace
}  // namespace hedgehop::sim::cli
