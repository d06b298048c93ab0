#include "ui/editor/render_worker.h"

#include <malloc.h>
#include <sys/resource.h>

#include <algorithm>
#include <new>
#include <optional>

#include "engine/core/error.h"
#include "engine/core/log.h"
#include "engine/core/stopwatch.h"
#include "engine/render/device_recovery.h"
#include "engine/render/kernel_use.h"
#include "engine/render/prepared_settings.h"
#include "engine/render/renderer.h"
#include "ui/editor/model/edit_kinds.h"
#include "ui/editor/model/settled_environment.h"
#include "ui/editor/moving_size.h"
#include "ui/editor/picture_feed.h"
#include "ui/editor/render_status.h"
#include "ui/editor/time_text.h"
#include "ui/editor/view_caster.h"

namespace raylab {
namespace {

constexpr int kNice = 10;
/// A slice at most, so that a new request waits no longer than that.
constexpr double kSliceMs = 25.0;
/// Samples of a pass that takes longer than a slice: what grows in sight grows evenly, and whole passes are what A/B times.
constexpr uint32_t kMostOfPass = 1;
/// Unless a new request is waiting for longer than this, a moving picture is finished.
constexpr double kPatienceSeconds = 0.2;
/// Between words on how it goes on, which take a frame of the interface each, while no picture comes.
constexpr double kStatusInterval = 0.25;

class RenderWorker {
public:
    RenderWorker(RenderSession& session, const std::string& selector, bool validation)
        : session_(session), device_({selector, validation}) {
        session.report([&](RenderStatus& status) {
            status.device = device_.get().description().name;
            status.deviceDescription = std::make_shared<const DeviceDescription>(device_.get().description());
        });
    }

    void run() {
        while (const auto task = session_.nextTask(rendering_ && !paused_)) {
            try {
                attend(*task);
            } catch (const Cancelled&) {
                report(renderer_ ? RenderPhase::done : RenderPhase::idle, "cancelled");
            } catch (const DeviceLost& loss) {
                recover(loss);
            } catch (const Error& error) {
                fail(error.what());
            } catch (const std::bad_alloc&) {
                fail("out of memory; use a smaller scene or picture");
            }
            session_.setValidationMessages(device_.validationMessageCount());
        }
    }

private:
    void attend(const RenderSession::Task& task) {
        if (task.paused != paused_) pause(task.paused);
        if (task.request) adopt(*task.request);
        if (task.reload && wanted_.scene) reload();
        if (task.reloadShaders && wanted_.scene && !task.reload) reloadShaders();
        if (task.pick) answerPick(*task.pick);
        if (renderer_ && rendering_ && !paused_) advance();
    }

    void fail(const std::string& message) {
        logError(message);
        session_.report([&](RenderStatus& status) {
            status.error = message;
            status.phase = rendering_ ? RenderPhase::rendering : RenderPhase::idle;
            status.text.clear();
        });
    }

    /// The newest request can be fulfilled.
    void clearError() {
        session_.report([](RenderStatus& status) { status.error.clear(); });
    }

    /// All that was on the lost device is made anew from the scene that is wanted, at the next task, which this asks
    /// for. Where nothing is left to be tried the device is fresh too, and waits for a request of other geometry or a
    /// reload.
    void recover(const DeviceLost& loss) {
        forgetPrepared();
        RenderSettings settings = effectiveSettings();
        const bool goesOn = recovery_.adjust(loss, settings);
        device_.replace();
        if (!goesOn) {
            recovery_.forget();
            return fail(std::string(loss.what()) + "; F5 tries again");
        }
        afterLoss_ = settings;
        session_.report([&](RenderStatus& status) {
            status.recovery = "the device was lost: " + settings.tracer + " goes on, on a fresh one";
        });
        session_.reload();
    }

    /// Nothing of it may be used any more. What is shown stays.
    void forgetPrepared() {
        caster_.forget();
        renderer_.reset();
        prepared_.reset();
        isPrepared_ = false;
        rendering_ = false;
    }

