// From scene-referred to display-referred linear colour; the host writes PNGs with it.
#ifndef RAYLAB_SHARED_TONEMAP_H
#define RAYLAB_SHARED_TONEMAP_H

#include "types.h"

RAYLAB_SHARED_BEGIN

RAYLAB_CONST uint kTonemapLinear = 0;
RAYLAB_CONST uint kTonemapReinhard = 1;
RAYLAB_CONST uint kTonemapFilmic = 2;

// Reinhard et al., "Photographic Tone Reproduction for Digital Images", SIGGRAPH 2002, equation 4, white at 4, by channel.
RAYLAB_FN vec3 tonemapReinhard(vec3 c) { return c * (c * (1.0f / 16.0f) + 1.0f) / (c + 1.0f); }

// Hable, "Uncharted 2: HDR Lighting", GDC 2010: a curve with toe and shoulder, white at 11.2, exposed by 2 as he does.
RAYLAB_FN vec3 hableCurve(vec3 x) {
    return (x * (x * 0.15f + 0.05f) + 0.004f) / (x * (x * 0.15f + 0.50f) + 0.06f) - 0.02f / 0.30f;
}
RAYLAB_FN vec3 tonemapFilmic(vec3 c) { return hableCurve(c * 2.0f) / hableCurve(vec3(11.2f)); }

RAYLAB_FN vec3 tonemap(vec3 c, uint curve) {
    vec3 positive = max(c, vec3(0.0f));
    if (curve == kTonemapReinhard) return clamp(tonemapReinhard(positive), vec3(0.0f), vec3(1.0f));
    if (curve == kTonemapFilmic) return clamp(tonemapFilmic(positive), vec3(0.0f), vec3(1.0f));
    return clamp(positive, vec3(0.0f), vec3(1.0f));
}

RAYLAB_SHARED_END
#endif
