#include <gtest/gtest.h>

#include <cmath>

#include "ui/editor/model/color_map.h"

namespace raylab::editor {
namespace {

/// Relative luminance of IEC 61966-2-1.
double relativeLuminance(const glm::vec3& color) {
    const auto linear = [](float v) {
        const auto x = static_cast<double>(v);
        return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(color.x) + 0.7152 * linear(color.y) + 0.0722 * linear(color.z);
}

TEST(ColorMap, MoreIsBrighterInAllButTheDivergingOne) {
    for (const ColorMap map : {ColorMap::heat, ColorMap::sequential, ColorMap::grey})
        for (int i = 0; i < 64; ++i)
            EXPECT_LT(relativeLuminance(mapColor(map, i / 64.0)), relativeLuminance(mapColor(map, (i + 1) / 64.0)))
                << static_cast<int>(map) << " at " << i;
}

TEST(ColorMap, TheDivergingOneIsBrightestInTheMiddle) {
    const auto at = [](double v) { return relativeLuminance(mapColor(ColorMap::diverging, v)); };
    for (int i = 0; i < 32; ++i) {
        EXPECT_LT(at(i / 64.0), at((i + 1) / 64.0));
        EXPECT_LT(at(1.0 - i / 64.0), at(1.0 - (i + 1) / 64.0));
    }
    EXPECT_GT(mapColor(ColorMap::diverging, 1.0).x, 2.0f * mapColor(ColorMap::diverging, 1.0).z) << "red";
    EXPECT_GT(mapColor(ColorMap::diverging, 0.0).z, 2.0f * mapColor(ColorMap::diverging, 0.0).x) << "blue";
}

TEST(ColorMap, StaysWithinWhatADisplayHasAndClampsItsValue) {
    for (const ColorMapInfo& info : kColorMaps) {
        for (int i = 0; i <= 100; ++i) {
            const glm::vec3 color = mapColor(info.map, i / 100.0);
            for (int c = 0; c < 3; ++c) EXPECT_TRUE(color[c] >= 0.0f && color[c] <= 1.0f) << info.name;
        }
        EXPECT_EQ(mapColor(info.map, -3.0), mapColor(info.map, 0.0));
        EXPECT_EQ(mapColor(info.map, 7.0), mapColor(info.map, 1.0));
        EXPECT_EQ(mapColor(info.map, std::nan("")), mapColor(info.map, 0.0));
    }
    EXPECT_EQ(packColor({1.0f, 0.0f, 0.5f}), 0xff8000ffu);
}

TEST(ColorMap, NeighbouringCategoriesDiffer) {
    for (uint32_t i = 0; i < 100; ++i) EXPECT_GT(glm::distance(categoryColor(i), categoryColor(i + 1)), 0.15f) << i;
}

}  // namespace
}  // namespace raylab::editor
