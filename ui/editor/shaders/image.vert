// A rectangle of an image in the editor's window: a strip of two triangles, without a vertex buffer.
#version 450

layout(push_constant) uniform Rectangle {
    vec4 corners;  // x0, y0, x1, y1 in normalised device coordinates
    vec4 uv;       // the same corners in the image
};
layout(location = 0) out vec2 outUv;

void main() {
    const vec2 at = vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1);
    outUv = mix(uv.xy, uv.zw, at);
    gl_Position = vec4(mix(corners.xy, corners.zw, at), 0.0, 1.0);
}
