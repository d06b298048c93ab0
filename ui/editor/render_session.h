#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "engine/gpu/shader_sources.h"
#include "ui/editor/render_request.h"
#include "ui/editor/render_turns.h"

namespace raylab {

/// What sessions that render side by side have in common.
struct RenderShare {
    std::shared_ptr<ShaderSources> shaders;
    std::shared_ptr<RenderTurns> turns = std::make_shared<RenderTurns>();
};

/// Renders what the viewport wants in a thread and on a device of its own. No call waits for work of that thread; what
/// it does with a request is in render_worker.h.
class RenderSession {
public:
    /// `wake` is called from the thread whenever there is something new to show.
    RenderSession(std::string deviceSelector, bool validation, RenderShare share, std::function<void()> wake);
    ~RenderSession();
    RenderSession(const RenderSession&) = delete;
    RenderSession& operator=(const RenderSession&) = delete;

    /// Replaces a request that has not been taken up. `isOther`: of another file, so that what is being prepared is
    /// useless.
    void submit(RenderRequest request, bool isOther);
    void setPaused(bool paused);
    /// Pauses as well, whatever setPaused() says: something else needs the machine.
    void setHeld(bool held);
    /// Prepares everything anew, with kernels of the sources as they are: F5.
    void reload();
    /// Takes up what has changed of the shaders' sources. Where one does not compile, the kernel stays.
    void reloadShaders();
    const RenderShare& share() const { return share_; }
    /// Ends what is being prepared; the picture stays as it was.
    void cancel();
    RenderStatus status() const;
    /// The newest picture; nullptr before the first.
    std::shared_ptr<const Picture> picture() const;
    /// Asks what lies behind a point of the picture, (0, 0) at its upper left and (1, 1) at its lower right, as seen by
    /// `camera`. Returns the ticket of the answer.
    uint64_t pick(const Camera& camera, double aspect, double x, double y);
    /// An answer that was not taken yet.
    std::optional<PickResult> takePick();
    uint32_t validationMessages() const { return validationMessages_; }
    /// Uploaded for the last edit that was taken up in place; 0 where the last one prepared everything anew.
    uint64_t updatedBytes() const { return updatedBytes_; }
    /// Ends the thread; nothing is rendered afterwards.
    void stop();

    // What the thread asks for. ------------------------------------------------------------------
    struct PickTask {
        uint64_t ticket = 0;
        Camera camera;
        double aspect = 1.0, x = 0.0, y = 0.0;
    };
    struct Task {
        std::optional<RenderRequest> request;
        std::optional<PickTask> pick;
        bool reload = false;
        bool reloadShaders = false;
        bool paused = false;
    };
    /// What is new, at once where `busy`, else when there is something. Nothing: the session ends.
    std::optional<Task> nextTask(bool busy);
    /// Whether a request waits that nextTask() has not given yet.
    bool hasRequest() const;
    void report(const std::function<void(RenderStatus&)>& change);
    /// A picture, and what is said with it: one frame shows both.
    void publish(std::shared_ptr<const Picture> picture, const std::function<void(RenderStatus&)>& change);
    void answer(const PickResult& result);
    void setValidationMessages(uint32_t count) { validationMessages_ = count; }
    void setUpdatedBytes(uint64_t bytes) { updatedBytes_ = bytes; }
    const std::atomic<bool>& cancelled() const { return cancel_; }

private:
    RenderShare share_;
    std::function<void()> wake_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::optional<RenderRequest> request_;
    std::optional<PickTask> pick_;
    std::optional<PickResult> picked_;
    RenderStatus status_;
    std::shared_ptr<const Picture> picture_;
    uint64_t lastTicket_ = 0;
    bool paused_ = false;
    bool held_ = false;
    bool pauseChanged_ = false;
    bool reload_ = false;
    bool reloadShaders_ = false;
    bool stop_ = false;
    std::atomic<bool> cancel_{false};
    std::atomic<uint32_t> validationMessages_{0};
    std::atomic<uint64_t> updatedBytes_{0};
    std::thread thread_;
};

}  // namespace raylab
