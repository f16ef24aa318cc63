// The pace of a flight: `hedgehop run --pace`.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/sim/cli/ask.h"
#include "tests/sim/record/temporary_folder.h"

namespace hedgehop::sim::cli {
namespace {

/// Returns the trajectory hash of a short flight. @param options  further options.
std::string hash_of_run(const std::string& options) {
  const TemporaryFolder folder;
  const Answer answer = ask("run " HEDGEHOP_SOURCE_DIR
                            "/configs/andert2007_tree_160.yaml --renderer tiles --set duration=1 --set 'checks=[]' "
                            "--no-report --no-video --out " +
                            folder.path().string() + " " + options);
  EXPECT_EQ(answer.status, 0) << answer.text;
  std::ifstream file(folder.path() / "result.json");
  return nlohmann::json::parse(file).at("trajectory_hash");
}

/// A pace that no machine reaches never waits; it only steps the flight differently.
TEST(PaceOption, PaceDoesNotChangeTheFlight) { EXPECT_EQ(hash_of_run("--pace 1000000"), hash_of_run("")); }

TEST(PaceOption, PaceMustBePositive) {
  const Answer answer = ask("run " HEDGEHOP_SOURCE_DIR "/configs/andert2007_tree_160.yaml --pace 0");
  EXPECT_EQ(answer.status, kBadInput);
  EXPECT_NE(answer.text.find("--pace"), std::string::npos) << answer.text;
}

}  // namespace
}  // namespace hedgehop::sim::cli
