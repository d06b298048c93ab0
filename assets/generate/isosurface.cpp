#include "assets/generate/isosurface.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

namespace raylab::assets {
namespace {

constexpr uint32_t kBlock = 32;
constexpr uint32_t kNone = 0xffffffffu;

/// Distances at the corners of a regular grid; exact near the surface, of the right sign elsewhere.
class Field {
public:
    Field(const IsosurfaceConfig& config, const std::function<float(glm::vec3)>& distance)
        : config_(config), distance_(distance) {
        const glm::vec3 cells = glm::ceil((config.high - config.low) / (config.cell * kBlock));
        size_ = glm::uvec3(cells) * kBlock;
        values_.resize(static_cast<size_t>(size_.x) * size_.y * size_.z);
        const glm::uvec3 blocks = size_ / kBlock;
        tbb::parallel_for(0u, blocks.x * blocks.y * blocks.z, [&](uint32_t i) {
            fill(kBlock * glm::uvec3(i % blocks.x, i / blocks.x % blocks.y, i / (blocks.x * blocks.y)), kBlock);
        });
    }

    glm::uvec3 size() const { return size_; }
    float at(uint32_t x, uint32_t y, uint32_t z) const { return values_[index({x, y, z})]; }
    glm::vec3 position(glm::vec3 corner) const { return config_.low + config_.cell * corner; }

private:
    size_t index(glm::uvec3 c) const { return (static_cast<size_t>(c.z) * size_.y + c.y) * size_.x + c.x; }

    /// A cube of corners that lies wholly on one side gets one value; others are halved.
    void fill(glm::uvec3 low, uint32_t side) {
        const float toMiddle = 0.5f * static_cast<float>(side - 1);
        const float d = distance_(position(glm::vec3(low) + toMiddle));
        const float reach = config_.lipschitz * config_.cell * (toMiddle + 1.0f) * 1.7320508f;
        if (side == 1) {
            values_[index(low)] = d;
        } else if (std::abs(d) > reach) {
            for (uint32_t z = 0; z < side; ++z) {
                for (uint32_t y = 0; y < side; ++y) {
                    const size_t row = index(low + glm::uvec3(0, y, z));
                    std::fill_n(values_.begin() + static_cast<std::ptrdiff_t>(row), side, d);
                }
            }
        } else {
            const uint32_t half = side / 2;
            for (uint32_t child = 0; child < 8; ++child) {
                fill(low + half * glm::uvec3(child & 1u, child >> 1 & 1u, child >> 2), half);
            }
        }
    }

    const IsosurfaceConfig& config_;
    const std::function<float(glm::vec3)>& distance_;
    glm::uvec3 size_{};
    std::vector<float> values_;
};

/// Mean of the points where the surface crosses the edges of a cell with corner values `v` (x fastest); in [0, 1]^3.
glm::vec3 meanCrossing(const std::array<float, 8>& v) {
    glm::vec3 sum(0.0f);
    float count = 0.0f;
    for (uint32_t axis = 0; axis < 3; ++axis) {
        for (uint32_t corner = 0; corner < 8; ++corner) {
            const uint32_t other = corner | 1u << axis;
            if (other == corner || (v[corner] < 0.0f) == (v[other] < 0.0f)) continue;
            glm::vec3 p(corner & 1u, corner >> 1 & 1u, corner >> 2);
            p[static_cast<int>(axis)] = v[corner] / (v[corner] - v[other]);
            sum += p;
            count += 1.0f;
        }
    }
    return sum / count;
}

/// Walks the cells slice by slice; vertex ids of this slice and the one before are enough to stitch.
class Net {
public:
    explicit Net(const Field& field) : field_(field), size_(field.size()) {
        const size_t slice = static_cast<size_t>(size_.x) * size_.y;
        ids_.fill(std::vector<uint32_t>(slice, kNone));
    }

    Geometry build() {
        for (uint32_t z = 0; z + 1 < size_.z; ++z) {
            std::fill(ids_[z % 2].begin(), ids_[z % 2].end(), kNone);
            for (uint32_t y = 0; y + 1 < size_.y; ++y) {
                for (uint32_t x = 0; x + 1 < size_.x; ++x) visit(x, y, z);
            }
        }
        mesh_.uvs.resize(mesh_.positions.size(), glm::vec2(0.0f));
        smoothNormals(mesh_);
        return std::move(mesh_);
    }

private:
    uint32_t& id(uint32_t x, uint32_t y, uint32_t z) { return ids_[z % 2][static_cast<size_t>(y) * size_.x + x]; }

    void visit(uint32_t x, uint32_t y, uint32_t z) {
        std::array<float, 8> v{};
        uint32_t inside = 0;
        for (uint32_t corner = 0; corner < 8; ++corner) {
            v[corner] = field_.at(x + (corner & 1u), y + (corner >> 1 & 1u), z + (corner >> 2));
            inside += v[corner] < 0.0f ? 1 : 0;
        }
        if (inside == 0 || inside == 8) return;
        id(x, y, z) = static_cast<uint32_t>(mesh_.positions.size());
        mesh_.positions.push_back(field_.position(glm::vec3(x, y, z) + meanCrossing(v)));
        if (x == 0 || y == 0 || z == 0) return;
        const bool here = v[0] < 0.0f;
        if (here != (v[1] < 0.0f)) quad(here, {id(x, y - 1, z - 1), id(x, y, z - 1), id(x, y, z), id(x, y - 1, z)});
        if (here != (v[2] < 0.0f)) quad(here, {id(x - 1, y, z - 1), id(x - 1, y, z), id(x, y, z), id(x, y, z - 1)});
        if (here != (v[4] < 0.0f)) quad(here, {id(x - 1, y - 1, z), id(x, y - 1, z), id(x, y, z), id(x - 1, y, z)});
    }

    /// Around one crossed edge, counter-clockwise seen from the edge's far end; split along the shorter diagonal.
    void quad(bool insideFirst, std::array<uint32_t, 4> q) {
        if (!insideFirst) std::swap(q[1], q[3]);
        const auto distance = [&](uint32_t a, uint32_t b) {
            return glm::distance(mesh_.positions[a], mesh_.positions[b]);
        };
        const uint32_t first = distance(q[0], q[2]) <= distance(q[1], q[3]) ? 0 : 1;
        mesh_.triangles.emplace_back(q[first], q[first + 1], q[first + 2]);
        mesh_.triangles.emplace_back(q[first], q[first + 2], q[(first + 3) % 4]);
    }

    const Field& field_;
    glm::uvec3 size_;
    std::array<std::vector<uint32_t>, 2> ids_;
    Geometry mesh_;
};

}  // namespace

Geometry polygonise(const IsosurfaceConfig& config, const std::function<float(glm::vec3)>& distance) {
    const Field field(config, distance);
    return Net(field).build();
}

}  // namespace raylab::assets
