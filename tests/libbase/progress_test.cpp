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

}  // namespace
}  // namespace meshrepair
