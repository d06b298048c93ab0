#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/stopwatch.h"
#include "engine/measure/path_counts.h"
#include "ui/editor/context.h"
#include "ui/editor/model/color_map.h"

namespace raylab {

constexpr uint32_t kNoCount = 0xffffffffu;  ///< of a pixel whose path has ended before

/// Counters of the paths of a view.
struct ViewCounts {
    std::vector<BounceCounts> bounces;
    uint32_t width = 0, height = 0;
    Camera camera;
    std::shared_ptr<const Scene> scene;
    RenderSettings settings;
    std::string traversal;  ///< that was counted, for people
};

/// What one wants to count.
struct CountWish {
    std::shared_ptr<const Scene> scene;
    RenderSettings settings;
    Camera camera;
    uint32_t width = 0, height = 0;
    int bounces = 0;
};

/// Counts in a thread and on a device of its own, beside the rendering.
class ViewCounter {
public:
    ViewCounter();
    ~ViewCounter();
    ViewCounter(const ViewCounter&) = delete;
    ViewCounter& operator=(const ViewCounter&) = delete;

    /// Starts unless it counts already.
    void start(const CountWish& wish);
    /// Takes what has been counted.
    void collect() { background_.collect(); }
    bool isBusy() const { return isBusy_; }
    /// Nothing of the last ones: none were made yet, or error() says why there are none.
    std::shared_ptr<const ViewCounts> counts() const { return counts_; }
    const std::string& error() const { return error_; }
    /// Of what has been asked for last; nothing before the first.
    const std::optional<CountWish>& wish() const { return wish_; }
    uint32_t validationMessages() const { return validationMessages_; }

private:
    struct Machine;  ///< device and prepared scene, which the thread keeps

    std::optional<CountWish> wish_;
    std::shared_ptr<const ViewCounts> counts_;
    std::string error_;
    bool isBusy_ = false;
    uint32_t validationMessages_ = 0;
    std::shared_ptr<std::atomic<bool>> cancel_;
    std::shared_ptr<Machine> machine_;
    Background background_;
};

/// What the panel and the viewport share.
struct HeatState {
    ViewCounter counter;
    bool show = false;
    size_t field = 2;  ///< of kCountFields
    size_t bounce = 0;
    int bounces = 2;       ///< counted after the primary rays
    uint32_t divisor = 2;  ///< of the picture's width and height
    editor::ColorMap map = editor::ColorMap::heat;
    bool autoRange = true;
    uint32_t lo = 0, hi = 1;  ///< of the colours
    Stopwatch sinceChange;    ///< of view or scene
    std::optional<Camera> lastCamera;

    // Of the counts, field and bounce that are shown.
    std::shared_ptr<const ViewCounts> shown;
    size_t shownField = 0, shownBounce = 0;
    std::vector<uint32_t> values;  ///< a pixel each; kNoCount: no ray
    CountSummary summary;
    std::vector<uint32_t> histogram;  ///< [i]: rays with a count of i * binSize .. (i + 1) * binSize - 1
    uint32_t binSize = 1;
    UiImagePtr image;
    std::optional<editor::ColorMap> imageMap;  ///< that the image is in; nothing: it is to be made
    uint32_t imageLo = 0, imageHi = 0;
};

/// Counts anew where the view rests on something else, and colours what is shown; once a frame, nothing is waited for.
void keepHeatMap(EditorContext& context);

/// Draws the map over the viewport's picture; nothing while it is one of another view.
void drawHeatMap(EditorContext& context);
/// Its scale with the count under the pointer, over all else.
void drawHeatScale(EditorContext& context);

}  // namespace raylab
