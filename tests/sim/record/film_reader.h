#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <vector>

namespace hedgehop::sim {

/// A film as a player sees it.
struct ReadFilm {
  struct Image {
    double t_s = 0.0;
    cv::Mat rgb;
  };
  double duration_s = 0.0;
  std::vector<Image> images;
};

/// Decodes a film with FFmpeg's own VP8 decoder, which shares no code with the encoder. Throws std::runtime_error.
ReadFilm read_film(const std::filesystem::path& file);

}  // namespace hedgehop::sim
