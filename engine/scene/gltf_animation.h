#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <vector>

#include "engine/scene/gltf_document.h"

namespace raylab {

/// A node's transform as glTF has it: translation x rotation x scale.
struct NodePose {
    glm::dvec3 translation{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 scale{1.0};

    glm::dmat4 matrix() const;
};

/// Moments of a file's animation between which light is let in, in seconds.
struct Shutter {
    double open = 0.0;
    double close = 0.0;
};

/// `extras.raylab.shutter` of the shown scene or of the file, [open, close]; nothing: the file is taken as it stands,
/// without its animation. Throws Error where close is before open.
std::optional<Shutter> readShutter(const GltfDocument& document);

/// One channel of an animation: keys of a part of a node's pose (glTF 2.0, section 3.11).
struct AnimationChannel {
    enum class Path { translation, rotation, scale };
    enum class Interpolation { linear, step, cubicSpline };
    size_t node = 0;
    Path path = Path::translation;
    Interpolation interpolation = Interpolation::linear;
    std::vector<float> times;   ///< seconds, growing
    std::vector<float> values;  ///< three or four a key; cubic splines: in-tangent, value, out-tangent
};

/// Channels of the first animation that move nodes. Throws Error, with the place, for what does not fit together.
std::vector<AnimationChannel> readAnimation(const GltfDocument& document);

/// Puts the part of the pose in place that the channel says at that moment, before its first key and behind its last
/// one what these say. Rotations go the short way round, at even speed between linear keys.
void applyChannel(const AnimationChannel& channel, double seconds, NodePose& pose);

}  // namespace raylab
