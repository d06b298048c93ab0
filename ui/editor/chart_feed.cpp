#include "ui/editor/chart_feed.h"

namespace raylab {

ChartView ChartFeed::view() const {
    const std::lock_guard lock(mutex_);
    return view_;
}

ChartFeed::Pictures ChartFeed::pictures() const {
    const std::lock_guard lock(mutex_);
    return pictures_;
}

void ChartFeed::begin() {
    const std::lock_guard lock(mutex_);
    view_ = {.number = view_.number + 1, .running = true};
    pictures_.clear();
}

void ChartFeed::setDone(double done) {
    const std::lock_guard lock(mutex_);
    view_.done = done;
}

void ChartFeed::add(const Chart& chart, const ChartShot& shot, double done) {
    auto copy = std::make_shared<const Chart>(chart);
    std::shared_ptr<const ChartPictures> pictures;
    if (shot.repeat == 0) pictures = std::make_shared<const ChartPictures>(makePictures(chart, shot));
    const std::lock_guard lock(mutex_);
    view_.chart = std::move(copy);
    view_.done = done;
    ++view_.number;
    if (pictures != nullptr) pictures_[{shot.config, samplesOfLevel(shot.level)}] = std::move(pictures);
}

void ChartFeed::end(Chart chart) {
    auto last = std::make_shared<const Chart>(std::move(chart));
    const std::lock_guard lock(mutex_);
    view_.chart = std::move(last);
    view_.running = false;
    ++view_.number;
}

void ChartFeed::fail(const std::string& error) {
    const std::lock_guard lock(mutex_);
    view_.error = error;
    view_.running = false;
    ++view_.number;
}

}  // namespace raylab
