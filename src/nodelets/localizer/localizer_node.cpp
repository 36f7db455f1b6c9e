#include "nodelets/roscpp/run_nodelet.h"

/// The LocalizerNodelet in a process of its own.
int main(int argc, char** argv)
{
  return grasp_affordances::runNodelet(argc, argv, "localizer", "grasp_affordances/LocalizerNodelet");
}
