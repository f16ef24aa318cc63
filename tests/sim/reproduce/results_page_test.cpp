#include "sim/reproduce/results_page.h"

#include <gmock/gmock.h>

#include <regex>
#include <set>
#include <sstream>
#include <utility>

#include "sim/config/whole_file.h"
#include "sim/flight/build.h"

namespace hedgehop::sim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line.substr(1));
  for (std::string cell; std::getline(stream, cell, '|');) {
    cells.push_back(cell.size() > 1 ? cell.substr(1, cell.size() - 2) : "");
  }
  return cells;
}

/// Rows whose column `build` holds another build than the page's header, or a header without one.
std::vector<std::string> wrong_builds(const std::string& page) {
  std::smatch header;
  if (!std::regex_search(page, header, std::regex("\\nBuild `([0-9a-f]{16})`"))) return {"no build in the header"};
  std::vector<std::string> wrong;
  std::istringstream lines(page);
  size_t column = 0;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("|") || line.starts_with("|---")) continue;
    const std::vector<std::string> cells = cells_of(line);
    const auto heading = std::ranges::find(cells, "build");
    if (heading != cells.end()) {
      column = static_cast<size_t>(heading - cells.begin());
    } else if (column == 0 || cells.at(column) != header[1]) {
      wrong.push_back(cells[0]);
    }
  }
  return wrong;
}

RowsOfPapers rows_of(const std::vector<std::string>& builds) {
  RowsOfPapers papers{{Paper{.key = "p", .title = "T", .source = "S"}, {}}};
  for (const std::string& build : builds) {
    RowOutcome row{.row = {}, .modified = {}, .variants = {}, .holds = true, .command = "hedgehop batch a.yaml"};
    row.row.claim = "claim of " + build;
    row.builds = {build};
    papers[0].second.push_back(row);
  }
  return papers;
}

std::string page_of(const std::vector<std::string>& builds) {
  const RowsOfPapers papers = rows_of(builds);
  return results_page(papers, page_facts(papers, "Mesa 1", false));
}

TEST(ResultsPage, NamesItsBuildAndThatOfEachRow) {
  const std::string own(build_identity());
  EXPECT_THAT(wrong_builds(page_of({own, own})), IsEmpty());
  EXPECT_THAT(page_of({own}), StartsWith("# Results\n\nBuild `" + own + "`"));
}

TEST(ResultsPage, NamesTheCommitOfItsBuildIfKnown) {
  const RowsOfPapers papers = rows_of({"b"});
  PageFacts facts = page_facts(papers, "Mesa 1", false);
  facts.commit = "44e015e";
  EXPECT_THAT(results_page(papers, facts), HasSubstr("` of commit 44e015e, Hedgehop "));
  facts.commit = "";
  EXPECT_THAT(results_page(papers, facts), HasSubstr("`, Hedgehop "));
}

TEST(ResultsPage, ItsCommandNamesThePapersThatItHolds) {
  RowsOfPapers papers = rows_of({"b"});
  papers.push_back(papers[0]);
  papers[0].first.key = "one2001";
  papers[1].first.key = "two2002";
  EXPECT_THAT(results_page(papers, page_facts(papers, "Mesa 1", false)),
              HasSubstr("\nhedgehop reproduce one2001 two2002 --write docs/results.md\n"));
}

/// Rows of one paper each, of this build.
RowsOfPapers one_row_of(const std::vector<std::string>& keys) {
  RowsOfPapers papers;
  for (const std::string& key : keys) {
    papers.push_back(rows_of({std::string(build_identity())})[0]);
    papers.back().first.key = papers.back().first.title = key;
  }
  return papers;
}

std::string page_of_papers(const RowsOfPapers& papers, const std::string& earlier = "",
                           const char* packages = "Mesa 1") {
  return results_page(papers, page_facts(papers, packages, false), earlier);
}

