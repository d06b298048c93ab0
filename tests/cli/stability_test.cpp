#include <set>

#include "engine/image/image_io.h"
#include "tests/cli/program.h"

namespace raylab {
namespace {

class StabilityCommand : public ProgramTest {};

TEST_F(StabilityCommand, WritesWhatOthersRelyOn) {
    ASSERT_EQ(runProgram("stability --case S2,S7,S9 --quick --json a.json --csv a.csv"), 0)
        << text("err") << text("out");
    const Json result = json("a.json");
    EXPECT_EQ(result["schema"], "raylab.stability/1");
    EXPECT_TRUE(result["complete"].get<bool>());
    EXPECT_EQ(result["defaultFailures"], 0);
    std::set<std::string> ids;
    for (const Json& row : result["rows"]) {
        ids.insert(row["id"].get<std::string>());
        EXPECT_EQ(row["config"], "default");
        EXPECT_EQ(row["isDefault"], true);
        EXPECT_EQ(row["pass"], true) << row;
        EXPECT_LE(row["number"], row["limit"]) << row;
        EXPECT_TRUE(row["unit"].is_string());
        EXPECT_GT(row["seconds"], 0.0);
    }
    EXPECT_EQ(ids, (std::set<std::string>{"S2", "S7", "S9"}));
    EXPECT_EQ(text("a.csv").rfind("id,config,isDefault,what,number,limit,unit,verdict,seconds,note\n", 0), 0u);
    EXPECT_NE(text("out").find("0 fail"), std::string::npos) << text("out");
}

/// What other choices fail is shown with a picture, and is no failure of the run.
TEST_F(StabilityCommand, FailuresOfOtherChoicesAreShown) {
    ASSERT_EQ(runProgram("stability --case S7 --configs slabs --quick -o report --json -"), 0) << text("err");
    const Json result = json("out");
    bool plainFails = false;
    for (const Json& row : result["rows"])
        plainFails = plainFails || (row["config"] == "slab plain" && row["pass"] == false);
    EXPECT_TRUE(plainFails) << result;
    const std::string html = text("report/stability.html");
    EXPECT_NE(html.find("slab plain"), std::string::npos);
    EXPECT_NE(html.find("data:image/png;base64,iVBORw0KGgo"), std::string::npos);
    EXPECT_EQ(html.find("src=\"http"), std::string::npos);
    EXPECT_EQ(readImage(folder_ / "report" / "S7-1.png").width, 256);
}

/// What is within its limit is shown too, where there is something to see.
TEST_F(StabilityCommand, PlotsHowNumbersComeAbout) {
    ASSERT_EQ(runProgram("stability --case S19,S33 --quick -o report"), 0) << text("err");
    const std::string html = text("report/stability.html");
    EXPECT_NE(html.find("<svg"), std::string::npos);
    EXPECT_NE(html.find("a sum in float</text>"), std::string::npos);
    EXPECT_NE(html.find(">alpha</text>"), std::string::npos);
}

TEST_F(StabilityCommand, WhatIsMissingIsARow) {
    std::filesystem::create_directory(folder_ / "none");
    ASSERT_EQ(runProgram("stability --case S3 --scenes none --json a.json"), 0) << text("err");
    const Json row = json("a.json")["rows"][0];
    EXPECT_NE(row["skipped"].get<std::string>().find("--scenes"), std::string::npos);
    EXPECT_TRUE(row["number"].is_null());
    EXPECT_TRUE(row["pass"].is_null());
}

TEST_F(StabilityCommand, ATimeLimitEndsInAPartialResult) {
    ASSERT_EQ(runProgram("stability --time-limit 0.001 --json a.json"), 0) << text("err");
    EXPECT_FALSE(json("a.json")["complete"].get<bool>());
}

TEST_F(StabilityCommand, WrongUsageIsRefused) {
    expectProgramRefuses("stability --case S99", "there is no case 'S99'; there are S1, S2");
    expectProgramRefuses("stability --configs magic", "--configs");
    expectProgramRefuses("stability --scenes nowhere", "nowhere is no folder");
}

}  // namespace
}  // namespace raylab
