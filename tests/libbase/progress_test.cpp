// SPDX-License-Identifier: MIT
#include <vector>

#include <gtest/gtest.h>

#include <base/error.h>
#include <base/progress.h>

namespace meshrepair {
namespace {

class Canceller : public ProgressObserver {
 public:
  bool cancelled() override {
    ++asked;
    return true;
  }
  int asked = 0;
};

TEST(CancelCheck, AsksNowAndThenAndThrows) {
  Canceller canceller;
  CancelCheck check(&canceller);
  for (int i = 0; i < 100; ++i) check.tick();
  EXPECT_EQ(canceller.asked, 0);
  const auto tick_often = [&] {
    for (int i = 0; i < 10000; ++i) check.tick();
  };
  EXPECT_THROW(tick_often(), Cancelled);
  EXPECT_EQ(canceller.asked, 1);
}

TEST(CancelCheck, NeedsNoObserver) {
  CancelCheck check(nullptr);
  EXPECT_NO_THROW({
    for (int i = 0; i < 10000; ++i) check.tick();
  });
}

class Shares : public ProgressObserver {
 public:
  void advance(double share) override { shares.push_back(share); }
  std::vector<double> shares;
};

TEST(HalvedStage, LeavesHalfOfTheRestToNextSteps) {
  Shares told;
  HalvedStage stage(&told);
  stage.begin_step();
  stage.advance(0.5);
  stage.advance(1);
  stage.advance(0.25);  // begins anew within the step
  stage.begin_step();
  stage.advance(0);
  stage.advance(1);
  EXPECT_EQ(told.shares, (std::vector{0.25, 0.5, 0.75}));
}

TEST(HalvedStage, PassesOnThatItIsToEnd) {
  Canceller canceller;
  EXPECT_TRUE(HalvedStage(&canceller).cancelled());
  EXPECT_FALSE(HalvedStage(nullptr).cancelled());
  EXPECT_NO_THROW(HalvedStage(nullptr).advance(1));
}

}  // namespace
}  // namespace meshrepair
