#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/sim/batch/campaign_folder.h"
#include "tests/sim/pages/browser.h"

namespace hedgehop::sim {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(RunsPage, ListsAllResultsOfAFolderTreeSorted) {
  HEDGEHOP_NEEDS_BROWSER();
  const CampaignFolder folder;
  const std::string quick = " --no-video --no-report --renderer tiles ";
  const std::string words = " --set 'tags=[wind, first]' --set 'notes=gain < 2'";
  ASSERT_LE(folder.hedgehop("run tiny.yaml --seed 3 --out all/b/run" + quick + words).status, 1);
  ASSERT_LE(folder.hedgehop("run tiny.yaml --seed 1 --out all/a" + quick).status, 1);
  ASSERT_LE(folder.hedgehop("batch tiny.yaml --seeds 5 --out all/batch").status, 1);
  std::filesystem::create_directories(folder.path() / "all/search");
  write_file_whole(folder.path() / "all/search/falsify.csv", folder.read("all/batch/batch.csv"));
  ASSERT_EQ(folder.hedgehop("runs all").status, 0);
  const PageVisit page = visit(folder.path() / "all/index.html", R"js(
    const rows = () => [...document.querySelectorAll('#runs tbody tr')].map((tr) => tr.children[3].textContent);
    document.querySelector('#runs th[data-column="seed"]').click();
    const search = [...document.querySelectorAll('#campaigns tbody tr')].find((tr) => tr.children[1].textContent === 'search');
    const seen = {search: search.children[5].textContent, rising: rows(), campaigns: document.querySelectorAll('#campaigns tbody tr').length,
                  module: document.querySelector('#runs tbody tr').children[2].textContent};
    document.querySelector('#inside input').click();
    seen.all = rows();
    document.getElementById('filter').value = 'b/run';
    document.getElementById('filter').dispatchEvent(new Event('input'));
    seen.filtered = rows();
    seen.text = document.querySelector('#runs tbody tr').textContent;
    return seen;)js");
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_THAT(page.requests, IsEmpty());
  EXPECT_THAT(page.value.at("text").get<std::string>(), AllOf(HasSubstr("wind"), HasSubstr("gain < 2")));
  EXPECT_EQ(page.value.at("rising"), (std::vector<std::string>{"1", "3"}));
  EXPECT_EQ(page.value.at("all"), (std::vector<std::string>{"1", "3", "5"}));
  EXPECT_EQ(page.value.at("filtered"), (std::vector<std::string>{"3"}));
  EXPECT_EQ(page.value.at("campaigns"), 2);
  EXPECT_THAT(page.value.at("search").get<std::string>(), ::testing::StartsWith("20")) << "the year of its date";
  EXPECT_EQ(page.value.at("module"), "go_to_goal");
  EXPECT_EQ(folder.hedgehop("runs configs").status, 2);
}

TEST(RunAgainst, ShowsBothFilmsWithTheControlsBelow) {
  HEDGEHOP_NEEDS_BROWSER();
  const CampaignFolder folder;
  const std::string quick = " --no-report --renderer tiles ";
  ASSERT_LE(folder.hedgehop("run tiny.yaml --out a" + quick).status, 1);
  ASSERT_LE(folder.hedgehop("run tiny.yaml --out b" + quick).status, 1);
  if (!std::filesystem::exists(folder.path() / "a/video.webm")) GTEST_SKIP() << "this build writes no films";
  ASSERT_EQ(folder.hedgehop("report b --against a").status, 0);
  const PageVisit page = visit(folder.path() / "b/report.html", R"js(
    const films = [...document.querySelectorAll('#against video')];
    return [films.length, films.filter((film) => film.controls).length, document.querySelectorAll('#against .film-bar').length];)js");
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_EQ(page.value, nlohmann::json::array({2, 0, 2}));
}

TEST(RunAgainst, NamesTheFirstDifferenceAndTheSettings) {
  HEDGEHOP_NEEDS_BROWSER();
  const CampaignFolder folder;
  const std::string quick = " --no-video --no-report --renderer tiles --set duration=1 ";
  ASSERT_LE(folder.hedgehop("run tiny.yaml --out a" + quick).status, 1);
  ASSERT_LE(folder.hedgehop("run tiny.yaml --out b --set avoidance.speed=1" + quick).status, 1);
  ASSERT_EQ(folder.hedgehop("report b --against a").status, 0);
  const PageVisit page = visit(folder.path() / "b/report.html", R"js(
    const host = document.getElementById('against');
    return {lines: [...host.querySelectorAll('.first-difference')].map((p) => p.textContent), text: host.textContent,
            plots: host.querySelectorAll('.u-wrap').length};)js");
  EXPECT_THAT(page.errors, IsEmpty());
  ASSERT_FALSE(page.value.at("lines").empty());
  EXPECT_THAT(
      page.value.at("lines")[0].get<std::string>(),
      ::testing::MatchesRegex("First decision that differs at 0.0[0-9]* s: column [a-z_]+ is [-0-9.]{1,7} here, .*"));
  EXPECT_THAT(page.value.at("text").get<std::string>(), HasSubstr("avoidance.speed, m/s"));
  EXPECT_GT(page.value.at("plots"), 2);
  ASSERT_EQ(folder.hedgehop("report a --against a").status, 0);
  EXPECT_THAT(folder.read("a/report.html"), HasSubstr("The trajectories are equal, bit for bit."));
}

}  // namespace
}  // namespace hedgehop::sim
