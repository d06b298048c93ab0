#include <algorithm>
#include <array>
#include <cmath>

#include "engine/image/image_io.h"
#include "tests/cli/program.h"

namespace raylab {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 24, kHeight = 16;

/// With images made in the folder.
class Compare : public ProgramTest {
protected:
    int compare(const std::string& arguments) const { return runProgram("compare " + arguments); }
    Json figures(const std::string& arguments) const {
        compare(arguments + " --json -");
        return json("out");
    }
    void expectRefused(const std::string& arguments, const std::string& what) const {
        expectProgramRefuses("compare " + arguments, what);
    }

    /// An EXR of one colour; with a variance, as a rendering of four samples.
    void write(const std::string& name, const Bitmap& mean, float variance = -1.0f) const {
        std::vector<Layer> layers = {{"", mean}};
        if (variance >= 0.0f) {
            layers.push_back({"variance", Bitmap(mean.width, mean.height, 3)});
            layers.push_back({"samples", Bitmap(mean.width, mean.height, 1)});
            std::ranges::fill(layers[1].bitmap.pixels, variance);
            std::ranges::fill(layers[2].bitmap.pixels, 4.0f);
        }
        writeExr(folder_ / name, layers);
    }
};

Bitmap constant(float value, int width = kWidth, int height = kHeight) {
    Bitmap bitmap(width, height, 3);
    std::ranges::fill(bitmap.pixels, value);
    return bitmap;
}

/// A grey image whose left half is `left`.
Bitmap halves(float left, float right) {
    Bitmap bitmap = constant(right);
    for (int y = 0; y < kHeight; ++y) std::fill_n(bitmap.at(0, y), 3 * kWidth / 2, left);
    return bitmap;
}

TEST_F(Compare, ClosedFormsOfConstantImages) {
    write("black.exr", constant(0.0f));
    write("white.exr", constant(1.0f));
    const Json json = figures("white.exr black.exr");
    EXPECT_EQ(json["schema"], "raylab.compare/1");
    EXPECT_EQ(json["mse"], 1.0);
    EXPECT_NEAR(json["ssim"].get<double>(), 1e-4 / 1.0001, 1e-7);
    EXPECT_NEAR(json["flip"].get<double>(), 0.96738, 1e-5);  // see tests/unit/flip_test.cpp
    EXPECT_TRUE(json["flipHdr"].is_null()) << "nothing is brighter than a display";
    EXPECT_TRUE(json["zTest"].is_null());
    EXPECT_TRUE(json["zTestPassFraction"].is_null());
    const Json same = figures("white.exr white.exr");
    EXPECT_EQ(same["ssim"], 1.0);
    EXPECT_EQ(same["flip"], 0.0);
    EXPECT_EQ(same["passed"], true);
}

TEST_F(Compare, TextListsWhatTheJsonHas) {
    write("a.exr", constant(3.0f), 0.5f);
    write("b.exr", constant(3.5f), 0.5f);
    ASSERT_EQ(compare("a.exr b.exr"), 0) << text("err");
    for (const char* name : {"MSE", "RMSE", "relMSE", "PSNR", "max", "SSIM", "FLIP", "HDR-FLIP", "Z-test"})
        EXPECT_NE(text("out").find(name), std::string::npos) << name << "\n" << text("out");
}

TEST_F(Compare, HdrFlipSeesWhatIsBrighterThanTheDisplay) {
    Bitmap image = halves(0.1f, 20.0f), reference = halves(0.1f, 40.0f);
    image.at(0, 0)[0] = 0.1f;
    write("image.exr", image);
    write("reference.exr", reference);
    const Json json = figures("image.exr reference.exr");
    EXPECT_EQ(json["flip"], 0.0);
    EXPECT_GT(json["flipHdr"], 0.05);
    // Half of the pixels have a luminance of .1, half 40: the median lies in their middle, one stop below.
    EXPECT_EQ(json["flipHdrExposures"]["count"], 2);
    EXPECT_NEAR(
        json["flipHdrExposures"]["stopStops"].get<double>() - json["flipHdrExposures"]["startStops"].get<double>(),
        std::log2(40.0 / 20.05), 1e-4);
}

TEST_F(Compare, CropAppliesToEveryFigureAndMap) {
    write("a.exr", halves(0.0f, 0.5f), 1.0f);
    write("b.exr", constant(0.5f), 1.0f);
    const Json whole = figures("a.exr b.exr"), right = figures("a.exr b.exr --crop 12,1,12,15");
    EXPECT_EQ(whole["mse"], 0.125);
    EXPECT_GT(whole["flip"], 0.1);
    EXPECT_LT(whole["ssim"], 0.9);
    EXPECT_EQ(right["pixels"], 12 * 15);
    EXPECT_EQ(right["mse"], 0.0);
    EXPECT_EQ(right["flip"], 0.0);
    EXPECT_EQ(right["ssim"], 1.0);
    EXPECT_EQ(right["zTest"]["pixels"], 12 * 15);
    EXPECT_EQ(right["crop"], "12,1,12,15");
    ASSERT_EQ(compare("a.exr b.exr --crop 12,1,12,15 --heat h.png --flip-map f.png --ssim-map s.png"), 0)
        << text("err");
    for (const char* name : {"h.png", "f.png", "s.png"}) {
        const Bitmap map = readImage(folder_ / name);
        EXPECT_EQ(map.width, 12) << name;
        EXPECT_EQ(map.height, 15) << name;
    }
}

TEST_F(Compare, MaskAppliesToEveryFigureAndMap) {
    Bitmap image = constant(0.5f);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth / 2; ++x) image.at(x, y)[2] = 0.0f;
    write("a.exr", image, 1.0f);
    write("b.exr", constant(0.5f), 1.0f);
    Bitmap mask = constant(0.0f);
    for (int y = 0; y < kHeight; ++y) mask.at(kWidth - 1, y)[2] = mask.at(18, y)[1] = 1.0f;
    writePng(folder_ / "mask.png", mask);
    const Json json = figures("a.exr b.exr --mask mask.png");
    EXPECT_EQ(json["pixels"], 2 * kHeight);
    EXPECT_EQ(json["mse"], 0.0);
    EXPECT_EQ(json["ssim"], 1.0) << "column 18 lies more than a window's half from the left half";
    EXPECT_EQ(json["zTest"]["pixels"], 2 * kHeight);
    // FLIP's widest filter reaches 10 pixels: from the left half to column 18, but not to column 23.
    EXPECT_GT(json["flip"], 0.0);
    EXPECT_LT(json["flip"], figures("a.exr b.exr")["flip"]);
    ASSERT_EQ(compare("a.exr b.exr --mask mask.png --heat h.png --flip-map f.png --ssim-map s.png"), 0) << text("err");
    for (const char* name : {"h.png", "f.png", "s.png"}) {
        const Bitmap map = readImage(folder_ / name);
        ASSERT_EQ(map.width, kWidth);
        const float* out = map.at(3, 8);
        EXPECT_TRUE(out[0] == out[1] && out[1] == out[2] && out[0] > 0.1f && out[0] < 0.5f) << name;
        EXPECT_LT(map.at(18, 8)[1], 0.01f) << name;
    }
    EXPECT_EQ(figures("a.exr b.exr --mask mask.png --crop 20,0,4,16")["flip"], 0.0);
}

