// One triangle that covers the picture, from gl_VertexID alone: corners (-1,-1), (3,-1), (-1,3). A quad of two triangles would
// shade the pixels along its diagonal twice.
out vec2 vUv;  // 0..1 across the picture, v up

void main() {
    vec2 corner = vec2(float((gl_VertexID & 1) << 2), float((gl_VertexID & 2) << 1));
    vUv = 0.5 * corner;
    gl_Position = vec4(corner - 1.0, 0.0, 1.0);
}
