#pragma once

#include <optional>
#include <string>

#include "engine/render/render_settings.h"
#include "engine/scene/scene.h"

namespace raylab::editor {

/// Settles the environment of scenes that follow one another by edits, and makes it only where it is another: computing
/// a sky, reading or scaling a map takes longer than an edit of a material may.
class SettledEnvironment {
public:
    /// As settleEnvironment(); scenes between which nothing of the environment has changed share one. Throws Error as
    /// that does.
    void settle(Scene& scene, const RenderSettings& settings);
    /// The next one is made anew, whatever was: files may have changed.
    void forget() { key_.reset(); }

private:
    /// What an environment is made of.
    struct Key {
        SharedOptional<Environment> own;
        std::optional<SkyDescription> sky;
        bool hasLight = false;
        std::string choice;
        double scale = 1.0, sunElevation = 0.0, sunAzimuth = 0.0;

        bool operator==(const Key& other) const;
    };
    static Key keyOf(const Scene& scene, const RenderSettings& settings);

    std::optional<Key> key_;  ///< of `settled_`
    SharedOptional<Environment> settled_;
};

}  // namespace raylab::editor