TEST_F(Compare, ZTestOfStoredVariances) {
    write("a.exr", constant(0.5f), 0.02f);  // of the mean of 4 samples: 0.005
    Bitmap shifted = constant(0.5f);
    shifted.at(2, 3)[1] += 0.6f;  // 6 standard errors of sqrt(2 * 0.005)
    write("b.exr", shifted, 0.02f);
    const Json json = figures("b.exr a.exr");
    constexpr double kPixels = kWidth * kHeight;
    EXPECT_NEAR(json["zTestPassFraction"].get<double>(), (kPixels - 1) / kPixels, 1e-12);
    EXPECT_EQ(json["zTest"]["passFraction"], json["zTestPassFraction"]);
    EXPECT_EQ(json["zTest"]["significance"], 0.01);
    // The two-sided quantile of 1 - .99^(1 / 1152), from Python's statistics.NormalDist.
    EXPECT_NEAR(json["zTest"]["threshold"].get<double>(), 4.446594942531959, 1e-9);
    EXPECT_EQ(json["zTest"]["passed"], false);
    EXPECT_EQ(figures("a.exr a.exr")["zTest"]["passed"], true);
    EXPECT_EQ(compare("b.exr a.exr"), 0) << "no limit was given";
    EXPECT_EQ(compare("b.exr a.exr --min-ztest 0.99"), 0);
    EXPECT_EQ(compare("b.exr a.exr --min-ztest 1"), 1);
}

