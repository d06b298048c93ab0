#pragma once

#include <cstdio>

#include "engine/measure/stability/cases.h"
#include "tests/support/gpu_test.h"
#include "tests/support/paths.h"
#include "tests/support/trace_choice.h"

/// Tests that assert on the numbers of the stability battery.
namespace raylab::support {

using stability::Context;
using stability::Number;

class BatteryTest : public GpuTest {
protected:
    Context contextOf(const RenderSettings& settings, bool quick = false) const {
        return {.device = device_, .settings = settings, .quick = quick, .scenes = sharedScenes()};
    }
};

/// Every number is within its limit.
inline void expectPass(const std::vector<Number>& numbers, const std::string& what) {
    EXPECT_FALSE(numbers.empty()) << what;
    for (const Number& number : numbers)
        EXPECT_TRUE(number.passes()) << what << ": " << number.what << " " << number.value << ", limit " << number.limit
                                     << " " << number.note;
}

/// As `measure` measures them; a case that needs a file that is not there is left out with a line that says so.
inline std::vector<Number> measureOrSkip(std::vector<Number> (*measure)(const Context&), const Context& context) {
    try {
        return measure(context);
    } catch (const stability::Skipped& skipped) {
        std::printf("not run: %s\n", skipped.what());
        return {};
    }
}

}  // namespace raylab::support
