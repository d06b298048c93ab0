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
/// as the user names it. `report` gets all of it piece by piece; what it holds is not done again, so that a search goes
/// on after a loss of the device. False where the watch says stop. Throws Error as advise() does.
bool runAdvice(Device& device, const std::string& sceneName, const Scene& scene, const RenderSettings& base,
               const AdviceGoal& goal, double referenceError, const AdviceWatch& watch, AdviceReport& report);

}  // namespace raylab