TEST_F(Compare, LimitsDecideTheExitCode) {
    write("a.exr", constant(0.4f));
    write("b.exr", constant(0.5f));
    const Json json = figures("a.exr b.exr");
    EXPECT_EQ(json["passed"], true);
    const double flip = json["flip"], ssim = json["ssim"];
    const auto exitCode = [&](const std::string& option, double value) {
        return compare("a.exr b.exr " + option + " " + std::to_string(value));
    };
    EXPECT_EQ(exitCode("--max-flip", flip + 1e-3), 0);
    EXPECT_EQ(exitCode("--max-flip", flip - 1e-3), 1);
    EXPECT_EQ(exitCode("--min-ssim", ssim - 1e-3), 0);
    EXPECT_EQ(exitCode("--min-ssim", ssim + 1e-3), 1);
    EXPECT_EQ(exitCode("--max-rmse", 0.11), 0);
    EXPECT_EQ(exitCode("--max-rmse", 0.09), 1);
    EXPECT_EQ(exitCode("--max-relmse", 0.01), 1);
}

TEST_F(Compare, PixelsPerDegreeBlurs) {
    Bitmap board = constant(0.0f);
    for (int y = 0; y < kHeight; ++y)
        for (int x = y % 2; x < kWidth; x += 2) std::fill_n(board.at(x, y), 3, 1.0f);
    write("board.exr", board);
    write("grey.exr", constant(0.5f));
    const Json near = figures("board.exr grey.exr --pixels-per-degree 20"),
               far = figures("board.exr grey.exr --pixels-per-degree 200");
    EXPECT_GT(near["flip"], 5.0 * far["flip"].get<double>()) << "a fine board looks grey from afar";
    EXPECT_EQ(far["pixelsPerDegree"], 200.0);
}

TEST_F(Compare, SmallImagesHaveNoSsim) {
    write("a.exr", constant(0.4f, 8, 8));
    const Json json = figures("a.exr a.exr");
    EXPECT_TRUE(json["ssim"].is_null());
    EXPECT_EQ(json["passed"], true);
    EXPECT_EQ(compare("a.exr a.exr"), 0);
    EXPECT_NE(text("out").find("no whole window"), std::string::npos);
    expectRefused("a.exr a.exr --min-ssim 0.5", "--min-ssim");
}

TEST_F(Compare, BadInputIsRefused) {
    write("a.exr", constant(0.4f));
    write("small.exr", constant(0.4f, 8, 8));
    write("black.exr", constant(0.0f));
    expectRefused("a.exr small.exr", "24 x 16");
    expectRefused("a.exr a.exr --crop 0,0,25,16", "beyond the image of 24 x 16");
    expectRefused("a.exr a.exr --crop=-1,0,4,4", "beyond the image of 24 x 16");
    expectRefused("a.exr a.exr --crop 0,0,0,4", "empty");
    for (const char* crop : {"1,2,3", "1,2,3,4,5", "a,b,c,d", "1;2;3;4", "1,2,3,99999999999", "1,2,3,4x"})
        expectRefused("a.exr a.exr --crop '" + std::string(crop) + "'", "x,y,width,height");
    expectRefused("a.exr a.exr --mask small.exr", "small.exr: has 8 x 8 pixels, the images have 24 x 16");
    expectRefused("a.exr a.exr --mask black.exr", "black.exr: leaves out every pixel");
    expectRefused("a.exr a.exr --mask nowhere.png", "nowhere.png");
    expectRefused("a.exr a.exr --pixels-per-degree 0", "pixels per degree");
    expectRefused("a.exr a.exr --min-ztest 0.9", "--min-ztest");
    EXPECT_FALSE(fs::exists(folder_ / "out.png"));
    expectRefused("a.exr a.exr --flip-map nowhere/f.gif/../../a.exr/f.png", "f.png");
}

}  // namespace
}  // namespace raylab
