#include "evaluation/runtime.h"

#include "grasp_affordances/localizer.h"

namespace grasp_affordances
{

std::vector<Runtime> measureRuntimes(const Cloud& cloud, const std::vector<Config>& variations,
                                     const std::vector<int>& samples, std::size_t repetitions,
                                     const std::function<void()>& done)
{
  std::vector<Runtime> runtimes;
  for (Config config : variations) {
    config.neighborhood.kind = NeighborhoodKind::knn;
    for (const int count : samples) {
      config.sampling.samples = count;
      Localizer localizer(config);
      localizer.localize(cloud);
      std::vector<double> milliseconds;
      for (std::size_t i = 0; i < repetitions; ++i) {
        milliseconds.push_back(localizer.localize(cloud).milliseconds.total);
      }
      runtimes.push_back({config, mean(milliseconds)});
      done();
    }
  }
  return runtimes;
}

}  // namespace grasp_affordances
