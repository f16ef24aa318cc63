#include "sim/record/film.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "sim/config/whole_file.h"
#include "sim/record/film.h"
#include "tests/sim/record/error_of.h"
#include "tests/sim/record/film_reader.h"
#include "tests/sim/record/temporary_folder.h"

namespace hedgehop::sim {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// Returns images with different grey levels and a red left half. A decoder must return them in this order.
cv::Mat image(int i, cv::Size size_px) {
  cv::Mat rgb(size_px, CV_8UC3, cv::Scalar::all(40 + 8 * i));
  rgb.colRange(0, size_px.width / 2) = cv::Scalar(200, 30, 30);
  return rgb;
}

/// Maximum error of lossy coding of flat images, of 255.
constexpr double kCodingError = 12.0;

TEST(Film, ReadsBackWithEveryImageInOrder) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "video.webm";
  Film film(file, 12.5, {320, 240});
  for (int i = 0; i < 25; ++i) film.add(image(i, {320, 240}));
  film.close();

  const ReadFilm read = read_film(file);
  EXPECT_NEAR(read.duration_s, 25 / 12.5, 1e-3);
  ASSERT_EQ(read.images.size(), 25u);
  for (int i = 0; i < 25; ++i) {
    const auto& [t_s, rgb] = read.images[static_cast<size_t>(i)];
    EXPECT_NEAR(t_s, i / 12.5, 1e-3);
    ASSERT_EQ(rgb.size(), cv::Size(320, 240));
    const cv::Scalar left = cv::mean(rgb.colRange(20, 140)), right = cv::mean(rgb.colRange(180, 300));
    EXPECT_NEAR(right[0], 40 + 8 * i, kCodingError);
    EXPECT_NEAR(left[0], 200, kCodingError) << "red comes back red";
    EXPECT_NEAR(left[2], 30, kCodingError);
  }
}

TEST(Film, OfEqualImagesHasEqualBytes) {
  const TemporaryFolder folder;
  std::string texts[2];
  for (std::string& text : texts) {
    const std::filesystem::path file = folder.path() / "video.webm";
    Film film(file, 10.0, {160, 120});
    for (int i = 0; i < 30; ++i) film.add(image(i, {160, 120}));
    film.close();
    text = read_file_whole(file);
  }
  EXPECT_FALSE(texts[0].empty());
  EXPECT_TRUE(texts[0] == texts[1]);
}

TEST(Film, CropsAnOddRowAndColumn) {
  const TemporaryFolder folder;
  Film film(folder.path() / "video.webm", 10.0, {161, 121});
  film.add(image(0, {161, 121}));
  film.close();
  EXPECT_EQ(read_film(folder.path() / "video.webm").images.at(0).rgb.size(), cv::Size(160, 120));
}

TEST(Film, IsCompletedByTheDestructor) {
  const TemporaryFolder folder;
  { Film(folder.path() / "video.webm", 10.0, {64, 64}).add(image(0, {64, 64})); }
  EXPECT_EQ(read_film(folder.path() / "video.webm").images.size(), 1u);
}

TEST(Film, HasNoFileWithoutImages) {
  const TemporaryFolder folder;
  Film(folder.path() / "video.webm", 10.0, {64, 64}).close();
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Film, DoesNotWriteToTheImage) {
  const TemporaryFolder folder;
  const cv::Mat rgb = image(3, {64, 64}), before = rgb.clone();
  Film film(folder.path() / "video.webm", 10.0, {64, 64});
  film.add(rgb);
  EXPECT_EQ(cv::norm(rgb, before, cv::NORM_INF), 0.0);
}

TEST(Film, RejectsImagesOfAnotherSizeOrType) {
  const TemporaryFolder folder;
  Film film(folder.path() / "video.webm", 10.0, {64, 64});
  EXPECT_THROW(film.add(cv::Mat(64, 32, CV_8UC3)), std::invalid_argument);
  EXPECT_THROW(film.add(cv::Mat(64, 64, CV_8UC1)), std::invalid_argument);
  EXPECT_THROW(Film(folder.path() / "other.webm", 0.0, {64, 64}), std::invalid_argument);
  EXPECT_THROW(Film(folder.path() / "other.webm", NAN, {64, 64}), std::invalid_argument);
}