    /// Those that are wanted, in slices that let requests through, as far as losses of the device allow.
    RenderSettings effectiveSettings() const {
        RenderSettings settings = wanted_.settings;
        settings.sliceMs = std::min(settings.sliceMs, kSliceMs);
        if (!afterLoss_) return settings;
        settings.tracer = afterLoss_->tracer;
        settings.sliceMs = std::min(settings.sliceMs, afterLoss_->sliceMs);
        return settings;
    }

    void report(RenderPhase phase, const std::string& text) {
        session_.report([&](RenderStatus& status) {
            status.phase = phase;
            status.text = text;
        });
    }

    void pause(bool paused) {
        paused_ = paused;
        if (rendering_) report(paused ? RenderPhase::paused : RenderPhase::rendering, "");
    }

    /// Does what the step from the request before to this one takes.
    void adopt(const RenderRequest& request) {
        using namespace editor;
        const RenderRequest before = std::exchange(wanted_, request);
        const bool isFirst = before.scene == nullptr;
        if (before.settings.tracer != request.settings.tracer) forgetLosses();
        const uint32_t kinds = isFirst ? uint32_t{kEditEverything}
                                       : (editKinds(*before.scene, *request.scene) & ~uint32_t{kEditCamera}) |
                                             editKinds(before.settings, request.settings);
        const auto touches = [kinds](uint32_t mask) { return (kinds & mask) != 0; };
        if (touches(kEditTrees | kEditGeometry)) return prepare();
        if (!renderer_) {  // the first request has failed or was cancelled
            if (kinds != kEditNothing) prepare();
            return;
        }
        if (touches(kEditTransforms | kEditShading)) return updateInPlace(kinds);
        if (touches(kEditKernel)) return clearError(), restart("Compiling the kernel");
        if (touches(kEditCamera) || isOtherView(before, request)) return clearError(), restart("");
        if (touches(kEditBudget)) resume();
        const bool isDevelopedAnew = request.moving != before.moving && request.settings.denoise != kNoDenoiser;
        if (touches(kEditFilm) || request.wantsHits != before.wantsHits || isDevelopedAnew) publish();
    }

    /// Another tracer is wanted: it gets its own chance.
    void forgetLosses() {
        afterLoss_.reset();
        recovery_.forget();
        session_.report([](RenderStatus& status) { status.recovery.clear(); });
    }

    bool isOtherView(const RenderRequest& before, const RenderRequest& request) const {
        return !(before.camera == request.camera) || before.width != request.width || before.height != request.height ||
               size_.divisorFor(wanted_) != divisor_;
    }

    /// The settings of the film that is rendered now.
    RenderSettings filmSettings() {
        divisor_ = size_.divisorFor(wanted_);
        RenderSettings settings = effectiveSettings();
        settings.width = std::max<int64_t>(wanted_.width / divisor_, 1);
        settings.height = std::max<int64_t>(wanted_.height / divisor_, 1);
        settings.camera = "0";
        if (moved_) settings.trees = "mesh";
        return settings;
    }

    Scene settledScene() {
        Scene scene = *wanted_.scene;
        environment_.settle(scene, wanted_.settings);
        return scene;
    }

    void prepare() {
        isPrepared_ = false;
        session_.setUpdatedBytes(0);
        clearError();
        report(RenderPhase::preparing, "Reading the environment");
        const Scene scene = settledScene();
        BuildControl control;
        control.cancel = &session_.cancelled();
        control.progress = [this](float part) {
            report(RenderPhase::preparing,
                   "Building the BVH  " + std::to_string(static_cast<int>(100.0f * part)) + " %");
        };
        report(RenderPhase::preparing, "Building the BVH");
        size_.beginUnknown();  // first a small picture, then that of the size that is wanted
        const RenderSettings settings = filmSettings();
        auto prepared = std::make_shared<PreparedScene>(prepareScene(device_.get(), scene, settings, control));
        prepared->camera = wanted_.camera;
        report(RenderPhase::preparing, "Compiling the kernel");
        refreshSources(traversalOf(*prepared));
        auto renderer = std::make_unique<Renderer>(device_.get(), prepared, settings);
        caster_.forget();
        renderer_ = std::move(renderer);
        renderer_->limitPass(kMostOfPass);
        prepared_ = std::move(prepared);
        malloc_trim(0);  // what smaller pieces of the scene before have left
        isPrepared_ = true;
        preparedEnvironment_ = scene.environment;
        describe();
        begin();
    }

