// Path tracing by queues between kernels (Laine, Karras, Aila, "Megakernels Considered Harmful: Wavefront Path Tracing on GPUs",
// HPG 2013, section 4): generate, then round by round trace, shade and trace shadow rays, and at last the film. A path keeps its
// place in the arrays of state from the first ray to the last; the queues hold places. This file: the buffers, and the
// queues' ends.
#ifndef RAYLAB_WAVEFRONT_QUEUES_GLSL
#define RAYLAB_WAVEFRONT_QUEUES_GLSL

#include "lib/scene_buffers.glsl"
#include "shared/wavefront.h"

layout(set = 0, binding = kBindPaths, std430) buffer PathsBlock { uvec4 stateWords[]; };
layout(set = 0, binding = kBindQueues, std430) buffer QueuesBlock { uint queueWords[]; };
layout(push_constant) uniform PushBlock { WavefrontPush push; };
layout(constant_id = kSpecStage) const uint kStage = kStageClosest;
layout(constant_id = kSpecQueueOrder) const uint kQueueOrder = kOrderArrival;

const bool kSortsRays = kQueueOrder == kOrderOctant || kQueueOrder == kOrderOrigin;

uvec4 loadWord(uint word, uint place) { return stateWords[word * push.capacity + place]; }
vec4 loadFloats(uint word, uint place) { return uintBitsToFloat(loadWord(word, place)); }
void storeWord(uint word, uint place, uvec4 value) { stateWords[word * push.capacity + place] = value; }
void storeFloats(uint word, uint place, vec4 value) { storeWord(word, place, floatBitsToUint(value)); }

uint queueLength(uint queue) { return queueWords[kArgumentWords * queue + 3u]; }

uint arrayAt(uint array, uint place) { return kFirstPlace + array * push.capacity + place; }
uint keyCountAt(uint round, uint key) { return kFirstKeyCount + (round & 1u) * kMostKeys + key; }

// Arrays of this round: as the paths came, as they are traced (camera rays need no sorting), as they are shaded.
uint arrivalArray() { return push.round & 1u; }
uint tracedArray() { return kSortsRays && push.round > 0u ? kArraySorted : arrivalArray(); }
uint shadedArray() { return kQueueOrder == kOrderMaterial ? kArraySorted : tracedArray(); }

#endif
