#include "ui/cli/bvh_report_output.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace raylab {
namespace {

constexpr double kBarLength = 50.0;

template <class T>
nlohmann::ordered_json orNull(const std::optional<T>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

/// A row of a histogram's text for each value from the first that occurs on.
std::string histogramText(const char* title, const std::vector<uint32_t>& counts) {
    const auto first = std::ranges::find_if(counts, [](uint32_t count) { return count > 0; });
    if (first == counts.end()) return "";
    const double most = *std::ranges::max_element(counts);
    std::ostringstream text;
    text << "  " << title << "\n";
    for (auto count = first; count != counts.end(); ++count)
        text << "    " << std::setw(3) << count - counts.begin() << std::setw(11) << *count << "  "
             << std::string(static_cast<size_t>(std::ceil(kBarLength * *count / most)), '#') << "\n";
    return text.str();
}

}  // namespace

nlohmann::ordered_json bvhReportJson(const BvhReport& report) {
    return {{"builder", report.builder},
            {"layout", report.layout},
            {"triangle", report.triangle},
            {"sah", report.sah},
            {"epo", orNull(report.epo)},
            {"siblingOverlap", report.largest.siblingOverlap},
            {"depth", report.depth},
            {"nodes", report.nodes},
            {"flatNodes", report.flatNodes},
            {"leaves", report.largest.leaves},
            {"meanLeafSize", report.largest.meanLeafSize},
            {"depthHistogram", report.largest.depthHistogram},
            {"leafSizeHistogram", report.largest.leafSizeHistogram},
            {"trees", report.trees},
            {"buildMs", report.buildMs},
            {"flattenMs", orNull(report.flattenMs)},
            {"bytes", report.bytes()},
            {"memoryBytes",
             {{"nodes", report.nodeBytes}, {"triangles", report.triangleBytes}, {"instances", report.instanceBytes}}},
            {"duplicateTriangles", report.duplicates},
            {"skippedTriangles", report.skipped}};
}

std::string bvhReportLine(const BvhReport& report) {
    std::ostringstream text;
    text << std::fixed << std::setprecision(1) << "  BVH         " << report.builder << ", " << report.layout << ", "
         << report.trees << (report.trees == 1 ? " tree, " : " trees, ") << report.nodes << " nodes, depth "
         << report.depth << ", SAH " << report.sah << ", built in " << report.buildMs << " ms";
    if (report.duplicates > 0) text << ", " << report.duplicates << " triangles listed again";
    if (report.skipped > 0) text << ", " << report.skipped << " degenerate triangles left out";
    return text.str();
}

std::string bvhReportText(const BvhReport& report) {
    const auto mebibytes = [](size_t bytes) { return static_cast<double>(bytes) / (1 << 20); };
    std::ostringstream text;
    text << std::fixed << std::setprecision(1) << "  BVH memory  " << mebibytes(report.nodeBytes) << " MiB nodes + "
         << mebibytes(report.triangleBytes) << " MiB triangles + " << mebibytes(report.instanceBytes)
         << " MiB instances; " << report.flatNodes << " nodes of the layout\n";
    text << "\nThe tree with the most triangles\n";
    text << std::setprecision(3) << "  SAH " << report.largest.sah;
    if (report.epo) text << ", EPO " << *report.epo;
    text << ", sibling overlap " << report.largest.siblingOverlap << ", " << report.largest.leaves << " leaves of "
         << std::setprecision(2) << report.largest.meanLeafSize << " triangles on average";
    if (report.flattenMs) text << std::setprecision(1) << ", flattened in " << *report.flattenMs << " ms";
    text << "\n"
         << histogramText("leaves by size", report.largest.leafSizeHistogram)
         << histogramText("leaves by depth", report.largest.depthHistogram);
    return text.str();
}

}  // namespace raylab
