#include "sim/pages/trim_data.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "sim/pages/report_page.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;

TrimPoint point(double speed_mps) {
  return {speed_mps,
          {0.0,
           0.0,
           {{"phi", "deg", speed_mps + 1.0, "Attitude", "roll"},
            {"T", "N", speed_mps + 2.0, "Thrust", "main rotor"},
            {"theta", "deg", speed_mps + 3.0, "Attitude", "pitch"}}}};
}

TEST(TrimData, PutsQuantitiesOfAGroupIntoOnePlotOverTheSpeed) {
  const Json data = trim_data("kite", {point(-2.0), point(0.0), point(4.0)}, {});
  ASSERT_EQ(data["panels"].size(), 2u);
  const Json& attitude = data["panels"][0];
  EXPECT_EQ(attitude["title"], "Attitude");
  EXPECT_EQ(attitude["unit"], "deg");
  EXPECT_EQ(attitude["speed_mps"], Json({-2.0, 0.0, 4.0}));
  ASSERT_EQ(attitude["series"].size(), 2u);
  EXPECT_EQ(attitude["series"][0]["label"], "roll, phi");
  EXPECT_EQ(attitude["series"][0]["values"], Json({-1.0, 1.0, 5.0}));
  EXPECT_EQ(attitude["series"][1]["values"], Json({1.0, 3.0, 7.0}));
  EXPECT_EQ(data["panels"][1]["unit"], "N");
}

TEST(TrimData, DrawsLimitsMarginsAndNamesSpeedsBeyondThem) {
  TrimPoint within = point(0.0), beyond = point(8.0);
  within.flight.quantities.push_back({"theta_c", "deg", 10.0, "Main collective", "main collective", -12.0, 18.0});
  beyond.flight.quantities.push_back({"theta_c", "deg", 20.0, "Main collective", "main collective", -12.0, 18.0});
  const Json data = trim_data("kite", {within, beyond}, {});
  ASSERT_EQ(data["panels"].size(), 4u);
  EXPECT_EQ(data["panels"][2]["limits"].size(), 2u);
  EXPECT_EQ(data["panels"][2]["limits"][1]["value"], 18.0);
  EXPECT_EQ(data["panels"][3]["unit"], "%");
  EXPECT_LT(data["panels"][3]["series"][0]["values"][1].get<double>(), 0.0);
  EXPECT_THAT(data["notes"].dump(), testing::HasSubstr("Not flyable at 8 m/s: theta_c 20 deg, limit 18 deg"));
}

TEST(TrimData, ListsSpeedsWithoutATrim) {
  EXPECT_THAT(trim_data("kite", {point(0.0)}, {20.0, 22.5})["notes"].dump(), testing::HasSubstr("20, 22.5 m/s"));
  EXPECT_THAT(trim_data("kite", {point(0.0)}, {})["notes"].dump(), testing::Not(testing::HasSubstr("No steady")));
}

TEST(TrimPage, ContainsItsDataAndLoadsNoExternalResources) {
  const std::string page = trim_page("Trim of </script> kite", R"({"title": "</script>"})");
  EXPECT_THAT(page, testing::HasSubstr("uPlot"));
  EXPECT_THAT(page, testing::HasSubstr(R"({"title": "\u003c/script>"})"));
  EXPECT_THAT(page, testing::HasSubstr("<title>Trim of &lt;/script&gt; kite"));
  for (const char* outside : {"src=\"http", "href=\"http", "@import", "{{"}) {
    EXPECT_THAT(page, testing::Not(testing::HasSubstr(outside)));
  }
}

}  // namespace
}  // namespace hedgehop::sim
