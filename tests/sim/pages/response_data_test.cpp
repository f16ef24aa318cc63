#include "sim/pages/response_data.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "dynamics/identification/test_inputs.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;
namespace identification = dynamics::identification;

TEST(StepData, PlotsBothModelsInReadableUnitsOverTime) {
  const dynamics::helicopter::HelicopterConfig vehicle;
  const identification::TestFlight test{
      .input = [](double) { return dynamics::Controls(1e-3 * dynamics::Controls::Unit(dynamics::kPitch)); },
      .duration_s = 0.5,
      .gain = {},
      .steps_per_sample = 50};
  const auto linear = *dynamics::linear_system(vehicle, Eigen::Vector3d::Zero());
  const identification::Record record = *identification::fly_test(vehicle, test);
  const Eigen::MatrixXd states = identification::linear_states(linear.system, record);
  const Json data =
      step_data({"title", {"note"}, "longitudinal", "deg", 57.3, dynamics::kPitch, {4}}, linear, record, states);
  EXPECT_EQ(data["axis"]["key"], "t_s");
  ASSERT_EQ(data["panels"].size(), 10u);
  const Json& q = data["panels"][1];
  EXPECT_EQ(q["title"], "pitch rate, q");
  EXPECT_EQ(q["unit"], "deg/s");
  ASSERT_EQ(q["series"].size(), 2u);
  EXPECT_EQ(q["series"][0]["values"].size(), q["t_s"].size());
  EXPECT_NEAR(q["series"][0]["values"].back().get<double>(), record.states(record.states.rows() - 1, 4) * 57.29577951,
              1e-6);
}

TEST(ReadableUnit, IsInDegrees) {
  EXPECT_EQ(readable_unit("rad").first, "deg");
  EXPECT_EQ(readable_unit("rad/s").first, "deg/s");
  EXPECT_EQ(readable_unit("m/s"), (std::pair<std::string, double>("m/s", 1.0)));
}

}  // namespace
}  // namespace hedgehop::sim
