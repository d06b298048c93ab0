#include <cmath>
#include <glm/gtc/constants.hpp>

#include "assets/generate/noise.h"
#include "assets/generate/statue_parts.h"

namespace raylab::assets {
namespace {

constexpr float kTau = glm::two_pi<float>();

/// Polynomial smooth minimum; `k` is the width of the blend.
float blend(float a, float b, float k) {
    const float h = glm::max(k - std::abs(a - b), 0.0f) / k;
    return glm::min(a, b) - 0.25f * h * h * k;
}

float roundCone(glm::vec3 p, glm::vec3 a, glm::vec3 b, float ra, float rb) {
    const glm::vec3 ab = b - a;
    const float t = glm::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0f, 1.0f);
    return glm::distance(p, a + t * ab) - glm::mix(ra, rb, t);
}

/// First-order distance to an ellipsoid.
float ellipsoid(glm::vec3 p, glm::vec3 centre, glm::vec3 radii) {
    const glm::vec3 q = (p - centre) / radii;
    const float length = glm::length(q);
    const float slope = glm::length(q / radii);
    return slope > 1e-6f ? length * (length - 1.0f) / slope : -glm::min(radii.x, glm::min(radii.y, radii.z));
}

/// Cross-section of gathered cloth along `phase`, one fold a unit: broad round ridges between narrow valleys, in [0,
/// 1]. Each fold has its own depth; `period` folds close a ring.
float folds(float phase, float period, uint32_t seed) {
    const float number = std::floor(phase);
    const float s = phase - number;
    const float ridge = std::pow(std::abs(std::sin(glm::pi<float>() * s)), 0.75f);
    const auto id = static_cast<uint32_t>(glm::mod(number, period));
    return ridge * (0.35f + 0.65f * hash01(id, 7, seed));
}

std::vector<glm::vec3> bezier(glm::vec3 a, glm::vec3 b, glm::vec3 c, int steps) {
    std::vector<glm::vec3> points;
    for (int i = 0; i <= steps; ++i) {
        const float t = static_cast<float>(i) / static_cast<float>(steps);
        points.push_back(glm::mix(glm::mix(a, b, t), glm::mix(b, c, t), t));
    }
    return points;
}

glm::vec3 turnedY(glm::vec3 p, float degrees) {
    const float c = std::cos(glm::radians(degrees));
    const float s = std::sin(glm::radians(degrees));
    return {c * p.x - s * p.z, p.y, s * p.x + c * p.z};
}

}  // namespace

Figure::Figure() : bone_(wingBone(1.0f)) {
    // Rolls of cloth that the wind presses against and between the legs: from the right hip, fanning down to the left.
    const auto strand = [&](glm::vec3 a, glm::vec3 b, glm::vec3 c, float from, float to) {
        strands_.push_back({bezier(a, b, c, 7), from, to});
    };
    strand({-0.02f, 0.88f, 0.13f}, {0.02f, 0.55f, 0.20f}, {0.03f, 0.06f, 0.16f}, 0.010f, 0.030f);
    strand({0.02f, 0.90f, 0.13f}, {0.07f, 0.55f, 0.15f}, {0.10f, 0.05f, 0.10f}, 0.010f, 0.034f);
    strand({0.06f, 0.92f, 0.12f}, {0.13f, 0.55f, 0.10f}, {0.20f, 0.04f, 0.02f}, 0.008f, 0.030f);
    strand({0.11f, 0.92f, 0.09f}, {0.20f, 0.55f, 0.03f}, {0.29f, 0.05f, -0.10f}, 0.008f, 0.030f);
    strand({0.15f, 0.92f, 0.05f}, {0.25f, 0.55f, -0.06f}, {0.36f, 0.06f, -0.26f}, 0.008f, 0.028f);
    strand({-0.14f, 0.90f, 0.06f}, {-0.21f, 0.55f, 0.02f}, {-0.25f, 0.05f, -0.08f}, 0.008f, 0.030f);
    strand({-0.16f, 0.90f, 0.00f}, {-0.24f, 0.55f, -0.08f}, {-0.31f, 0.05f, -0.26f}, 0.008f, 0.032f);
    strand({-0.13f, 0.88f, 0.10f}, {-0.19f, 0.50f, 0.13f}, {-0.20f, 0.05f, 0.05f}, 0.006f, 0.022f);
    mantlePath_ = catmullRom<glm::vec3>({{-0.19f, 0.99f, -0.06f},
                                         {-0.165f, 0.985f, 0.07f},
                                         {-0.08f, 0.955f, 0.145f},
                                         {0.02f, 0.925f, 0.15f},
                                         {0.12f, 0.90f, 0.115f},
                                         {0.19f, 0.885f, 0.02f},
                                         {0.225f, 0.85f, -0.12f},
                                         {0.245f, 0.79f, -0.26f},
                                         {0.28f, 0.73f, -0.39f},
                                         {0.345f, 0.685f, -0.52f},
                                         {0.40f, 0.67f, -0.66f},
                                         {0.42f, 0.70f, -0.81f}},
                                        3);
}

