#include "engine/scene/gltf_animation.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "engine/scene/gltf_accessor.h"
#include "engine/scene/gltf_extras.h"

namespace raylab {
namespace {

using Path = AnimationChannel::Path;
using Interpolation = AnimationChannel::Interpolation;

size_t components(Path path) { return path == Path::rotation ? 4 : 3; }

Interpolation interpolationOf(const JsonView& sampler) {
    const std::string name = sampler.text("interpolation", "LINEAR");
    if (name == "LINEAR") return Interpolation::linear;
    if (name == "STEP") return Interpolation::step;
    if (name == "CUBICSPLINE") return Interpolation::cubicSpline;
    sampler.fail("has the interpolation \"" + name + "\"; glTF knows LINEAR, STEP and CUBICSPLINE");
}

/// Nothing where the path is none of a node's pose: weights of morph targets.
std::optional<Path> pathOf(const JsonView& target) {
    const std::string name = target.text("path", "");
    if (name == "translation") return Path::translation;
    if (name == "rotation") return Path::rotation;
    if (name == "scale") return Path::scale;
    if (name != "weights") target.fail("has the path \"" + name + "\"");
    return std::nullopt;
}

void readKeys(const GltfDocument& document, const JsonView& sampler, AnimationChannel& channel) {
    const size_t accessors = document.root().array("accessors").size();
    const auto input = sampler.index("input", accessors), output = sampler.index("output", accessors);
    if (!input || !output) sampler.fail("needs an input and an output");
    channel.interpolation = interpolationOf(sampler);
    channel.times = readFloats(document, *input);
    channel.values = readFloats(document, *output);
    const size_t each = components(channel.path) * (channel.interpolation == Interpolation::cubicSpline ? 3 : 1);
    if (channel.times.empty() || channel.values.size() != each * channel.times.size())
        sampler.fail("has " + std::to_string(channel.times.size()) + " keys, but " +
                     std::to_string(channel.values.size()) + " numbers for them");
    if (!std::ranges::is_sorted(channel.times)) sampler.fail("has times that do not grow");
}

/// The numbers of a key: `part` 0 the value; of cubic splines -1 the tangent in and 1 the tangent out.
glm::dvec4 keyValue(const AnimationChannel& channel, size_t key, int part = 0) {
    const size_t n = components(channel.path);
    const bool isSpline = channel.interpolation == Interpolation::cubicSpline;
    const size_t first = isSpline ? (3 * key + static_cast<size_t>(1 + part)) * n : key * n;
    glm::dvec4 value(0.0);
    for (size_t i = 0; i < n; ++i) value[static_cast<int>(i)] = static_cast<double>(channel.values[first + i]);
    return value;
}

glm::dquat quaternion(glm::dvec4 xyzw) { return glm::normalize(glm::dquat(xyzw.w, xyzw.x, xyzw.y, xyzw.z)); }

glm::dvec4 numbersOf(glm::dquat q) { return {q.x, q.y, q.z, q.w}; }

/// glTF 2.0, appendix C: between keys k and k + 1, `u` of the way, `span` seconds apart.
glm::dvec4 interpolated(const AnimationChannel& channel, size_t k, double u, double span) {
    const glm::dvec4 a = keyValue(channel, k), b = keyValue(channel, k + 1);
    switch (channel.interpolation) {
        case Interpolation::step:
            return a;
        case Interpolation::cubicSpline: {
            const double u2 = u * u, u3 = u2 * u;
            return (2.0 * u3 - 3.0 * u2 + 1.0) * a + span * (u3 - 2.0 * u2 + u) * keyValue(channel, k, 1) +
                   (3.0 * u2 - 2.0 * u3) * b + span * (u3 - u2) * keyValue(channel, k + 1, -1);
        }
        case Interpolation::linear:
            break;
    }
    if (channel.path == Path::rotation) return numbersOf(glm::slerp(quaternion(a), quaternion(b), u));
    return glm::mix(a, b, u);
}

glm::dvec4 valueAt(const AnimationChannel& channel, double seconds) {
    const auto after = std::ranges::upper_bound(channel.times, static_cast<float>(seconds));
    if (after == channel.times.begin()) return keyValue(channel, 0);
    if (after == channel.times.end()) return keyValue(channel, channel.times.size() - 1);
    const auto k = static_cast<size_t>(after - channel.times.begin()) - 1;
    const double start = static_cast<double>(channel.times[k]), span = static_cast<double>(*after) - start;
    return interpolated(channel, k, std::clamp((seconds - start) / span, 0.0, 1.0), span);
}

}  // namespace

glm::dmat4 NodePose::matrix() const {
    return glm::translate(glm::dmat4(1.0), translation) * glm::mat4_cast(rotation) * glm::scale(glm::dmat4(1.0), scale);
}

std::optional<Shutter> readShutter(const GltfDocument& document) {
    const std::optional<JsonView> extras = sceneExtras(document.root());
    if (!extras || !extras->has("shutter")) return std::nullopt;
    const std::vector<double> seconds = extras->numbers("shutter", {0.0, 0.0});
    if (seconds[1] < seconds[0]) extras->fail("needs a shutter [open, close] that closes after it opens");
    return Shutter{seconds[0], seconds[1]};
}

std::vector<AnimationChannel> readAnimation(const GltfDocument& document) {
    std::vector<AnimationChannel> channels;
    const JsonView animations = document.root().array("animations");
    if (animations.size() == 0) return channels;
    const JsonView samplers = animations.element(0).array("samplers"), list = animations.element(0).array("channels");
    for (size_t c = 0; c < list.size(); ++c) {
        const JsonView target = list.element(c).object("target");
        const auto node = target.index("node", document.root().array("nodes").size());
        const auto sampler = list.element(c).index("sampler", samplers.size());
        if (!sampler) list.element(c).fail("names no sampler");
        const std::optional<Path> path = pathOf(target);
        if (!node || !path) continue;
        AnimationChannel channel{.node = *node, .path = *path, .times = {}, .values = {}};
        readKeys(document, samplers.element(*sampler), channel);
        channels.push_back(std::move(channel));
    }
    return channels;
}

void applyChannel(const AnimationChannel& channel, double seconds, NodePose& pose) {
    const glm::dvec4 value = valueAt(channel, seconds);
    switch (channel.path) {
        case Path::translation:
            pose.translation = glm::dvec3(value);
            break;
        case Path::rotation:
            pose.rotation = quaternion(value);
            break;
        case Path::scale:
            pose.scale = glm::dvec3(value);
            break;
    }
}

}  // namespace raylab
