// What a path is inside of: volumes that light fades in (Beer's law), which may overlap. Where they do, the one of the
// highest priority is there, of equals the one entered last, and the boundaries of the others are not (Schmidt, Budge,
// "Simple Nested Dielectrics in Ray Traced Images", Journal of Graphics Tools 7(2), 2002).
#ifndef RAYLAB_MEDIA_GLSL
#define RAYLAB_MEDIA_GLSL

#include "materials/materials.glsl"

// Slots in the order of entering; a fifth volume inside four others is not noticed. Paths start in air.
struct Media {
    vec3 absorption;  // of the medium around the ray
    uvec4 material;
    vec4 ior;
    vec4 priority;  // negative: a free slot
};

const int kMediaSlots = 4;
const float kFreeSlot = -1.0;

Media mediaInAir() { return Media(vec3(0.0), uvec4(0u), vec4(1.0), vec4(kFreeSlot)); }

bool isVolume(Surface s) { return needs(kNeedTransmission) && !s.thin && throughShare(s) > 0.0; }

vec3 transmittance(vec3 absorption, float distance) { return exp(-absorption * distance); }

// The slot of the medium that is there; negative: air.
int strongestSlot(Media m) {
    int slot = -1;
    float priority = kFreeSlot;
    for (int i = 0; i < kMediaSlots; ++i)
        if (m.priority[i] > kFreeSlot && m.priority[i] >= priority) {
            slot = i;
            priority = m.priority[i];
        }
    return slot;
}

float iorAt(Media m, int slot) { return slot < 0 ? 1.0 : m.ior[slot]; }

void enter(inout Media m, Surface s) {
    for (int i = 0; i < kMediaSlots; ++i)
        if (m.priority[i] == kFreeSlot) {
            m.material[i] = s.material;
            m.ior[i] = s.ior;
            m.priority[i] = float(s.lobes.priority);
            return;
        }
}

// The slots after it move up, so that the order stays.
void leave(inout Media m, Surface s) {
    bool found = false;
    for (int i = 0; i < kMediaSlots; ++i) {
        found = found || (m.priority[i] > kFreeSlot && m.material[i] == s.material);
        if (!found) continue;
        bool last = i + 1 == kMediaSlots;
        int next = last ? i : i + 1;
        m.material[i] = m.material[next];
        m.ior[i] = m.ior[next];
        m.priority[i] = last ? kFreeSlot : m.priority[next];
    }
}

// On the other side of the surface.
Media across(Media m, Surface s) {
    if (!isVolume(s)) return m;
    if (!needs(kNeedNesting)) {
        m.absorption = s.frontFace ? s.lobes.absorption : vec3(0.0);
        return m;
    }
    if (s.frontFace)
        enter(m, s);
    else
        leave(m, s);
    int slot = strongestSlot(m);
    m.absorption = slot < 0 ? vec3(0.0) : loadLobes(m.material[slot]).absorption;
    return m;
}

// Whether the volume's boundary is there for a path in these media; if so, the surface gets its relative index.
bool isBoundary(Media m, inout Surface s) {
    if (!isVolume(s)) return true;
    int slot = strongestSlot(m);
    if (s.frontFace) {
        s.eta = s.ior / iorAt(m, slot);
        return slot < 0 || float(s.lobes.priority) >= m.priority[slot];
    }
    Media outside = m;
    leave(outside, s);
    s.eta = iorAt(outside, strongestSlot(outside)) / s.ior;
    return slot < 0 || m.material[slot] == s.material || outside == m;
}

#endif
