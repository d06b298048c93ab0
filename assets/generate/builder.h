#pragma once

#include "assets/generate/palette.h"
#include "assets/generate/textures.h"

namespace raylab::assets {

/// A scene with the courtyard's materials at hand.
class Builder {
public:
    Builder(Scene& scene, const Palette& palette) : scene_(scene), palette_(palette) {}

    /// Stores a mesh; `metres` is what one repeat of its texture covers.
    uint32_t mesh(const char* name, Geometry g, uint32_t material, float metres = 1.0f) {
        scaleUvs(g, glm::vec2(1.0f / metres));
        return addMesh(scene_, name, g, material);
    }
    uint32_t stone(const char* name, const Geometry& g) { return mesh(name, g, palette_.limestone, kLimestoneMetres); }
    void put(const char* name, uint32_t id, const glm::mat4& pose) { addInstance(scene_, name, id, pose); }
    void putOnce(const char* name, uint32_t id) { addInstance(scene_, name, id); }
    const Palette& palette() const { return palette_; }

private:
    Scene& scene_;
    Palette palette_;
};

}  // namespace raylab::assets
