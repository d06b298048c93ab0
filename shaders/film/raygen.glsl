// Where an invocation of a ray generation shader stands: as many a group as in a workgroup.
uint groupIndex() { return gl_LaunchIDEXT.x / kWorkgroupSize; }
uint laneIndex() { return gl_LaunchIDEXT.x % kWorkgroupSize; }
