#include "sim/config/utf8.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "sim/fields/shortened.h"

namespace hedgehop::sim {
namespace {

TEST(Utf8Text, KeepsUtf8) {
  const std::string text = "Straße\n飞行 🚁 naïve \\x41";
  EXPECT_EQ(utf8_text(text), text);
}

TEST(Utf8Text, WritesEachByteThatIsNotUtf8AsAnEscape) {
  EXPECT_EQ(utf8_text("a\xff"
                      "b"),
            "a\\xFFb");
  EXPECT_EQ(utf8_text("\xc3"), "\\xC3") << "cut off";
  EXPECT_EQ(utf8_text("\xc0\xaf"), "\\xC0\\xAF") << "overlong";
  EXPECT_EQ(utf8_text("\xed\xa0\x80"), "\\xED\\xA0\\x80") << "half of a surrogate pair";
}

TEST(NameText, ReadsBackToTheSameBytes) {
  const std::string alphabet("\\xX0E9a/\xe9\xc3\xa9\n\x01", 13);
  std::mt19937_64 random(1);
  for (int i = 0; i < 20000; ++i) {
    std::string name;
    for (uint64_t n = random() % 12; n > 0; --n) name += alphabet[random() % alphabet.size()];
    EXPECT_EQ(raw_name(name_text(name)), name);
    EXPECT_EQ(utf8_text(name_text(name)), name_text(name)) << "is UTF-8";
  }
}

TEST(Shortened, CutsAfterAWholeCharacter) {
  const std::string text = "aé飞🚁é飞🚁a";
  for (size_t bytes = 0; bytes < text.size(); ++bytes) {
    const std::string cut = shortened(text, bytes);
    ASSERT_TRUE(cut.ends_with("...") && cut.size() <= bytes + 3) << bytes;
    EXPECT_TRUE(text.starts_with(cut.substr(0, cut.size() - 3))) << bytes;
    EXPECT_EQ(utf8_text(cut), cut) << bytes;
    EXPECT_GT(cut.size() + 1, bytes) << "drops less than one character";
  }
  EXPECT_EQ(shortened(text, text.size()), text);
}

TEST(JsonText, IsStrictJsonForAnyBytes) {
  const nlohmann::ordered_json json{{"caf\xe9", {"\xff", 1, "ü"}}};
  const auto read = nlohmann::ordered_json::parse(json_text(json, 2));
  EXPECT_EQ(read, (nlohmann::ordered_json{{"caf\\xE9", {"\\xFF", 1, "ü"}}}));
}

}  // namespace
}  // namespace hedgehop::sim
