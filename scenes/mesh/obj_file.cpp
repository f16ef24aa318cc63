#include "scenes/mesh/obj_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <system_error>

#include "scenes/mesh/mesh_reader.h"
#include "scenes/mesh/obj_text.h"
#include "sim/fields/shortened.h"

namespace hedgehop::scenes::mesh {

namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr size_t kMaxValues = 3 * kMaxTriangles;  // positions, normals or image coordinates

class ObjReader {
 public:
  ObjReader(const std::filesystem::path& folder, const Vector3d& origin) : folder_(folder), origin_(origin) {
    file_.materials.emplace_back();
  }

  ObjFile read(std::string_view text) {
    for_each_line(text, [this](std::string_view keyword, std::string_view rest, size_t line) {
      line_ = line;
      add(keyword, rest);
    });
    if (file_.normals.empty()) {
      for (ObjCorner& corner : file_.corners) corner.normal = kNoIndex;
    }
    require_indices();
    return std::move(file_);
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw std::invalid_argument("line " + std::to_string(line_) + ": " + why);
  }

  void add(std::string_view keyword, std::string_view rest) {
    if (keyword == "v") {
      add_position(rest);
    } else if (keyword == "vt") {
      const auto uv = numbers<2>(rest, 1, file_.uvs.size());
      file_.uvs.push_back(uv.values.cast<float>());
    } else if (keyword == "vn") {
      const auto normal = numbers<3>(rest, 3, file_.normals.size());
      file_.normals.push_back(normal.values.cast<float>());
    } else if (keyword == "f") {
      add_face(rest);
    } else if (keyword == "l" || keyword == "p") {
      file_.has_points_or_lines = true;
    } else if (keyword == "usemtl") {
      const auto [at, is_new] = material_numbers_.try_emplace(std::string(rest), file_.materials.size());
      if (is_new) file_.materials.emplace_back(rest);
      material_ = static_cast<uint32_t>(at->second);
    } else if (keyword == "mtllib") {
      read_material_files(rest, folder_, file_.library);
    }
  }

  template <int size>
  struct Numbers {
    Eigen::Matrix<double, size, 1> values = Eigen::Matrix<double, size, 1>::Zero();
    int count = 0;
  };

  // Reads up to `size` numbers, up to a comment. @param before  number of such lines before this one.
  template <int size>
  Numbers<size> numbers(std::string_view rest, int required, size_t before) const {
    if (before >= kMaxValues) {
      throw std::invalid_argument("it has more than " + std::to_string(kMaxValues) +
                                  " positions, normals or image coordinates");
    }
    Numbers<size> found;
    while (found.count < size && !rest.empty() && rest.front() != '#') {
      const std::string_view word = take_word(rest);
      const std::optional<double> number = number_of(word);
      if (!number) fail("'" + shortened(word, 40) + "' is not a number");
      found.values[found.count++] = *number;
    }
    if (found.count < required) fail("fewer than " + std::to_string(required) + " numbers");
    return found;
  }

  void add_position(std::string_view rest) {
    constexpr int kWithColor = 6;
    const auto read = numbers<kWithColor>(rest, 3, file_.positions.size());
    if (read.count == kWithColor && file_.colors.empty()) file_.colors.resize(file_.positions.size(), kNoColor);
    const bool has_colors = read.count == kWithColor || !file_.colors.empty();
    file_.positions.emplace_back(read.values.template head<3>() - origin_);
    if (!has_colors) return;
    file_.colors.push_back(read.count == kWithColor ? Vector3f(read.values.template tail<3>().cast<float>())
                                                    : kNoColor);
  }

  void add_face(std::string_view rest) {
    uint32_t count = 0;
    for (; !rest.empty() && rest.front() != '#'; ++count) {
      if (count == kMaxFaceCorners) {
        throw std::invalid_argument("it has a face of more than " + std::to_string(kMaxFaceCorners) + " corners");
      }
      file_.corners.push_back(corner_of(take_word(rest)));
    }
    if (count < 3) {
      file_.corners.resize(file_.corners.size() - count);
      file_.has_points_or_lines = file_.has_points_or_lines || count > 0;
      return;
    }
    file_.faces.push_back({material_, count});
    triangles_ += count - 2;
    if (triangles_ > kMaxTriangles) {
      throw std::invalid_argument("it has more than " + std::to_string(kMaxTriangles) + " triangles");
    }
  }

  // Reads "1", "1/2", "1//3" or "1/2/3". Negative indices count backward from the last line of their kind.
  ObjCorner corner_of(std::string_view word) const {
    ObjCorner corner;
    const std::array indices{&corner.position, &corner.uv, &corner.normal};
    const std::array counts{file_.positions.size(), file_.uvs.size(), file_.normals.size()};
    const char* at = word.data();
    const char* const last = at + word.size();
    for (size_t k = 0; k < indices.size(); ++k) {
      if (k == 0 || (at != last && *at != '/')) {
        int32_t index = 0;
        const auto [end, error] = std::from_chars(at, last, index);
        if (index < 0) index += static_cast<int32_t>(counts[k]) + 1;
        if (error != std::errc() || index <= 0) break;
        *indices[k] = index - 1;
        at = end;
      }
      if (at == last) return corner;
      if (*at++ != '/') break;
    }
    fail("'" + shortened(word, 40) + "' is not a corner of a face; valid: indices such as 1, -1, 1/2 or 1//3");
  }

  void require_indices() const {
    const auto require = [](int32_t index, size_t count, const std::string& kind, const std::string& keyword) {
      if (index < static_cast<int32_t>(count)) return;
      const std::string most = count == 0 ? "" : " up to number " + std::to_string(index + 1);
      const std::string has = count == 0 ? "none" : std::to_string(count);
      throw std::invalid_argument("its faces refer to " + kind + most + ", but it has " + has + " (" + keyword + ")");
    };
    ObjCorner most;
    for (const ObjCorner& corner : file_.corners) {
      most.position = std::max(most.position, corner.position);
      most.uv = std::max(most.uv, corner.uv);
      most.normal = std::max(most.normal, corner.normal);
    }
    require(most.position, file_.positions.size(), "positions", "v");
    require(most.uv, file_.uvs.size(), "image coordinates", "vt");
    require(most.normal, file_.normals.size(), "normals", "vn");
  }

  inline static const Vector3f kNoColor = Vector3f::Constant(std::numeric_limits<float>::quiet_NaN());

  std::filesystem::path folder_;
  Vector3d origin_;
  ObjFile file_;
  std::map<std::string, size_t> material_numbers_ = {{"", 0}};
  uint32_t material_ = 0;
  size_t triangles_ = 0, line_ = 0;
};

}  // namespace

ObjFile read_obj_file(std::string_view text, const std::filesystem::path& folder, const Vector3d& origin) {
  return ObjReader(folder, origin).read(text);
}

}  // namespace hedgehop::scenes::mesh
