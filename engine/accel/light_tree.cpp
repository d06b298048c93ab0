#include "engine/accel/light_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

namespace raylab {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kBins = 12;
constexpr uint32_t kLongestTrail = 31;

double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
}

/// `v` turned about the unit axis (Rodrigues).
glm::dvec3 rotate(const glm::dvec3& v, const glm::dvec3& axis, double angle) {
    return v * std::cos(angle) + glm::cross(axis, v) * std::sin(angle) +
           axis * (glm::dot(axis, v) * (1.0 - std::cos(angle)));
}

/// M_Omega of the paper: the cone's solid angle, weighed by the cosine beyond thetaO.
double orientationMeasure(const EmissionCone& c) {
    const double widest = std::min(c.thetaO + c.thetaE, kPi);
    const double sine = std::sin(c.thetaO), cosine = std::cos(c.thetaO);
    return 2.0 * kPi * (1.0 - cosine) +
           0.5 * kPi * (2.0 * widest * sine - std::cos(c.thetaO - 2.0 * widest) - 2.0 * c.thetaO * sine + cosine);
}

/// Surface area, and the diagonal squared, lest points in a row measure nothing.
double sizeMeasure(const Aabb& box) {
    const glm::dvec3 e = glm::dvec3(box.hi) - glm::dvec3(box.lo);
    return 2.0 * (e.x * e.y + e.y * e.z + e.z * e.x) + glm::dot(e, e);
}

/// Nothing, or the union of what was added.
struct Accumulated {
    LightBound bound;
    uint32_t count = 0;

    void add(const LightBound& light) {
        bound.box.grow(light.box);
        bound.cone = count == 0 ? light.cone : uniteCones(bound.cone, light.cone);
        bound.power += light.power;
        bound.isTwoSided = bound.isTwoSided || light.isTwoSided;
        ++count;
    }
    void add(const Accumulated& other) {
        if (other.count == 0) return;
        const uint32_t sum = count + other.count;
        add(other.bound);
        count = sum;
    }
    double cost() const { return bound.power * orientationMeasure(bound.cone) * sizeMeasure(bound.box); }
};

struct Split {
    int axis = -1;
    int lastBin = 0;  ///< of the first side
    double cost = std::numeric_limits<double>::infinity();
};

class Builder {
public:
    explicit Builder(std::span<const LightBound> lights) : lights_(lights), order_(lights.size()) {
        std::iota(order_.begin(), order_.end(), 0u);
        tree_.nodes.resize(2 * (lights.size() - 1));
        tree_.trails.resize(lights.size());
    }

    LightTree build() {
        tree_.box = boundOf(order_).box;
        splitRange(order_, 0, 0, 0);
        return std::move(tree_);
    }

private:
    LightBound boundOf(std::span<const uint32_t> range) const {
        Accumulated sum;
        for (const uint32_t light : range) sum.add(lights_[light]);
        return sum.bound;
    }

    glm::dvec3 centre(uint32_t light) const {
        return 0.5 * (glm::dvec3(lights_[light].box.lo) + glm::dvec3(lights_[light].box.hi));
    }

    /// Halves, where there is no better split or the way would get too long.
    size_t splitInTheMiddle(std::span<uint32_t> range, int axis) {
        const size_t half = range.size() / 2;
        std::nth_element(range.begin(), range.begin() + static_cast<std::ptrdiff_t>(half), range.end(),
                         [&](uint32_t a, uint32_t b) {
                             const double x = centre(a)[axis], y = centre(b)[axis];
                             return x < y || (x == y && a < b);
                         });
        return half;
    }

    Split bestOnAxis(const std::array<Accumulated, kBins>& bins, int axis, double regularity) const {
        std::array<Accumulated, kBins> after;  // of bin i and all behind it
        after[kBins - 1] = bins[kBins - 1];
        for (int i = kBins - 2; i >= 0; --i) {
            after[static_cast<size_t>(i)] = bins[static_cast<size_t>(i)];
            after[static_cast<size_t>(i)].add(after[static_cast<size_t>(i) + 1]);
        }
        Split best;
        Accumulated before;
        for (int i = 0; i + 1 < kBins; ++i) {
            before.add(bins[static_cast<size_t>(i)]);
            const Accumulated& rest = after[static_cast<size_t>(i) + 1];
            if (before.count == 0 || rest.count == 0) continue;
            const double cost = regularity * (before.cost() + rest.cost());
            if (cost < best.cost) best = {axis, i, cost};
        }
        return best;
    }

