#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "ui/report/chart_job.h"

namespace raylab {

/// A chart as the interface sees it while it is measured.
struct ChartView {
    std::shared_ptr<const Chart> chart;  ///< nullptr before the first point
    uint64_t number = 0;                 ///< grows with each change of the chart
    double done = 0.0;                   ///< of all points; before the first, of the reference
    bool running = false;
    std::string error;  ///< why it ended early; empty where it did not
};

/// What the thread that measures a chart tells the interface.
class ChartFeed {
public:
    using Pictures = std::map<std::pair<size_t, uint32_t>, std::shared_ptr<const ChartPictures>>;

    ChartView view() const;
    /// By configuration and samples.
    Pictures pictures() const;

    void begin();
    void setDone(double done);
    void add(const Chart& chart, const ChartShot& shot, double done);
    /// The chart with what only its end knows.
    void end(Chart chart);
    void fail(const std::string& error);

private:
    mutable std::mutex mutex_;
    ChartView view_;
    Pictures pictures_;
};

}  // namespace raylab
