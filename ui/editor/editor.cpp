#include "ui/editor/editor.h"

#include <imgui.h>
#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/core/stopwatch.h"
#include "engine/gpu/check.h"
#include "engine/image/image8.h"
#include "engine/render/camera.h"
#include "engine/scene/import.h"
#include "ui/editor/actions.h"
#include "ui/editor/compare.h"
#include "ui/editor/context.h"
#include "ui/editor/document_files.h"
#include "ui/editor/imgui_backend.h"
#include "ui/editor/inspection_actions.h"
#include "ui/editor/layout.h"
#include "ui/editor/latency.h"
#include "ui/editor/model/edit_kinds.h"
#include "ui/editor/model/edit_surroundings.h"
#include "ui/editor/model/merge_scene.h"
#include "ui/editor/script.h"
#include "ui/editor/shader_watch.h"
#include "ui/editor/swapchain.h"

namespace raylab {
namespace {

constexpr double kRestSeconds = 0.2;    ///< without a movement, until the picture is a full one again
constexpr double kFrameSeconds = 0.015; ///< from frame to frame while something moves or settles
constexpr double kIdleSeconds = 0.5;    ///< between frames while nothing happens
constexpr uint32_t kSwapchainImages = 3;
constexpr int kOwnPages = 1 << 20;      ///< bytes, from which an allocation has pages of its own
constexpr int kSettlingFrames = 3;      ///< that ImGui wants after an event

using Clock = std::chrono::steady_clock;

double secondsBetween(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
}

class Editor {
public:
    explicit Editor(const EditorOptions& options)
        : config_(loadConfig()),
          window_(config_.windowWidth, config_.windowHeight, options.settings.device, options.settings.validation),
          swapchain_(std::make_unique<Swapchain>(window_.device(), window_.surface())),
          imgui_(window_, window_.device(), swapchain_->renderPass(), kSwapchainImages, window_.scale()),
          images_(window_.device(), swapchain_->renderPass()),
          background_(wakeWindow),
          measuring_(wakeWindow),
          shaders_(std::make_shared<ShaderSources>(dataFolder("shaders"))),
          session_(options.settings.device, options.settings.validation, {shaders_}, wakeWindow),
          shaderWatch_(shaders_, wakeWindow),
          files_(std::chrono::seconds(config_.autosaveSeconds)),
          script_(options.script.empty() ? nullptr : std::make_unique<Script>(options.script)),
          context_{.state = state_,
                   .config = config_,
                   .session = session_,
                   .background = background_,
                   .measuring = measuring_,
                   .images = images_,
                   .log = log_,
                   .input = window_.input(),
                   .fileDialog = fileDialog_,
                   .states = states_,
                   .files = files_,
                   .open = [this](const std::filesystem::path& path, OpenMode mode) { open(path, mode); },
                   .show =
                       [this](editor::OpenedDocument opened, const std::function<void()>& then) {
                           auto held = std::make_shared<editor::OpenedDocument>(std::move(opened));
                           files_.ask(context_, [this, held, then] {
                               adopt(std::move(*held));
                               then();
                           });
                       },
                   .quit = [this] { quit_ = true; }} {
        state_.startSettings = options.settings;
        context_.scale = window_.scale();
        if (!options.scene.empty()) open(options.scene, OpenMode::replace);
    }

    ExitCode run() {
        while (!quit_) {
            window_.waitEvents(waitSeconds());
            frameStart_ = Clock::now();
            if (window_.hasNewEvents()) settling_ = kSettlingFrames;
            background_.collect();
            measuring_.collect();
            session_.setHeld(!measuring_.busyWith().empty());
            takeDrops();
            look();
            stepScript();
            frame();
            if (window_.shouldClose()) {
                window_.cancelClose();
                files_.ask(context_, [this] { quit_ = true; });
            }
        }
        files_.leave();
        keepConfig();
        session_.stop();
        const uint32_t messages = session_.validationMessages() + comparison().validationMessages() +
                                  countingValidationMessages(context_) + window_.validationMessageCount();
        return messages > 0 ? ExitCode::checkFailed : ExitCode::done;
    }

private:
    /// An event ends the wait: it should rarely meet a frame that is being drawn, and wait for its end.
    double waitSeconds() const {
        if (settling_ > 0 || context_.viewMoves || moving_) return kFrameSeconds;
        const double rest = std::min(kIdleSeconds, context_.redrawSeconds);
        return script_ == nullptr ? rest : std::min(std::max(script_->restSeconds(), kFrameSeconds), rest);
    }

