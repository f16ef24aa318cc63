#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <vector>

namespace hedgehop::sim {

/// A decoded film.
struct ReadFilm {
  struct Image {
    double t_s = 0.0;
    cv::Mat rgb;
  };
  double duration_s = 0.0;
  std::vector<Image> images;
};

/// Decodes a film with the VP8 decoder of FFmpeg, which shares no code with the encoder. Throws std::runtime_error.
ReadFilm read_film(const std::filesystem::path& file);

}  // namespace hedgehop::sim
