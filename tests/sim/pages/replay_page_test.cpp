#include "sim/pages/replay.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "sim/pages/replay_images.h"
#include "sim/record/run_record.h"
#include "sim/record/table.h"
#include "tests/sim/pages/browser.h"
#include "tests/sim/pages/run_folder.h"

namespace hedgehop::sim {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Visits a replay in a small window, because the processor draws it.
PageVisit visit_replay(const std::filesystem::path& run, const std::string& steps) {
  return visit(run / "replay.html", steps, 480, 360);
}

TEST(ReplayInBrowser, PlacesTheVehicleAtItsTruePose) {
  HEDGEHOP_NEEDS_BROWSER();
  const RunFolder run;
  write_replay(run.path(), read_run(run.path()));
  const PageVisit page = visit_replay(run.path(), R"js(
    const places = [];
    for (const t of [0, 3.21, 7.5]) {
      replay.setTime(t);
      places.push([replay.state.t_s, ...replay.point(1, 2, 3)]);
    }
    return places;)js");
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_THAT(page.requests, IsEmpty());
  const Table table(run.path() / "trajectory.csv");
  const auto column = [&](const char* name) { return table.numbers(name); };
  const auto t_s = column("t_s");
  constexpr double kRoundingM = 3e-3;  // 1 mm of position, and 0.1 mrad of attitude at 4 m
  for (const auto& place : page.value) {
    const auto row = static_cast<size_t>(
        std::ranges::min_element(t_s, {}, [&](double t) { return std::abs(t - place[0].get<double>()); }) -
        t_s.begin());
    const Eigen::Quaterniond q_WB = Eigen::AngleAxisd(column("yaw_rad")[row], Eigen::Vector3d::UnitZ()) *
                                    Eigen::AngleAxisd(column("pitch_rad")[row], Eigen::Vector3d::UnitY()) *
                                    Eigen::AngleAxisd(column("roll_rad")[row], Eigen::Vector3d::UnitX());
    const Eigen::Vector3d p_W = Eigen::Vector3d(column("north_m")[row], column("east_m")[row], column("down_m")[row]) +
                                q_WB * Eigen::Vector3d(1.0, 2.0, 3.0);
    EXPECT_NEAR(place[1].get<double>(), p_W.y(), kRoundingM);   // x east
    EXPECT_NEAR(place[2].get<double>(), -p_W.z(), kRoundingM);  // y up
    EXPECT_NEAR(place[3].get<double>(), -p_W.x(), kRoundingM);  // z south
  }
}

/// In the plan, a label is as many meters wide and high as its sprite.
TEST(ReplayInBrowser, LabelsOfCloseObstaclesDoNotCoverEachOther) {
  HEDGEHOP_NEEDS_BROWSER();
  const TemporaryFolder run;
  Scenario scenario = load_scenario(HEDGEHOP_SOURCE_DIR "/configs/garratt2009_city_0_light.yaml");
  scenes::worlds::RoomConfig hall{.length_m = 500.0, .width_m = 500.0, .height_m = 40.0, .texture_size_px = 64};
  constexpr int kBoxes = 3;
  for (int i = 0; i < kBoxes; ++i) {
    hall.added.boxes.push_back(
        {.name = fmt::format("box {}", i), .north_m = -120.0 + 0.2 * i, .east_m = 80.0 + 0.3 * i});
  }
  scenario.scene = hall;
  write_result_files(run.path(), {.scenario = "hall", .seed = 9, .scenario_yaml = to_yaml(scenario)},
                     fake_flight(10.0, 1));
  write_replay(run.path(), read_run(run.path()));
  const PageVisit page = visit_replay(run.path(), R"js(
    const frames = async (n) => { while (n--) await new Promise(requestAnimationFrame); }, camera = document.getElementById('camera');
    camera.value = 'plan';
    camera.dispatchEvent(new Event('change'));
    replay.setTime(0);
    replay.tags.update(-130, 80);  // the page does so at most every 80 ms
    await frames(3);
    return [...replay.tags.tags].filter(([, {visible, material}]) => visible && material.visible).map(([row, {position, scale, center}]) =>
      [row[0], position.y - scale.x / 2, position.y + scale.x / 2, position.x - center.y * scale.y, position.x + (1 - center.y) * scale.y]);)js");
  EXPECT_THAT(page.errors, IsEmpty());
  constexpr double kTouchM = 1e-6;
  int boxes = 0;
  for (size_t i = 0; i < page.value.size(); ++i) {
    const auto& one = page.value[i];
    boxes += one[0].get<std::string>().starts_with("box");
    for (size_t k = 0; k < i; ++k) {
      const auto apart = [&](size_t low, size_t high) {
        return std::max(one[low].get<double>() - page.value[k][high].get<double>(),
                        page.value[k][low].get<double>() - one[high].get<double>());
      };
      EXPECT_GT(std::max(apart(1, 2), apart(3, 4)), -kTouchM) << page.value.dump();
    }
  }
  EXPECT_EQ(boxes, kBoxes) << page.value.dump();
}

/// Views from above, through a ceiling. As a counterexample, a box around the flight hides it.
TEST(ReplayInBrowser, CeilingDoesNotHideTheFlightBelowIt) {
  HEDGEHOP_NEEDS_BROWSER();
  for (const bool is_boxed : {false, true}) {
    const TemporaryFolder run;
    Scenario scenario = load_scenario(HEDGEHOP_SOURCE_DIR "/configs/garratt2009_city_0_light.yaml");
    scenes::worlds::RoomConfig hall{.length_m = 500.0, .width_m = 500.0, .height_m = 40.0, .texture_size_px = 64};
    if (is_boxed) hall.added.boxes = {{.length_m = 490.0, .width_m = 490.0, .height_m = 39.0}};
    scenario.scene = hall;
    write_result_files(run.path(), {.scenario = "hall", .seed = 9, .scenario_yaml = to_yaml(scenario)},
                       fake_flight(10.0, 1));
    write_replay(run.path(), read_run(run.path()));
    const PageVisit page = visit_replay(run.path(), R"js(
      const camera = document.getElementById('camera');
      camera.value = 'plan';
      camera.dispatchEvent(new Event('change'));
      return [replay.state.camera, replay.facesBefore()];)js");
    EXPECT_THAT(page.errors, IsEmpty());
    EXPECT_EQ(page.value[0], "plan");
    EXPECT_EQ(page.value[1].get<int>() > 0, is_boxed);
  }
}

TEST(ReplayInBrowser, PlaysPausesAndChangesCameraAndSpeed) {
  HEDGEHOP_NEEDS_BROWSER();
  const RunFolder run;
  write_replay(run.path(), read_run(run.path()));
  const PageVisit page = visit_replay(run.path(), R"js(
    const frames = async (n) => { while (n--) await new Promise(requestAnimationFrame); };
    const set = (id, value) => {
      const element = document.getElementById(id);
      element.value = value;
      element.dispatchEvent(new Event('change'));
    };
    const play = document.getElementById('play'), seen = [1];
    replay.setTime(seen[0]);
    set('speed', '0.1');
    play.click();
    const word = play.textContent;
    await frames(4);
    play.click();
    seen.push(replay.state.t_s);
    await frames(4);
    seen.push(replay.state.t_s);
    set('camera', 'chase');
    await frames(2);
    set('camera', 'plan');
    await frames(2);
    return {word, moved: seen[1] > seen[0], rested: seen[2] === seen[1], speed: replay.state.speed, camera: replay.state.camera};
    )js");
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_EQ(page.value, nlohmann::json::parse(
                            R"({"word": "pause", "moved": true, "rested": true, "speed": 0.1, "camera": "plan"})"));
}

TEST(ReplayInBrowser, HasOneTimeAxisForStatusEventsHandleAndKeys) {
  HEDGEHOP_NEEDS_BROWSER();
  const RunFolder run;
  write_replay(run.path(), read_run(run.path()));
  const PageVisit page = visit_replay(run.path(), R"js(
    const {track, state} = replay, canvas = document.getElementById('track'), apart = [];
    for (const t of [0, 3.3, track.end_s]) apart.push(Math.abs(track.timeAt(track.x(t)) - t));
    replay.setTime(3);
    canvas.dispatchEvent(new KeyboardEvent('keydown', {key: 'ArrowRight', cancelable: true}));
    const moved = state.t_s;
    canvas.dispatchEvent(new KeyboardEvent('keydown', {key: 'End', cancelable: true}));
    return [Math.max(...apart) < 1e-9, Math.abs(moved - 3.1) < 1e-9, state.t_s === track.end_s, track.events.at(-1).t_s === track.end_s,
            track.statuses.length > 0];)js");
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_THAT(page.value, ElementsAre(true, true, true, true, true));
}

TEST(ReplayInBrowser, LeavesTheSpaceKeyToControlsAndNamesTheGround) {
  HEDGEHOP_NEEDS_BROWSER();
  const RunFolder run;
  Flight flight = fake_flight(10.0, 1);
  flight.result.outcome = Outcome::collided;
  flight.result.closest_obstacle = {.distance_m = 8.0, .t_s = 2.0, .what = "wall"};
  flight.result.closest_ground = {.distance_m = 0.0, .t_s = 10.0, .what = "ground"};
  write_result_files(run.path(), {.scenario = "low", .scenario_yaml = run.yaml()}, flight);
  write_replay(run.path(), read_run(run.path()));
  const PageVisit page = visit_replay(run.path(), R"js(
    const taken = (element) => {
      const event = new KeyboardEvent('keydown', {code: 'Space', key: ' ', bubbles: true, cancelable: true});
      element.dispatchEvent(event);
      return event.defaultPrevented;
    };
    return [...['show-names', 'speed', 'play'].map((id) => taken(document.getElementById(id))), taken(document.body), replay.track.events.at(-1).text];)js");
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_THAT(page.value, ElementsAre(false, false, false, true, "hit the ground"));
}

TEST(ReplayInBrowser, ShowsTexturesLightAndTheImagesOfAllCameras) {
  HEDGEHOP_NEEDS_BROWSER();
  const RunFolder run;
  const RunRecord record = read_run(run.path());
  write_replay(run.path(), record);
  EXPECT_LT(std::filesystem::file_size(run.path() / "replay.html"), 10'000'000);
  const PageVisit page = visit_replay(run.path(), R"js(
    while (!replay.screens.has_images) await new Promise(requestAnimationFrame);  // browser.mjs ends a visit after 90 s
    const {surfaces, screens} = replay, box = (name) => replay.surfaces.fixed.children.map((mesh) => {
      mesh.geometry.computeBoundingBox();
      return mesh.geometry.boundingBox[name];
    });
    const low = Math.min(...box('min').map(({x}) => x)), high = Math.max(...box('max').map(({x}) => x));
    const kinds = [...document.getElementById('camera').options].map((option) => option.value);
    return {textures: surfaces.textures, low, high, shown: surfaces.fixed.visible, images: screens.has_images, screens: screens.group.children.length, kinds,
            plots: document.querySelectorAll('#plots .uplot').length};)js");
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_THAT(page.requests, IsEmpty());
  EXPECT_EQ(page.value.at("textures"), record.scene->textures.size());
  Eigen::AlignedBox3f box;
  for (const scenes::Vertex& vertex : record.scene->meshes.front().vertices) box.extend(vertex.p_W);
  EXPECT_NEAR(page.value.at("low").get<float>(), box.min().x(), 0.02f);
  EXPECT_NEAR(page.value.at("high").get<float>(), box.max().x(), 0.02f);
  EXPECT_TRUE(page.value.at("shown").get<bool>());
  EXPECT_TRUE(page.value.at("images").get<bool>());
  EXPECT_EQ(page.value.at("screens"), record.scenario.rig.cameras.size());
  EXPECT_EQ(page.value.at("kinds").size(), 3 + record.scenario.rig.cameras.size());  // orbit, chase, plan
  EXPECT_GE(page.value.at("plots").get<int>(), 3);
}

TEST(ReplayInBrowser, ShowsTheMapAndThePathOfTheModuleAtEachTime) {
  HEDGEHOP_NEEDS_BROWSER();
  const RunFolder run;
  Flight flight = fake_flight(10.0, 1);
  flight.map.points = {{{40, 10, -20}, Eigen::Matrix3d::Identity(), true}};
  flight.map.course_NE = {{0, 0}, {100, 0}};
  flight.map.paths = {{2.0, {{30, 20}, {100, 0}}}, {6.0, {{30, 20}}}};
  write_result_files(run.path(), {.scenario = "map", .scenario_yaml = run.yaml()}, flight);
  write_replay(run.path(), read_run(run.path()));
  const PageVisit page = visit_replay(run.path(), R"js(
    const drawn = () => replay.map.paths.map(({drawn}) => drawn?.visible ?? null);
    return [1, 3, 7].map((t) => { replay.setTime(t); return drawn(); });)js");
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_EQ(page.value, nlohmann::json::parse("[[false, null], [true, null], [false, null]]"));
}

TEST(CameraFilm, NeedsNoTemporaryFolderAndItsFaultHasACause) {
  const RunFolder run;
  const RunRecord record = read_run(run.path());
  ASSERT_EQ(setenv("TMPDIR", "/nonexistent", 1), 0);
  const CameraFilm film = camera_film(record, run.path());
  unsetenv("TMPDIR");
  EXPECT_EQ(film.fault, "");
  EXPECT_FALSE(film.bytes.empty());
  for (const auto& entry : std::filesystem::directory_iterator(run.path())) {
    EXPECT_NE(entry.path().extension(), ".webm") << "the film is in the page";
  }
  const CameraFilm none = camera_film(record, run.path() / "missing");
  EXPECT_EQ(none.bytes, "");
  EXPECT_THAT(none.fault, ::testing::HasSubstr("missing"));
}

}  // namespace
}  // namespace hedgehop::sim