    /// What the frame will show.
    void look() {
        context_.seconds = std::min(sinceFrame_.restart(), 0.1);
        context_.status = session_.status();
        context_.picture = session_.picture();
        context_.picked = session_.takePick();
        context_.viewMoves = false;
        context_.redrawSeconds = kIdleSeconds;
        if (shaderWatch_.takeChange()) reloadShaders();
        comparison().look(context_);
        settling_ = std::max(settling_ - 1, 0);
    }

    Comparison& comparison() { return states_.get<Comparison>(); }

    void reloadShaders() {
        session_.reloadShaders();
        comparison().reloadShaders();
    }

    void stepScript() {
        if (script_ == nullptr) return;
        ScriptHost host{context_,
                        window_,
                        imgui_,
                        latency_,
                        pointer_,
                        [this](const std::filesystem::path& path) { screenshot_ = path; },
                        [this] { return isIdle(); }};
        if (!script_->step(host)) script_.reset();
    }

    bool isIdle() {
        const RenderPhase phase = context_.status.phase;
        return background_.busyWith().empty() && measuring_.busyWith().empty() && !moving_ &&
               phase != RenderPhase::preparing && phase != RenderPhase::rendering && !comparison().isBusy();
    }

    void frame() {
        imgui_.newFrame(pointer_);
        runKeys(context_);
        drawLayout(context_);
        files_.draw(context_, [this](editor::OpenedDocument&& opened) { adopt(std::move(opened)); });
        imgui_.endFrame();
        requestPicture();
        try {
            show();
            shownSinceLoss_ = true;
        } catch (const DeviceLost& loss) {
            replaceDevice(loss);
        }
        window_.endFrame();
        window_.setTitle(title());
    }

    /// The window goes on with another device; all that the interface knows stays as it is. Throws Error where that one
    /// is lost before it has shown a frame.
    void replaceDevice(const DeviceLost& loss) {
        if (!std::exchange(shownSinceLoss_, false)) throw loss;
        logWarning(std::string("the window's device was lost (") + loss.what() + "); a fresh one draws it");
        images_.releaseDevice();
        imgui_.releaseDevice();
        swapchain_.reset();
        window_.replaceDevice();
        swapchain_ = std::make_unique<Swapchain>(window_.device(), window_.surface());
        imgui_.useDevice(window_.device(), swapchain_->renderPass(), kSwapchainImages);
        images_.useDevice(window_.device(), swapchain_->renderPass());
        settling_ = kSettlingFrames;
    }

    void show() {
        const ImDrawData& data = *ImGui::GetDrawData();
        const Swapchain::Recorder recorder{
            [&](VkCommandBuffer commands) { images_.recordUploads(commands); },
            [&](VkCommandBuffer commands) {
                images_.beginDraw(commands, data.DisplayPos, data.DisplaySize, data.FramebufferScale.x);
                imgui_.draw(commands);
            }};
        Image8 copy;
        const Clock::time_point built = Clock::now();
        const bool shown = swapchain_->present(window_.framebufferSize(), recorder, screenshot_.empty() ? nullptr : &copy);
        images_.endFrame();
        if (!shown) return;
        latency_.countFrame();
        if (window_.hasNewEvents())
            latency_.record({secondsBetween(window_.oldestEvent(), frameStart_), secondsBetween(frameStart_, built),
                             secondsBetween(built, Clock::now())});
        if (!screenshot_.empty()) writeFileAtomically(screenshot_, encodePng8(copy.texels, copy.width, copy.height));
        screenshot_.clear();
    }

    /// Tells the session where what it should show is not what it was told last.
    void requestPicture() {
        if (!state_.hasScene() || context_.viewWidth == 0) return;
        if (!ImGui::IsAnyItemActive()) state_.document->endMerge();
        RenderRequest next{state_.document->rendered(), state_.settings(), state_.camera, context_.viewWidth, context_.viewHeight};
        const bool isOther = std::exchange(opened_, false);
        const bool sceneChanged = next.scene != requested_.scene;
        const bool viewChanged = !(next.camera == requested_.camera) || next.width != requested_.width || next.height != requested_.height;
        if ((viewChanged || sceneChanged) && !isOther) sinceMove_.restart();
        moving_ = !isOther && (context_.viewMoves || sinceMove_.seconds() < kRestSeconds);
        next.moving = moving_;
        next.wantsHits = requested_.wantsHits || comparison().mode() == CompareMode::firstHit ||
                         !state_.document->selection().instances.empty();
        comparison().request(context_, next, isOther);
        if (!viewChanged && !sceneChanged && next.moving == requested_.moving && next.wantsHits == requested_.wantsHits && editor::editKinds(next.settings, requested_.settings) == 0)
            return;
        requested_ = next;
        session_.submit(std::move(next), isOther);
    }