    void reload() {
        const ShaderSources& sources = *session_.share().shaders;
        if (!sources.missing().empty()) logWarning("F5 cannot compile kernels: " + sources.missing());
        environment_.forget();
        prepare();
    }

    /// Brings the kernels of a traversal up to their sources. True where one has become another. Throws Error where a
    /// source does not compile.
    bool refreshSources(const std::string& traversal) {
        const Stopwatch watch;
        const uint64_t before = std::exchange(
            shaders_,
            session_.share().shaders->refresh([&](const std::string& entry) { return mayServe(entry, traversal); }));
        if (shaders_ == before) return false;
        logInfo("shaders of " + traversal + " compiled anew, " + timeText(watch.seconds()));
        return true;
    }

    /// Where a source does not compile, all stays as it was.
    void reloadShaders() {
        if (!isPrepared_) return prepare();
        report(RenderPhase::preparing, "Compiling shaders");
        if (!refreshSources(traversalOf(*prepared_))) {
            clearError();
            return report(rendering_ ? RenderPhase::rendering : RenderPhase::done, "");
        }
        pictures_.keepBackdrop();
        report(RenderPhase::preparing, "Compiling the kernel");
        auto renderer = std::make_unique<Renderer>(device_.get(), prepared_, filmSettings());
        caster_.forget();
        renderer_ = std::move(renderer);
        renderer_->limitPass(kMostOfPass);
        clearError();
        describe();
        begin();
    }

    /// Takes what is on the device up to an edit that leaves meshes and textures as they are: buffers whose bytes stay
    /// are not touched.
    void updateInPlace(uint32_t kinds) {
        const bool moves = (kinds & editor::kEditTransforms) != 0;
        // From the first move on each mesh has a tree of its own below its instances, which can be moved.
        if (!isPrepared_ || (moves && !std::exchange(moved_, true))) return prepare();
        const Scene scene = settledScene();
        const SceneParts changed{.geometry = false,
                                 .instances = false,
                                 .textures = false,
                                 .environment = !scene.environment.sameAs(preparedEnvironment_)};
        caster_.forget();
        const uint64_t before = prepared_->gpu->uploadedBytes();
        try {
            if (moves) updateScene(device_.get(), scene, {.instances = true, .meshes = {}}, *prepared_);
            if ((kinds & editor::kEditShading) != 0)
                updateSettings(device_.get(), scene, effectiveSettings(), *prepared_, changed);
        } catch (...) {
            forgetPrepared();  // it may be half of each
            throw;
        }
        preparedEnvironment_ = scene.environment;
        session_.setUpdatedBytes(prepared_->gpu->uploadedBytes() - before);
        clearError();
        restart("Compiling the kernel");
        describe();
    }

    /// `meanwhile`: what takes long about it; empty where nothing does.
    void restart(const std::string& meanwhile) {
        pictures_.keepBackdrop();
        if (!meanwhile.empty()) report(RenderPhase::preparing, meanwhile);
        renderer_->restart(filmSettings(), wanted_.camera);
        begin();
    }

    /// A film has just been started.
    void begin() {
        pictures_.begin();
        resume();
    }

    void resume() {
        if (!renderer_) return;
        renderer_->setSampleGoal(wanted_.settings.spp);
        rendering_ = true;
        report(paused_ ? RenderPhase::paused : RenderPhase::rendering, "");
    }

