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

TEST(XmlText, WritesEachByteThatIsNotUtf8AsAnEscape) { EXPECT_EQ(xml_text("caf\xe9.yaml"), "caf\\xE9.yaml"); }

}  // namespace
}  // namespace hedgehop::sim
