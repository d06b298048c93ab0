#pragma once

#include "assets/generate/mesh_tools.h"

namespace raylab::assets {

// The courtyard's module, in metres: every part below is made to it and stands on y = 0 at the middle of its bay.
constexpr float kBay = 2.5f;         ///< distance between columns
constexpr float kSpringing = 2.55f;  ///< top of the capitals, where arches start
constexpr float kArchRadius = 0.98f;
constexpr float kWallThickness = 0.46f;
constexpr float kWallTop = 4.0f;
constexpr float kGalleryDepth = 3.0f;
constexpr float kRoofPitchDegrees = 19.0f;
constexpr float kRoofStripWidth = 0.25f;  ///< kBay is a multiple of it

/// Tuscan column on a square plinth, up to kSpringing; about the origin.
Geometry column();
/// Square pier for the corners, up to kWallTop.
Geometry pier();
/// Wall above one arch from kSpringing to kWallTop, without the arch's own stones. Faces +Z and -Z.
Geometry archWall();
/// The wedge-shaped stones of one arch with a raised keystone.
Geometry archStones();
/// Moulded cornice above one bay, at kWallTop, towards +Z.
Geometry cornice();
/// Two steps along one bay, from the courtyard up to the gallery floor, towards +Z.
Geometry steps();
constexpr float kGalleryFloor = 0.3f;
/// One turned baluster, its foot at y = 0, and what stands above and below a row of them in one bay.
Geometry baluster();
Geometry balustradeRails();
constexpr float kBalusterFoot = 0.14f;
/// One strip of barrel tiles from the eave at the origin up the slope towards -Z; `variant` changes how tiles sit.
Geometry roofStrip(uint32_t variant);
/// A rough-hewn ceiling beam along Z, its underside at y = 0.
Geometry ceilingBeam();
/// Panelled door with an arched head, facing +Z, foot at y = 0.
Geometry doorLeaf();
Geometry doorFrame();
/// Curb of a pool whose water has the given half extents; the water stands below kPoolRim.
constexpr float kPoolRim = 0.32f;
Geometry poolCurb(glm::vec2 halfExtent);
/// Moulded pedestal of a statue: top at y = `height`.
Geometry pedestal(float height, float halfWidth);
/// Stone table: slab on two scrolled supports, top at y = kTableHeight, along X.
Geometry stoneTable();
constexpr float kTableHeight = 0.82f;
/// A polygon (counter-clockwise, star-shaped about its centroid) from zLow to zHigh with edges broken by `bevel`.
Geometry extrude(std::span<const glm::vec2> polygon, float zLow, float zHigh, float bevel);

}  // namespace raylab::assets
