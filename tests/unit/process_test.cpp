#include "engine/core/process.h"

#include <gtest/gtest.h>

#include "engine/core/error.h"

namespace raylab {
namespace {

TEST(Process, GivesOutputAndExitCode) {
    const ProcessResult result = runProcess({"sh", "-c", "echo out; echo 'a  b' >&2; exit 3"});
    EXPECT_EQ(result.exitCode, 3);
    EXPECT_NE(result.output.find("out\n"), std::string::npos);
    EXPECT_NE(result.output.find("a  b\n"), std::string::npos);
    EXPECT_EQ(runProcess({"printf", "%s", "$HOME; *"}).output, "$HOME; *") << "no shell sees the words";
    EXPECT_EQ(runProcess({"sh", "-c", "kill -9 $$"}).exitCode, 128 + 9);
}

TEST(Process, ReadsMoreThanAPipeHolds) {
    EXPECT_EQ(runProcess({"head", "-c", "300000", "/dev/zero"}).output.size(), 300000u);
}

TEST(Process, SaysWhatCannotBeRun) {
    try {
        runProcess({"no-such-program-of-raylab"});
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("no-such-program-of-raylab"), std::string::npos);
    }
}

}  // namespace
}  // namespace raylab
