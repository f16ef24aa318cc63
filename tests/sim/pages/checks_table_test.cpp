#include <gmock/gmock.h>

#include "sim/pages/report.h"
#include "tests/sim/pages/browser.h"
#include "tests/sim/pages/run_folder.h"

namespace hedgehop::sim {
namespace {

TEST(ChecksTableInBrowser, TinyValuesOfChecksAreShort) {
  HEDGEHOP_NEEDS_BROWSER();
  const RunFolder run;
  Flight flight = fake_flight(10.0, 1);
  flight.result.checks = {{"no_collision", false, -0.0001637, 0.0, "m", ">"}, {"gap", true, 0.00921, 0.0092, "m", ">"}};
  write_result_files(run.path(), {.scenario = "tiny", .seed = 1, .scenario_yaml = run.yaml()}, flight);
  write_report(run.path(), read_run(run.path()));
  const PageVisit page = visit(run.path() / "report.html", R"js(
    return [...document.querySelectorAll('#checks tr')].slice(1).map((tr) => tr.children[2].textContent);)js");
  EXPECT_EQ(page.value, nlohmann::json::array({"\u22120.00016 m", "0.00921 m"}));
}

}  // namespace
}  // namespace hedgehop::sim
