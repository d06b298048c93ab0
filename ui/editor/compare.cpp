#include "ui/editor/compare.h"

#include <algorithm>
#include <array>
#include <utility>

#include "engine/core/log.h"
#include "engine/image/image_io.h"
#include "engine/measure/difference_map.h"
#include "ui/editor/model/edit_kinds.h"
#include "ui/editor/model/edit_surroundings.h"

namespace raylab {
namespace {

constexpr std::array<std::string_view, 7> kShared = {"width",  "height",     "seed",      "camera",
                                                     "device", "validation", "camera-end"};
constexpr size_t kMostPoints = 2000;

bool isRendering(const RenderStatus& status) { return status.phase == RenderPhase::rendering; }

/// Neither builds nor compiles, which would take time from the other.
bool isQuiet(const RenderStatus& status) { return status.phase != RenderPhase::preparing; }

/// Pictures of another film, or denoised where those before were not, begin a new line.
void addPoint(Comparison::Side& side, double seconds, bool isDenoised, const std::optional<double>& error) {
    side.error = error;
    if (std::exchange(side.isDenoised, isDenoised) != isDenoised) side.history.clear();
    if (!error || *error <= 0.0 || seconds <= 0.0) return;
    if (!side.history.empty() && seconds < side.history.back().seconds) side.history.clear();
    if (side.history.size() >= kMostPoints || (!side.history.empty() && seconds == side.history.back().seconds)) return;
    side.history.push_back({seconds, *error});
}

}  // namespace

bool Comparison::isShared(std::string_view setting) { return std::ranges::find(kShared, setting) != kShared.end(); }

RenderSettings Comparison::effectiveSettings(const RenderSettings& ofA) const {
    RenderSettings settings = settings_;
    for (const Setting<RenderSettings>& row : renderSettingsTable())
        if (isShared(row.name)) setSetting(row, settings, settingText(getSetting(row, ofA)));
    return settings;
}

void Comparison::begin(EditorContext& context) {
    if (!std::exchange(hasSettings_, true)) copyFromA(context);
}

void Comparison::setMode(EditorContext& context, CompareMode mode) {
    if (mode == CompareMode::off && mode_ != CompareMode::off) lastMode_ = mode_;
    begin(context);
    mode_ = mode;
    if (session_ && mode == CompareMode::off) session_->setPaused(true);
}

void Comparison::toggle(EditorContext& context) { setMode(context, isOn() ? CompareMode::off : lastMode_); }

void Comparison::giveToA(EditorContext& context) const {
    applyEdit(context, editor::replaceRenderSettings(effectiveSettings(context.state.settings()), "Take B's settings"));
}

void Comparison::swap(EditorContext& context) {
    RenderSettings ofA = context.state.settings();
    applyEdit(context, editor::replaceRenderSettings(effectiveSettings(ofA), "Swap A and B"));
    settings_ = std::move(ofA);
}

void Comparison::forgetErrors() {
    for (Side* side : {&a_, &b_}) {
        side->error.reset();
        side->history.clear();
    }
    jobA_ = jobB_ = 0;  // figures are due again
}

void Comparison::growReference() {
    reference_ = CompareReference::growing;
    kept_.reset();
    referenceName_.clear();
    forgetErrors();
}

void Comparison::keepReference() {
    if (!a_.picture || !b_.picture || a_.picture->samples < 2 || b_.picture->samples < 2) {
        logError("there is nothing to keep yet: both sides want two samples");
        return;
    }
    const bool aIsBetter = relativeNoise(*a_.picture->film) <= relativeNoise(*b_.picture->film);
    const Picture& better = aIsBetter ? *a_.picture : *b_.picture;
    kept_ = std::make_shared<const Bitmap>(better.film->picture());
    referenceName_ = std::string(aIsBetter ? "A" : "B") + " after " + std::to_string(better.samples) + " samples";
    reference_ = CompareReference::kept;
    forgetErrors();
}

void Comparison::readReference(EditorContext& context, const std::filesystem::path& path) {
    context.background.start("Reading " + path.filename().string(), [this, path](JobControl&) -> Background::Finish {
        auto image = std::make_shared<const Bitmap>(readImage(path));
        return [this, path, image] {
            kept_ = image;
            referenceName_ =
                path.filename().string() + ", " + std::to_string(image->width) + " x " + std::to_string(image->height);
            reference_ = CompareReference::kept;
            forgetErrors();
        };
    });
}

void Comparison::look(EditorContext& context) {
    a_.status = context.status;
    a_.picture = context.picture;
    if (!session_) return;
    b_.status = session_->status();
    b_.picture = session_->picture();
    session_->setPaused(!isOn() || context.status.phase == RenderPhase::paused);
    session_->setHeld(!context.measuring.busyWith().empty());
    if (job_) job_->collect();
    if (!isOn()) return;
    const bool counts = isQuiet(a_.status) && isQuiet(b_.status);
    for (Side* side : {&a_, &b_})
        if (side->status.divisor == 1)
            side->clock.look(side->status.samples, side->status.seconds, counts && isRendering(side->status));
    startJob();
}

void Comparison::startJob() {
    if (!a_.picture || !b_.picture) return;
    if (!job_) job_ = std::make_unique<LatestJob>(wakeWindow);
    if (jobA_ == a_.picture->number && jobB_ == b_.picture->number && jobMode_ == mode_) return;
    if (job_->isBusy()) return;  // the newest pair is taken when this one is done
    jobA_ = a_.picture->number;
    jobB_ = b_.picture->number;
    jobMode_ = mode_;
    job_->start([this, input = CompareInput{mode_, a_.picture, b_.picture, reference_, kept_}] {
        auto result = std::make_shared<CompareResult>(comparePictures(input));
        return [this, result] { adopt(std::move(*result)); };
    });
}

void Comparison::adopt(CompareResult&& result) {
    addPoint(a_, result.secondsA, result.isDenoisedA, result.errorA);
    addPoint(b_, result.secondsB, result.isDenoisedB, result.errorB);
    result_ = std::move(result);
}

void Comparison::request(EditorContext& context, const RenderRequest& ofA, bool isOther) {
    if (!isOn()) return;
    RenderRequest next = ofA;
    next.settings = effectiveSettings(ofA.settings);
    next.wantsHits = mode_ == CompareMode::firstHit;
    if (!session_)
        session_ = std::make_unique<RenderSession>(next.settings.device, next.settings.validation,
                                                   context.session.share(), wakeWindow);
    const bool sameView = requested_ && requested_->scene == next.scene && requested_->camera == next.camera &&
                          requested_->width == next.width && requested_->height == next.height;
    if (!sameView) forgetErrors();
    if (sameView && requested_->moving == next.moving && requested_->wantsHits == next.wantsHits &&
        editor::editKinds(requested_->settings, next.settings) == 0)
        return;
    requested_ = next;
    session_->submit(std::move(next), isOther);
}

void Comparison::reloadShaders() {
    if (session_) session_->reloadShaders();
}

bool Comparison::isBusy() const {
    if (!isOn()) return false;
    return !session_ || b_.status.phase == RenderPhase::preparing || b_.status.phase == RenderPhase::rendering ||
           (job_ && job_->isBusy());
}

}  // namespace raylab