float Figure::legs(glm::vec3 p) const {
    const glm::vec3 kneeR(-0.105f, 0.51f, 0.175f);
    const glm::vec3 ankleR(-0.10f, 0.09f, 0.10f);
    const glm::vec3 kneeL(0.125f, 0.50f, -0.05f);
    const glm::vec3 ankleL(0.165f, 0.14f, -0.33f);
    float d = roundCone(p, {-0.095f, 0.92f, 0.01f}, kneeR, 0.098f, 0.062f);
    d = blend(d, roundCone(p, kneeR, ankleR, 0.060f, 0.036f), 0.03f);
    d = blend(d, ellipsoid(p, {-0.102f, 0.36f, 0.115f}, {0.052f, 0.13f, 0.058f}), 0.03f);
    float left = roundCone(p, {0.095f, 0.92f, -0.01f}, kneeL, 0.098f, 0.062f);
    left = blend(left, roundCone(p, kneeL, ankleL, 0.060f, 0.036f), 0.03f);
    d = blend(d, left, 0.03f);
    const float footR = blend(roundCone(p, {-0.10f, 0.045f, 0.08f}, {-0.105f, 0.022f, 0.245f}, 0.040f, 0.024f),
                              ellipsoid(p, {-0.105f, 0.02f, 0.25f}, {0.042f, 0.02f, 0.045f}), 0.03f);
    return blend(d, footR, 0.03f);
}

float Figure::torso(glm::vec3 p) const {
    const glm::vec3 q = turnedY(p - glm::vec3(0.0f, 0.0f, 0.02f), 9.0f * glm::smoothstep(0.95f, 1.35f, p.y));
    const glm::vec3 mirrored(std::abs(q.x), q.y, q.z);
    float d = ellipsoid(q, {0.0f, 0.965f, -0.012f}, {0.168f, 0.135f, 0.118f});
    d = blend(d, ellipsoid(mirrored, {0.072f, 0.93f, -0.075f}, {0.085f, 0.095f, 0.075f}), 0.06f);
    d = blend(d, ellipsoid(q, {0.0f, 1.09f, 0.012f}, {0.120f, 0.16f, 0.090f}), 0.09f);
    d = blend(d, ellipsoid(q, {0.0f, 1.275f, 0.015f}, {0.142f, 0.175f, 0.098f}), 0.07f);
    d = blend(d, ellipsoid(mirrored, {0.072f, 1.288f, 0.088f}, {0.060f, 0.062f, 0.058f}), 0.035f);
    d = blend(d, roundCone(mirrored, {0.03f, 1.435f, -0.005f}, {0.165f, 1.405f, 0.0f}, 0.050f, 0.058f), 0.06f);
    d = blend(d, roundCone(q, {0.0f, 1.43f, 0.0f}, {0.006f, 1.56f, 0.028f}, 0.058f, 0.050f), 0.05f);
    // Arms broken off below the shoulder, neck above the collar: cut by rough, slanted planes.
    const float roughness = 0.006f * noise3(38.0f * p, 603);
    float arms = roundCone(mirrored, {0.175f, 1.40f, 0.0f}, {0.255f, 1.27f, -0.045f}, 0.055f, 0.043f);
    arms = glm::max(
        arms, glm::dot(mirrored - glm::vec3(0.225f, 1.315f, -0.02f), glm::vec3(0.55f, -0.80f, -0.22f)) + roughness);
    d = blend(d, arms, 0.03f);
    const float neckCut =
        glm::dot(q - glm::vec3(0.0f, 1.535f, 0.02f), glm::normalize(glm::vec3(0.15f, 1.0f, 0.25f))) + roughness;
    return glm::max(d, neckCut);
}

