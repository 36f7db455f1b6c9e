#include "evaluation/units.h"

namespace grasp_affordances
{

std::vector<Unit> makeUnits(const std::vector<const FrameResult*>& frames, std::size_t variation)
{
  std::vector<Unit> units;
  for (const FrameResult* frame : frames) {
    if (frames.size() > 1) {
      units.emplace_back();
    }
    for (const Run& run : frame->runs[variation]) {
      if (frames.size() == 1) {
        units.emplace_back();
      }
      units.back().push_back({*frame, run});
    }
  }
  return units;
}

}  // namespace grasp_affordances
