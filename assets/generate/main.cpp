#include <cstdio>
#include <exception>
#include <filesystem>

#include "assets/generate/cornell.h"
#include "assets/generate/courtyard.h"
#include "assets/generate/lights.h"
#include "assets/generate/materials.h"
#include "assets/generate/mirrors.h"
#include "assets/generate/quadrics.h"
#include "assets/generate/statue.h"
#include "assets/generate/water.h"
#include "engine/scene/save_gltf.h"

/// raylab-make-assets FOLDER: writes the project's own scenes there. The same bytes on every run.
int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: raylab-make-assets FOLDER\n");
        return 2;
    }
    try {
        const std::filesystem::path folder = argv[1];
        std::filesystem::create_directories(folder);
        raylab::saveGltf(raylab::assets::makeCornellBox(), folder / "cornell.glb");
        raylab::saveGltf(raylab::assets::makeQuadrics(), folder / "quadrics.glb");
        raylab::saveGltf(raylab::assets::makeMaterials(), folder / "materials.glb");
        raylab::saveGltf(raylab::assets::makeLights(), folder / "lights.glb");
        raylab::saveGltf(raylab::assets::makeWater(), folder / "water.glb");
        const raylab::assets::Geometry statue = raylab::assets::makeStatue();
        raylab::saveGltf(raylab::assets::makeCourtyard(statue), folder / "courtyard.glb");
        raylab::saveGltf(raylab::assets::makeMirrors(statue), folder / "mirrors.glb");
    } catch (const std::exception& error) {
        std::fprintf(stderr, "raylab-make-assets: %s\n", error.what());
        return 1;
    }
    return 0;
}
