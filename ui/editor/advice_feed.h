#pragma once

#include <memory>
#include <mutex>
#include <string>

#include "ui/editor/context.h"
#include "ui/report/advise_job.h"

namespace raylab {

/// What the thread that searches for the cheapest settings tells the interface.
class AdviceFeed {
public:
    struct View {
        bool running = false;
        std::string doing;  ///< what is tried now
        std::string error;
        std::shared_ptr<const AdviceReport> report;  ///< of the last search that came to its end
    };

    View view() const;
    void begin();
    void setDoing(const std::string& what);
    void end(std::shared_ptr<const AdviceReport> report);
    void fail(const std::string& error);

private:
    mutable std::mutex mutex_;
    View view_;
};

/// As raylab advise on the scene as it is seen, for a relative error or, where that is 0, for a time in seconds; in
/// pictures of so many pixels a row. The viewport waits meanwhile.
void startAdvice(EditorContext& context, const AdviceGoal& goal, int width, const std::shared_ptr<AdviceFeed>& feed);

/// The settings that the search chose, over those of the document.
void adoptAdvice(EditorContext& context, const AdviceReport& report);

/// Writes them for --preset, in the background.
void saveAdvice(EditorContext& context, const std::shared_ptr<const AdviceReport>& report, const std::string& file);

}  // namespace raylab
