#include <grasp_affordances/CylindricalShellArray.h>
#include <grasp_affordances/localizer.h>

int main()
{
  grasp_affordances::Localizer localizer;
  grasp_affordances::CylindricalShellArray message;
  message.shells.resize(localizer.localize(grasp_affordances::Cloud()).shells.size());
  return message.shells.empty() ? 0 : 1;
}
