#include "sim/pages/film_strip.h"

#include <gmock/gmock.h>

#include <random>
#include <set>

#include "tests/sim/batch/campaign_folder.h"
#include "tests/sim/pages/browser.h"

namespace hedgehop::sim {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Json = nlohmann::ordered_json;

FlightRecord made_up_film(bool collided, double figure) {
  FlightRecord record{.status = FlightRecord::Status::flown};
  FlightResult& result = record.result.emplace().flight;
  result.outcome = collided ? Outcome::collided : Outcome::reached;
  result.flight_time_s = result.closest_obstacle.distance_m = figure;
  return record;
}

/// No omitted flight of a kind is worse. As many flights as possible are selected, half of each kind.
TEST(WorstFlights, AreNotBetterThanOmittedFlights) {
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<FlightRecord> records;
    const auto flights = random() % 12;
    for (uint64_t i = 0; i < flights; ++i) {
      records.push_back(made_up_film(random() % 2 == 0, static_cast<double>(random() % 1000)));
      if (random() % 5 == 0) records.back().status = FlightRecord::Status::failed;
    }
    const size_t count = random() % 8;
    const std::vector<size_t> rows = worst_flights(records, count);
    const std::set<size_t> chosen(rows.begin(), rows.end());
    size_t eligible[2] = {0, 0}, taken[2] = {0, 0};
    for (size_t i = 0; i < records.size(); ++i) {
      if (records[i].status != FlightRecord::Status::flown) {
        EXPECT_FALSE(chosen.contains(i));
        continue;
      }
      const bool collided = records[i].result->flight.outcome == Outcome::collided;
      ++eligible[collided];
      taken[collided] += chosen.contains(i);
      for (size_t other = 0; other < records.size(); ++other) {
        if (chosen.contains(i) || !chosen.contains(other)) continue;
        if (records[other].result->flight.outcome != records[i].result->flight.outcome) continue;
        EXPECT_LE(records[other].result->flight.flight_time_s, records[i].result->flight.flight_time_s);
      }
    }
    EXPECT_EQ(chosen.size(), std::min(count, eligible[0] + eligible[1]));
    EXPECT_GE(taken[1], std::min(eligible[1], (count + 1) / 2));
    EXPECT_GE(taken[0], std::min(eligible[0], count / 2));
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
    return {width: image.naturalWidth, height: image.naturalHeight,
            why: document.querySelector('#strips-card figcaption .soft').textContent,
            boards: document.querySelectorAll('#board-card').length};)js");
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_EQ(page.value.at("width"), 5 * 242);            // five images of 240 px and a gap
  EXPECT_EQ(page.value.at("height"), 240 * 3 / 4 + 16);  // 64 x 48 px, and a line below
  EXPECT_THAT(page.value.at("why").get<std::string>(), HasSubstr("collided (hit north wall"));
  EXPECT_EQ(page.value.at("boards"), 0);
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