    /// Index of the first light of the second side; reorders the range.
    size_t split(std::span<uint32_t> range, uint32_t depth) {
        glm::dvec3 lo(std::numeric_limits<double>::infinity()), hi(-std::numeric_limits<double>::infinity());
        for (const uint32_t light : range) {
            lo = glm::min(lo, centre(light));
            hi = glm::max(hi, centre(light));
        }
        const glm::dvec3 extent = hi - lo;
        const double longest = std::max({extent.x, extent.y, extent.z});
        const int longestAxis = extent.x == longest ? 0 : extent.y == longest ? 1 : 2;
        const auto halvings = static_cast<uint32_t>(std::bit_width(range.size() - 1));
        if (!(longest > 0.0) || depth + halvings >= kLongestTrail) return splitInTheMiddle(range, longestAxis);
        const auto binOf = [&](uint32_t light, int axis) {
            return std::min(static_cast<int>((centre(light)[axis] - lo[axis]) / extent[axis] * kBins), kBins - 1);
        };
        Split best;
        for (int axis = 0; axis < 3; ++axis) {
            if (!(extent[axis] > 0.0)) continue;
            std::array<Accumulated, kBins> bins;
            for (const uint32_t light : range) bins[static_cast<size_t>(binOf(light, axis))].add(lights_[light]);
            const Split found = bestOnAxis(bins, axis, longest / extent[axis]);
            if (found.cost < best.cost) best = found;
        }
        if (best.axis < 0) return splitInTheMiddle(range, longestAxis);
        const auto middle = std::partition(range.begin(), range.end(),
                                           [&](uint32_t light) { return binOf(light, best.axis) <= best.lastBin; });
        return static_cast<size_t>(middle - range.begin());
    }

    void placeChild(std::span<uint32_t> range, uint32_t node, uint32_t trail, uint32_t depth) {
        if (range.size() == 1) {
            tree_.nodes[node] = {lights_[range[0]], range[0], true};
            tree_.trails[range[0]] = trail | 1u << depth;
            return;
        }
        const uint32_t pair = ++lastPair_;
        tree_.nodes[node] = {boundOf(range), pair, false};
        splitRange(range, pair, trail, depth);
    }

    void splitRange(std::span<uint32_t> range, uint32_t pair, uint32_t trail, uint32_t depth) {
        const size_t middle = split(range, depth);
        placeChild(range.first(middle), 2 * pair, trail, depth + 1);
        placeChild(range.subspan(middle), 2 * pair + 1, trail | 1u << depth, depth + 1);
    }

    std::span<const LightBound> lights_;
    std::vector<uint32_t> order_;
    LightTree tree_;
    uint32_t lastPair_ = 0;
};

}  // namespace

EmissionCone uniteCones(EmissionCone a, EmissionCone b) {
    if (b.thetaO > a.thetaO) std::swap(a, b);
    const double thetaE = std::max(a.thetaE, b.thetaE);
    const double between = angleBetween(a.axis, b.axis);
    if (std::min(between + b.thetaO, kPi) <= a.thetaO) return {a.axis, a.thetaO, thetaE};
    const double thetaO = 0.5 * (a.thetaO + between + b.thetaO);
    const glm::dvec3 pivot = glm::cross(a.axis, b.axis);
    const double length = glm::length(pivot);
    if (thetaO >= kPi || length == 0.0) return {a.axis, kPi, thetaE};
    return {glm::normalize(rotate(a.axis, pivot / length, thetaO - a.thetaO)), thetaO, thetaE};
}

LightTree buildLightTree(std::span<const LightBound> lights) {
    assert(lights.size() >= 2);
    return Builder(lights).build();
}

}  // namespace raylab
