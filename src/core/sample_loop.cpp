#include "core/sample_loop.h"

#include "core/parallel/stopwatch.h"

#include <algorithm>
#include <cstddef>

namespace grasp_affordances
{

void SampleLoop::run(const Work& work)
{
  times_ = StageTimes();
  draw_.start(work.views, work.config);
  results_.resize(draw_.size());
  for (std::size_t begin = 0; begin < draw_.size();) {
    const std::size_t end = draw_.drawRound(work.views, work.config, results_.data(), work.team, work.cancellation);
    examine(work, SampleSpan{begin, end - begin, draw_.points() + begin, &results_[begin]});
    begin = end;
  }
}

void SampleLoop::examine(const Work& work, const std::vector<PreparedViews::MeasuredPoint>& points)
{
  times_ = StageTimes();
  results_.resize(points.size());
  examine(work, SampleSpan{0, points.size(), points.data(), results_.data()});
}

void SampleLoop::examine(const Work& work, const SampleSpan& span)
{
  if (work.config.estimation.estimator == Estimator::normals) {
    Stopwatch stopwatch;
    work.views.estimateNormals(work.config, span.points, span.count, work.team, work.cancellation);
    times_.preparation += stopwatch.lap();
  }
  blocks_.resize(work.team.size());
  for (SampleBlock& block : blocks_) {
    block.times = StageTimes();
  }
  const SampleContext context{work.views, work.config, work.budget, work.cancellation};
  constexpr std::size_t kSize = SampleBlock::kSamples;
  work.team.forEach((span.count + kSize - 1) / kSize, [&](std::size_t i, std::size_t member) {
    const std::size_t begin = i * kSize, end = std::min(begin + kSize, span.count);
    blocks_[member].examine(context, {span.first + begin, end - begin, span.points + begin, span.results + begin});
  });
  work.cancellation.check();
  for (const SampleBlock& block : blocks_) {
    times_.neighborhoods += block.times.neighborhoods;
    times_.occlusion += block.times.occlusion;
    times_.fit += block.times.fit;
    times_.shell += block.times.shell;
  }
}

}  // namespace grasp_affordances