float Figure::skirt(glm::vec3 p, float toLegs) const {
    const float t = glm::clamp((1.0f - p.y) / 1.0f, 0.0f, 1.15f);
    const glm::vec2 centre(0.02f * t, -0.025f - 0.20f * std::pow(t, 1.3f));
    const glm::vec2 radii(0.158f + 0.15f * t, 0.115f + 0.26f * std::pow(t, 1.25f));
    const glm::vec2 q = (glm::vec2(p.x, p.z) - centre) / radii;
    const float length = glm::length(q);
    const float d =
        (length - 1.0f) * glm::mix(glm::min(radii.x, radii.y), glm::length(radii * q) / glm::max(length, 0.05f), 0.7f);
    if (d > 0.16f) return d - 0.07f;
    // The ring of folds widens towards the hem; noise makes them wander, part and meet.
    constexpr float kFolds = 21.0f;
    const float wander = 0.75f * noise3(glm::vec3(3.4f * p.x, 1.5f * p.y, 3.4f * p.z), 605);
    const float phase = kFolds * std::atan2(p.x - centre.x, p.z - centre.y) / kTau + wander;
    const float fine = folds(2.0f * phase + noise3(6.0f * p, 607), 2.0f * kFolds, 609);
    const float depth = 0.075f * glm::smoothstep(0.02f, 0.75f, t) * glm::smoothstep(0.0f, 0.09f, toLegs + 0.03f);
    const float ripple = depth * (folds(phase, kFolds, 611) - 0.45f) + (0.004f + 0.14f * depth) * (fine - 0.4f);
    return glm::max(d - ripple, p.y - 0.99f);
}

float Figure::strands(glm::vec3 p) const {
    float d = 1.0f;
    for (const Strand& strand : strands_) {
        const auto last = static_cast<float>(strand.path.size() - 1);
        for (size_t i = 0; i + 1 < strand.path.size(); ++i) {
            const float from = glm::mix(strand.fromRadius, strand.toRadius, static_cast<float>(i) / last);
            const float to = glm::mix(strand.fromRadius, strand.toRadius, static_cast<float>(i + 1) / last);
            d = glm::min(d, roundCone(p, strand.path[i], strand.path[i + 1], from, to));
        }
    }
    return d;
}

float Figure::mantle(glm::vec3 p) const {
    // Nearest point of the path; the cloth is a rope about the hips that opens into a streaming band behind.
    float best = 1e9f;
    float along = 0.0f;
    glm::vec3 foot(0.0f);
    glm::vec3 tangent(1.0f, 0.0f, 0.0f);
    for (size_t i = 0; i + 1 < mantlePath_.size(); ++i) {
        const glm::vec3 ab = mantlePath_[i + 1] - mantlePath_[i];
        const float t = glm::clamp(glm::dot(p - mantlePath_[i], ab) / glm::dot(ab, ab), 0.0f, 1.0f);
        const glm::vec3 at = mantlePath_[i] + t * ab;
        const glm::vec3 toPoint = p - at;
        if (glm::dot(toPoint, toPoint) < best) {
            best = glm::dot(toPoint, toPoint);
            along = (static_cast<float>(i) + t) / static_cast<float>(mantlePath_.size() - 1);
            foot = at;
            tangent = glm::normalize(ab);
        }
    }
    if (best > 0.16f) return std::sqrt(best) - 0.33f;
    const float open = glm::smoothstep(0.42f, 0.95f, along);
    const glm::vec3 offset = p - foot;
    const glm::vec3 across = glm::normalize(glm::vec3(-tangent.z, 0.0f, tangent.x));
    const float up = offset.y + 0.11f * open;
    const float wave = 0.032f * open * std::sin(16.0f * up + 6.0f * along);
    const glm::vec2 half(glm::mix(0.036f, 0.20f + 0.03f * std::sin(21.0f * along), open),
                         glm::mix(0.036f, 0.024f, open));
    const glm::vec2 q(up, glm::dot(offset, across) + wave);
    const float rolls = glm::mix(0.008f * std::sin(5.0f * std::atan2(q.x, q.y) + 30.0f * along),
                                 0.008f * std::sin(46.0f * up - 12.0f * along), open);
    const glm::vec2 outside = glm::max(glm::abs(q) - half + half.y, 0.0f);
    const float section = glm::length(outside) - half.y - rolls;
    const float beyondEnd = std::abs(glm::dot(offset, tangent)) - 0.01f;
    return glm::length(glm::max(glm::vec2(section, beyondEnd), 0.0f)) + glm::min(glm::max(section, beyondEnd), 0.0f);
}

