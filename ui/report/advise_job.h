#pragma once

#include <functional>

#include "ui/report/advise_output.h"

namespace raylab {

/// Who looks on, from the thread that measures.
struct AdviceWatch {
    std::function<bool()> stop;                               ///< asked between dispatches
    std::function<void(double done)> onReference;             ///< the part of the reference that is rendered
    std::function<void(const std::string& what)> onProgress;  ///< what is tried
};

/// The reference (`referenceError` 0: half of the goal's error), the search, and what the scene does not need. `scene`
/// as the user names it. Nothing where the watch says stop. Throws Error as advise() does.
std::optional<AdviceReport> runAdvice(Device& device, const std::string& sceneName, const Scene& scene,
                                      const RenderSettings& base, const AdviceGoal& goal, double referenceError,
                                      const AdviceWatch& watch);

}  // namespace raylab
