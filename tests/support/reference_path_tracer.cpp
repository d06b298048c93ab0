#include "tests/support/reference_path_tracer.h"

#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "tests/support/reference_bsdf.h"
#include "tests/support/scene_build.h"

namespace raylab::support {
namespace {

constexpr double kAway = 1e-9;  // scene units

struct Triangle {
    glm::dvec3 p0, e1, e2, normal, tangent;
    uint32_t material;
};

struct Ray {
    glm::dvec3 origin, direction;
};

/// Moller, Trumbore 1997.
std::optional<double> distanceTo(const Triangle& t, const Ray& ray) {
    const glm::dvec3 q = glm::cross(ray.direction, t.e2), s = ray.origin - t.p0, r = glm::cross(s, t.e1);
    const double determinant = glm::dot(t.e1, q);
    if (determinant == 0.0) return std::nullopt;
    const double u = glm::dot(s, q) / determinant, v = glm::dot(ray.direction, r) / determinant;
    const double distance = glm::dot(t.e2, r) / determinant;
    if (u < 0.0 || v < 0.0 || u + v > 1.0 || distance <= kAway) return std::nullopt;
    return distance;
}

Triangle triangleOf(const Mesh& mesh, const glm::dmat4& matrix, glm::uvec3 corners) {
    const auto world = [&](uint32_t i) { return glm::dvec3(matrix * glm::dvec4(glm::dvec3(mesh.positions[i]), 1.0)); };
    Triangle t{.p0 = world(corners.x), .material = mesh.material};
    t.e1 = world(corners.y) - t.p0;
    t.e2 = world(corners.z) - t.p0;
    t.normal = glm::normalize(glm::cross(t.e1, t.e2));
    const glm::dvec3 along = mesh.tangents.empty() ? t.e1 : glm::dmat3(matrix) * glm::dvec3(mesh.tangents[corners.x]);
    t.tangent = glm::normalize(along - t.normal * glm::dot(t.normal, along));
    return t;
}

class Dice {
public:
    explicit Dice(uint32_t seed) : engine_(seed) {}
    double operator()() { return number_(engine_); }

private:
    std::mt19937_64 engine_;
    std::uniform_real_distribution<double> number_;
};

/// Half by the cosine, half evenly over the hemisphere.
glm::dvec3 hemisphere(Dice& dice, double& pdf) {
    const double u = dice(), phi = 2.0 * kPi * dice();
    const double z = dice() < 0.5 ? std::sqrt(u) : u, r = std::sqrt(1.0 - z * z);
    pdf = 0.5 * z / kPi + 0.25 / kPi;
    return {r * std::cos(phi), r * std::sin(phi), z};
}

/// Where a path goes on, in the frame of the surface.
struct Step {
    glm::dvec3 direction{0.0};
    glm::dvec3 weight{0.0};
};

Step smoothGlass(const ReferenceBsdf& bsdf, glm::dvec3 o, double eta, Dice& dice) {
    if (dice() < referenceFresnel(o.z, eta)) return {{-o.x, -o.y, o.z}, glm::dvec3(1.0)};
    const glm::dvec3 across(-o.x / eta, -o.y / eta, 0.0);
    const glm::dvec3 i = across - glm::dvec3(0.0, 0.0, std::sqrt(1.0 - glm::dot(across, across)));
    return {i, glm::dvec3(bsdf.material().baseColor) / (eta * eta)};
}

/// Normals by the fourth power of their cosine; the refracted directions of Snell's law crowd together, and the
/// Jacobian of Walter et al. 2007, equation 17, says by how much.
Step refracted(const ReferenceBsdf& bsdf, glm::dvec3 o, double eta, Dice& dice) {
    const double z = std::pow(dice(), 0.2), r = std::sqrt(1.0 - z * z), phi = 2.0 * kPi * dice();
    const glm::dvec3 h(r * std::cos(phi), r * std::sin(phi), z);
    const double oh = glm::dot(o, h), cos2 = 1.0 - (1.0 - oh * oh) / (eta * eta);
    if (oh <= 0.0 || cos2 <= 0.0) return {};
    const glm::dvec3 i = (oh / eta - std::sqrt(cos2)) * h - o / eta;
    if (i.z >= 0.0) return {};
    const double ih = glm::dot(i, h), pdfNormal = 2.5 / kPi * std::pow(z, 4);
    const double pdf = pdfNormal * eta * eta * -ih / std::pow(oh + eta * ih, 2);
    return {i, bsdf.roughGlass(o, i, eta) * (-i.z / pdf)};
}

Step scatter(const ReferenceBsdf& bsdf, glm::dvec3 o, double eta, Dice& dice) {
    const bool meetsGlass = dice() < bsdf.through();
    if (meetsGlass && bsdf.isSmoothGlass()) return smoothGlass(bsdf, o, eta, dice);
    double pdf;
    const glm::dvec3 i = hemisphere(dice, pdf);
    if (!meetsGlass) return {i, bsdf.opaque(o, i) * (i.z / pdf)};
    if (dice() < 0.5) return {i, 2.0 * bsdf.roughGlass(o, i, eta) * (i.z / pdf)};
    Step step = refracted(bsdf, o, eta, dice);
    step.weight *= 2.0;
    return step;
}

}  // namespace

struct ReferencePathTracer::Impl {
    std::vector<Triangle> triangles;
    std::vector<Material> materials;
    std::vector<ReferenceBsdf> bsdfs;
    Camera camera;
    glm::dvec3 environment{0.0};

