#include <grasp_affordances/localizer.h>

int main()
{
  grasp_affordances::Localizer localizer;
  const grasp_affordances::Localization localization = localizer.localize(grasp_affordances::Cloud());
  return localization.shells.empty() && !localization.warnings.empty() ? 0 : 1;
}
