#include "scenes/mesh/mtl_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "scenes/mesh/image_file.h"
#include "scenes/mesh/mesh_reader.h"
#include "scenes/mesh/obj_text.h"
#include "sim/fields/utf8_mark.h"

namespace hedgehop::scenes::mesh {

namespace {

constexpr float kDefaultColor = 0.6f;  // of a material without a color, as in other importers

std::string lower(std::string_view word) {
  std::string result(word);
  std::ranges::transform(result, result.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

// Reads up to `count` numbers.
std::vector<double> take_numbers(std::string_view& rest, size_t count) {
  std::vector<double> numbers;
  while (numbers.size() < count) {
    std::string_view after = rest;
    const std::optional<double> number = number_of(take_word(after));
    if (!number || after.empty()) break;  // a file's name comes last
    numbers.push_back(*number);
    rest = after;
  }
  return numbers;
}

// The value of a statement such as map_Kd: options, then the name of an image.
class ImageStatement {
 public:
  ImageStatement(std::string_view rest, MtlMaterial& material, std::set<std::string>& unrendered)
      : material_(material), unrendered_(unrendered) {
    while (rest.starts_with('-')) {
      std::string_view after = rest;
      if (!read_option(lower(take_word(after)), after)) break;
      rest = after;
    }
    name = std::string(rest);
  }

  std::string name;

 private:
  // Returns whether this is an option.
  bool read_option(const std::string& option, std::string_view& rest) {
    if (option == "-o" || option == "-s" || option == "-t") {
      const std::vector<double> numbers = take_numbers(rest, 3);
      if (option == "-t") unrendered_.insert("MTL option -t");
      Eigen::Vector2f& target = option == "-o" ? material_.uv_offset : material_.uv_scale;
      for (size_t k = 0; k < std::min<size_t>(numbers.size(), 2) && option != "-t"; ++k) {
        target[static_cast<Eigen::Index>(k)] = static_cast<float>(numbers[k]);
      }
      return true;
    }
    if (option == "-clamp") {
      if (lower(take_word(rest)) == "on") material_.look.wrap = {Wrap::clamp, Wrap::clamp};
      return true;
    }
    if (option == "-mm") {
      const std::vector<double> numbers = take_numbers(rest, 2);
      if (numbers != std::vector{0.0, 1.0}) unrendered_.insert("MTL option -mm");
      return true;
    }
    if (option == "-colorspace") {
      if (lower(take_word(rest)) != "srgb") unrendered_.insert("MTL option -colorspace");
      return true;
    }
    constexpr std::array<std::string_view, 7> kWithoutEffect{"-blendu", "-blendv", "-cc",  "-texres",
                                                             "-boost",  "-bm",     "-type"};
    if (option == "-imfchan") unrendered_.insert("MTL option -imfchan");
    if (option != "-imfchan" && std::ranges::find(kWithoutEffect, option) == kWithoutEffect.end()) return false;
    take_word(rest);
    return true;
  }

  MtlMaterial& material_;
  std::set<std::string>& unrendered_;
};

void set_color(std::string_view rest, Material& look) {
  std::vector<double> values;
  while (values.size() < 3) {
    const std::optional<double> value = number_of(take_word(rest));
    if (!value || std::isnan(*value)) break;
    values.push_back(std::clamp(*value, 0.0, 1.0));
  }
  if (values.empty()) return;
  for (size_t k = 0; k < 3; ++k) {
    look.color[static_cast<Eigen::Index>(k)] = static_cast<float>(values[std::min(k, values.size() - 1)]);
  }
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(stream), {});
  return std::string(without_utf8_mark(text));
}

void read_mtl(const std::filesystem::path& file, const std::filesystem::path& obj_folder, ObjMaterials& found) {
  constexpr float kHalf = 0.5f;
  MtlMaterial unnamed;
  MtlMaterial* material = &unnamed;
  for_each_line(text_of(file), [&](std::string_view keyword, std::string_view rest, size_t) {
    const std::string key = lower(keyword);
    Material& look = material->look;
    const auto image = [&] {
      const ImageStatement statement(rest, *material, found.unrendered);
      return ImageSource{.name = statement.name, .folders = {file.parent_path(), obj_folder}};
    };
    const auto transparent = [&] { found.unrendered.insert("transparency of material '" + look.name + "'"); };
    if (key == "newmtl") {
      material = &found.by_name[std::string(rest)];
      *material = {};
      material->look.name = std::string(rest);
      material->look.color.setConstant(kDefaultColor);
    } else if (key == "kd") {
      set_color(rest, look);
    } else if (key == "map_kd") {
      look.image = image();
    } else if (key == "map_d") {
      look.opacity = image();
      look.alpha_cutoff = kHalf;
    } else if (key == "d" || key == "tr") {
      const double opaque = key == "d" ? 1.0 : 0.0;
      if (number_of(take_word(rest)).value_or(opaque) != opaque) transparent();
    } else if (key == "map_bump" || key == "bump" || key == "norm" || key == "disp") {
      found.unrendered.insert("bump maps");
    } else if (key == "map_ke") {
      found.unrendered.insert("emission");
    } else if (key == "decal") {
      found.unrendered.insert("decals");
    }
  });
}

// Removes the first name of a text and returns it. A backslash before a space makes it a part of the name.
std::string take_name(std::string_view& text) {
  std::string name;
  do {
    if (!name.empty()) name.back() = ' ';
    name += take_word(text);
  } while (name.ends_with('\\') && !text.empty());
  return name;
}

// Returns the material files that a statement names: one name with spaces, or several.
std::vector<std::string> libraries_of(std::string_view rest, const std::filesystem::path& folder) {
  if (rest.empty() || file_named(std::string(rest), {folder}, false)) return {std::string(rest)};
  const std::string_view whole = rest;
  std::vector<std::string> names;
  while (!rest.empty()) names.push_back(take_name(rest));
  const bool any =
      std::ranges::any_of(names, [&](const auto& name) { return file_named(name, {folder}, false).has_value(); });
  return any ? names : std::vector{std::string(whole)};
}

}  // namespace

void read_material_files(std::string_view names, const std::filesystem::path& folder, ObjMaterials& found) {
  for (const std::string& name : libraries_of(names, folder)) {
    const std::optional<std::filesystem::path> file = file_named(name, {folder}, false);
    if (!file) throw std::invalid_argument("its material file '" + name + "': there is no such file");
    if (!may_be_read(*file))
      throw std::invalid_argument("its file '" + file->string() + "' is not a regular file of at most 256 MB");
    if (!found.files.insert(file->lexically_normal()).second) continue;
    read_mtl(*file, folder, found);
    found.names += (found.names.empty() ? "'" : ", '") + name + "'";
  }
}

MtlMaterial ObjMaterials::find(const std::string& name) const {
  const auto found = by_name.find(name);
  if (found != by_name.end()) return found->second;
  MtlMaterial plain;
  plain.look.name = name;
  plain.look.color.setConstant(kDefaultColor);
  // Exporters write these names for faces without a material.
  if (name.empty() || name == "None" || name == "(null)") return plain;
  throw std::invalid_argument("its material '" + name + "' is in no material file; " +
                              (names.empty() ? "it names none (mtllib)" : "it names " + names));
}

}  // namespace hedgehop::scenes::mesh
