#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cstring>
#include <thread>

#include "engine/core/error.h"
#include "engine/core/stopwatch.h"
#include "engine/measure/flip.h"
#include "engine/measure/image_pair.h"
#include "engine/measure/stability/cases.h"
#include "engine/measure/stability/render_case.h"
#include "engine/measure/stability/scene_parts.h"
#include "engine/scene/import.h"

namespace raylab::stability {
namespace {

namespace fs = std::filesystem;

Bitmap truckImage(const Context& context, Scene scene, const glm::vec3& offset) {
    lookAt(scene, offset + glm::vec3(4.0f, 3.0f, 6.0f), offset + glm::vec3(0.0f, 1.0f, 0.0f), 0.7f);
    RenderSettings settings = smallImage(context.settings, context.quick ? 64 : 128, context.quick ? 16 : 64, 3);
    settings.environment = "white";
    return displayed(renderFilm(context, scene, settings).mean);
}

constexpr double kHangSeconds = 10.0;

enum class Ending { finished, crashed, hung };

/// Runs the program on a file, what it prints thrown away.
Ending runOn(const fs::path& program, const fs::path& file) {
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    for (const int descriptor : {STDOUT_FILENO, STDERR_FILENO})
        ::posix_spawn_file_actions_addopen(&actions, descriptor, "/dev/null", O_WRONLY, 0);
    std::string words[] = {program.string(), "info", file.string()};
    char* arguments[] = {words[0].data(), words[1].data(), words[2].data(), nullptr};
    pid_t child = 0;
    const int failed = ::posix_spawn(&child, words[0].c_str(), &actions, nullptr, arguments, environ);
    ::posix_spawn_file_actions_destroy(&actions);
    if (failed != 0) throw Error(words[0] + " cannot be started: " + std::strerror(failed));
    const Stopwatch watch;
    int status = 0;
    while (::waitpid(child, &status, WNOHANG) == 0) {
        if (watch.seconds() > kHangSeconds) {
            ::kill(child, SIGKILL);
            ::waitpid(child, &status, 0);
            return Ending::hung;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    const bool isTold = WIFEXITED(status) && WEXITSTATUS(status) <= static_cast<int>(ExitCode::badInput);
    return isTold ? Ending::finished : Ending::crashed;
}

std::vector<fs::path> malformedFiles(const Context& context) {
    std::vector<fs::path> files;
    for (const char* folder : {"malformed-assimp", "derived-edge-cases"})
        for (const auto& entry : fs::recursive_directory_iterator(context.sceneFile(folder))) {
            std::string extension = entry.path().extension().string();
            std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
            if (!extension.empty() &&
                (" " + importableExtensions() + " ").find(" " + extension + " ") != std::string::npos)
                files.push_back(entry.path());
        }
    std::ranges::sort(files);
    return files;
}

/// Renders what a file with a NaN in it leaves; whether anybody was told of it.
bool rendersAndTells(const Context& context, const std::string& file, size_t& nonFinite) {
    Scene scene;
    try {
        scene = importScene(context.sceneFile("derived-edge-cases/" + file));
    } catch (const Error&) {
        return true;
    }
    RenderSettings settings = smallImage(context.settings, 32, 16, 4);
    settings.environment = "white";
    nonFinite += renderFilm(context, scene, settings).nonFinitePixels;
    return !scene.warnings.empty();
}

}  // namespace

std::vector<Number> measureFarFromOrigin(const Context& context) {
    const Bitmap reference =
        truckImage(context, importScene(context.sceneFile("gltf-features/CesiumMilkTruck/glTF/CesiumMilkTruck.gltf")),
                   glm::vec3(0.0f));
    std::vector<Number> numbers;
    for (const auto& [file, offset] :
         {std::pair("truck_offset_1e4.gltf", 1e4f), std::pair("truck_offset_1e6.gltf", 1e6f)}) {
        Scene scene = importScene(context.sceneFile(std::string("derived-edge-cases/") + file));
        const bool told = std::ranges::any_of(scene.warnings, [](const std::string& warning) {
            return warning.find("from the origin") != std::string::npos;
        });
        const Bitmap map = flipMap(truckImage(context, std::move(scene), {offset, 0.0f, -offset}), reference);
        Number number{std::string("FLIP of the truck at ") + (offset < 1e5f ? "1e4" : "1e6") + " against the origin",
                      meanOf(map),
                      told ? kNoLimit : 0.01,
                      "",
                      told ? "the importer warns of it" : "",
                      std::nullopt};
        if (!number.passes() || told) {
            number.picture = Bitmap(map.width, map.height, 3);
            for (size_t i = 0; i < map.pixels.size(); ++i)
                for (size_t c = 0; c < 3; ++c) number.picture->pixels[3 * i + c] = map.pixels[i];
        }
        numbers.push_back(std::move(number));
    }
    return numbers;
}

std::vector<Number> measureBadValues(const Context& context) {
    constexpr std::array kFiles = {"box_nan_vertex.glb", "box_inf_vertex.glb", "box_huge_vertex_1e30.glb",
                                   "box_nan_normal.glb", "box_nan_uv.glb"};
    size_t nonFinite = 0, silent = 0;
    std::string names;
    for (const char* file : kFiles)
        if (!rendersAndTells(context, file, nonFinite)) {
            ++silent;
            names += std::string(names.empty() ? "" : ", ") + file;
        }
    return {countOf("pixels with a sample that is not finite: boxes with NaN, Inf, 1e30", nonFinite, "pixels",
                    "of 5 files"),
            countOf("files that nobody is told of", silent, "files", names)};
}

std::vector<Number> measureMalformedFiles(const Context& context) {
    if (context.program.empty()) throw Skipped("runs raylab itself in a process for each file");
    size_t crashes = 0, hangs = 0;
    std::string names;
    const std::vector<fs::path> files = malformedFiles(context);
    const size_t step = context.quick ? 10 : 1;
    for (size_t i = 0; i < files.size(); i += step) {
        context.check();
        const Ending ending = runOn(context.program, files[i]);
        crashes += ending == Ending::crashed ? 1u : 0u;
        hangs += ending == Ending::hung ? 1u : 0u;
        if (ending != Ending::finished) names += (names.empty() ? "" : ", ") + files[i].filename().string();
    }
    const std::string of =
        "of " + std::to_string((files.size() + step - 1) / step) + (names.empty() ? "" : ": " + names);
    return {countOf("malformed files that end the program", crashes, "files", of),
            countOf("malformed files that take over 10 s", hangs, "files", of)};
}

}  // namespace raylab::stability
