#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <csignal>
#include <thread>

#include "engine/core/file.h"
#include "model_support.h"
#include "ui/editor/model/autosave.h"
#include "ui/editor/model/edit_cameras.h"
#include "ui/editor/model/edit_instances.h"
#include "ui/editor/model/edit_materials.h"
#include "ui/editor/model/edit_surroundings.h"
#include "ui/editor/model/project_file.h"

namespace raylab::editortest {
namespace {

namespace fs = std::filesystem;
using std::chrono::seconds;

constexpr auto kSoon = Autosave::Clock::time_point::max();  ///< whatever the interval, it is over

std::string bytesOf(const fs::path& file) {
    const std::vector<std::byte> bytes = readFile(file);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST(EditorFiles, ViewSettingsAndHiddenInstancesComeBack) {
    const ScratchFolder folder;
    const fs::path file = folder.path() / "scene.glb";
    Document document(smallScene());
    document.apply(setRenderSetting("depth", "17"));
    document.apply(setRenderSetting("tonemap", "linear"));
    document.apply(setRenderSetting("lens-radius", "0.125"));
    document.apply(showInstances({1, 3}, false));
    const Camera view{.name = "view", .position = {0.1f, 0.2f, 0.3f}, .target = {1, 2, 3}, .fovYRadians = 0.3f};
    saveDocument(document, file, view);
    EXPECT_FALSE(document.isUnsaved());
    EXPECT_EQ(document.file(), file);
    const OpenedDocument opened = openDocument(file);
    EXPECT_EQ(opened.view, view);
    EXPECT_EQ(opened.document.hidden(), document.hidden());
    EXPECT_EQ(opened.document.settings().depth, 17);
    EXPECT_EQ(opened.document.settings().tonemap, "linear");
    EXPECT_EQ(opened.document.settings().lensRadius, 0.125);
    EXPECT_EQ(opened.document.settings().spp, RenderSettings{}.spp);
    EXPECT_EQ(opened.document.rendered()->instances.size(), 3u);
    EXPECT_FALSE(opened.document.isUnsaved());
}

TEST(EditorFiles, OnlySettingsThatDifferAreWritten) {
    const ScratchFolder folder;
    const fs::path file = folder.path() / "a.raylab.json";
    RenderSettings settings;
    settings.depth = 3;
    settings.device = "llvmpipe";  // of this machine
    writeProject(file, {settings, {}, {}, {}});
    const auto json = nlohmann::json::parse(bytesOf(file));
    EXPECT_EQ(json["settings"], nlohmann::json({{"depth", "3"}}));
}

TEST(EditorFiles, WhatDoesNotFitIsLeftOutWithAWarning) {
    const ScratchFolder folder;
    const fs::path file = folder.write("a.raylab.json", R"({"schema": "raylab.project/1", "instances": 9, "hidden": [1],
        "settings": {"depth": "9", "spp": "many", "warp-factor": "9"}})");
    const Project project = readProject(file, 5);
    EXPECT_EQ(project.settings.depth, 9);
    EXPECT_EQ(project.settings.spp, RenderSettings{}.spp);
    EXPECT_TRUE(project.hidden.empty());
    ASSERT_EQ(project.warnings.size(), 3u);
    EXPECT_TRUE(importtest::anyContains(project.warnings, "warp-factor"));
    for (const char* damaged :
         {"", "[]", "{\"schema\": \"other\"}", R"({"schema": "raylab.project/1", "settings": {"depth": 9}})"}) {
        folder.write("a.raylab.json", damaged);
        try {
            readProject(file, 5);
            ADD_FAILURE() << damaged;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("a.raylab.json"), std::string::npos);
        }
    }
    EXPECT_TRUE(readProject(folder.path() / "none.raylab.json", 5).warnings.empty());
}

TEST(EditorFiles, SaveWantsASceneFormat) {
    const ScratchFolder folder;
    Document document(smallScene(), folder.path() / "scan.ply");
    EXPECT_FALSE(canSave(document));
    EXPECT_FALSE(canSave(Document(smallScene())));
    EXPECT_TRUE(canSave(Document(smallScene(), "a.gltf")));
    document.apply(renameInstance(0, "x"));
    EXPECT_THROW(saveDocument(document, folder.path() / "scan.ply", {}), Error);
    EXPECT_TRUE(document.isUnsaved());
}

/// Runs `body` where no file grows beyond 16 KiB: writing fails half-way, as on a full disk.
template <class Body>
void withSmallFilesOnly(Body&& body) {
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    const rlimit small{16384, before.rlim_max};
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    body();
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
    std::signal(SIGXFSZ, handler);
}

TEST(EditorFiles, ASaveThatFailsHalfWayKeepsTheOldFileAndTheEdits) {
    const ScratchFolder folder;
    const fs::path file = folder.path() / "scene.glb";
    Document document(smallScene());
    saveDocument(document, file, {});
    const std::string old = bytesOf(file);
    document.apply(renameInstance(0, "edited"));
    withSmallFilesOnly([&] { EXPECT_THROW(saveDocument(document, file, {}), Error); });
    EXPECT_EQ(bytesOf(file), old);
    EXPECT_TRUE(document.isUnsaved());
    EXPECT_EQ(document.scene().instances[0].name, "edited");
    size_t files = 0;
    for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder.path())) ++files;
    EXPECT_EQ(files, 2u) << "a temporary file was left behind";
    saveDocument(document, file, {});
    EXPECT_NE(bytesOf(file), old);
}

