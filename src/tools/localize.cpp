#include "grasp_affordances/localizer.h"
#include "grasp_affordances/point_cloud2.h"
#include "io/bag.h"
#include "io/pcd.h"
#include "rendering/color.h"
#include "rendering/picture.h"
#include "tools/localization_report.h"
#include "tools/localize_options.h"
#include "tools/posed_view.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <iostream>
#include <vector>

namespace grasp_affordances
{
namespace
{

// Exit statuses.
constexpr int kDone = 0, kBadInput = 1, kBadUsage = 2;

/// FILE.png for the first cloud, FILE-2.png for the second.
std::string picturePath(const std::string& first, std::size_t number)
{
  if (number == 1) {
    return first;
  }
  std::filesystem::path path(first);
  const std::string extension = path.extension().string();
  return path.replace_extension().string() + "-" + std::to_string(number) + extension;
}

/// Localizes in one cloud after another and reports each as it is done.
class Batch
{
public:
  explicit Batch(const LocalizeOptions& options)
      : options_(options), localizer_(options.config), shows_progress_(options.json || isatty(STDOUT_FILENO) == 0)
  {
  }

  int run()
  {
    if (!options_.views.empty()) {
      attempt(options_.views.front().file, [this] { processViews(); });
    }
    for (const std::string& file : options_.inputs) {
      ++input_;
      attempt(file, [&] { isBag(file) ? processBag(file) : processPcd(file); });
    }
    return status_;
  }

private:
  /// Reports what goes wrong with a file, and goes on.
  template <class Task>
  void attempt(const std::string& file, Task&& task)
  {
    try {
      task();
    } catch (const std::exception& error) {
      fail(file, error.what());
    }
  }

  void fail(const std::string& file, const std::string& reason)
  {
    std::cerr << file << ": " << reason << "\n";
    status_ = kBadInput;
  }

  void processPcd(const std::string& file)
  {
    SensorPose viewpoint;
    const pcl::PCLPointCloud2 points = readPcd(file, &viewpoint);
    cloud_.sensor_origin = options_.viewpoint ? options_.viewpoint : viewpoint.sensorOrigin();
    const std::string position = std::to_string(input_) + "/" + std::to_string(options_.inputs.size());
    process(points, {file, "", 0.0}, options_.inputs.size() > 1 ? position : "");
  }

  void processViews()
  {
    std::vector<PosedView> views;
    for (const ViewFile& option : options_.views) {
      attempt(option.file, [&] { views.push_back(readPosedView(option.file, option.T_common_cloud)); });
    }
    if (views.size() < options_.views.size()) {
      return;
    }
    CloudSource source{options_.views.front().file, "", 0.0};
    std::vector<PosedCloud> posed;
    std::size_t first_point_index = 0;
    for (std::size_t i = 0; i < views.size(); ++i) {
      const auto& [cloud, colors, T_common_cloud] = views[i];
      posed.push_back({&cloud, T_common_cloud});
      source.views.push_back({options_.views[i].file, T_common_cloud, views[i].measuredPoints(), first_point_index});
      first_point_index += cloud.size();
    }
    Localization localization;
    localizer_.localize(posed, localization);
    ++localized_;
    report(source, localization, "");
    if (!options_.picture.empty()) {
      drawViews(views, source, localization);
    }
  }

  void processBag(const std::string& file)
  {
    cloud_.sensor_origin = options_.viewpoint;
    BagVisitor visitor;
    visitor.cloud = [&](const sensor_msgs::PointCloud2& message, std::size_t index, std::size_t count) {
      const std::string position = std::to_string(index + 1) + "/" + std::to_string(count);
      try {
        process(message, {file, message.header.frame_id, message.header.stamp.toSec()},
                options_.inputs.size() > 1 || count > 1 ? position : "");
      } catch (const std::exception& error) {
        fail(file, "message " + position + ": " + error.what());
      }
    };
    visitor.malformed = [&](const std::string& reason, std::size_t index, std::size_t count) {
      fail(file, "message " + std::to_string(index + 1) + "/" + std::to_string(count) + ": " + reason);
    };
    readBagClouds(file, options_.topic, visitor);
  }

  /// @param position  among several clouds, for the progress; empty: there is one only
  template <class PointCloud2>
  void process(const PointCloud2& points, const CloudSource& source, const std::string& position)
  {
    cloudFromPointCloud2(points, cloud_);
    const Localization localization = localizer_.localize(cloud_);
    ++localized_;
    report(source, localization, position);
    if (!options_.picture.empty()) {
      draw(pointColors(points), source, localization);
    }
  }

  void report(const CloudSource& source, const Localization& localization, const std::string& position)
  {
    const Config& config = localizer_.config();
    if (options_.json) {
      std::cout << toJson(source, config, localization) << std::endl;
    } else {
      printTable(std::cout, source, config, localization);
      std::cout.flush();
    }
    for (const std::string& warning : localization.warnings) {
      std::cerr << source.name() << ": " << warning << "\n";
    }
    if (localization.handles.empty() && localization.sampled > 0) {  // else a warning says why
      std::cerr << source.name() << ": " << explainNothing(localization, config) << "\n";
    }
    if (shows_progress_ && !position.empty()) {
      std::cerr << "[" << position << "] " << source.file << ": " << localization.handles.size() << " handles, "
                << localization.shells.size() << " shells, " << std::lround(localization.milliseconds.total) << " ms\n";
    }
  }

  void draw(const std::vector<Color>& colors, const CloudSource& source, const Localization& localization)
  {
    Picture picture(cloud_, colors);
    finish(picture, source, localization);
  }

  /// What the first view's camera would see, had it seen what the others saw.
  void drawViews(const std::vector<PosedView>& views, const CloudSource& source, const Localization& localization)
  {
    PictureCamera camera = pictureCamera(views.front().cloud);
    camera.camera_from_cloud = camera.camera_from_cloud * views.front().T_common_cloud.inverse();
    std::vector<Color> colors;
    const Cloud cloud = cloudInCommonFrame(views, colors);
    Picture picture(cloud, colors, camera);
    finish(picture, source, localization);
  }

  void finish(Picture& picture, const CloudSource& source, const Localization& localization)
  {
    drawLocalization(picture, localization, options_.config);
    const std::string others =
        source.views.size() > 1 ? " and " + std::to_string(source.views.size() - 1) + " more" : "";
    picture.drawCaption(std::filesystem::path(source.file).filename().string() + others + ":  " +
                        std::to_string(localization.handles.size()) + " handles,  " +
                        std::to_string(localization.shells.size()) + " shells,  preset " + options_.config.preset +
                        ",  capture radius " + std::to_string(std::lround(1000 * options_.config.hand.capture_radius)) +
                        " mm");
    picture.save(picturePath(options_.picture, localized_));
  }

  const LocalizeOptions& options_;
  Localizer localizer_;
  const bool shows_progress_;  // the tables on a terminal show it already
  Cloud cloud_;
  std::size_t input_ = 0;      // of the options' inputs, from 1
  std::size_t localized_ = 0;  // clouds
  int status_ = kDone;
};

int localizeMain(int argc, char** argv)
{
  std::optional<LocalizeOptions> options;
  try {
    options = parseLocalizeOptions(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "localize: " << error.what() << "\n";
    return kBadUsage;
  }
  const int status = options ? Batch(*options).run() : kDone;
  if (!std::cout.flush()) {
    std::cerr << "localize: cannot write to stdout\n";
    return kBadInput;
  }
  return status;
}

}  // namespace
}  // namespace grasp_affordances

int main(int argc, char** argv)
{
  return grasp_affordances::localizeMain(argc, argv);
}
