#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include <stdexcept>

namespace grasp_affordances
{

/// Replaces the driver in a build without OpenNI2. It does not start, and says why. It exists because
/// camera_plugins.xml, which the devel space reads from the source folder, names the class in every build.
class XtionNodelet : public nodelet::Nodelet
{
private:
  void onInit() override
  {
    constexpr const char* kReason =
        "this build of grasp_affordances has no OpenNI2; install the Debian package libopenni2-dev and build again";
    // The nodelet loader does not print the exception.
    NODELET_FATAL_STREAM(getName() << " does not start: " << kReason);
    throw std::runtime_error(kReason);
  }
};

}  // namespace grasp_affordances

PLUGINLIB_EXPORT_CLASS(grasp_affordances::XtionNodelet, nodelet::Nodelet)
