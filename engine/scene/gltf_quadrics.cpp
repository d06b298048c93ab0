#include "engine/scene/gltf_quadrics.h"

#include <algorithm>
#include <cmath>

#include "engine/scene/gltf_extras.h"
#include "engine/scene/import_mesh.h"
#include "engine/scene/quadric.h"

namespace raylab {
namespace {

constexpr const char* kSphere = "sphere";

QuadricKind quadricKind(const JsonView& surface, const std::string& name) {
    if (name == kSphere) return QuadricKind::ellipsoid;
    const auto found = std::find(kQuadricKindNames.begin(), kQuadricKindNames.end(), name);
    if (found != kQuadricKindNames.end()) return static_cast<QuadricKind>(found - kQuadricKindNames.begin());
    std::string known = kSphere;
    for (const std::string_view kind : kQuadricKindNames) known += ", " + std::string(kind);
    surface.fail("has the kind \"" + name + "\"; there are " + known);
}

glm::vec3 radiiOf(const JsonView& surface, bool isSphere) {
    const glm::vec3 radii = isSphere ? glm::vec3(static_cast<float>(surface.number("radius", 1.0)))
                                     : surface.vec3("radii", glm::vec3(1.0f));
    for (int axis = 0; axis < 3; ++axis)
        if (!(radii[axis] >= 1.0f / kLargestSceneCoordinate && radii[axis] <= kLargestSceneCoordinate))
            surface.fail("needs positive radii (1e-18 to 1e18)");
    return radii;
}

void readClip(const JsonView& surface, Quadric& quadric) {
    const bool bounded = quadric.kind == QuadricKind::ellipsoid;
    if (!surface.has("clip") && !bounded) surface.fail("needs \"clip\": [low, high], for its kind has no end");
    const double reach = quadric.radii.z;
    const std::vector<double> clip = surface.numbers("clip", {-reach, reach});
    quadric.clipLow = static_cast<float>(clip[0]);
    quadric.clipHigh = static_cast<float>(clip[1]);
    if (std::max(std::abs(quadric.clipLow), std::abs(quadric.clipHigh)) > kLargestSceneCoordinate)
        surface.fail("has a clip plane beyond 1e18");
    if (!(quadric.clipLow < quadric.clipHigh)) surface.fail("needs a lower clip plane below the higher one");
    const Bounds left = quadricBounds(quadric);
    if (!(left.lo.z < left.hi.z)) surface.fail("has clip planes that leave nothing of it");
}

Quadric readQuadric(const JsonView& surface) {
    if (!surface.has("kind")) surface.fail("names no kind");
    const std::string kind = surface.text("kind", "");
    Quadric quadric{.kind = quadricKind(surface, kind)};
    quadric.radii = radiiOf(surface, kind == kSphere);
    readClip(surface, quadric);
    return quadric;
}

GltfQuadrics readEntry(const JsonView& entry, size_t index, size_t materialCount) {
    GltfQuadrics result;
    result.mesh.name = entry.text("name", "quadrics " + std::to_string(index));
    result.material = entry.index("material", materialCount);
    const JsonView surfaces = entry.array("surfaces");
    if (surfaces.size() == 0) entry.fail("needs at least one of \"surfaces\"");
    for (size_t s = 0; s < surfaces.size(); ++s) result.mesh.quadrics.push_back(readQuadric(surfaces.element(s)));
    return result;
}

}  // namespace

std::vector<GltfQuadrics> readGltfQuadrics(const GltfDocument& document) {
    const JsonView root = document.root();
    const size_t materialCount = root.array("materials").size();
    std::vector<GltfQuadrics> result;
    const std::optional<JsonView> extras = raylabExtras(root);
    if (!extras) return result;
    const JsonView entries = extras->array("quadrics");
    for (size_t e = 0; e < entries.size(); ++e) result.push_back(readEntry(entries.element(e), e, materialCount));
    return result;
}

std::optional<size_t> quadricsOfNode(const JsonView& node, size_t entryCount) {
    const std::optional<JsonView> extras = raylabExtras(node);
    return extras ? extras->index("quadrics", entryCount) : std::nullopt;
}

}  // namespace raylab
