#include "core/views/prepared_views.h"

#include "core/fit/principal_axis.h"
#include "core/views/stratified_draw.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace grasp_affordances
{
namespace
{

/// m, of the sphere of a neighborhood of kind `radius`.
float sphereRadius(const Config& config)
{
  const double radius = config.neighborhood.radius;
  return static_cast<float>(radius > 0.0 ? radius : config.hand.capture_radius);
}

}  // namespace

void PreparedViews::update(const std::vector<PosedCloud>& views, const Config& config,
                           const Eigen::Isometry3d& T_workspace_common, ThreadTeam& team)
{
  while (clouds_.size() < views.size()) {
    clouds_.emplace_back();
  }
  views_.clear();
  warnings.clear();
  nothing_sampled = NothingSampled::no_cloud;
  measured = 0;
  disagreement = std::numeric_limits<double>::quiet_NaN();
  std::uint32_t first_point = 0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    PreparedCloud& cloud = clouds_[i];
    cloud.update(*views[i].cloud, config, T_workspace_common * views[i].T_common_cloud, team);
    for (const std::string& warning : cloud.warnings) {
      warnings.push_back(views.size() == 1 ? warning : "view " + std::to_string(i + 1) + ": " + warning);
    }
    if (!views[i].T_common_cloud.matrix().cast<float>().allFinite()) {  // relative poses might then be NaN
      warnings.push_back("view " + std::to_string(i + 1) + ": its pose is not finite in single precision");
    } else if (cloud.search != nullptr) {
      views_.push_back({i + 1, &cloud, views[i].T_common_cloud, first_point});
    }
    nothing_sampled = std::max(nothing_sampled, cloud.nothing_sampled.value_or(NothingSampled::no_cloud));
    measured += static_cast<std::uint32_t>(cloud.measured.size());
    first_point += static_cast<std::uint32_t>(views[i].cloud->size());
  }
  others_.resize(size());
  for (std::vector<OtherView>& others : others_) {
    others.clear();
  }
  if (size() > 1) {
    joinPoints();
    relateViews();
    compareViews(team);
    uncoverHiddenSurfaces(config.hand.finger_thickness, team);
  }
  if (!views_.empty() && !hasSamples()) {
    nothing_sampled = NothingSampled::outside_workspace;
    warnings.push_back(nothingToLocalize(nothing_sampled));
  }
  if (hasSamples() && config.estimation.estimator == Estimator::normals) {
    for (const View& view : views_) {
      view.cloud->normals.reset(view.cloud->cloud->size());
    }
  }
}

void PreparedViews::joinPoints()
{
  points_.clear();
  for (const View& view : views_) {
    const std::vector<std::uint32_t>& all = view.cloud->drawablePoints();
    std::transform(all.begin(), all.end(), std::back_inserter(points_),
                   [&](std::uint32_t point) { return view.first_point + point; });
  }
  joinScreened();
}

/// The views take turns, so that each has the same share of the first points of the list as of the whole list: a first
/// round draws its samples from the first points.
void PreparedViews::joinScreened()
{
  screened_.clear();
  if (!allHaveImages()) {
    return;  // points of a view without an image cannot be screened, and would hardly be drawn
  }
  std::size_t total = 0;
  for (View& view : views_) {
    view.joined = 0;
    total += view.cloud->screen.points().size();
  }
  const auto isLater = [](const View& a, const View& b) {
    return (2 * a.joined + 1) * b.cloud->screen.points().size() > (2 * b.joined + 1) * a.cloud->screen.points().size();
  };
  while (screened_.size() < total) {
    View* next = nullptr;
    for (View& view : views_) {
      if (view.joined < view.cloud->screen.points().size() && (next == nullptr || isLater(*next, view))) {
        next = &view;
      }
    }
    screened_.push_back(next->first_point + next->cloud->screen.points()[next->joined++]);
  }
}

void PreparedViews::relateViews()
{
  T_.clear();
  for (const View& to : views_) {
    for (const View& from : views_) {
      T_.push_back(to.T_common_cloud.inverse() * from.T_common_cloud);
    }
  }
  for (std::size_t view = 0; view < size(); ++view) {
    for (std::size_t other = 0; other < size(); ++other) {
      if (other != view) {
        const ShellSurroundings seen = surroundings(other, 0.0);
        others_[view].push_back({&seen.cloud, seen.hidden, seen.image, transform(other, view)});
      }
    }
  }
}