TEST(ResultsPage, WrittenByPaperInAnyOrderEqualsThePageOfAll) {
  const RowsOfPapers all = one_row_of({"a2001", "b2002", "c2003"});
  std::string page = page_of_papers({all[1]});
  page = page_of_papers({all[2]}, page);
  page = page_of_papers({all[0]}, page);
  EXPECT_EQ(page, page_of_papers(all));
  RowsOfPapers again = {all[1]};
  again[0].second[0].row.claim = "another claim";
  page = page_of_papers(again, page);
  EXPECT_EQ(page, page_of_papers({all[0], again[0], all[2]}));
}

TEST(ResultsPage, DropsPapersOfOtherBuildsAndPackagesAndOfInvalidPages) {
  const RowsOfPapers all = one_row_of({"a2001", "b2002"});
  const std::string alone = page_of_papers({all[0]});
  EXPECT_EQ(page_of_papers({all[0]}, page_of_papers({all[1]}, "", "Mesa 2")), alone);
  std::string other = page_of_papers({all[1]});
  other.replace(other.find(build_identity()), 4, "0000");
  EXPECT_EQ(page_of_papers({all[0]}, other), alone);
  EXPECT_EQ(page_of_papers({all[0]}, "# Notes\n\n## b2002\n"), alone);
  EXPECT_EQ(page_of_papers({all[0]}, page_of_papers({all[1]}) + "\n## Mine\n"), alone);
}

TEST(ResultsPage, ReportsSeveralBuildsInItsFirstLineAndIsRefused) {
  const std::string own(build_identity());
  const std::string page = page_of({own, "0123456789abcdef"});
  EXPECT_THAT(page.substr(0, page.find('\n')), HasSubstr("Rows of 2 builds: "));
  EXPECT_THAT(wrong_builds(page), ElementsAre("claim of 0123456789abcdef"));
}

TEST(ResultsPage, TheShippedPageHasOneBuild) {
  EXPECT_THAT(wrong_builds(read_file_whole(HEDGEHOP_SOURCE_DIR "/docs/results.md")), IsEmpty());
}

TEST(ResultsPage, ListsDeviationsOfThePublishedLaw) {
  RowsOfPapers papers = rows_of({"b"});
  papers[0].first.deviations = {"images of another camera"};
  papers[0].first.moved_on = "the law was changed after a look";
  const std::string page = results_page(papers, page_facts(papers, "Mesa 1", false));
  EXPECT_THAT(page, HasSubstr("- images of another camera\n"));
  EXPECT_THAT(page, HasSubstr("the law was changed after a look"));
}

TEST(ResultsPage, KeepsPapersThatOtherRenderersDrewAndNamesAllRenderers) {
  const RowsOfPapers all = one_row_of({"a2001", "b2002"});
  const auto page = [&](const RowsOfPapers& papers, std::set<std::string> renderers, const std::string& earlier) {
    return results_page(papers, page_facts(papers, "OpenCV 4", false, std::move(renderers)), earlier);
  };
  const std::string first = page({all[0]}, {"renderer tiles"}, "");
  EXPECT_THAT(first, HasSubstr(", renderer tiles, OpenCV 4. Written by\n"));
  const std::string both = page({all[1]}, {"renderer Mesa 22.3.6"}, first);
  EXPECT_EQ(both, page(all, {"renderer Mesa 22.3.6", "renderer tiles"}, ""));
  EXPECT_EQ(page({all[1]}, {}, both), both) << "no flight has a result";
  EXPECT_THAT(dropped_sections(first, both), IsEmpty());
}

TEST(ResultsPage, ListsTheSectionsThatItDrops) {
  const RowsOfPapers all = one_row_of({"a2001", "b2002"});
  const std::string page = page_of_papers({all[0]}, page_of_papers({all[1]}, "", "Mesa 2"));
  EXPECT_THAT(dropped_sections(page_of_papers({all[1]}, "", "Mesa 2"), page), ElementsAre("b2002 [S]"));
}

}  // namespace
}  // namespace hedgehop::sim
