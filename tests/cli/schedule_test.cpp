#include "engine/image/image_io.h"
#include "tests/cli/program.h"

namespace raylab {
namespace {

using Schedule = ProgramTest;

TEST_F(Schedule, QueuesAreReportedAndDoNotShow) {
    const std::string render = "render cornell --width 19 --height 11 --spp 2 --depth 3 ";
    ASSERT_EQ(runProgram(render + "-o mega.exr --json mega.json"), 0) << text("err");
    ASSERT_EQ(
        runProgram(render +
                   "--schedule wavefront --queue-order octant --queue-paths 20000 -o queues.exr --json queues.json"),
        0)
        << text("err");
    EXPECT_EQ(json("mega.json")["memoryBytes"]["queues"], 0);
    EXPECT_GT(json("queues.json")["memoryBytes"]["queues"], 19968 * 9 * 16);
    EXPECT_EQ(json("queues.json")["rays"], json("mega.json")["rays"]);
    EXPECT_EQ(readImage(folder_ / "queues.exr").pixels, readImage(folder_ / "mega.exr").pixels);
}

TEST_F(Schedule, InfoTellsAPathsMemory) {
    ASSERT_EQ(runProgram("info cornell --json plain.json"), 0) << text("err");
    EXPECT_EQ(json("plain.json")["pathBytes"], 9 * 16 + 8);
}

TEST_F(Schedule, IsForPathsAlone) {
    expectProgramRefuses("render cornell --schedule wavefront --integrator normal -o a.png", "--schedule mega");
}

}  // namespace
}  // namespace raylab