void PreparedViews::compareViews(ThreadTeam& team)
{
  compared_.clear();
  for (const View& view : views_) {
    compared_.push_back({view.number, view.cloud->image ? &*view.cloud->image : nullptr, view.T_common_cloud});
  }
  comparison_.compare(compared_, team);
  disagreement = comparison_.disagreement();
  warnings.insert(warnings.end(), comparison_.warnings().begin(), comparison_.warnings().end());
}

/// Takes out points of hidden surfaces where another view saw through.
void PreparedViews::uncoverHiddenSurfaces(double margin, ThreadTeam& team)
{
  for (std::size_t view = 0; view < size(); ++view) {
    PreparedCloud& cloud = *views_[view].cloud;
    if (!cloud.hidden_search) {
      continue;
    }
    for (std::size_t other = 0; other < size(); ++other) {
      if (other != view && views_[other].cloud->image) {
        cloud.hidden.remove(
            [&](const Eigen::Vector3f& point) {
              return sawThrough(other, transform(other, view) * point.cast<double>(), margin);
            },
            team);
      }
    }
  }
}

/// Whether a view measured something that is farther away than a point (in the view's frame) by more than a margin (m).
bool PreparedViews::sawThrough(std::size_t view, const Eigen::Vector3d& point, double margin) const
{
  const RangeImage& image = *views_[view].cloud->image;
  const auto pixel = image.pixel(point);
  return pixel && image.cloud().measured(*pixel) &&
         image.cloud().point(*pixel).cast<double>().norm() > point.norm() + margin;
}

PreparedViews::MeasuredPoint PreparedViews::drawAnywhere(const SamplingConfig& config, std::uint64_t i) const
{
  const std::vector<std::uint32_t>& screened = size() == 1 ? views_[0].cloud->screen.points() : screened_;
  return viewOf(drawStratified(drawablePoints(), screened, config, i));
}

PreparedViews::MeasuredPoint PreparedViews::viewOf(std::uint32_t point) const
{
  if (size() == 1) {
    return {0, point};
  }
  std::size_t view = size() - 1;
  while (views_[view].first_point > point) {
    --view;
  }
  return {view, point - views_[view].first_point};
}

bool PreparedViews::allHaveImages() const
{
  return std::all_of(views_.begin(), views_.end(), [](const View& view) { return view.cloud->image.has_value(); });
}

Eigen::Vector3f PreparedViews::centerIn(std::size_t view, const MeasuredPoint& sample) const
{
  const Eigen::Vector3f center = views_[sample.view].cloud->cloud->point(sample.point);
  return view == sample.view ? center
                             : Eigen::Vector3f((transform(view, sample.view) * center.cast<double>()).cast<float>());
}

std::size_t PreparedViews::look(const MeasuredPoint& sample, const Config& config, SphereView* spheres) const
{
  std::size_t points = 0;
  for (std::size_t view = 0; view < size(); ++view) {
    spheres[view] = views_[view].cloud->windowSearch()->look(centerIn(view, sample), sphereRadius(config));
    points += spheres[view].survey.points;
  }
  return points;
}

void PreparedViews::gather(const MeasuredPoint& sample, const Config& config, bool with_index,
                           Neighborhood& neighborhood, SphereView* spheres, Neighborhood& part) const
{
  const PreparedCloud& own = *views_[sample.view].cloud;
  const Eigen::Vector3f center = centerIn(sample.view, sample);
  const bool knn = config.neighborhood.kind == NeighborhoodKind::knn;
  if (size() == 1) {
    *spheres = knn ? own.gatherNearest(center, static_cast<std::size_t>(config.neighborhood.k), config.occlusion.filter,
                                       neighborhood)
                   : own.gather(center, sphereRadius(config), with_index, neighborhood);
    return;
  }
  const float radius = knn ? radiusOfNearest(sample, config, neighborhood, part) : sphereRadius(config);
  spheres[sample.view] = own.gather(center, radius, with_index, neighborhood);
  for (std::size_t view = 0; view < size(); ++view) {
    if (view != sample.view) {
      spheres[view] = views_[view].cloud->gather(centerIn(view, sample), radius, with_index, part);
      neighborhood.append(part, transform(sample.view, view));
    }
  }
}

