#include "engine/scene/import.h"
#include "tests/support/gpu_test.h"
#include "tests/support/paths.h"

namespace raylab::support {
namespace {

class Determinism : public GpuTest {
protected:
    /// An image whose sides are no multiples of a tile's.
    RenderSettings oddImage() const {
        RenderSettings settings = smallImage(8, 24, 4);
        settings.width = 37;
        settings.height = 21;
        return settings;
    }
    FilmImage render(const RenderSettings& settings) { return renderFilm(device_, scene_, settings); }

    const Scene scene_ = importScene(support::binaryFolder() / "assets/cornell.glb");
};

void expectSameBits(const FilmImage& a, const FilmImage& b) {
    EXPECT_EQ(a.mean.pixels, b.mean.pixels);
    EXPECT_EQ(a.variance.pixels, b.variance.pixels);
    EXPECT_EQ(a.samples.pixels, b.samples.pixels);
    EXPECT_EQ(a.rays, b.rays);
}

/// S22. The length of a slice decides how tiles and samples are cut into dispatches.
TEST_F(Determinism, SlicesDoNotShow) {
    RenderSettings settings = oddImage();
    settings.sliceMs = 1.0;
    const FilmImage fine = render(settings);
    settings.sliceMs = 200.0;
    const FilmImage coarse = render(settings);
    expectSameBits(fine, coarse);
    expectSameBits(coarse, render(settings));
    for (const float count : fine.samples.pixels) EXPECT_EQ(count, 24.0f);
}

TEST_F(Determinism, SeedsDiffer) {
    RenderSettings settings = oddImage();
    const FilmImage one = render(settings);
    settings.seed += 1;
    const FilmImage two = render(settings);
    size_t same = 0;
    for (size_t i = 0; i < one.mean.pixels.size(); ++i)
        if (one.mean.pixels[i] == two.mean.pixels[i] && one.mean.pixels[i] > 0.0f) ++same;
    EXPECT_LT(same, one.mean.pixels.size() / 20) << "but for pixels that see a lamp alone";
}

}  // namespace
}  // namespace raylab::support
