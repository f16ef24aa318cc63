#include "scenes/mesh/gltf_material.h"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace hedgehop::scenes::mesh {

namespace {

using Json = GltfFile::Json;

// Returns a list of numbers. Throws if its length differs.
template <size_t kCount>
std::array<float, kCount> numbers_at(const Json& object, const char* key, std::array<float, kCount> otherwise) {
  const auto found = object.find(key);
  return found == object.end() ? otherwise : found->get<std::array<float, kCount>>();
}

const Json* member(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

const Json* extension(const Json& object, const char* name) {
  const Json* const extensions = member(object, "extensions");
  return extensions ? member(*extensions, name) : nullptr;
}

Wrap wrap_of(const Json& sampler, const char* key) {
  constexpr size_t kRepeat = 10497, kClamp = 33071, kMirror = 33648;
  switch (GltfFile::count_at(sampler, key, kRepeat)) {
    case kRepeat:
      return Wrap::repeat;
    case kClamp:
      return Wrap::clamp;
    case kMirror:
      return Wrap::mirror;
    default:
      throw std::invalid_argument(std::string("its key '") + key + "' is not 10497, 33071 or 33648");
  }
}

}  // namespace

const ImageSource& GltfMaterials::image_source(size_t index) {
  const auto [at, is_new] = images_.try_emplace(index);
  ImageSource& source = at->second;
  if (!is_new) return source;
  const Json& image = file_.element("images", index);
  source = {.name = image.value("uri", ""), .folders = {file_.folder()}, .is_uri = true};
  std::optional<std::vector<uint8_t>> bytes = GltfFile::data_of(source.name);
  if (source.name.empty()) {
    const auto view = file_.view(GltfFile::count_at(image, "bufferView"));
    bytes.emplace(view.begin(), view.end());
  }
  if (bytes) {
    source.bytes = std::make_shared<const std::vector<uint8_t>>(*std::move(bytes));
    source.name = image.value("name", "images[" + std::to_string(index) + "]");
  }
  return source;
}

// Reads the image of a material, its wrapping and the transformation of its coordinates.
void GltfMaterials::read_image(const Json& info, GltfMaterial& material) {
  const Json& texture = file_.element("textures", GltfFile::count_at(info, "index"));
  const Json* const webp = extension(texture, "EXT_texture_webp");
  material.look.image = image_source(GltfFile::count_at(webp ? *webp : texture, "source"));
  material.uv_set = GltfFile::count_at(info, "texCoord", 0);
  if (texture.contains("sampler")) {
    constexpr size_t kNearest = 9728, kLinear = 9729;
    const Json& sampler = file_.element("samplers", GltfFile::count_at(texture, "sampler"));
    material.look.wrap = {wrap_of(sampler, "wrapS"), wrap_of(sampler, "wrapT")};
    if (GltfFile::count_at(sampler, "magFilter", kLinear) == kNearest) unrendered_.insert("magFilter NEAREST");
  }
  if (const Json* const moved = extension(info, "KHR_texture_transform")) {
    const auto offset = numbers_at<2>(*moved, "offset", {0.0f, 0.0f});
    const auto scale = numbers_at<2>(*moved, "scale", {1.0f, 1.0f});
    // Positive angles turn the coordinates from v to u, because v grows downward.
    material.uv_transform = Eigen::Translation2f(offset[0], offset[1]) *
                            Eigen::Rotation2Df(-moved->value("rotation", 0.0f)) * Eigen::Scaling(scale[0], scale[1]);
    material.uv_set = GltfFile::count_at(*moved, "texCoord", material.uv_set);
  }
}

void GltfMaterials::note_unrendered(const Json& material) {
  constexpr std::array<std::pair<const char*, const char*>, 2> kTextures{
      {{"normalTexture", "normal maps"}, {"occlusionTexture", "occlusion maps"}}};
  for (const auto& [key, words] : kTextures) {
    if (material.contains(key)) unrendered_.insert(words);
  }
  const auto emission = numbers_at<3>(material, "emissiveFactor", {0.0f, 0.0f, 0.0f});
  if (std::ranges::any_of(emission, [](float e) { return e > 0.0f; })) unrendered_.insert("emission");
}

GltfMaterial GltfMaterials::read(size_t index) {
  GltfMaterial result;
  result.look.is_single_sided = true;
  result.look.color = Eigen::Vector3f::Ones();
  if (index >= file_.length("materials")) return result;
  const Json& material = file_.element("materials", index);
  result.look.name = material.value("name", "materials[" + std::to_string(index) + "]");
  result.look.is_single_sided = !material.value("doubleSided", false);
  note_unrendered(material);

  std::array<float, 4> factor{1.0f, 1.0f, 1.0f, 1.0f};
  const Json* info = nullptr;
  if (const Json* const diffuse = extension(material, "KHR_materials_pbrSpecularGlossiness")) {
    factor = numbers_at<4>(*diffuse, "diffuseFactor", factor);
    info = member(*diffuse, "diffuseTexture");
  } else if (const Json* const base = member(material, "pbrMetallicRoughness")) {
    factor = numbers_at<4>(*base, "baseColorFactor", factor);
    info = member(*base, "baseColorTexture");
  }
  for (int k = 0; k < 3; ++k) {
    result.look.tint[k] = std::clamp(factor[static_cast<size_t>(k)], 0.0f, 1.0f);
    result.look.color[k] = srgb_of_linear(result.look.tint[k]);
  }
  if (info) read_image(*info, result);

  const std::string mode = material.value("alphaMode", "OPAQUE");
  if (mode == "BLEND") unrendered_.insert("transparency of material '" + result.look.name + "' (alphaMode BLEND)");
  if (mode == "MASK") {
    // The mask is alpha x factor >= cutoff; the image alone varies.
    const float cutoff = material.value("alphaCutoff", 0.5f);
    result.look.alpha_cutoff = factor[3] > 0.0f ? cutoff / factor[3] : (cutoff > 0.0f ? 2.0f : 0.0f);
  }
  return result;
}

}  // namespace hedgehop::scenes::mesh