    /// Reads in the background; what was there stays until it is read.
    void open(const std::filesystem::path& path, OpenMode mode) {
        if (mode != OpenMode::replace && !state_.hasScene()) return logError(path.string() + ": open a scene first");
        if (mode == OpenMode::save) return files_.saveTo(context_, path);
        if (mode == OpenMode::replace)
            files_.ask(context_, [this, path] { read(path, OpenMode::replace); });
        else
            read(path, mode);
    }

    void read(const std::filesystem::path& path, OpenMode mode) {
        RenderSettings settings = state_.settings();
        settings.camera = "0";
        background_.start("Reading " + path.filename().string(), [this, path, mode, settings = std::move(settings), place = context_.texturePlace](JobControl&) -> Background::Finish {
            if (mode == OpenMode::environment) {
                const editor::Edit edit = editor::loadEnvironment(path);
                return [this, edit] { applyEdit(context_, edit); };
            }
            if (mode == OpenMode::texture) {
                const editor::Edit edit = editor::loadTexture(place.material, place.slot, path);
                return [this, edit] { applyEdit(context_, edit); };
            }
            if (mode == OpenMode::merge) {
                auto scene = std::make_shared<Scene>(importScene(path));
                for (const std::string& warning : scene->warnings) logWarning(warning);
                return [this, scene] { applyEdit(context_, editor::mergeScene(std::move(*scene))); };
            }
            auto opened = std::make_shared<editor::OpenedDocument>(editor::openDocument(path, settings));
            return [this, opened] { adopt(std::move(*opened)); };
        });
    }

    void adopt(editor::OpenedDocument&& opened) {
        for (const std::string& warning : opened.warnings) logWarning(warning);
        const bool isFirst = !state_.hasScene();
        const Scene& scene = opened.document.scene();
        const std::string named = isFirst ? state_.startSettings.camera : "0";
        state_.camera = opened.view && named == "0" ? *opened.view : chooseCamera(scene, named);
        state_.document = std::make_unique<editor::Document>(std::move(opened.document));
        opened_ = true;
        const std::filesystem::path file = state_.document->file();
        if (!file.empty()) config_.addRecent(file);
        logInfo("opened " + (file.empty() ? "a scene without a name" : file.string()));
    }

    void takeDrops() {
        for (const Drop& drop : window_.input().drops)
            for (const std::filesystem::path& path : drop.paths) {
                const std::string extension = path.extension().string();
                const bool sky = extension == ".hdr" || extension == ".exr";
                open(path, sky ? OpenMode::environment : drop.shift ? OpenMode::merge : OpenMode::replace);
            }
    }

    std::string title() const {
        if (!state_.hasScene()) return "raylab";
        return state_.document->file().filename().string() + (state_.document->isUnsaved() ? " *" : "") + " - raylab";
    }

    void keepConfig() {
        const VkExtent2D size = window_.framebufferSize();
        if (size.width > 0) {
            config_.windowWidth = static_cast<int>(size.width);
            config_.windowHeight = static_cast<int>(size.height);
        }
        saveConfig(config_);
    }

    EditorLog log_;
    EditorConfig config_;
    EditorState state_;
    Window window_;
    std::unique_ptr<Swapchain> swapchain_;
    ImGuiBackend imgui_;
    ImagePainter images_;
    Background background_;
    Background measuring_;
    std::shared_ptr<ShaderSources> shaders_;
    RenderSession session_;
    ShaderWatch shaderWatch_;
    FileDialog fileDialog_;
    PanelStates states_;
    DocumentFiles files_;
    LatencyRecorder latency_;
    std::unique_ptr<Script> script_;
    std::optional<PointerOverride> pointer_;  ///< of the script, once it has moved the pointer
    std::filesystem::path screenshot_;        ///< of the window, to be written with the next frame
    EditorContext context_;
    RenderRequest requested_;
    Clock::time_point frameStart_;
    Stopwatch sinceFrame_;
    Stopwatch sinceMove_;
    bool moving_ = false;
    bool opened_ = false;  ///< a document that has not been shown yet
    bool quit_ = false;
    bool shownSinceLoss_ = true;  ///< a frame
    int settling_ = kSettlingFrames;
};

}  // namespace

ExitCode runEditor(const EditorOptions& options) {
    // What a scene held goes back to the system when it is closed. By glibc's own rule the bound rises to 32 MiB, and
    // the rest of a large scene stays: 1150 MiB instead of 850 with the courtyard open for the third time.
    mallopt(M_MMAP_THRESHOLD, kOwnPages);
    Editor editor(options);
    return editor.run();
}

}  // namespace raylab
