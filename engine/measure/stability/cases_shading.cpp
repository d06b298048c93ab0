#include <algorithm>
#include <cmath>

#include "engine/measure/image_pair.h"
#include "engine/measure/stability/cases.h"
#include "engine/measure/stability/render_case.h"
#include "engine/measure/stability/scene_parts.h"

/// S31, S32: what stands in for geometry: normals between vertices, and textures with more texels than pixels.
namespace raylab::stability {
namespace {

/// A white ball of triangles with the ball's normals, below a white sky: radiance 1 where no light is lost.
Scene furnaceBall(uint32_t rings) {
    Scene scene;
    addMesh(scene, smoothBall(addMaterial(scene, lambert(1.0f)), 1.0f, glm::vec3(0.0f), rings));
    scene.environment = constantEnvironment(1.0f);
    lookAt(scene, {0.0f, 0.6f, 4.0f}, glm::vec3(0.0f), 0.3f);
    return scene;
}

/// An image that nothing but the ball is in.
FilmImage furnaceImage(const Context& context, const Scene& scene, RenderSettings& settings) {
    settings = smallImage(context.settings, 32, context.quick ? 64 : 256, 64);
    settings.rouletteDepth = 64;
    return renderFilm(context, scene, settings);
}

constexpr uint32_t kTexels = 64;

/// Texels black and white in turn, or with holes in place of black.
Texture checkerboard(bool holes) {
    Texture texture;
    texture.width = texture.height = kTexels;
    for (uint32_t y = 0; y < kTexels; ++y)
        for (uint32_t x = 0; x < kTexels; ++x) {
            const bool isWhite = (x + y) % 2 == 0;
            texture.texels.push_back(isWhite ? 0xffffffffu : holes ? 0x00000000u : 0xff000000u);
        }
    return texture;
}

constexpr float kRepeats = 400.0f;

/// A glowing floor up to the horizon, a texel 1/25 wide, seen from a height of 1: beyond 10 units many fall into each
/// of 32 pixels.
Scene farFloor() {
    Scene scene;
    scene.textures.push_back(checkerboard(false));
    Material material = lamp(1.0f);
    material.emissionTexture = 0;
    Mesh mesh = floorQuad(addMaterial(scene, material), 0.5f * kRepeats * static_cast<float>(kTexels) / 25.0f);
    for (glm::vec2& uv : mesh.uvs) uv *= kRepeats;
    addMesh(scene, std::move(mesh));
    lookAt(scene, {0.0f, 1.0f, 0.0f}, {20.0f, 0.0f, 3.0f}, 0.06f);
    return scene;
}

/// A black sheet with a hole in place of every other texel, a texel 1/100 wide, far off before a white sky.
Scene farSheet() {
    Scene scene;
    scene.textures.push_back(checkerboard(true));
    Material material = lambert(0.0f);
    material.baseColorTexture = 0;
    material.alphaMode = AlphaMode::mask;
    Mesh mesh = quad(addMaterial(scene, material), {-8, -8, 0}, {8, -8, 0}, {8, 8, 0}, {-8, 8, 0});
    for (glm::vec2& uv : mesh.uvs) uv *= 1600.0f / static_cast<float>(kTexels);
    addMesh(scene, std::move(mesh));
    scene.environment = constantEnvironment(1.0f);
    lookAt(scene, {1.3f, 0.4f, 20.0f}, glm::vec3(0.0f), 0.5f);
    return scene;
}

/// How far the mean of an image that is half white is from a half.
Number halfNumber(const Context& context, const std::string& what, const Scene& scene) {
    const RenderSettings settings = smallImage(context.settings, 32, 64, 0);
    const FilmImage film = renderFilm(context, scene, settings);
    const double mean = estimateOf(film).mean;
    Number number{"mean of " + what, std::abs(mean / 0.5 - 1.0),       0.01,
                  "of exact",        shortText(mean) + ", exactly .5", std::nullopt};
    showImage(number, scene, settings, film);
    return number;
}

/// Of pixels of one sample, over their mean.
Number noiseNumber(const Context& context, const std::string& what, const Scene& scene, double limit,
                   const std::string& note) {
    const RenderSettings settings = smallImage(context.settings, 64, 1, 0);
    const FilmImage film = renderFilm(context, scene, settings);
    double squares = 0.0;
    const double mean = estimateOf(film).mean;
    for (size_t i = 0; i < film.mean.pixels.size(); i += 3)
        squares += std::pow(static_cast<double>(film.mean.pixels[i]) - mean, 2.0);
    const double deviation = std::sqrt(squares / static_cast<double>(film.mean.pixelCount()));
    Number number{"noise of a sample of " + what, deviation / mean, limit, "of the mean", note, std::nullopt};
    showImage(number, scene, settings, film);
    return number;
}

}  // namespace

std::vector<Number> measureShadingNormals(const Context& context) {
    RenderSettings settings;
    Plot plot{"rings of the ball", "light lost", true, true, {{"mean", {}}, {"darkest pixel", {}}}};
    Number lost{"light that the normals of a white ball of 8 x 16 lose",
                0.0,
                kNoLimit,
                "of all",
                "directions above the normal's plane and below the triangle's end inside the ball",
                std::nullopt};
    Number gained{"light that the normals of white balls make", 0.0, 1e-4, "of exact", "", std::nullopt};
    for (const uint32_t rings : {4u, 8u, 16u, 32u}) {
        const Scene scene = furnaceBall(rings);
        const FilmImage film = furnaceImage(context, scene, settings);
        const double mean = estimateOf(film).mean;
        const auto [darkest, brightest] = std::ranges::minmax(film.mean.pixels);
        plot.series[0].points.emplace_back(rings, 1.0 - mean);
        plot.series[1].points.emplace_back(rings, 1.0 - static_cast<double>(darkest));
        gained.value = std::max(gained.value, static_cast<double>(brightest) - 1.0);
        if (!gained.picture) showImage(gained, scene, settings, film);
        if (rings != 8) continue;
        lost.value = 1.0 - mean;
        showImage(lost, scene, settings, film);
        Bitmap loss(film.mean.width, film.mean.height, 1);
        for (size_t i = 0; i < loss.pixels.size(); ++i) loss.pixels[i] = 1.0f - film.mean.pixels[3 * i];
        lost.picture = heatPicture(loss, 0.0, 0.05);
    }
    lost.plot = std::move(plot);
    return {std::move(lost), std::move(gained)};
}

std::vector<Number> measureFarTextures(const Context& context) {
    const Scene floor = farFloor(), sheet = farSheet();
    return {halfNumber(context, "a checkerboard of many texels a pixel", floor),
            noiseNumber(context, "the checkerboard", floor, 0.5,
                        "1 where a sample takes one texel: smaller images of it are taken"),
            halfNumber(context, "a sheet with as many holes", sheet),
            noiseNumber(context, "the sheet", sheet, kNoLimit,
                        "1: holes are looked up at full size, for smaller images of them would close")};
}

}  // namespace raylab::stability