/// m, distance of the k-th nearest point of all views, or of the farthest point where there are fewer than k.
float PreparedViews::radiusOfNearest(const MeasuredPoint& sample, const Config& config, Neighborhood& joined,
                                     Neighborhood& part) const
{
  const auto k = static_cast<std::size_t>(config.neighborhood.k);
  views_[sample.view].cloud->search->nearest(centerIn(sample.view, sample), k, joined);
  const bool bounded = joined.size() == k;  // then points of other views that are farther than these do not count
  for (std::size_t view = 0; view < size(); ++view) {
    if (view != sample.view) {
      const NeighborhoodSearch& search = *views_[view].cloud->search;
      const Eigen::Vector3f center = centerIn(view, sample);
      bounded ? search.withinRadius(center, joined.radius, part) : search.nearest(center, k, part);
      joined.append(part, transform(sample.view, view));
    }
  }
  joined.keepNearest(std::min(k, joined.size()));
  return std::nextafter(joined.radius, std::numeric_limits<float>::infinity());  // its square holds the last of them
}

bool PreparedViews::occluded(const OcclusionConfig& config, const SphereView* spheres) const
{
  const auto enough = static_cast<std::size_t>(config.max_points_in_front);
  for (std::size_t view = 0; view < size(); ++view) {
    const std::optional<RangeImage>& image = views_[view].cloud->image;
    if (spheres[view].survey.points > 0 &&
        !(image && grasp_affordances::occluded(*image, spheres[view], enough, config.min_distance_in_front))) {
      return false;
    }
  }
  return true;
}

/// Calls visit(view, begin, count) for each view: which points of a gathered neighborhood it contributed.
template <typename Visitor>
void PreparedViews::visitParts(const MeasuredPoint& sample, const SphereView* spheres, Visitor&& visit) const
{
  std::size_t begin = spheres[sample.view].survey.points;
  visit(sample.view, std::size_t{0}, begin);
  for (std::size_t view = 0; view < size(); ++view) {
    if (view != sample.view) {
      visit(view, begin, spheres[view].survey.points);
      begin += spheres[view].survey.points;
    }
  }
}

std::optional<Eigen::Vector3d> PreparedViews::normalsAxis(const MeasuredPoint& sample, const Neighborhood& neighborhood,
                                                          const SphereView* spheres) const
{
  if (size() == 1) {
    return grasp_affordances::normalsAxis(neighborhood, views_[0].cloud->normals.normals());
  }
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  visitParts(sample, spheres, [&](std::size_t view, std::size_t begin, std::size_t count) {
    const Eigen::Matrix3d rotation = transform(sample.view, view).linear();
    const Normals& normals = views_[view].cloud->normals.normals();
    scatter += rotation * normalsScatter(normals, neighborhood.index() + begin, count) * rotation.transpose();
  });
  return grasp_affordances::normalsAxis(scatter);
}

/// At all points in the neighborhoods of those samples that are not occluded.
void PreparedViews::estimateNormals(const Config& config, const MeasuredPoint* samples, std::size_t count,
                                    ThreadTeam& team, const Cancellation& cancellation)
{
  neighborhoods_.resize(2 * team.size());
  spheres_.resize(size() * team.size());
  team.forEach(count, [&](std::size_t i, std::size_t member) {
    if (cancellation.wanted()) {
      return;
    }
    Neighborhood& neighborhood = neighborhoods_[2 * member];
    SphereView* spheres = &spheres_[member * size()];
    const MeasuredPoint& sample = samples[i];
    gather(sample, config, true, neighborhood, spheres, neighborhoods_[2 * member + 1]);
    if (!config.occlusion.filter || !occluded(config.occlusion, spheres)) {
      visitParts(sample, spheres, [&](std::size_t view, std::size_t begin, std::size_t count) {
        views_[view].cloud->normals.require(neighborhood.index() + begin, count);
      });
    }
  });
  cancellation.check();
  const bool sparse = config.estimation.normals_mode == NormalsMode::sparse;
  for (const View& view : views_) {
    view.cloud->normals.compute(*view.cloud->cloud, *view.cloud->search, config.estimation.normals_radius,
                                sparse ? SurfaceNormals::kSparseStride : 1, team, cancellation);
  }
}

double PreparedViews::spacing(std::size_t view, const Eigen::Vector3d& point) const
{
  const std::optional<RangeImage>& image = views_[view].cloud->image;
  return image ? image->spacing(point.z()) : 0.0;
}

ShellSurroundings PreparedViews::surroundings(std::size_t view, double spacing) const
{
  const PreparedCloud& cloud = *views_[view].cloud;
  return {*cloud.search, cloud.hidden_search ? &*cloud.hidden_search : nullptr, cloud.image ? &*cloud.image : nullptr,
          spacing, &others_[view]};
}

}  // namespace grasp_affordances
