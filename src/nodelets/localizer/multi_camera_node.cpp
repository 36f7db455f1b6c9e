#include "nodelets/roscpp/run_nodelet.h"

/// The MultiCameraNodelet in a process of its own.
int main(int argc, char** argv)
{
  return grasp_affordances::runNodelet(argc, argv, "multi_camera", "grasp_affordances/MultiCameraNodelet");
}
