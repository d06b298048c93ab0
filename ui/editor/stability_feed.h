#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "engine/measure/stability/battery.h"
#include "ui/editor/context.h"

namespace raylab {

/// What the Stability panel asks for.
struct StabilityOrder {
    std::vector<std::string> ids;  ///< of cases; none: all
    std::string configs = "default";
    bool quick = true;
};

/// What the thread that runs the battery tells the interface.
class StabilityFeed {
public:
    using Rows = std::vector<std::shared_ptr<const stability::Row>>;

    struct View {
        Rows rows;
        bool running = false;
        bool complete = false;  ///< the plan was run to its end
        std::string error;      ///< why it was not, beside being stopped
    };

    View view() const;
    void begin();
    void add(std::span<const stability::Row> rows);
    void end(bool complete);
    void fail(const std::string& error);

private:
    mutable std::mutex mutex_;
    View view_;
};

/// Runs the cases on a device of their own; the viewport waits meanwhile.
void startStability(EditorContext& context, const StabilityOrder& order, const std::shared_ptr<StabilityFeed>& feed);

}  // namespace raylab
