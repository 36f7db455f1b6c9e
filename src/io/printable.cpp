#include "io/printable.h"

#include <cstdint>

namespace grasp_affordances
{
namespace
{

std::uint8_t byteAt(const std::string& text, std::size_t at)
{
  return at < text.size() ? static_cast<std::uint8_t>(text[at]) : 0;
}

/// Bytes of the printable character that begins there; 0 where there is none.
std::size_t characterSize(const std::string& text, std::size_t at)
{
  const std::uint8_t first = byteAt(text, at);
  if (first < 0x80) {
    return first >= 0x20 && first != 0x7F ? 1 : 0;
  }
  const std::size_t size = first >= 0xC2 && first < 0xE0 ? 2 : first >= 0xE0 && first < 0xF0 ? 3 : 4;
  if (first < 0xC2 || first > 0xF4) {
    return 0;
  }
  for (std::size_t i = 1; i < size; ++i) {
    if ((byteAt(text, at + i) & 0xC0) != 0x80) {
      return 0;
    }
  }
  const std::uint8_t second = byteAt(text, at + 1);
  const bool is_control = first == 0xC2 && second < 0xA0;  // U+0080 to U+009F
  const bool is_overlong = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
  const bool is_no_character = (first == 0xED && second >= 0xA0) || (first == 0xF4 && second >= 0x90);
  return is_control || is_overlong || is_no_character ? 0 : size;
}

std::string escaped(std::uint8_t byte)
{
  constexpr char kDigits[] = "0123456789abcdef";
  return {'\\', 'x', kDigits[byte >> 4], kDigits[byte & 15]};
}

}  // namespace

std::string printable(const std::string& text, std::size_t longest)
{
  const std::string more = "...";
  std::string shown;
  std::size_t fits = 0;  // of what is shown, beside `more`
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t size = characterSize(text, at);
    shown += size > 0 ? text.substr(at, size) : escaped(byteAt(text, at));
    at += size > 0 ? size : 1;
    if (shown.size() > longest) {
      return shown.substr(0, fits) + more;
    }
    fits = shown.size() + more.size() <= longest ? shown.size() : fits;
  }
  return shown;
}

std::string quoted(const std::string& text)
{
  return "'" + printable(text) + "'";
}

}  // namespace grasp_affordances
