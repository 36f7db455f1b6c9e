#include "nodelets/localizer/input_demand.h"

#include <ros/exceptions.h>

#include <gtest/gtest.h>

#include <string>

namespace grasp_affordances
{
namespace
{

/// A demand for inputs, and what it has done.
class InputDemandTest : public testing::Test
{
protected:
  void open(bool lazy, bool on_demand)
  {
    demand_.open("test", {lazy, on_demand, [this] { return listens_; },
                          [this] {
                            ++begun_;
                            if (broken_) {
                              throw ros::InvalidNameException("no such name");
                            }
                          },
                          [this] { ++ended_; }});
  }

  bool subscribed() const { return begun_ == ended_ + 1; }

  bool listens_ = false;
  bool broken_ = false;
  int begun_ = 0;
  int ended_ = 0;
  InputDemand demand_;
};

TEST_F(InputDemandTest, DoesNothingBeforeItIsOpen)
{
  listens_ = true;
  demand_.update();
  EXPECT_EQ(demand_.demand(true), "");
  demand_.demand(false);
  EXPECT_EQ(begun_, 0);
  open(true, false);
  EXPECT_TRUE(subscribed());  // somebody listened before
}

TEST_F(InputDemandTest, FollowsListenersWhereItIsLazy)
{
  open(true, false);
  EXPECT_FALSE(subscribed());
  listens_ = true;
  demand_.update();
  demand_.update();
  EXPECT_TRUE(subscribed());
  EXPECT_EQ(begun_, 1);
  listens_ = false;
  demand_.update();
  EXPECT_FALSE(subscribed());
}

TEST_F(InputDemandTest, SubscribesAtOnceWhereItIsNotLazy)
{
  open(false, false);
  EXPECT_TRUE(subscribed());
  demand_.close();
  EXPECT_FALSE(subscribed());
}

TEST_F(InputDemandTest, IgnoresListenersOnDemand)
{
  open(true, true);
  listens_ = true;
  demand_.update();
  EXPECT_FALSE(subscribed());
  EXPECT_EQ(demand_.demand(true), "");
  EXPECT_TRUE(subscribed());
  demand_.demand(false);
  EXPECT_FALSE(subscribed());
}

TEST_F(InputDemandTest, SaysWhyThereIsNoInputAndTriesAgain)
{
  open(true, false);
  broken_ = true;
  EXPECT_NE(demand_.demand(true).find("no such name"), std::string::npos);
  EXPECT_EQ(begun_, 1);
  EXPECT_EQ(ended_, 1);  // what had begun of several subscriptions has ended
  broken_ = false;
  demand_.update();
  EXPECT_EQ(begun_, 2);
  EXPECT_TRUE(subscribed());
}

TEST_F(InputDemandTest, NeverSubscribesAfterItsEnd)
{
  listens_ = true;
  open(true, false);
  demand_.close();
  EXPECT_FALSE(subscribed());
  demand_.update();
  demand_.demand(true);
  EXPECT_EQ(begun_, 1);
  EXPECT_EQ(ended_, 1);
}

}  // namespace
}  // namespace grasp_affordances
