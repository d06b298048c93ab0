#include "engine/measure/chart_points.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "engine/core/error.h"

namespace raylab {
namespace {

class ChartCsv : public testing::Test {
protected:
    void TearDown() override { std::filesystem::remove(path_); }
    void write(const std::string& text) const { std::ofstream(path_, std::ios::binary) << text; }

    std::filesystem::path path_ =
        std::filesystem::temp_directory_path() / ("chart-" + std::to_string(::getpid()) + ".csv");
};

ChartTable someTable() {
    ChartTable table;
    table.points = {{"depth=4", 7, 1, 0.1, 0.11, 1.0 / 3.0, 0.2, 0.05},
                    {"a, \"b\"", 4294967295u, 16777216, 1e-9, 12345.678901234567, 1e-300, 2.5, 0.0}};
    table.biases = {{"depth=4", 1, {-1e-7, 3.3e-8, 0.125}}};
    return table;
}

TEST_F(ChartCsv, IsReadBackToTheBit) {
    const ChartTable table = someTable();
    write(chartCsv(table, {{0.1, 0.3, true, true}, {std::nan(""), std::nan(""), false, true}}, ErrorMeasure::rmse));
    const ChartTable again = readChartCsv(path_);
    EXPECT_EQ(again.points, table.points);
    ASSERT_EQ(again.biases.size(), 1u);
    EXPECT_EQ(again.biases[0].config, "depth=4");
    EXPECT_EQ(again.biases[0].samples, 1u);
    EXPECT_EQ(again.biases[0].estimate.biasSquared, -1e-7);
    EXPECT_EQ(again.biases[0].estimate.standardError, 3.3e-8);
    EXPECT_EQ(again.biases[0].estimate.variance, 0.125);
}

TEST_F(ChartCsv, HasTheColumnsThatOthersRelyOn) {
    const std::string text = chartCsv(someTable(), std::vector<ChartMark>(2), ErrorMeasure::relative);
    EXPECT_EQ(text.substr(0, text.find('\n')).find("config,seed,samples,deviceSeconds,wallSeconds,rmse,relMse,flip,"),
              0u);
    for (const char* column : {",low", ",high", ",pareto"})
        EXPECT_NE(text.substr(0, text.find('\n')).find(column), std::string::npos);
}

TEST_F(ChartCsv, DamageIsNamedByItsLine) {
    const std::string text = chartCsv(someTable(), std::vector<ChartMark>(2), ErrorMeasure::relative);
    const auto expectRefused = [&](const std::string& damaged, const std::string& what) {
        write(damaged);
        try {
            readChartCsv(path_);
            FAIL() << "was read";
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
        }
    };
    expectRefused(text + "depth=4,1\n", ":4: has 2 fields");
    std::string wrong = text;
    wrong.replace(wrong.find("depth=4,7"), 9, "depth=4,x");
    expectRefused(wrong, ":2: column 'seed' has 'x'");
    expectRefused("config,seed\nx,1\n", "no column 'samples'");
}

TEST(ChartPoints, ErrorMeasuresHaveNames) {
    for (const std::string& name : errorMeasureNames()) EXPECT_EQ(nameOf(parseErrorMeasure(name)), name);
    EXPECT_THROW(parseErrorMeasure("ssim"), Error);
    const ChartPoint point{"", 0, 1, 0, 0, 3.0, 4.0, 0.5};
    EXPECT_EQ(point.error(ErrorMeasure::rmse), 3.0);
    EXPECT_EQ(point.error(ErrorMeasure::relative), 2.0);
    EXPECT_EQ(point.error(ErrorMeasure::flip), 0.5);
}

}  // namespace
}  // namespace raylab
