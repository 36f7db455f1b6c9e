#include "fuzz/targets.h"

#include <cstdio>
#include <cstdlib>

namespace grasp_affordances::fuzz
{

void require(bool holds, const char* what)
{
  if (!holds) {
    std::fprintf(stderr, "This does not hold: %s\n", what);
    std::abort();
  }
}

void requireOneLine(const std::string& reason)
{
  constexpr std::size_t kLongest = 1000;
  require(!reason.empty(), "an error has a reason");
  require(reason.find('\n') == std::string::npos, "a reason is one line");
  require(reason.size() <= kLongest, "a reason is short");
}

}  // namespace grasp_affordances::fuzz
