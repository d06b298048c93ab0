#include <algorithm>
#include <numeric>
#include <tuple>

#include "engine/measure/hit_oracle_surface.h"

namespace raylab::oracle {
namespace {

struct Edge {
    glm::dvec3 a;
    glm::dvec3 b;  ///< behind `a` in lexicographic order
    double distance;
    size_t triangle;
};

auto keyOf(const glm::dvec3& p) { return std::tie(p.x, p.y, p.z); }

auto keyOf(const Edge& edge) { return std::tuple_cat(keyOf(edge.a), keyOf(edge.b)); }

std::vector<Edge> sortedEdges(const std::vector<const Candidate*>& triangles) {
    std::vector<Edge> edges;
    for (size_t i = 0; i < triangles.size(); ++i)
        for (size_t corner = 0; corner < 3; ++corner) {
            const glm::dvec3& a = triangles[i]->corners[corner];
            const glm::dvec3& b = triangles[i]->corners[(corner + 1) % 3];
            const bool ordered = keyOf(a) < keyOf(b);
            edges.push_back({ordered ? a : b, ordered ? b : a, triangles[i]->edgeDistance[corner], i});
        }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return keyOf(a) < keyOf(b); });
    return edges;
}

/// Calls `visit(first, last)` for each run of equal edges.
template <class Visit>
void forEachEdge(const std::vector<Edge>& edges, const Visit& visit) {
    for (size_t first = 0, last; first < edges.size(); first = last) {
        for (last = first + 1; last < edges.size() && keyOf(edges[first]) == keyOf(edges[last]);) ++last;
        visit(first, last);
    }
}

/// For each triangle the first one that it hangs together with by edges.
std::vector<size_t> groupsOf(const std::vector<Edge>& edges, size_t count) {
    std::vector<size_t> parent(count);
    std::iota(parent.begin(), parent.end(), size_t{0});
    const auto root = [&](size_t i) {
        while (parent[i] != i) i = parent[i];
        return i;
    };
    forEachEdge(edges, [&](size_t first, size_t last) {
        for (size_t i = first + 1; i < last; ++i) {
            const auto [low, high] = std::minmax({root(edges[first].triangle), root(edges[i].triangle)});
            parent[high] = low;
        }
    });
    for (size_t& entry : parent) entry = root(entry);
    return parent;
}

/// Whether a triangle covers a point across the ray.
bool contains(const Candidate& triangle, const glm::dvec2& point) {
    const auto side = [&](size_t i) {
        const glm::dvec2 a = triangle.projected[i] - point, b = triangle.projected[(i + 1) % 3] - point;
        return a.x * b.y - a.y * b.x > 0.0;
    };
    return side(0) == side(1) && side(1) == side(2);
}

double nearestEdge(const Candidate& triangle) {
    return std::min({triangle.edgeDistance[0], triangle.edgeDistance[1], triangle.edgeDistance[2]});
}

/// The largest `high` near the ray of a group that covers it; infinite where it does not.
double coverOf(const std::vector<const Candidate*>& triangles, const std::vector<size_t>& groups, size_t group,
               const std::vector<Edge>& edges) {
    double margin = 0.0;
    for (size_t i = 0; i < triangles.size(); ++i)
        if (groups[i] == group && triangles[i]->certainty != Certainty::none)
            margin = std::max(margin, triangles[i]->margin);
    if (margin == 0.0) return std::numeric_limits<double>::infinity();
    bool closed = true;
    forEachEdge(edges, [&](size_t first, size_t last) {
        if (groups[edges[first].triangle] == group && edges[first].distance <= margin)
            closed &= (last - first) % 2 == 0;
    });
    // No edge within the margin is a border, so the count is odd or even all over it: where no edge passes will do.
    const glm::dvec2 aside = margin * glm::dvec2(0.3719, 0.2083);
    bool odd = false;
    double high = 0.0;
    for (size_t i = 0; i < triangles.size(); ++i) {
        if (groups[i] != group) continue;
        odd ^= contains(*triangles[i], aside);
        const bool near = triangles[i]->certainty != Certainty::none || nearestEdge(*triangles[i]) <= margin;
        if (near) high = std::max(high, triangles[i]->high);
    }
    return closed && odd ? high : std::numeric_limits<double>::infinity();
}

}  // namespace

double coveredBy(const std::vector<Candidate>& candidates) {
    double nearest = std::numeric_limits<double>::infinity();
    if (candidates.size() < 2) return nearest;
    std::vector<const Candidate*> triangles;
    for (const Candidate& candidate : candidates)
        if (candidate.covers) triangles.push_back(&candidate);
    const std::vector<Edge> edges = sortedEdges(triangles);
    const std::vector<size_t> groups = groupsOf(edges, triangles.size());
    for (size_t i = 0; i < groups.size(); ++i)
        if (groups[i] == i) nearest = std::min(nearest, coverOf(triangles, groups, i, edges));
    return nearest;
}

}  // namespace raylab::oracle
