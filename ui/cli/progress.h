#pragma once

#include <cstdint>
#include <string>

#include "engine/core/stopwatch.h"

namespace raylab {

/// How far a rendering is: to standard error, a bar that is redrawn on a terminal, a line now and then elsewhere.
class Progress {
public:
    explicit Progress(bool quiet);
    ~Progress() { finish(); }
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// `noise`: estimated relative error; negative where it is not known yet.
    void show(double fraction, uint32_t samples, double noise);
    /// Ends the bar's line.
    void finish();

private:
    std::string line(double fraction, uint32_t samples, double noise) const;

    bool quiet_;
    bool terminal_;
    bool drawn_ = false;
    double nextShow_ = 0.0;
    Stopwatch watch_;
};

}  // namespace raylab
