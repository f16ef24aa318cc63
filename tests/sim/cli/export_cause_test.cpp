// The cause that `hedgehop export` names if the trajectory differs from that of the run.
#include <gmock/gmock.h>

#include "tests/sim/batch/campaign_folder.h"

namespace hedgehop::sim::cli {
namespace {

using testing::HasSubstr;

TEST(ExportCause, IsTheChangedOneOfTwoFilesOfOneName) {
  const CampaignFolder folder;
  const std::string triangle = "v 41 0 0\nv 40 1 0\nf 1 2 3\n";
  std::filesystem::create_directory(folder.path() / "a");
  std::filesystem::create_directory(folder.path() / "b");
  folder.write("a/post.obj", "v 40 0 0\n" + triangle);
  folder.write("b/post.obj", "v 40 0 1\n" + triangle);
  folder.write("posts.yaml",
               "use: tiny.yaml\nname: posts\nscene: {imports: [{file: a/post.obj, name: one}, {file: b/post.obj, "
               "name: two}]}\n");
  const CommandEnd flown = folder.hedgehop("run posts.yaml --no-video --no-report --out out");
  ASSERT_EQ(flown.status, 0) << flown.err;
  nlohmann::ordered_json result = folder.json("out/result.json");
  result["trajectory_hash"] = "0";
  folder.write("out/result.json", result.dump());
  EXPECT_THAT(folder.hedgehop("export out --format ulog --out same").err, HasSubstr(": another kind of processor;"));
  folder.write("b/post.obj", "v 40 0 2\n" + triangle);
  EXPECT_THAT(folder.hedgehop("export out --format ulog --out changed").err,
              HasSubstr(": b/post.obj has changed since;"));
}

}  // namespace
}  // namespace hedgehop::sim::cli
