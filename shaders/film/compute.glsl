// Where an invocation of a compute shader stands: kWorkgroupSize lanes a group.
layout(local_size_x = kWorkgroupSize) in;

uint groupIndex() { return gl_WorkGroupID.x; }
uint laneIndex() { return gl_LocalInvocationID.x; }