    const Triangle* closest(const Ray& ray, double& distance) const {
        const Triangle* found = nullptr;
        distance = std::numeric_limits<double>::infinity();
        for (const Triangle& t : triangles)
            if (const std::optional<double> d = distanceTo(t, ray); d && *d < distance) {
                distance = *d;
                found = &t;
            }
        return found;
    }

    static glm::dvec3 absorption(const Material& m) {
        if (!std::isfinite(m.attenuationDistance)) return glm::dvec3(0.0);
        return -glm::log(glm::dvec3(m.attenuationColor)) / static_cast<double>(m.attenuationDistance);
    }

    glm::dvec3 radiance(Ray ray, int depth, Dice& dice) const {
        glm::dvec3 sum(0.0), throughput(1.0), fading(0.0);
        for (int event = 0;; ++event) {
            double distance;
            const Triangle* hit = closest(ray, distance);
            if (hit == nullptr) return sum + throughput * environment;
            throughput *= glm::exp(-fading * distance);
            const ReferenceBsdf& bsdf = bsdfs[hit->material];
            const Material& m = bsdf.material();
            const bool isFront = glm::dot(hit->normal, ray.direction) < 0.0;
            if (isFront || m.doubleSided) sum += throughput * glm::dvec3(m.emission);
            if (event >= depth) return sum;
            const glm::dvec3 n = isFront ? hit->normal : -hit->normal;
            const glm::dmat3 frame(hit->tangent, glm::cross(n, hit->tangent), n);
            const double ior = static_cast<double>(m.ior);
            const Step step = scatter(bsdf, -ray.direction * frame, isFront ? ior : 1.0 / ior, dice);
            throughput *= step.weight;
            if (throughput == glm::dvec3(0.0)) return sum;
            if (step.direction.z < 0.0) fading = isFront ? absorption(m) : glm::dvec3(0.0);
            ray = {ray.origin + distance * ray.direction, frame * step.direction};
        }
    }

    Ray cameraRay(int size, double x, double y) const {
        const glm::dvec3 view = glm::normalize(glm::dvec3(camera.target) - glm::dvec3(camera.position));
        const glm::dvec3 right = glm::normalize(glm::cross(view, glm::dvec3(camera.up))), up = glm::cross(right, view);
        const double f = std::tan(0.5 * static_cast<double>(camera.fovYRadians));
        return {glm::dvec3(camera.position),
                glm::normalize(f * (2.0 * x / size - 1.0) * right - f * (2.0 * y / size - 1.0) * up + view)};
    }
};

ReferencePathTracer::ReferencePathTracer(const Scene& scene) : impl_(std::make_unique<Impl>()) {
    impl_->materials = scene.materials;
    for (const Material& material : impl_->materials) impl_->bsdfs.emplace_back(material);
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        for (const glm::uvec3 t : mesh.triangles)
            impl_->triangles.push_back(triangleOf(mesh, glm::dmat4(instance.objectToWorld), t));
    }
    impl_->camera = scene.cameras.at(0);
    if (scene.environment) {
        const float* texel = scene.environment->radiance.at(0, 0);
        impl_->environment = glm::dvec3(texel[0], texel[1], texel[2]);
    }
}

ReferencePathTracer::~ReferencePathTracer() = default;

std::vector<ReferencePixel> ReferencePathTracer::render(int size, int samples, int depth, uint32_t seed) const {
    Dice dice(seed);
    std::vector<ReferencePixel> pixels;
    for (int p = 0; p < size * size; ++p) {
        glm::dvec3 sum(0.0), squares(0.0);
        for (int i = 0; i < samples; ++i) {
            const double x = p % size + dice(), y = p / size + dice();
            const glm::dvec3 value = impl_->radiance(impl_->cameraRay(size, x, y), depth, dice);
            sum += value;
            squares += value * value;
        }
        const glm::dvec3 mean = sum / static_cast<double>(samples);
        pixels.push_back({mean, (squares / static_cast<double>(samples) - mean * mean) / (samples - 1.0)});
    }
    return pixels;
}

}  // namespace raylab::support
