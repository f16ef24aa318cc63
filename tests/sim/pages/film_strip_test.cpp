#include "sim/pages/film_strip.h"

#include <gmock/gmock.h>

#include <array>
#include <random>
#include <set>

#include "sim/pages/campaign_data.h"
#include "tests/sim/batch/campaign_folder.h"
#include "tests/sim/pages/browser.h"

namespace hedgehop::sim {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Json = nlohmann::ordered_json;

enum class Kind { collision, failure, near_miss };

FlightRecord made_up_film(Kind kind, double figure) {
  FlightRecord record{.status = FlightRecord::Status::flown};
  FlightResult& result = record.result.emplace().flight;
  result.outcome = kind == Kind::collision ? Outcome::collided
                   : kind == Kind::failure ? Outcome::timeout
                                           : Outcome::reached;
  result.checks = {{.name = "no_collision", .passed = kind == Kind::near_miss, .unit = "m"}};
  result.flight_time_s = result.closest_obstacle.distance_m = figure;
  return record;
}

/// No omitted flight of a kind is worse. Failed flights come first, half of them collisions if there are enough.
TEST(WorstFlights, AreFailedFlightsFirstAndNotBetterThanOmittedFlights) {
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<FlightRecord> records;
    std::vector<Kind> kinds;
    const auto flights = random() % 12;
    for (uint64_t i = 0; i < flights; ++i) {
      kinds.push_back(static_cast<Kind>(random() % 3));
      records.push_back(made_up_film(kinds.back(), static_cast<double>(random() % 1000)));
      if (random() % 5 == 0) records.back().status = FlightRecord::Status::failed;
    }
    const size_t count = random() % 8;
    const std::vector<size_t> rows = worst_flights(records, count);
    const std::set<size_t> chosen(rows.begin(), rows.end());
    std::array<size_t, 3> eligible{}, taken{};
    for (size_t i = 0; i < records.size(); ++i) {
      if (records[i].status != FlightRecord::Status::flown) {
        EXPECT_FALSE(chosen.contains(i));
        continue;
      }
      const auto kind = static_cast<size_t>(kinds[i]);
      ++eligible[kind];
      taken[kind] += chosen.contains(i);
      for (size_t other = 0; other < records.size(); ++other) {
        if (chosen.contains(i) || !chosen.contains(other) || kinds[other] != kinds[i]) continue;
        EXPECT_LE(records[other].result->flight.flight_time_s, records[i].result->flight.flight_time_s);
      }
    }
    const size_t failed = eligible[0] + eligible[1];
    EXPECT_EQ(taken[0] + taken[1], std::min(count, failed));
    EXPECT_EQ(chosen.size(), std::min(count, failed + eligible[2]));
    EXPECT_GE(taken[0], std::min(eligible[0], (count + 1) / 2));
    EXPECT_GE(taken[1], std::min(eligible[1], count / 2));
    for (size_t i = 1; i < rows.size(); ++i) EXPECT_LE(kinds[rows[i - 1]], kinds[rows[i]]);
  }
}

/// A batch of one flight into a wall.
class WallFolder : public CampaignFolder {
 public:
  WallFolder() {
    write("wall.yaml",
          "use: tiny.yaml\nname: wall\nduration: 12\navoidance: {speed: 2}\ngoal: {north: 20}\nseed: 1\n"
          "rig: {cameras: [{role: front, width: 64, height: 48, fov: 90, rate: 25, channel: grey}]}\n");
    hedgehop("batch wall.yaml --out out");
  }
};

