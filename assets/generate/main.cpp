#include <cstdio>
#include <exception>
#include <filesystem>

#include "assets/generate/cornell.h"
#include "assets/generate/courtyard.h"

/// raylab-make-assets FOLDER: writes the project's own scenes there. The same bytes on every run.
int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: raylab-make-assets FOLDER\n");
        return 2;
    }
    try {
        const std::filesystem::path folder = argv[1];
        std::filesystem::create_directories(folder);
        raylab::assets::makeCornellBox().write(folder / "cornell.glb");
        raylab::assets::makeCourtyard().write(folder / "courtyard.glb");
    } catch (const std::exception& error) {
        std::fprintf(stderr, "raylab-make-assets: %s\n", error.what());
        return 1;
    }
    return 0;
}
