// What tests/shaders/bsdf.comp does; C++ and GLSL.
#ifndef RAYLAB_TESTS_BSDF_PUSH_H
#define RAYLAB_TESTS_BSDF_PUSH_H

#include "../../shaders/shared/types.h"

RAYLAB_SHARED_BEGIN

RAYLAB_CONST uint kBsdfSample = 0;    // direction, density; zeros: absorbed or a mirror's
RAYLAB_CONST uint kBsdfGrid = 1;      // f |cos|, density over `columns` of azimuth and rows of height from -1 to 1
RAYLAB_CONST uint kBsdfBothWays = 2;  // red and green of f(a, b), of f(b, a)
RAYLAB_CONST uint kBsdfAlbedo = 3;    // what is left of the light at one scattering

struct BsdfPush {
    vec3 wo;
    uint mode;
    uint count;
    uint columns;
};
RAYLAB_CHECK(BsdfPush, 24);

RAYLAB_SHARED_END
#endif
