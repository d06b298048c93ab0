// What tests/shaders/samples.comp draws; C++ and GLSL.
#ifndef RAYLAB_TESTS_ROUTINES_H
#define RAYLAB_TESTS_ROUTINES_H

#include "../../shaders/shared/types.h"

RAYLAB_SHARED_BEGIN

RAYLAB_CONST uint kSpecRoutine = 40;

RAYLAB_CONST uint kRoutinePair = 0;         // the numbers themselves
RAYLAB_CONST uint kRoutineCosine = 1;       // direction, density
RAYLAB_CONST uint kRoutineGgxNormal = 2;    // visible normal for wo at alpha
RAYLAB_CONST uint kRoutineTriangle = 3;     // barycentrics
RAYLAB_CONST uint kRoutineDisc = 4;         // point
RAYLAB_CONST uint kRoutineFilter = 5;       // place in the image, from the pixel's corner
RAYLAB_CONST uint kRoutineEnvironment = 6;  // direction, density
RAYLAB_CONST uint kRoutineRectangle = 7;    // point of a lamp, its density, that of the ray which comes upon it
RAYLAB_CONST uint kRoutineSphere = 8;       // direction to a sphere's light, density
RAYLAB_CONST uint kRoutineSunDisc = 9;      // direction to the sun, density

RAYLAB_CONST uint kRoutineChooseLight = 0;  // tests/shaders/light_choice.comp: a light and its probability, by hashed numbers
RAYLAB_CONST uint kRoutineLightTrail = 1;   // the probability of the light at the end of a trail

struct LightChoicePush {
    vec3 position;
    uint count;
    vec3 normal;
    uint seed;
};
RAYLAB_CHECK(LightChoicePush, 32);

struct SamplesPush {
    vec3 wo;
    float alpha;
    uint count;
    uint samplesPerPixel;
    uint firstSample;
    uint pixelsPerRow;
};
RAYLAB_CHECK(SamplesPush, 32);

RAYLAB_SHARED_END
#endif
