#include <algorithm>
#include <array>
#include <string_view>

#include "tests/sim/render/osmesa.h"
#include "tests/sim/render/tested_renderer.h"

namespace hedgehop::sim {
namespace {

/// Suites that choose their renderers themselves; Tiled.* omits them, too.
constexpr std::array<std::string_view, 5> kOthers = {"GlDeclarations", "ImageColors", "Renderers", "Threads", "Tiles"};

/// Skips the tests that use OSMesa if it is not installed. Tiled.* runs them with the renderer tiles.
class SkipWithoutOsmesa : public testing::EmptyTestEventListener {
  void OnTestStart(const testing::TestInfo& test) override {
    const std::string_view suite = test.test_suite_name();
    if (tests_tiles() || std::ranges::any_of(kOthers, [&](std::string_view o) { return suite.starts_with(o); })) return;
    HEDGEHOP_REQUIRE_OSMESA();
  }
};

[[maybe_unused]] const bool kIsAppended = [] {
  testing::UnitTest::GetInstance()->listeners().Append(new SkipWithoutOsmesa);  // GoogleTest deletes it
  return true;
}();

}  // namespace
}  // namespace hedgehop::sim
