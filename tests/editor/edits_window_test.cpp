#include "engine/scene/import.h"
#include "tests/editor/window.h"

namespace raylab {
namespace {

using support::WindowTest;

const std::string kCornellToEdit = "cornell --depth 2 --spp 1 ";
const std::string kSelectTheTallBox = "wait-samples 1\nclick v0.62 v0.55\nwait-until selected == 1\n";

TEST_F(WindowTest, DuplicatesDragsAndUndoesWithNames) {
    EXPECT_EQ(
        runScript(kCornellToEdit,
                  kSelectTheTallBox +
                      "key Ctrl+d\nwait-until instances == 9\nassert undo contains Duplicate\nassert unsaved == 1\n"
                      "key f\nwait-idle\nremember item-x\nscreenshot gizmo.png\n"
                      "drag v0.42 v0.5 v0.3 v0.5\nwait-until item-x != remembered\nassert undo contains Move\n"
                      "assert undo-steps == 2\nscreenshot moved.png\n"
                      "key Ctrl+z\nwait-until item-x == remembered\nassert redo contains Move\n"
                      "key Ctrl+z\nwait-until instances == 8\nassert unsaved == 0\nassert undo-steps == 0\n"
                      "key Ctrl+y\nwait-until instances == 9\nassert errors == 0\nquit\n"),
        0)
        << readFile("log");
}

/// An edit of a material uploads the table of materials (and the first metal 17 KB of albedos), and nothing is prepared anew;
/// undone, the picture is what it was.
TEST_F(WindowTest, TakesUpAnEditOfAMaterialInPlace) {
    EXPECT_EQ(runScript(kCornellToEdit,
                        kSelectTheTallBox +
                            "wait-idle\nassert updated-bytes == 0\nremember picture-contrast\npress material-metallic\n"
                            "wait-until undo contains metallic\nwait-until updated-bytes > 0\nwait-idle\n"
                            "assert updated-bytes < 20000\nassert picture-contrast != remembered\n"
                            "panel Kernel\nwait 0.2\nscreenshot kernel.png\n"
                            "key Ctrl+z\nwait-until picture-contrast == remembered\n"
                            "assert errors == 0\nassert validation == 0\nquit\n"),
              0)
        << readFile("log");
}

TEST_F(WindowTest, HidesIsolatesAndDeletes) {
    EXPECT_EQ(runScript(kCornellToEdit,
                        kSelectTheTallBox +
                            "key h\nwait-until rendered == 7\nassert instances == 8\nkey h\nwait-until rendered == 8\n"
                            "key Shift+h\nwait-until rendered == 1\nwait-idle\nkey Alt+h\nwait-until rendered == 8\n"
                            "key Del\nwait-until instances == 7\nassert selected == 0\nwait-idle\n"
                            "key Ctrl+a\nwait-until selected == 7\nkey Del\nwait 0.2\nassert instances == 7\n"
                            "assert errors == 1\nquit\n"),
              0)
        << readFile("log");
    EXPECT_NE(readFile("log").find("keeps at least one instance"), std::string::npos);
}

TEST_F(WindowTest, SavesUnderAnotherNameAndBesideIt) {
    const std::string file = (folder_ / "saved.glb").string();
    EXPECT_EQ(
        runScript(
            kCornellToEdit,
            kSelectTheTallBox +
                "key Ctrl+d\nwait-until instances == 9\nset depth 5\nkey Ctrl+Shift+s\nwait 0.3\nscreenshot "
                "names.png\ntype " +
                file +
                "\nwait 0.2\nkey Enter\nwait-until unsaved == 0\nassert file == saved.glb\nassert errors == 0\nquit\n"),
        0)
        << readFile("log");
    ASSERT_TRUE(std::filesystem::exists(file)) << readFile("log");
    EXPECT_EQ(importScene(file).instances.size(), 9u);
    EXPECT_NE(readFile("saved.raylab.json").find("\"depth\": \"5\""), std::string::npos);
}

TEST_F(WindowTest, AsksBeforeEditsAreLostAndRecoversThemAfterACrash) {
    std::filesystem::create_directories(folder_ / "raylab");
    writeFile("raylab/editor.json", "{\"autosaveSeconds\": 1}");
    const std::string crash = "while [ ! -e edited.png ]; do sleep .1; done\nsleep 2.5\nkill -9 $editor\n";
    EXPECT_NE(
        runScript(kCornellToEdit,
                  kSelectTheTallBox + "key Ctrl+d\nwait-until instances == 9\nscreenshot edited.png\nwait 20\nquit\n",
                  crash),
        0);
    EXPECT_EQ(runScript(kCornellToEdit,
                        "wait-samples 1\nwait 0.3\nscreenshot recovery.png\nclick 488 365\nwait-until instances == "
                        "9\nassert unsaved == 1\n"
                        "assert file == cornell.glb\nwait-idle\nkey Ctrl+q\nwait 0.3\nscreenshot question.png\nclick "
                        "640 343\nwait 20\n"
                        "assert instances == 0\n"),
              0)
        << readFile("log");
}

}  // namespace
}  // namespace raylab