TEST(FilmStrip, ShowsTheWorstFlightsInTheReport) {
  HEDGEHOP_NEEDS_BROWSER();
  const WallFolder folder;
  ASSERT_EQ(folder.json("out/batch.json").at("flights").at(0).at("result").at("outcome"), "collided");
  const CommandEnd end = folder.hedgehop("report out --film-strips 3");
  ASSERT_EQ(end.status, 0) << end.err;
  EXPECT_EQ(end.err, "1/1: re-simulating wall/seed1 for its film strip\n");
  const PageVisit page = visit(folder.path() / "out/report.html", R"js(
    const image = document.querySelector('#strips-card img');
    await image.decode();
    document.getElementById('strips-card').style.width = '300px';
    return {width: image.naturalWidth, height: image.naturalHeight, name: document.querySelector('#strips-card .name').offsetHeight,
            why: document.querySelector('#strips-card figcaption .soft').textContent,
            omitted: [omittedWords(1), omittedWords(3)], boards: document.querySelectorAll('#board-card').length};)js");
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_EQ(page.value.at("width"), 5 * 242);            // five images of 240 px and a gap
  EXPECT_EQ(page.value.at("height"), 240 * 3 / 4 + 16);  // 64 x 48 px, and a line below
  EXPECT_THAT(page.value.at("why").get<std::string>(), HasSubstr("collided (hit north wall"));
  EXPECT_EQ(page.value.at("boards"), 0);
  EXPECT_EQ(page.value.at("omitted"),
            Json::array({"1 film strip is not shown, because a page has at most 2.5 MB of them. It is strip.jpg in the "
                         "folder of the flight.",
                         "3 film strips are not shown, because a page has at most 2.5 MB of them. Each is strip.jpg in "
                         "the folder of its flight."}));
  EXPECT_LT(page.value.at("name"), 30) << "one line next to a long cause";
}

TEST(StripsData, OmitsAndCountsStripsBeyondTheLimitOfAPage) {
  const TemporaryFolder folder;
  std::vector<FlightRecord> records(4);
  for (const size_t row : {0U, 1U, 3U}) {
    records[row].order.id = "f" + std::to_string(row);
    std::filesystem::create_directories(folder.path() / records[row].order.id);
    write_file_whole(folder.path() / records[row].order.id / "strip.jpg", "abc");
  }
  records[2].order.id = "without";
  std::filesystem::resize_file(folder.path() / "f1/strip.jpg", 2'499'998);
  const Json strips = strips_data(folder.path(), records);
  EXPECT_EQ(strips, Json::parse(R"({"images": [[0, "YWJj"], [3, "YWJj"]], "omitted": 1})"));
}

TEST(FilmStrip, ShowsTheEndOfATimeout) {
  const CampaignFolder folder;
  folder.write("timeout.yaml", "use: tiny.yaml\nchecks: [{check: reached_goal}]\n");
  folder.hedgehop("batch timeout.yaml --out out --set duration=0.5");
  const CommandEnd end = folder.hedgehop("report out --film-strips 1");
  EXPECT_EQ(end.err, "1/1: re-simulating tiny_duration=0.5/seed1 for its film strip\n");
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "out/tiny_duration=0.5/seed1/strip.jpg"));
}

TEST(FilmStrip, IsNotWrittenIfTheFlightDiffersFromTheTable) {
  const WallFolder folder;
  Json result = folder.json("out/wall/seed1/result.json");
  result["closest_obstacle"]["distance_m"] = 0.5;
  folder.write("out/wall/seed1/result.json", result.dump());
  const CommandEnd end = folder.hedgehop("report out --film-strips 1");
  EXPECT_EQ(end.status, 0);
  EXPECT_THAT(end.err, HasSubstr("wall/seed1: no film strip: minimum clearance of the re-simulated flight"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out/wall/seed1/strip.jpg"));
  EXPECT_EQ(folder.hedgehop("report out/wall/seed1 --film-strips 1").status, 2);
}

TEST(FilmStrip, IsRemovedIfItsFlightIsFlownAgain) {
  const WallFolder folder;
  folder.write("out/wall/seed1/strip.jpg", "old");
  folder.hedgehop("batch wall.yaml --out out");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out/wall/seed1/strip.jpg"));
}

}  // namespace
}  // namespace hedgehop::sim
