#include "io/printable.h"

#include <gtest/gtest.h>

#include <string>

namespace grasp_affordances
{
namespace
{

TEST(Printable, keepsTextOfAnyLanguage)
{
  for (const std::string text : {"", "six", "T\xC3\xBCr", "\xE7\x82\xB9", "\xF0\x9F\x99\x82", "a b"}) {
    EXPECT_EQ(printable(text), text);
  }
  EXPECT_EQ(quoted("six"), "'six'");
}

TEST(Printable, showsOtherBytesByTheirNumbers)
{
  EXPECT_EQ(printable("a\nb\x1b\x7f"), "a\\x0ab\\x1b\\x7f");
  EXPECT_EQ(printable(std::string(1, '\0')), "\\x00");
  EXPECT_EQ(printable("\xC3"), "\\xc3") << "a character that ends early";
  EXPECT_EQ(printable("\xC2\x9B"), "\\xc2\\x9b") << "a control character beyond ASCII";
  EXPECT_EQ(printable("\xC0\xAF"), "\\xc0\\xaf") << "a longer form than is needed";
  EXPECT_EQ(printable("\xE0\x80\xAF"), "\\xe0\\x80\\xaf");
  EXPECT_EQ(printable("\xED\xA0\x80"), "\\xed\\xa0\\x80") << "half a pair of UTF-16";
  EXPECT_EQ(printable("\xF5\x80\x80\x80"), "\\xf5\\x80\\x80\\x80");
}

TEST(Printable, isShort)
{
  EXPECT_EQ(printable("12345678", 8), "12345678");
  EXPECT_EQ(printable("123456789", 8), "12345...");
  EXPECT_EQ(printable("1234\xC3\xBC"
                      "6789",
                      8),
            "1234...")
      << "no half characters";
  EXPECT_EQ(printable(std::string(1000000, '\n')).size(), 59U) << "fourteen of them and three dots";
}

}  // namespace
}  // namespace grasp_affordances
