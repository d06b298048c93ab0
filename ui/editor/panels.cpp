#include "ui/editor/panels.h"

#include <array>

#include "ui/editor/inspection_panels.h"

namespace raylab {

std::span<const Panel> panelTable() {
    static constexpr std::array kPanels = {
        Panel{"Viewport", drawViewportPanel, Pane::centre},
        Panel{"Scene", drawScenePanel, Pane::left},
        Panel{"BVH", drawBvhPanel, Pane::left},
        Panel{"Counts", drawHeatPanel, Pane::left},
        Panel{"Inspector", drawInspectorPanel, Pane::right},
        Panel{"Render", drawRenderPanel, Pane::right},
        Panel{"A/B", drawComparePanel, Pane::right},
        Panel{"Log", drawLogPanel, Pane::bottom},
        Panel{"Kernel", drawKernelPanel, Pane::bottom, 220.0f},
        Panel{"Nodes", drawNodesPanel, Pane::bottom, 250.0f},
        Panel{"Ray", drawRayPanel, Pane::bottom, 250.0f},
        Panel{"Chart", drawChartPanel, Pane::bottom, 372.0f},
        Panel{"Advice", drawAdvicePanel, Pane::bottom, 220.0f},
        Panel{"Stability", drawStabilityPanel, Pane::bottom, 300.0f},
    };
    return kPanels;
}

}  // namespace raylab