TEST(Film, NamesAFileThatCannotBeCreatedAndTheCause) {
  EXPECT_THAT(error_of([] {
                Film("/no/such/folder/video.webm", 10.0, {64, 64});
              }),
              AllOf(HasSubstr("/no/such/folder/video.webm"), HasSubstr("No such file or directory")));
}

TEST(Film, FullDiskIsAnErrorWithTheFile) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "video.webm";
  std::filesystem::create_symlink("/dev/full", file);
  const auto action = [&] {
    Film film(file, 10.0, {640, 480});
    cv::Mat noise(480, 640, CV_8UC3);
    for (int i = 0; i < 20; ++i) {
      cv::randu(noise, 0, 255);
      film.add(noise);
    }
    film.close();
  };
  EXPECT_THAT(error_of(action), AllOf(HasSubstr("video.webm"), HasSubstr("No space left on device")));
}

TEST(ContactSheet, HasThreeFramesPerRowOrTwoRowsIfOneIsVeryWide) {
  const auto size_of = [](size_t count, cv::Size size_px) {
    const avoidance::CameraFrame frame{.role = "front", .image = cv::Mat(size_px, CV_8UC1, cv::Scalar(90))};
    return contact_sheet(std::vector<avoidance::CameraFrame>(count, frame)).size();
  };
  EXPECT_EQ(size_of(0, {}), cv::Size());
  EXPECT_EQ(size_of(3, {100, 120}), cv::Size(300, 120));
  EXPECT_EQ(size_of(5, {100, 120}), cv::Size(300, 240));
  EXPECT_EQ(size_of(3, {320, 240}), cv::Size(640, 480)) << "one row of 960 x 240 px would be very wide";
}

TEST(ContactSheet, ShowsColorsAndDepthFromWhiteAt0MetersToBlackFrom50Meters) {
  std::vector<avoidance::CameraFrame> frames;
  for (const float depth_m : {0.0f, 25.0f, 50.0f, 80.0f}) {
    frames.push_back({.role = "depth", .image = cv::Mat(120, 100, CV_32FC1, cv::Scalar::all(depth_m))});
  }
  frames.push_back({.role = "color", .image = cv::Mat(120, 100, CV_8UC3, cv::Scalar(200, 30, 10))});
  const cv::Mat sheet = contact_sheet(frames);
  const auto at = [&](int row, int column) { return sheet.at<cv::Vec3b>(120 * row + 100, 100 * column + 50); };
  EXPECT_EQ(at(0, 0), cv::Vec3b::all(255));
  EXPECT_NEAR(at(0, 1)[0], 127.5, 1.0);
  EXPECT_EQ(at(0, 2), cv::Vec3b::all(0));
  EXPECT_EQ(at(1, 0), cv::Vec3b::all(0));
  EXPECT_EQ(at(1, 1), cv::Vec3b(200, 30, 10));
}

TEST(FilmWatcher, WritesTimeStatusAndClearanceBelowTheImageOnly) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "video.webm";
  FilmConfig config;
  config.width_px = 320;
  config.rate_hz = 5.0;
  FilmWatcher watcher(config, file);
  const cv::Mat grey(120, 160, CV_8UC3, cv::Scalar(90, 120, 150));
  for (const auto& [status, clearance_m] : {std::pair{"cruise", 12.0}, {"cruise", 12.0}, {"avoid", 3.0}}) {
    watcher.on_images(
        {.t_ns = 0, .annotated = grey, .frames = {}, .status = status, .obstacle_clearance_m = clearance_m});
  }
  watcher.close();
  ASSERT_EQ(watcher.fault(), "");
  const ReadFilm film = read_film(file);
  ASSERT_EQ(film.images.size(), 3U);
  const auto differ = [&](size_t a, size_t b, cv::Range rows) {
    return cv::norm(film.images[a].rgb.rowRange(rows), film.images[b].rgb.rowRange(rows), cv::NORM_INF);
  };
  const cv::Range image_rows(0, 236), caption_rows(240, film.images[0].rgb.rows);
  constexpr double kCoding = 25.0;  // coding error
  EXPECT_LT(differ(0, 2, image_rows), kCoding);
  EXPECT_LT(differ(0, 1, caption_rows), kCoding);
  EXPECT_GT(differ(0, 2, caption_rows), 100.0);
}

}  // namespace
}  // namespace hedgehop::sim
