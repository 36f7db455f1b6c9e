#pragma once

#include "benchmark/textbook.h"
#include "core/cloud/range_image.h"
#include "core/fit/curvature.h"
#include "core/fit/quadric.h"
#include "core/neighborhoods/neighborhoods.h"
#include "core/shell/shell.h"
#include "grasp_affordances/cloud.h"
#include "grasp_affordances/config.h"

#include <pcl/PCLPointCloud2.h>
#include <pcl/search/organized.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace grasp_affordances::test
{

/// A sample that the preset `paper` fits a quadric to, with what each stage leaves for the next.
struct StageSample
{
  Neighborhood neighborhood;
  Moments moments;
  TaubinFit fit;
  NeighborhoodCurvature curvature;
  FittedCylinder cylinder;
  textbook::LocalPoints local_points;
  textbook::QuadricFit textbook_fit;
};

/// What the stages work on, and their working memory.
class Workbench
{
public:
  /// The cloud must outlive the workbench. @throw std::runtime_error for a cloud without range image.
  explicit Workbench(const Cloud& cloud);

  const StageSample& nextSample() { return samples_[next_sample_++ % samples_.size()]; }
  /// One that the shell search gets to see: curved enough, and thin enough.
  const StageSample& nextCurvedSample() { return samples_[curved_[next_curved_++ % curved_.size()]]; }

  const Cloud& cloud;
  const Config paper, localizer;
  RangeImage image;
  std::unique_ptr<NeighborhoodSearch> search;
  std::vector<std::uint32_t> measured;  // indices of the measured points
  Cloud hidden;
  RangeImage hidden_image;
  std::unique_ptr<NeighborhoodSearch> hidden_search;
  pcl::PCLPointCloud2 message;
  textbook::PclCloud::Ptr pcl_cloud;
  pcl::search::OrganizedNeighbor<pcl::PointXYZ> pcl_search;

  Neighborhood neighborhood;
  TaubinFitter fitter;
  CurvatureScratch curvature_scratch;
  ShellSearch shell_search;
  Cloud converted;
  std::mt19937 random;
  std::vector<int> indices;
  std::vector<float> squared_distances;

private:
  void addSample(std::uint32_t point);

  std::vector<StageSample> samples_;
  std::vector<std::size_t> curved_;
  std::size_t next_sample_ = 0, next_curved_ = 0;
};

/// A stage of the package, or of the textbook pipeline, for itself.
struct Stage
{
  std::string name;  ///< "sample/..." where a call works on a sample, "cloud/..." where it works on the cloud
  void (*run)(Workbench&);
};

const std::vector<Stage>& stages();

}  // namespace grasp_affordances::test
