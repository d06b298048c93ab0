#include "engine/image/image_io.h"
#include "engine/measure/embree_caster.h"
#include "tests/cli/program.h"

namespace raylab {
namespace {

namespace fs = std::filesystem;

const std::string kFewPixels = " --width 24 --height 16 --repeats 2 --quiet";
const std::string kFew = " --spp 2 --rays 3000";

class CompareTracersCommand : public ProgramTest {
protected:
    int run(const std::string& arguments, const std::string& much = kFew) const {
        return runProgram("compare-tracers " + arguments + kFewPixels + much);
    }
    void expectRefused(const std::string& arguments, const std::string& what) const {
        expectProgramRefuses("compare-tracers " + arguments + kFewPixels + kFew, what);
    }
};

TEST_F(CompareTracersCommand, WritesWhatOthersRelyOn) {
    ASSERT_EQ(run("cornell --a software --b brute --json a.json --heat heat.png -o images"), 0) << text("err");
    const Json result = json("a.json");
    EXPECT_EQ(result["schema"], "raylab.compare-tracers/1");
    EXPECT_EQ(result["rays"], 3000);
    for (const char* name : {"hitMiss", "primitive", "t", "aWrong", "bWrong", "ties", "instance", "tUlp1", "tUlp4",
                             "undecidable", "bothWrong"})
        EXPECT_TRUE(result[name].is_number()) << name;
    EXPECT_EQ(result["aWrong"], 0);
    EXPECT_EQ(result["bWrong"], 0);
    size_t rays = 0;
    for (const Json& kind : result["kinds"]) rays += kind["rays"].get<size_t>();
    EXPECT_EQ(result["kinds"].size(), 6u);
    EXPECT_EQ(rays, 3000u);
    EXPECT_EQ(result["images"]["samplesA"], 2);
    EXPECT_EQ(result["images"]["zTestPassFraction"], 1.0);
    EXPECT_EQ(result["settings"]["a"]["tracer"], "software");
    EXPECT_EQ(result["settings"]["b"]["tracer"], "brute");
    EXPECT_EQ(result["isDefault"]["a"], true);
    EXPECT_EQ(result["isDefault"]["b"], false);
    EXPECT_FALSE(result["device"].get<std::string>().empty());
    EXPECT_TRUE(result["complete"].get<bool>());
    EXPECT_EQ(result["times"].size(), 6u);
    for (const Json& row : result["times"]) {
        EXPECT_LE(row["ratioLow"], row["ratio"]);
        EXPECT_LE(row["ratio"], row["ratioHigh"]);
    }
    EXPECT_EQ(readImage(folder_ / "heat.png").width, 24);
    for (const char* name : {"a.png", "b.png", "a.exr", "b.exr", "difference.png"})
        EXPECT_EQ(readImage(folder_ / "images" / name).height, 16) << name;
    EXPECT_NE(text("out").find("the same hit"), std::string::npos) << "legend";
}

TEST_F(CompareTracersCommand, AnyTwoConfigurationsCanBeCompared) {
    ASSERT_EQ(run("cornell --a software,layout=bvh8q,triangle=minimal --b builder=sweep,layout=bvh2 --only hits,time "
                  "--json -"),
              0)
        << text("err");
    const Json result = json("out");
    EXPECT_EQ(result["settings"]["a"]["layout"], "bvh8q");
    EXPECT_EQ(result["settings"]["a"]["triangle"], "minimal");
    EXPECT_EQ(result["settings"]["b"]["builder"], "sweep");
    EXPECT_EQ(result["settings"]["b"]["tracer"], "software");
    EXPECT_FALSE(result.contains("images"));
}

TEST_F(CompareTracersCommand, EmbreeCanBeASide) {
    if (!hasEmbree()) GTEST_SKIP() << "built without Embree";
    ASSERT_EQ(run("courtyard --b embree-robust --only hits,images --json -", " --rays 20000 --spp 2"), 0) << text("err");
    const Json result = json("out");
    EXPECT_EQ(result["rays"], 20000);
    EXPECT_EQ(result["aWrong"], 0);
    EXPECT_EQ(result["bWrong"], 0) << "leaves cut out of cards by the same rule";
    EXPECT_EQ(result["sides"]["b"], "embree-robust");
    EXPECT_FALSE(result["isDefault"]["b"].get<bool>());
    EXPECT_FALSE(result.contains("images"));
    EXPECT_NE(result["leftOut"].dump().find("Embree renders none"), std::string::npos) << result["leftOut"];
    expectRefused("cornell --b embree,layout=bvh2", "takes no settings");
    expectRefused("quadrics --b embree", "quadrics");
}

TEST_F(CompareTracersCommand, ImagesThatDifferFail) {
    EXPECT_EQ(run("cornell --b software,integrator=normal --only images --json a.json"), 1) << text("err");
    const Json result = json("a.json");
    EXPECT_LT(result["images"]["zTestPassFraction"], 0.9);
    EXPECT_FALSE(result["passed"].get<bool>());
    EXPECT_NE(text("out").find("FAILED: the images differ"), std::string::npos) << text("out");
}

TEST_F(CompareTracersCommand, ATimeLimitEndsInAPartialResult) {
    ASSERT_EQ(run("cornell --b software --time-limit 0.2 --json a.json", " --spp 100000 --rays 1000000000"), 0)
        << text("err");
    const Json result = json("a.json");
    EXPECT_FALSE(result["complete"].get<bool>());
    EXPECT_FALSE(result["leftOut"].empty());
    EXPECT_GT(result["rays"], 0);
    EXPECT_LT(result["rays"], 1000000000);
    EXPECT_NE(text("out").find("partial: "), std::string::npos) << text("out");
}

TEST_F(CompareTracersCommand, WrongUsageIsRefused) {
    expectRefused("cornell --b magic", "--tracer is one of");
    expectRefused("cornell --b software,layot=bvh2", "did you mean layout");
    expectRefused("cornell --b software,layout=bvh3", "--layout is one of");
    expectRefused("cornell --b software,brute", "names two tracers");
    expectRefused("cornell --b software,width=100", "give --width");
    expectRefused("cornell", "--b");
    expectRefused("nowhere.glb --b brute", "nowhere.glb");
    expectRefused("cornell --b brute --only images --heat heat.png", "--heat");
    expectRefused("cornell --b brute --only hits -o images", "-o");
    EXPECT_FALSE(fs::exists(folder_ / "images"));
}

}  // namespace
}  // namespace raylab
