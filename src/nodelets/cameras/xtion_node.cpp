#include "nodelets/roscpp/run_nodelet.h"

/// Runs the XtionNodelet in a process of its own.
int main(int argc, char** argv)
{
  return grasp_affordances::runNodelet(argc, argv, "xtion", "grasp_affordances/XtionNodelet");
}
