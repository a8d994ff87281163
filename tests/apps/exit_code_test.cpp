// SPDX-License-Identifier: MIT
#include "process/exit_code.h"

#include <exception>
#include <new>
#include <stdexcept>

#include <gtest/gtest.h>

#include <base/error.h>

namespace meshrepair {
namespace {

template <class Exception>
Failure failure_of(const Exception& exception) {
  return describe_failure(std::make_exception_ptr(exception));
}

TEST(DescribeFailure, EachKindOfErrorHasItsCode) {
  EXPECT_EQ(failure_of(UsageError("")).code, ExitCode::usage);
  EXPECT_EQ(failure_of(InputError("")).code, ExitCode::input);
  EXPECT_EQ(failure_of(LimitError("")).code, ExitCode::limit);
  EXPECT_EQ(failure_of(std::bad_alloc()).code, ExitCode::limit);
  EXPECT_EQ(failure_of(NoSolidError("")).code, ExitCode::no_solid);
  EXPECT_EQ(failure_of(OutputError("")).code, ExitCode::output);
  EXPECT_EQ(failure_of(InternalError("")).code, ExitCode::internal);
  EXPECT_EQ(failure_of(std::logic_error("")).code, ExitCode::internal);
  EXPECT_EQ(failure_of(Cancelled()).code, ExitCode::interrupted);
  EXPECT_EQ(failure_of(42).code, ExitCode::internal);
}

TEST(DescribeFailure, MessageIsOneLine) {
  EXPECT_EQ(failure_of(InputError("a.stl: is empty")).message, "a.stl: is empty");
  EXPECT_EQ(failure_of(InputError("one\ntwo\r\n\nthree\n")).message, "one two three");
}

TEST(RunGuarded, ReturnsTheCodeOfTheFunction) {
  EXPECT_EQ(run_guarded("test", [] { return ExitCode::done; }), 0);
  EXPECT_EQ(run_guarded("test", [] { return ExitCode::not_certified; }), 1);
}

TEST(RunGuarded, PrintsOneLineForAnException) {
  testing::internal::CaptureStderr();
  const int code = run_guarded("test", []() -> ExitCode { throw InputError("a.stl: is empty"); });
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "test: a.stl: is empty\n");
  EXPECT_EQ(code, 3);
}

}  // namespace
}  // namespace meshrepair
