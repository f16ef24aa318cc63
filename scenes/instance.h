#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace hedgehop::scenes {

/// The class of an object. New classes are added at the end, because the values are stored in images.
enum class SemanticClass {
  other,
  ground,  ///< also floors
  road,
  building,
  wall,
  ceiling,
  furniture,
  tree,
  bush,
  rock,
  vehicle,
  pole,
  wire,
  balloon,
};

/// Name of each class in files, in order.
inline constexpr auto kSemanticClassNames =
    std::to_array<std::string_view>({"other", "ground", "road", "building", "wall", "ceiling", "furniture", "tree",
                                     "bush", "rock", "vehicle", "pole", "wire", "balloon"});
static_assert(kSemanticClassNames.size() == 1 + static_cast<size_t>(SemanticClass::balloon));

/// Returns the value of a class in images, where 0 is the sky.
constexpr int class_id(SemanticClass kind) { return 1 + static_cast<int>(kind); }

/// An object of a scene, such as a tree, a building with its roof housing, or the ground.
struct Instance {
  std::string name;
  SemanticClass kind = SemanticClass::other;
};

}  // namespace hedgehop::scenes
