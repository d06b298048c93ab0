#include "engine/measure/film_merge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/core/error.h"
#include "engine/render/film.h"

namespace raylab {
namespace {

constexpr uint32_t kWidth = 5, kHeight = 3;

/// Sums of samples, as a kernel keeps them.
struct SampleFilm {
    std::vector<shared::FilmPixel> pixels = std::vector<shared::FilmPixel>(kWidth * kHeight);

    void add(size_t pixel, float value) {
        shared::FilmPixel& p = pixels[pixel];
        ++p.count;
        for (int c = 0; c < 3; ++c) {
            addExactly(p.sumHi[c], p.sumLo[c], double{value} * (c + 1));
            addExactly(p.squareHi[c], p.squareLo[c], double{value} * double{value} * (c + 1) * (c + 1));
        }
    }

    static void addExactly(float& high, float& low, double value) {
        const double sum = double{high} + double{low} + value;
        high = static_cast<float>(sum);
        low = static_cast<float>(sum - double{high});
    }
};

FilmPart partOf(const SampleFilm& film, const std::string& seed, const std::string& samples) {
    FilmImage image = developFilm(film.pixels, kWidth, kHeight);
    return {"part" + seed + ".exr",
            image.mean,
            image.variance,
            image.samples,
            {{"depth", "8"}, {"seed", seed}, {"spp", samples}, {"samples", samples}, {"tracer", "software"}}};
}

/// Three films of the same pixels with 1, 7 and 100 samples, and one of all 108: heavy-tailed values with a large mean,
/// where pooling raw moments would lose the variance.
TEST(FilmMerge, PartsMakeTheFilmOfAllTheirSamples) {
    std::mt19937 random(3);
    std::lognormal_distribution<float> samples(1.0f, 1.0f);
    SampleFilm all;
    std::vector<FilmPart> parts;
    for (const int count : {1, 7, 100}) {
        SampleFilm film;
        for (size_t pixel = 0; pixel < film.pixels.size(); ++pixel)
            for (int i = 0; i < count; ++i) {
                const float value = 1000.0f + samples(random);
                film.add(pixel, value);
                all.add(pixel, value);
            }
        parts.push_back(partOf(film, std::to_string(count), std::to_string(count)));
    }
    const FilmImage whole = developFilm(all.pixels, kWidth, kHeight);
    const FilmPart merged = mergeFilms(parts);
    for (size_t i = 0; i < merged.mean.pixels.size(); ++i) {
        EXPECT_NEAR(merged.mean.pixels[i], whole.mean.pixels[i], 1e-6f * whole.mean.pixels[i]);
        EXPECT_NEAR(merged.variance.pixels[i], whole.variance.pixels[i], 1e-3f * whole.variance.pixels[i]);
    }
    for (const float count : merged.samples.pixels) EXPECT_EQ(count, 108.0f);
    const auto value = [&](const std::string& key) {
        for (const auto& [name, text] : merged.metadata)
            if (name == key) return text;
        return std::string("missing");
    };
    EXPECT_EQ(value("seed"), "1 7 100");
    EXPECT_EQ(value("spp"), "108");
    EXPECT_EQ(value("merged-parts"), "3");
}

TEST(FilmMerge, SaysWhatDoesNotFit) {
    SampleFilm film;
    for (size_t pixel = 0; pixel < film.pixels.size(); ++pixel) film.add(pixel, 1.0f);
    const FilmPart first = partOf(film, "1", "1");
    const auto expectRefused = [&](const FilmPart& second, const std::string& what) {
        try {
            mergeFilms(std::vector{first, second});
            FAIL() << "merged";
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
        }
    };
    expectRefused(first, "seed 1 is in another part");
    FilmPart second = partOf(film, "2", "1");
    second.metadata[0].second = "4";
    expectRefused(second, "depth '4' instead of '8'");
    second = partOf(film, "2", "1");
    second.metadata.clear();
    expectRefused(second, "depth '' instead of '8'");
    second = partOf(film, "2", "1");
    second.mean = Bitmap(2, 2, 3);
    expectRefused(second, "2 x 2 pixels");
    second = partOf(film, "2", "1");
    second.metadata[4].second = "brute";  // another way to the same picture
    EXPECT_NO_THROW(mergeFilms(std::vector{first, second}));
    EXPECT_THROW(mergeFilms({}), Error);
}

}  // namespace
}  // namespace raylab
