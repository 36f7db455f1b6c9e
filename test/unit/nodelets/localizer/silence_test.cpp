#include "nodelets/localizer/silence.h"

#include <gtest/gtest.h>

namespace grasp_affordances
{
namespace
{

TEST(DescribeSilence, ClaimsNothingThatOnlyTheMasterKnows)
{
  const CloudPace::Time begin{std::chrono::hours(1)};
  CloudPace pace;
  pace.begin(begin);
  EXPECT_EQ(describeSilence(ros::Subscriber(), pace, begin + std::chrono::seconds(5)),
            ", none came in 5 s (the master does not answer)");
}

}  // namespace
}  // namespace grasp_affordances