    void advance() {
        bool more = true;
        const Stopwatch watch;
        do {
            const RenderTurns::Turn turn(*session_.share().turns);
            more = renderer_->step();
        } while (wanted_.moving && more && renderer_->completeSamples() == 0 &&
                 (watch.seconds() < kPatienceSeconds || !session_.hasRequest()));
        size_.measure(*renderer_);
        if (size_.isPreview() && renderer_->completeSamples() > 0) {
            size_.endPreview();
            publish();
            if (size_.divisorFor(wanted_) != divisor_) return restart("");
        }
        const std::string reason = more ? reasonToStop(*renderer_, wanted_.settings, pictures_.noise()) : "samples";
        if (!reason.empty()) rendering_ = false;
        if (!rendering_ || pictures_.isDue(*renderer_)) publish();
        if (!reason.empty()) {
            recovery_.forget();
            report(RenderPhase::done, reason);
        } else if (sinceStatus_.seconds() >= kStatusInterval) {
            session_.report([&](RenderStatus& status) { describeProgress(nullptr, status); });
            sinceStatus_.restart();
        }
    }

    /// In a turn of its own where it takes the device's time.
    std::shared_ptr<Picture> makePicture() {
        const auto isAskedFor = [this] { return session_.hasRequest(); };
        if (!renderer_->denoises()) return pictures_.make(*renderer_, wanted_.settings, isAskedFor);
        const RenderTurns::Turn turn(*session_.share().turns);
        return pictures_.make(*renderer_, wanted_.settings, isAskedFor);
    }

    void publish() {
        const Stopwatch watch;
        const bool isRough = wanted_.moving || divisor_ > 1 || renderer_->completeSamples() == 0;
        renderer_->setDenoiser(isRough ? kNoDenoiser : wanted_.settings.denoise);
        const std::shared_ptr<Picture> picture = makePicture();
        picture->hits = lookBehind(picture->width, picture->height);
        session_.publish(picture, [&](RenderStatus& status) { describeProgress(picture->film.get(), status); });
        sinceStatus_.restart();
        pictures_.finish(watch.seconds());
    }

    /// What lies behind the film's pixels; nullptr where nobody asked, or while things move that a caster would have to
    /// be made for anew each time.
    std::shared_ptr<const HitMap> lookBehind(uint32_t width, uint32_t height) {
        if (!wanted_.wantsHits || (wanted_.moving && !caster_.isReady())) return nullptr;
        return caster_.lookBehind(width, height, device_.get(), prepared_, effectiveSettings());
    }

    void describe() {
        session_.report([&](RenderStatus& status) { describeKernel(*renderer_, status); });
    }

    void describeProgress(const FilmImage* film, RenderStatus& status) const {
        describeFilm(*renderer_, wanted_.settings, film, status);
        status.relativeError = pictures_.noise();
        status.divisor = divisor_;
    }

    void answerPick(const RenderSession::PickTask& task) {
        session_.answer(renderer_ ? caster_.pick(task, device_.get(), prepared_, effectiveSettings())
                                  : PickResult{.ticket = task.ticket});
    }

    RenderSession& session_;
    ReplaceableDevice device_;
    LossRecovery recovery_;
    std::optional<RenderSettings> afterLoss_;  ///< tracer and slices to go on by, in place of those that are wanted
    RenderRequest wanted_;
    std::shared_ptr<PreparedScene> prepared_;
    std::unique_ptr<Renderer> renderer_;
    editor::SettledEnvironment environment_;
    SharedOptional<Environment> preparedEnvironment_;  ///< that `prepared_` has
    ViewCaster caster_;
    MovingSize size_;
    PictureFeed pictures_;
    uint64_t shaders_ = 0;     ///< state of the sources that kernels are of
    bool isPrepared_ = false;  ///< what is wanted: the last prepare() did not throw
    bool rendering_ = false;
    bool paused_ = false;
    bool moved_ = false;  ///< an instance has been: trees are laid out for more of it
    uint32_t divisor_ = 1;
    Stopwatch sinceStatus_;
};

}  // namespace

void runRenderWorker(RenderSession& session, const std::string& deviceSelector, bool validation) {
    // A thread that stays as urgent as the others is no reason to give up.
    if (::setpriority(PRIO_PROCESS, 0, kNice) != 0) logWarning("the rendering thread cannot yield to the interface");
    try {
        RenderWorker worker(session, deviceSelector, validation);
        worker.run();
    } catch (const std::exception& error) {
        logError(error.what());
        const std::string message = error.what();
        session.report([&](RenderStatus& status) {
            status.phase = RenderPhase::idle;
            status.error = message;
        });
    }
}

}  // namespace raylab