/// A disk that holds a small scene once, but not twice.
class SmallDisk {
public:
    explicit SmallDisk(const fs::path& folder)
        : folder_(folder), mounted_(::mount("none", folder.c_str(), "tmpfs", 0, "size=600k") == 0) {}
    ~SmallDisk() {
        if (!mounted_) return;
        EXPECT_EQ(::umount(folder_.c_str()), 0);
    }
    bool isThere() const { return mounted_; }

private:
    fs::path folder_;
    bool mounted_;
};

TEST(EditorFiles, AFullDiskKeepsTheOldFile) {
    const ScratchFolder folder;
    const SmallDisk disk(folder.path());
    if (!disk.isThere()) GTEST_SKIP() << "only root may mount a small disk";
    const fs::path file = folder.path() / "scene.glb";
    Document document(smallScene());
    saveDocument(document, file, {});
    const std::string old = bytesOf(file);
    document.apply(addShape(Shape::sphere, glm::vec3(0.0f), 1.0f));
    std::string message;
    try {
        saveDocument(document, file, {});
    } catch (const Error& error) {
        message = error.what();
    }
    EXPECT_NE(message.find("scene.glb"), std::string::npos) << message;
    EXPECT_EQ(bytesOf(file), old);
    EXPECT_TRUE(document.isUnsaved());
}

TEST(EditorAutosave, CopiesUnsavedChangesOnly) {
    const ScratchFolder folder;
    Autosave autosave(folder.path() / "autosave", seconds(30));
    Document document(smallScene(), "somewhere.glb");
    EXPECT_FALSE(autosave.update(document, {}, kSoon));  // nothing to lose
    document.apply(renameInstance(0, "edited"));
    EXPECT_FALSE(autosave.update(document, {}));  // too soon
    EXPECT_TRUE(autosave.update(document, {}, kSoon));
    autosave.wait();
    EXPECT_EQ(autosave.takeProblem(), "");
    EXPECT_FALSE(autosave.update(document, {}, kSoon));  // it is there already
    EXPECT_TRUE(findRecoverable(folder.path() / "autosave").empty()) << "its session lives";
    document.markSaved("somewhere.glb");
    autosave.update(document, {});
    for (const auto& entry : fs::directory_iterator(folder.path() / "autosave"))
        EXPECT_EQ(entry.path().extension(), ".lock") << entry.path();
}

/// What a killed process leaves in `folder`: the child edits, copies, and is gone without a farewell.
void crashAfterEdits(const fs::path& folder, const fs::path& original) {
    const pid_t child = ::fork();
    if (child == 0) {
        Autosave autosave(folder, seconds(0));
        Document document(smallScene(), original);
        document.apply(renameInstance(2, "edited before the crash"));
        document.apply(showInstances({4}, false));
        autosave.update(document, Camera{.name = "view"}, kSoon);
        autosave.wait();
        ::kill(::getpid(), SIGKILL);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status));
}

TEST(EditorAutosave, AKilledProcessLeavesItsEditsToBeRecovered) {
    const ScratchFolder folder;
    const fs::path saves = folder.path() / "autosave";
    crashAfterEdits(saves, folder.path() / "mine.glb");
    const std::vector<Recoverable> found = findRecoverable(saves);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].original, folder.path() / "mine.glb");
    OpenedDocument recovered = recover(found[0]);
    EXPECT_EQ(recovered.document.scene().instances[2].name, "edited before the crash");
    EXPECT_TRUE(recovered.document.isHidden(4));
    ASSERT_TRUE(recovered.view);
    EXPECT_EQ(recovered.view->name, "view");
    EXPECT_TRUE(recovered.document.isUnsaved());
    EXPECT_EQ(recovered.document.file(), folder.path() / "mine.glb");
    discard(found[0]);
    EXPECT_TRUE(findRecoverable(saves).empty());
    EXPECT_TRUE(fs::is_empty(saves));
}

TEST(EditorAutosave, AnEndWithoutAnythingToLoseLeavesNothing) {
    const ScratchFolder folder;
    const fs::path saves = folder.path() / "autosave";
    { const Autosave autosave(saves, seconds(0)); }
    EXPECT_TRUE(fs::is_empty(saves));
    {
        Autosave autosave(saves, seconds(0));
        Document document(smallScene());
        document.apply(renameInstance(0, "edited"));
        autosave.update(document, {}, kSoon);
        autosave.discard();
    }
    EXPECT_TRUE(fs::is_empty(saves));
}

TEST(EditorAutosave, AFailureIsToldOnce) {
    const ScratchFolder folder;
    Autosave autosave(folder.path() / "autosave", seconds(0));
    Document document(smallScene());
    document.apply(renameInstance(0, "edited"));
    withSmallFilesOnly([&] {
        EXPECT_TRUE(autosave.update(document, {}, kSoon));
        autosave.wait();
    });
    EXPECT_NE(autosave.takeProblem().find("autosave failed"), std::string::npos);
    EXPECT_EQ(autosave.takeProblem(), "");
    EXPECT_FALSE(autosave.update(document, {}, kSoon)) << "not again before the next edit";
}

}  // namespace
}  // namespace raylab::editortest
