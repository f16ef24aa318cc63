#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <opencv2/core.hpp>
#include <vector>

namespace hedgehop::scenes {

/// The textures of a scene: CV_8UC3 RGB, square, all of one power-of-two size, tileable. They are painted on first use,
/// because many scenes are never drawn. Copies share the pixels, and any number of threads may use them.
class TextureList {
 public:
  static constexpr int kDefaultSizePx = 512;

  /// Paints one texture. Each call must return the same pixels.
  using Paint = std::function<cv::Mat()>;
  /// Paints several textures.
  using PaintSeveral = std::function<std::vector<cv::Mat>()>;

  TextureList() = default;
  /// @param size_px  side of each texture, > 0.
  explicit TextureList(int size_px) : size_px_(size_px) {}
  /// A list of finished textures. Throws std::invalid_argument unless all have the form above.
  TextureList(std::vector<cv::Mat> images);

  int size_px() const { return size_px_; }
  size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }

  /// Adds a texture. @return its index.
  uint32_t add(Paint paint);
  /// Adds `count` textures. @return the index of the first.
  uint32_t add(size_t count, PaintSeveral paint);

  /// Returns all textures. Throws std::invalid_argument if one of them does not have the form above.
  std::vector<cv::Mat> images() const;

 private:
  struct Group;

  int size_px_ = kDefaultSizePx;
  size_t size_ = 0;
  std::vector<std::shared_ptr<Group>> groups_;
};

}  // namespace hedgehop::scenes
