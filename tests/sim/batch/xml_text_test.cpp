#include "sim/batch/xml_text.h"

#include <gtest/gtest.h>

#include <string>

namespace hedgehop::sim {
namespace {

TEST(XmlText, KeepsUtf8AndLineBreaks) {
  const std::string text = "Straße\n飞行 🚁 naïve";
  EXPECT_EQ(xml_text(text), text);
}

TEST(XmlText, ReplacesControlCharacters) {
  EXPECT_EQ(xml_text(std::string("a\x01\x1b[0m\x7f\tb\0c", 11)), "a??[0m??b?c");
  EXPECT_EQ(xml_text("\xef\xbf\xbf"), "?") << "U+FFFF is no character of XML";
}

TEST(XmlText, ReplacesEachByteThatIsNotUtf8) {
  const std::string unknown = "\xef\xbf\xbd";
  EXPECT_EQ(xml_text("a\xff"
                     "b"),
            "a" + unknown + "b");
  EXPECT_EQ(xml_text("\xc3"), unknown) << "cut off";
  EXPECT_EQ(xml_text("\xc0\xaf"), unknown + unknown) << "overlong";
  EXPECT_EQ(xml_text("\xed\xa0\x80"), unknown + unknown + unknown) << "half of a surrogate pair";
}

}  // namespace
}  // namespace hedgehop::sim
