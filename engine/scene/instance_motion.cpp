#include "engine/scene/instance_motion.h"

namespace raylab {
namespace {

constexpr int kSteps = 64;
constexpr double kSmallestDeterminant = 1e-3;  ///< of a matrix on the way, over the smaller one of its ends

glm::dmat3 between(const glm::mat4& start, const glm::mat4& end, double time) {
    return glm::dmat3(start) * (1.0 - time) + glm::dmat3(end) * time;
}

}  // namespace

bool moves(const Instance& instance) { return instance.endToWorld && *instance.endToWorld != instance.objectToWorld; }

glm::mat4 transformAt(const Instance& instance, float time) {
    const glm::mat4 end = instance.endToWorld.value_or(instance.objectToWorld);
    return instance.objectToWorld * (1.0f - time) + end * time;
}

bool isInvertibleBetween(const glm::mat4& start, const glm::mat4& end) {
    const double first = glm::determinant(glm::dmat3(start)), last = glm::determinant(glm::dmat3(end));
    const double sign = first < 0.0 ? -1.0 : 1.0;
    const double least = kSmallestDeterminant * glm::min(sign * first, sign * last);
    if (!(least > 0.0)) return false;
    for (int i = 1; i < kSteps; ++i)
        if (!(sign * glm::determinant(between(start, end, static_cast<double>(i) / kSteps)) > least)) return false;
    return true;
}

}  // namespace raylab
