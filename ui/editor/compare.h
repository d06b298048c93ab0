#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ui/editor/compare_job.h"
#include "ui/editor/context.h"
#include "ui/editor/latest_job.h"
#include "ui/editor/sample_clock.h"

namespace raylab {

/// A point of the chart of error against time.
struct ErrorPoint {
    double seconds = 0.0;
    double error = 0.0;
};

/// Two configurations side by side: A is the document's, B has settings of its own and all else in common with A:
/// scene, camera, size, seed. B renders in a session of its own, on a device of its own, that takes turns with A's.
/// One object in PanelStates; what panels read of it is of this frame.
class Comparison {
public:
    /// One of the two.
    struct Side {
        RenderStatus status;
        std::shared_ptr<const Picture> picture;
        SampleClock clock;
        std::optional<double> error;
        std::vector<ErrorPoint> history;
        bool isDenoised = false;  ///< what the history is of
    };

    CompareMode mode() const { return mode_; }
    bool isOn() const { return mode_ != CompareMode::off; }
    /// The first time, B's settings become a copy of A's.
    void setMode(EditorContext& context, CompareMode mode);
    /// B's settings become a copy of A's, unless they have been asked for before.
    void begin(EditorContext& context);
    /// Off, or as it was before it was off.
    void toggle(EditorContext& context);

    /// B's: what it has in common with A is A's.
    const RenderSettings& settings() const { return settings_; }
    void setSettings(const RenderSettings& settings) { settings_ = settings; }
    /// Whether B has the setting of A whatever it is.
    static bool isShared(std::string_view setting);
    void copyFromA(EditorContext& context) { settings_ = context.state.settings(); }
    void giveToA(EditorContext& context) const;
    void swap(EditorContext& context);

    CompareReference reference() const { return reference_; }
    const std::string& referenceName() const { return referenceName_; }
    void growReference();
    /// Keeps the film of the side that is less noisy now.
    void keepReference();
    /// Reads an image in the background.
    void readReference(EditorContext& context, const std::filesystem::path& path);

    /// Once a frame, before panels are drawn: takes what is new.
    void look(EditorContext& context);
    /// Once a frame, after: tells B what A was asked for.
    void request(EditorContext& context, const RenderRequest& ofA, bool isOther);
    void reloadShaders();
    /// B is preparing or rendering, or figures are on their way.
    bool isBusy() const;
    /// Messages of the validation layers about B.
    uint32_t validationMessages() const { return session_ ? session_->validationMessages() : 0; }

    const Side& side(bool b) const { return b ? b_ : a_; }
    /// The newest difference picture and figures; its mode may be another one's still.
    const CompareResult& result() const { return result_; }

    float wipe = 0.5f;  ///< where the line is, in parts of the width

private:
    RenderSettings effectiveSettings(const RenderSettings& ofA) const;
    void startJob();
    void adopt(CompareResult&& result);
    void forgetErrors();

    CompareMode mode_ = CompareMode::off;
    CompareMode lastMode_ = CompareMode::wipe;
    RenderSettings settings_;
    bool hasSettings_ = false;
    std::unique_ptr<RenderSession> session_;
    std::optional<RenderRequest> requested_;
    Side a_, b_;
    std::unique_ptr<LatestJob> job_;
    CompareResult result_;
    CompareMode jobMode_ = CompareMode::off;
    uint64_t jobA_ = 0, jobB_ = 0;  ///< pictures of the job that was started last
    CompareReference reference_ = CompareReference::growing;
    std::shared_ptr<const Bitmap> kept_;
    std::string referenceName_;
};

}  // namespace raylab
