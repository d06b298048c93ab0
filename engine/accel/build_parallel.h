#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/parallel_reduce.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <atomic>
#include <cstddef>

#include "engine/accel/build_input.h"

namespace raylab {

// None of these constants changes a result: only who computes it.
constexpr size_t kParallelPass = size_t{1} << 16;  ///< above: a pass over one node is shared between threads
constexpr size_t kSubtree = size_t{1} << 12;       ///< up to: one thread builds everything below a node
constexpr size_t kChunk = size_t{1} << 13;

// What follows runs to its end or throws. Each call has a context of its own: the cancellation of tasks around it, by
// an exception elsewhere, would leave a loop half done without a word, and whoever reads its result in ruins.

/// body(i) for each i below `count`; without tasks where that is one.
template <class Body>
void parallelFor(size_t count, const Body& body) {
    if (count == 1) return body(size_t{0});
    tbb::task_group_context context(tbb::task_group_context::isolated);
    tbb::parallel_for(size_t{0}, count, body, context);
}

template <class First, class Second>
void parallelInvoke(const First& first, const Second& second) {
    tbb::task_group_context context(tbb::task_group_context::isolated);
    tbb::parallel_invoke(first, second, context);
}

inline size_t chunkCount(size_t size) { return (size + kChunk - 1) / kChunk; }

/// body(chunk, begin, end) for each chunk of `size` items. Chunks are the same for any number of threads.
template <class Body>
void forEachChunk(size_t size, const Body& body) {
    parallelFor(chunkCount(size),
                [&](size_t chunk) { body(chunk, chunk * kChunk, std::min(size, (chunk + 1) * kChunk)); });
}

/// value.add(begin, end) over stretches of `size` items, copies of `value` joined by value.add(other): for sums that do
/// not depend on their order.
template <class Value>
Value parallelSum(size_t size, const Value& value) {
    tbb::task_group_context context(tbb::task_group_context::isolated);
    return tbb::parallel_reduce(
        tbb::blocked_range<size_t>(0, size, kChunk), value,
        [](const tbb::blocked_range<size_t>& range, Value sum) {
            sum.add(range.begin(), range.end());
            return sum;
        },
        [](Value a, const Value& b) {
            a.add(b);
            return a;
        },
        context);
}

/// What the tasks of one build share to be followed and stopped.
class BuildMonitor {
public:
    /// `total`: what the amounts add up to.
    BuildMonitor(const BuildControl& control, size_t total) : control_(control), total_(total) { check(); }

    /// Throws Cancelled where that is asked for.
    void check() const {
        if (control_.cancel && control_.cancel->load(std::memory_order_relaxed)) throw Cancelled();
    }
    void advance(size_t amount) {
        if (!control_.progress) return;
        const size_t before = done_.fetch_add(amount, std::memory_order_relaxed);
        const size_t step = stepAt(before + amount);
        if (step > stepAt(before) && step < kSteps)
            control_.progress(static_cast<float>(step) / static_cast<float>(kSteps));
    }

private:
    static constexpr size_t kSteps = 64;
    size_t stepAt(size_t done) const { return done * kSteps / total_; }

    const BuildControl& control_;
    size_t total_;
    std::atomic<size_t> done_{0};
};

}  // namespace raylab
