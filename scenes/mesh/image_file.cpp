#include "scenes/mesh/image_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <opencv2/imgproc.hpp>
#include <span>
#include <stdexcept>
#include <system_error>

#include "scenes/mesh/mesh_import.h"
#include "scenes/mesh/mesh_reader.h"
#include "scenes/mesh/texture_image.h"
#include "scenes/mesh/uri.h"
#include "scenes/textures/stone_textures.h"

namespace hedgehop::scenes::mesh {

namespace {

namespace fs = std::filesystem;

std::string with_slashes(std::string name) {
  std::ranges::replace(name, '\\', '/');
  return name;
}

// Returns a name without quotes and without the spaces at its end, which a comment of a PLY can have.
std::string plain_name(std::string name) {
  name.erase(name.find_last_not_of(" \t\r") + 1);
  const bool quoted = name.size() >= 2 && name.front() == '"' && name.back() == '"';
  return quoted ? name.substr(1, name.size() - 2) : name;
}

// Returns a name whose spaces have no backslash before them.
std::string without_escapes(std::string name) {
  for (size_t at = name.find("\\ "); at != std::string::npos; at = name.find("\\ ", at)) name.erase(at, 1);
  return name;
}

// Returns the bytes of an image. Throws with the reason if there is no such file.
std::vector<uint8_t> bytes_of(const ImageSource& source, const std::string& place) {
  if (source.bytes) return *source.bytes;
  const std::optional<fs::path> file = file_named(source.name, source.folders, source.is_uri);
  if (!file) throw std::invalid_argument(place + "there is no such file");
  std::error_code error;
  if (!fs::is_regular_file(*file, error)) throw std::invalid_argument(place + "it is not a regular file");
  if (fs::file_size(*file, error) > kMaxImageBytes) throw std::invalid_argument(place + "it is larger than 300 MB");
  std::ifstream stream(*file, std::ios::binary);
  std::vector<uint8_t> bytes(fs::file_size(*file, error));
  stream.read(reinterpret_cast<char*>(bytes.data()), std::ssize(bytes));
  if (!stream) throw std::invalid_argument(place + "it cannot be read");
  return bytes;
}

// Returns an image of CV_8UC3 or CV_8UC4 with the size of the textures.
cv::Mat read_image(const ImageSource& source, int size_px, std::set<std::string>& unrendered) {
  const std::string place = "its image '" + source.name + "': ";
  cv::Mat image;
  try {
    image = decode_texture(bytes_of(source, place));
  } catch (const ImageTooLarge& fault) {
    throw std::invalid_argument(place + fault.what());
  }
  if (image.empty()) throw std::invalid_argument(place + "it cannot be decoded as " + image_formats());
  if (image.cols > size_px || image.rows > size_px) {
    const auto size = [](int width, int height) { return std::to_string(width) + " x " + std::to_string(height); };
    unrendered.insert("image '" + source.name + "' of " + size(image.cols, image.rows) + " px is reduced to " +
                      size(size_px, size_px) + " px (texture_size)");
  }
  cv::resize(image, image, {size_px, size_px}, 0.0, 0.0, cv::INTER_AREA);
  return image;
}

// Multiplies an image by a factor in linear light.
void tint(const Eigen::Vector3f& factor, cv::Mat& rgb) {
  if (factor == Eigen::Vector3f::Ones()) return;
  cv::Mat table(1, 256, CV_8UC3);
  for (int level = 0; level < 256; ++level) {
    for (int k = 0; k < 3; ++k) {
      const float linear = linear_of_srgb(static_cast<float>(level) / 255.0f) * factor[k];
      table.at<cv::Vec3b>(level)[k] = static_cast<uint8_t>(std::lround(255.0f * srgb_of_linear(linear)));
    }
  }
  cv::LUT(rgb, table, rgb);
}

// Appends the mirror image along u or v.
void mirror(int axis, cv::Mat& image) {
  cv::Mat flipped, both;
  cv::flip(image, flipped, axis == 0 ? 1 : 0);
  if (axis == 0) cv::hconcat(image, flipped, both);
  if (axis == 1) cv::vconcat(image, flipped, both);
  cv::resize(both, image, image.size(), 0.0, 0.0, cv::INTER_AREA);
}

cv::Mat alpha_of(const cv::Mat& image) {
  cv::Mat alpha;
  if (image.channels() == 4) cv::extractChannel(image, alpha, 3);
  return alpha;
}

// Returns the opacity of a material: the alpha of its image, or the brightness of an image of its own.
cv::Mat opacity_of(const Material& material, const cv::Mat& image, int size_px, std::set<std::string>& unrendered) {
  if (!material.alpha_cutoff) return {};
  if (!material.opacity) return alpha_of(image);
  const cv::Mat mask = read_image(*material.opacity, size_px, unrendered);
  cv::Mat brightness = alpha_of(mask);
  double darkest = 255.0;
  if (!brightness.empty()) cv::minMaxLoc(brightness, &darkest);
  if (darkest == 255.0) cv::cvtColor(mask, brightness, mask.channels() == 4 ? cv::COLOR_RGBA2GRAY : cv::COLOR_RGB2GRAY);
  return brightness;
}

}  // namespace

std::optional<fs::path> file_named(const std::string& name, const std::vector<fs::path>& folders, bool is_uri) {
  const std::string plain = plain_name(name);
  std::vector<std::string> spellings{plain, with_slashes(plain), percent_decoded(plain),
                                     with_slashes(percent_decoded(plain))};
  if (is_uri) std::ranges::rotate(spellings, spellings.begin() + 2);
  spellings.push_back(without_escapes(plain));
  for (const bool base_only : {false, true}) {
    for (const std::string& spelling : spellings) {
      const fs::path path = base_only ? fs::path(with_slashes(spelling)).filename() : fs::path(spelling);
      for (const fs::path& folder : folders) {
        std::error_code error;
        if (!path.empty() && fs::exists(folder / path, error) && !fs::is_directory(folder / path, error))
          return folder / path;
      }
    }
  }
  return std::nullopt;
}

MaterialImage material_image(const Material& material, int size_px, std::set<std::string>& unrendered) {
  MaterialImage result;
  const Eigen::Vector3f& color = material.color;
  const cv::Mat image = material.image ? read_image(*material.image, size_px, unrendered)
                                       : textures::paint_blank(size_px, {color.x(), color.y(), color.z()});
  result.opacity = opacity_of(material, image, size_px, unrendered);
  result.rgb = image;
  if (image.channels() == 4) cv::cvtColor(image, result.rgb, cv::COLOR_RGBA2RGB);
  if (material.image) tint(material.tint, result.rgb);
  for (int axis = 0; axis < 2; ++axis) {
    if (material.wrap[static_cast<size_t>(axis)] != Wrap::mirror) continue;
    result.repeat[axis] = 2.0f;
    mirror(axis, result.rgb);
    if (!result.opacity.empty()) mirror(axis, result.opacity);
  }
  return result;
}

}  // namespace hedgehop::scenes::mesh
