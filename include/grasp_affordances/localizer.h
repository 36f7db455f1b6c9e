#pragma once

#include "grasp_affordances/cloud.h"
#include "grasp_affordances/config.h"
#include "grasp_affordances/localization.h"

#include <memory>

namespace grasp_affordances
{

/// Localizes enveloping grasp affordances in point clouds (paper, Algorithm 1).
///
/// The result depends on the cloud, the configuration and its seed alone: not on the number of threads, nor on clouds
/// seen before. One instance serves one caller at a time; it keeps its working memory from cloud to cloud.
class Localizer
{
public:
  /// @throw ParameterError for a value outside its range.
  explicit Localizer(const Config& config = Config());
  ~Localizer();
  Localizer(Localizer&&) noexcept;
  Localizer& operator=(Localizer&&) noexcept;

  /// Never fails for what a cloud holds: a cloud without a usable point gives no samples, no shells and a warning.
  Localization localize(const Cloud& cloud);

  /// The same into a result whose memory is used again. For organized clouds with intrinsics, of a size seen before,
  /// nothing is allocated but by what has to grow.
  void localize(const Cloud& cloud, Localization& result);

  const Config& config() const;

private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace grasp_affordances