float Figure::rock(glm::vec3 p) const {
    const float lumps =
        0.045f * noise3(4.5f * p, 615) + 0.018f * noise3(13.0f * p, 617) + 0.006f * noise3(40.0f * p, 619);
    const float d = ellipsoid(p, {0.02f, -0.13f, -0.08f}, {0.46f, 0.125f, 0.46f});
    return d - lumps;
}

float Figure::clothedTorso(glm::vec3 p) const {
    // Thin cloth clings to the body: fine folds that run down from the shoulders and draw together under the breasts.
    const float bare = torso(p);
    if (bare > 0.08f) return bare - 0.02f;
    const float spread = 1.0f + 1.3f * std::abs(p.y - 1.17f);
    const float wander = 1.6f * noise3(glm::vec3(4.0f, 2.2f, 4.0f) * p, 621);
    const float phase = 38.0f * p.x / spread + wander + 9.0f * std::abs(p.z);
    const float neckline = p.y - 1.365f - 0.42f * std::abs(p.x);
    const float clothed = 1.0f - glm::smoothstep(0.0f, 0.02f, neckline);
    const float fine = folds(2.3f * phase + noise3(7.0f * p, 629), 128.0f, 631);
    const float hemRoll = 0.005f * std::exp(-neckline * neckline / 0.0001f);
    const float cling = clothed * (0.0090f * (folds(phase, 64.0f, 623) - 0.35f) + 0.0025f * fine) + hemRoll;
    const float belt = p.y - 1.175f - 0.02f * std::sin(9.0f * p.x);
    const float groove = 0.010f * std::exp(-belt * belt / 0.00016f);
    const float cord = 0.009f * std::exp(-(belt - 0.035f) * (belt - 0.035f) / 0.0004f);
    return bare - cling + groove - cord;
}

float Figure::clothedLegs(glm::vec3 p) const {
    const float bare = legs(p);
    float d = bare;
    if (bare < 0.08f) {
        // Taut, shallow folds drawn slantwise round the limbs; the forward foot is bare.
        const float phase = 15.0f * (p.y + 1.1f * p.x + 0.5f * p.z) + 1.3f * noise3(4.5f * p, 625);
        const float crease = 0.0075f * std::pow(folds(phase, 64.0f, 627), 4.0f);
        d -= (0.011f + crease) * glm::smoothstep(0.06f, 0.10f, p.y);
    }
    d = blend(d, skirt(p, bare), 0.05f);
    return blend(d, strands(p), 0.045f);
}

float Figure::wingArms(glm::vec3 p) const {
    const glm::vec3 mirrored(std::abs(p.x), p.y, p.z);
    float d = roundCone(mirrored, bone_[0], bone_[1], 0.062f, 0.050f);
    d = blend(d, roundCone(mirrored, bone_[1], bone_[2], 0.050f, 0.040f), 0.03f);
    return blend(d, roundCone(mirrored, bone_[2], bone_[3], 0.040f, 0.018f), 0.03f);
}

float Figure::distance(glm::vec3 p) const {
    // A part that is out of reach counts with a lower bound of its distance, from its height alone.
    float d = kGround - p.y < 0.0f ? 1.0f : kGround - p.y;
    d = blend(d, p.y > 0.80f ? clothedTorso(p) : 0.86f - p.y, 0.05f);
    d = blend(d, p.y < 1.10f ? clothedLegs(p) : p.y - 1.02f, 0.05f);
    d = blend(d, p.y > 0.40f && p.y < 1.15f ? mantle(p) : std::abs(p.y - 0.77f) - 0.30f, 0.012f);
    d = blend(d, p.y > 1.15f ? wingArms(p) : 1.22f - p.y, 0.05f);
    d = blend(d, p.y < 0.20f ? rock(p) : p.y - 0.12f, 0.02f);
    return glm::max(d, kGround - p.y);
}

}  // namespace raylab::assets
