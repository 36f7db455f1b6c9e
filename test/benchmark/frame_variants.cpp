#include "benchmark/frame_variants.h"

#include "benchmark/textbook.h"
#include "grasp_affordances/localizer.h"
#include "grasp_affordances/parameters.h"

#include <algorithm>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace grasp_affordances::test
{
namespace
{

/// Changes the config as one part of a variant's name says.
void applyChange(const std::string& change, Config& config)
{
  if (change == "2_threads") {
    config.threads = 2;
  } else if (change == "1000_samples") {
    config.sampling.samples = 1000;
  } else if (change == "10000_samples") {
    config.sampling.samples = 10000;
  } else if (change == "unfiltered") {
    config.occlusion.filter = false;
  } else if (change == "48_mm") {
    config.hand.capture_radius = 0.048;
  } else if (change == "500_nearest") {
    config.neighborhood.kind = NeighborhoodKind::knn;
  } else if (change == "sparse_normals") {
    config.estimation.estimator = Estimator::normals;
    config.estimation.normals_mode = NormalsMode::sparse;
  } else {
    config.estimation.estimator = enumFromWord<Estimator>("estimator", change);
  }
}

FrameVariant makeFrameVariant(const std::string& name)
{
  std::istringstream parts(name);
  std::string part;
  std::getline(parts, part, '/');
  FrameVariant variant{name, presetConfig(part == "textbook" ? "paper" : part), part == "textbook"};
  variant.config.threads = 1;
  while (std::getline(parts, part, '/')) {
    applyChange(part, variant.config);
  }
  validate(variant.config);
  return variant;
}

std::vector<FrameVariant> makeFrameVariants()
{
  std::vector<FrameVariant> variants;
  const auto add = [&](const std::string& pipeline, const std::vector<std::string>& changes) {
    variants.push_back(makeFrameVariant(pipeline));
    for (const std::string& change : changes) {
      variants.push_back(makeFrameVariant(pipeline + "/" + change));
    }
  };
  add("paper", {"2_threads", "1000_samples", "10000_samples", "48_mm", "500_nearest", "pca", "normals",
                "sparse_normals", "unfiltered", "unfiltered/2_threads", "unfiltered/pca", "unfiltered/sparse_normals"});
  add("localizer",
      {"2_threads", "1000_samples", "10000_samples", "48_mm", "500_nearest", "pca", "normals", "sparse_normals"});
  add("textbook", {"unfiltered", "48_mm", "500_nearest", "pca", "normals"});
  return variants;
}

}  // namespace

const std::vector<FrameVariant>& frameVariants()
{
  static const std::vector<FrameVariant> variants = makeFrameVariants();
  return variants;
}

const FrameVariant& frameVariant(std::string_view name)
{
  const auto& variants = frameVariants();
  const auto found =
      std::find_if(variants.begin(), variants.end(), [&](const FrameVariant& variant) { return variant.name == name; });
  if (found == variants.end()) {
    throw std::out_of_range("no frame variant is called " + std::string(name));
  }
  return *found;
}

std::function<Localization()> frameRun(const FrameVariant& variant, const Cloud& cloud)
{
  if (variant.textbook) {
    const auto pipeline = std::make_shared<textbook::Pipeline>(variant.config);
    return [pipeline, pcl_cloud = textbook::toPcl(cloud)] { return pipeline->localize(pcl_cloud); };
  }
  const auto localizer = std::make_shared<Localizer>(variant.config);
  return [localizer, &cloud] { return localizer->localize(cloud); };
}

}  // namespace grasp_affordances::test
