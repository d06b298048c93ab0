#include <algorithm>
#include <cmath>
#include <sstream>

#include "engine/image/image_io.h"
#include "tests/cli/program.h"

namespace raylab {
namespace {

using Chart = ProgramTest;
using Merge = ProgramTest;
using Preset = ProgramTest;
using Advise = ProgramTest;

/// Seconds: a picture that is nearly nothing.
const std::string kSmallCornell = "cornell --width 24 --height 24 --depth 2";
const std::string kChart =
    "chart " + kSmallCornell + " -o c --vary sampler=sobol,independent --seeds 2 --reference-error 0.3 --quiet";

std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

TEST_F(Chart, WritesATableAChartAndAReportAndGoesOnWhereItStopped) {
    ASSERT_EQ(runProgram(kChart + " --points 2"), 0) << text("err");
    std::vector<std::string> before = linesOf(text("c/chart.csv"));
    ASSERT_EQ(before.size(), 1u + 2u * 2u * 2u);
    EXPECT_EQ(before[0].find("config,seed,samples,deviceSeconds,wallSeconds,rmse,relMse,flip,"), 0u);

    ASSERT_EQ(runProgram(kChart + " --points 3"), 0) << text("err");
    const std::vector<std::string> after = linesOf(text("c/chart.csv"));
    ASSERT_EQ(after.size(), 1u + 2u * 3u * 2u);
    const auto measured = [](const std::string& line) {  // marks may change with more points
        size_t end = 0;
        for (int i = 0; i < 8; ++i) end = line.find(',', end) + 1;
        return line.substr(0, end);
    };
    for (size_t i = 1; i < before.size(); ++i) EXPECT_EQ(measured(before[i]), measured(after[i]));

    const Json json = this->json("c/chart.json");
    EXPECT_EQ(json["schema"], "raylab.chart/1");
    ASSERT_EQ(json["curves"].size(), 2u);
    EXPECT_EQ(json["curves"][1]["config"], "sampler=independent");
    EXPECT_EQ(json["points"].size(), 12u);
    EXPECT_TRUE(text("out").find(json["answer"].get<std::string>()) != std::string::npos);
    EXPECT_NE(text("c/chart.svg").find("Pareto front"), std::string::npos);
    EXPECT_NE(text("c/chart.gnuplot").find("$curve1"), std::string::npos);
    const std::string report = text("c/report.html");
    EXPECT_NE(report.find("data:image/png;base64,iVBORw0KGgo"), std::string::npos);
    for (const char* outside : {"src=\"http", "href=", "@import", "url(", "<script"})
        EXPECT_EQ(report.find(outside), std::string::npos) << outside;

    // A point is what its printed command makes.
    const Json& point = json["points"][7];
    ASSERT_EQ(runProgram(point["command"].get<std::string>().substr(std::string("raylab ").size())), 0) << text("err");
    const std::string reference = json["curves"][0]["reference"]["from"].get<std::string>();
    ASSERT_EQ(runProgram("compare point.exr '" + reference + "' --json compare.json"), 0) << text("err");
    EXPECT_NEAR(this->json("compare.json")["rmse"].get<double>(), point["rmse"].get<double>(), 1e-9);
}

/// A configuration that takes some samples at least begins with these, beside one that does not.
TEST_F(Chart, BeginsWhereAConfigurationCan) {
    ASSERT_EQ(runProgram("chart " + kSmallCornell + " -o a --vary adaptive=off,on --points 5 --seeds 2 --reference-error 0.3 --quiet"), 0)
        << text("err");
    const Json points = json("a/chart.json")["points"];
    const auto leastOf = [&](const std::string& config) {
        int least = 1000;
        for (const Json& point : points)
            if (point["config"] == config) least = std::min(least, point["samples"].get<int>());
        return least;
    };
    EXPECT_EQ(leastOf("adaptive=off"), 1);
    EXPECT_EQ(leastOf("adaptive=on"), 8);
    EXPECT_EQ(points.size(), 2u * (5u + 2u));
}

TEST_F(Chart, RefusesWhatDoesNotBelongToTheFolder) {
    ASSERT_EQ(runProgram(kChart + " --points 1"), 0) << text("err");
    expectProgramRefuses(kChart + " --points 1 --clamp 2", "with clamp 0.0 instead of 2.0");
    expectProgramRefuses(kChart + " --points 1 --seed 9", "firstSeed 0 instead of 9");
    expectProgramRefuses("chart " + kSmallCornell + " -o c --seeds 2 --reference-error 0.3",
                         "'sampler=independent', which is not asked for");
    expectProgramRefuses("chart mirrors --width 24 --height 24 -o c", "has a chart of scene");
    std::filesystem::remove(folder_ / "c/chart.json");
    expectProgramRefuses(kChart + " --points 1", "unknown origin");
}

TEST_F(Chart, ReferenceAndConfigurationsMayBeFiles) {
    ASSERT_EQ(runProgram("render " + kSmallCornell + " --spp 8 -o reference.exr --quiet"), 0) << text("err");
    writeText(
        "configs.json",
        R"([{"name": "short, of course", "settings": {"depth": 1}}, {"settings": {"clamp": 2.5, "sampler": "independent"}}])");
    ASSERT_EQ(runProgram("chart " + kSmallCornell +
                         " -o c --configs configs.json --reference reference.exr --seeds 2 --points 1 --quiet"),
              0)
        << text("err");
    const Json json = this->json("c/chart.json");
    EXPECT_EQ(json["curves"][0]["config"], "short, of course");
    EXPECT_EQ(json["curves"][1]["config"], "clamp=2.5 sampler=independent");
    EXPECT_EQ(json["curves"][1]["settings"]["clamp"], 2.5);
    EXPECT_NE(text("c/chart.csv").find("\"short, of course\","), std::string::npos);

    writeText("configs.json", R"([{"name": "a", "settings": {"dept": 1}}])");
    expectProgramRefuses("chart cornell -o d --configs configs.json",
                         "configs.json: there is no setting 'dept'; did you mean depth?");
    writeText("configs.json", R"({"depth": 3})");
    expectProgramRefuses("chart cornell -o d --configs configs.json", "is no list of configurations");
    expectProgramRefuses("chart cornell -o d --vary depth", "--vary takes NAME=A,B,C");
    expectProgramRefuses("chart cornell -o d --set-of colours", "--set-of");
    expectProgramRefuses("chart cornell --width 8 --height 8 -o d --reference reference.exr", "has 24 x 24 pixels");
}

TEST_F(Chart, ComparesWhatRoundingsCost) {
    ASSERT_EQ(runProgram("chart " + kSmallCornell + " -o c --set-of precision --seeds 2 --points 1 --reference-error 0.3 --quiet"),
              0)
        << text("err");
    const Json curves = json("c/chart.json")["curves"];
    ASSERT_EQ(curves.size(), 6u);
    for (const Json& curve : curves) {
        EXPECT_EQ(curve["groups"].size(), 1u);
        EXPECT_EQ(curve["reference"]["from"], curves[0]["reference"]["from"]) << "shortcuts are measured as bias";
    }
    EXPECT_EQ(curves[5]["config"], "offset=epsilon slab=plain triangle=minimal");
    EXPECT_EQ(curves[5]["settings"]["slab"], "plain");
}

/// Under few samples a denoised picture is nearer to the truth, and a chart shows it.
TEST_F(Chart, ComparesDenoisers) {
    ASSERT_EQ(runProgram("chart cornell --width 64 --height 64 --depth 3 --environment none -o c --set-of denoise --seeds 2 "
                         "--points 2 --reference-error 0.1 --quiet"),
              0)
        << text("err");
    const Json curves = json("c/chart.json")["curves"];
    ASSERT_EQ(curves.size(), 2u);
    EXPECT_EQ(curves[0]["settings"]["denoise"], "none");
    EXPECT_EQ(curves[1]["settings"]["denoise"], "atrous");
    EXPECT_LT(curves[1]["groups"][0]["medianError"].get<double>(), curves[0]["groups"][0]["medianError"].get<double>());
}

/// Of the layer at pixel 0.
float valueOf(const std::filesystem::path& path, const std::string& name) {
    for (const Layer& layer : readExrLayers(path))
        if (layer.name == name) return layer.bitmap.pixels.at(0);
    return std::nanf("");
}

TEST_F(Merge, AddsSamplesOfDifferentSeeds) {
    const std::string render = "render cornell --width 8 --height 8 --quiet ";
    ASSERT_EQ(runProgram(render + "--spp 4 --seed 1 -o a.exr"), 0) << text("err");
    ASSERT_EQ(runProgram(render + "--spp 12 --seed 2 -o b.exr"), 0) << text("err");
    ASSERT_EQ(runProgram("merge a.exr b.exr -o all.exr"), 0) << text("err");
    const float a = valueOf(folder_ / "a.exr", ""), b = valueOf(folder_ / "b.exr", "");
    EXPECT_EQ(valueOf(folder_ / "all.exr", "samples"), 16.0f);
    EXPECT_NEAR(valueOf(folder_ / "all.exr", ""), (4.0f * a + 12.0f * b) / 16.0f, 1e-6f);

    ASSERT_EQ(runProgram(render + "--spp 12 --seed 2 --denoise atrous -o smooth.exr"), 0) << text("err");
    EXPECT_NE(valueOf(folder_ / "smooth.exr", ""), b);
    ASSERT_EQ(runProgram("merge a.exr smooth.exr -o same.exr"), 0) << text("err");
    EXPECT_EQ(valueOf(folder_ / "same.exr", ""), valueOf(folder_ / "all.exr", "")) << "what is merged is what was sampled";

    ASSERT_EQ(runProgram(render + "--spp 4 --seed 3 --depth 2 -o short.exr"), 0) << text("err");
    expectProgramRefuses("merge a.exr a.exr -o no.exr", "seed 1 is in another part");
    expectProgramRefuses("merge all.exr b.exr -o no.exr", "seed 2 is in another part");
    expectProgramRefuses("merge a.exr short.exr -o no.exr", "depth '2' instead of '8'");
    expectProgramRefuses("merge a.exr b.exr -o no.png", "only .exr");
    expectProgramRefuses("merge a.exr missing.exr -o no.exr", "missing.exr");
    EXPECT_FALSE(std::filesystem::exists(folder_ / "no.exr"));
}

TEST_F(Preset, GivesSettingsBelowTheCommandLine) {
    writeText("preset.json",
              R"({"schema": "raylab.preset/1", "settings": {"width": 16, "height": 8, "spp": 3, "bvh-cache": true}})");
    ASSERT_EQ(runProgram("render cornell --preset preset.json --spp 2 -o a.png --json a.json --quiet"), 0)
        << text("err");
    const Json settings = json("a.json")["settings"];
    EXPECT_EQ(settings["width"], 16);
    EXPECT_EQ(settings["height"], 8);
    EXPECT_EQ(settings["bvh-cache"], true);
    EXPECT_EQ(settings["spp"], 2);
    writeText("preset.json", R"({"widht": 16})");
    expectProgramRefuses("render cornell --preset preset.json",
                         "preset.json: there is no setting 'widht'; did you mean width?");
    writeText("preset.json", R"({"depth": [1]})");
    expectProgramRefuses("render cornell --preset preset.json", "preset.json: 'depth' must be a text, a number");
    writeText("preset.json", "{");
    expectProgramRefuses("render cornell --preset preset.json", "preset.json: is no JSON");
}

TEST_F(Advise, FindsADepthAndWritesAPreset) {
    ASSERT_EQ(runProgram("advise cornell --width 24 --height 24 --depth 1 --target-error 0.4 --only depth -o p.json "
                         "--json a.json --quiet"),
              0)
        << text("err");
    const Json advice = json("a.json");
    EXPECT_EQ(advice["schema"], "raylab.advise/1");
    ASSERT_EQ(advice["steps"].size(), 1u);
    const Json& options = advice["steps"][0]["options"];
    EXPECT_EQ(options[0]["value"], "1");
    const auto energyOf = [&](const std::string& depth) {
        for (const Json& option : options)
            if (option["value"] == depth) return option["energy"].get<double>();
        return std::nan("");
    };
    // Interreflection in the Cornell box: deeper is brighter, and 32 is as good as all.
    EXPECT_LT(energyOf("1"), energyOf("4"));
    EXPECT_NEAR(energyOf("32"), 1.0, 0.1);
    EXPECT_GE(advice["forecast"]["samples"].get<int>(), 1);
    EXPECT_GT(advice["achieved"]["relativeError"].get<double>(), 0.0);
    EXPECT_EQ(runProgram("render cornell --width 24 --height 24 --preset p.json -o p.png --json r.json --quiet"), 0)
        << text("err");
    EXPECT_EQ(json("r.json")["settings"]["depth"], std::stoi(advice["steps"][0]["chosen"].get<std::string>()));
    EXPECT_EQ(json("r.json")["settings"]["spp"], advice["forecast"]["samples"]);
}

/// A search may begin with adaptive samples and a denoiser, which the lights' shares and few samples do without.
TEST_F(Advise, BeginsWhereTheUserIs) {
    ASSERT_EQ(runProgram("advise cornell --width 16 --height 16 --depth 2 --adaptive --denoise atrous --target-error 0.3 "
                         "--only sampler -o p.json --json a.json --quiet"),
              0)
        << text("err");
    const Json advice = json("a.json");
    for (const Json& option : advice["steps"][0]["options"]) EXPECT_NE(option["value"], "stratified");
    EXPECT_EQ(json("p.json")["settings"]["adaptive"], true);
    EXPECT_EQ(json("p.json")["settings"]["denoise"], "atrous");
}

/// What depth 4 lacks is no reason against a sampler: all of them lack it.
TEST_F(Advise, ComparesByNoiseWhatConvergesToTheSame) {
    ASSERT_EQ(runProgram("advise cornell --width 32 --height 32 --depth 4 --target-error 0.06 --only sampler "
                         "-o p.json --json a.json --quiet"),
              0)
        << text("err");
    const Json advice = json("a.json");
    ASSERT_EQ(advice["steps"][0]["options"].size(), 4u);
    for (const Json& option : advice["steps"][0]["options"]) {
        EXPECT_EQ(option["relativeBias"], 0.0) << option["value"];
        EXPECT_GT(option["gain"]["value"], 0.0) << option["value"];
    }
    EXPECT_GT(advice["forecast"]["relativeBias"], 0.01);
}

TEST_F(Advise, RefusesWhatIsNoGoal) {
    expectProgramRefuses("advise cornell", "give either --target-error");
    expectProgramRefuses("advise cornell --target-error 0.1 --time-limit 3", "give either --target-error");
    expectProgramRefuses("advise cornell --target-error 0.1 --only width", "--only");
}

}  // namespace
}  // namespace raylab
