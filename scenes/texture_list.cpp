#include "scenes/texture_list.h"

#include <mutex>
#include <stdexcept>
#include <utility>

namespace hedgehop::scenes {
namespace {

bool has_form(const cv::Mat& image, int size_px) {
  return image.type() == CV_8UC3 && image.cols == size_px && image.rows == size_px && size_px > 0 &&
         (size_px & (size_px - 1)) == 0;
}

}  // namespace

/// Textures that are painted together.
struct TextureList::Group {
  size_t count;
  PaintSeveral paint;
  std::once_flag once = {};
  std::vector<cv::Mat> images = {};  ///< written once
};

TextureList::TextureList(std::vector<cv::Mat> images)
    : size_px_(images.empty() ? kDefaultSizePx : images.front().cols) {
  const size_t count = images.size();
  add(count, [images = std::move(images)] { return images; });
  this->images();
}

uint32_t TextureList::add(Paint paint) {
  return add(1, [paint = std::move(paint)] { return std::vector<cv::Mat>{paint()}; });
}

uint32_t TextureList::add(size_t count, PaintSeveral paint) {
  const size_t first = size_;
  groups_.push_back(std::make_shared<Group>(count, std::move(paint)));
  size_ += count;
  return static_cast<uint32_t>(first);
}

std::vector<cv::Mat> TextureList::images() const {
  std::vector<cv::Mat> images;
  images.reserve(size_);
  for (const std::shared_ptr<Group>& group : groups_) {
    std::call_once(group->once, [&] { group->images = group->paint(); });
    if (group->images.size() != group->count) throw std::invalid_argument("a painter returned too few textures");
    for (const cv::Mat& image : group->images) {
      if (!has_form(image, size_px_))
        throw std::invalid_argument("textures must be CV_8UC3, square, and all of one power-of-two size");
      images.push_back(image);
    }
  }
  return images;
}

}  // namespace hedgehop::scenes
