// Occluders, projected from points of the light on a receiver's texture: instance i from point i, by the matrix of Heckbert and
// Herf (1997). w is the fraction of the way from the light to the receiver; the near and far planes cut off what is behind the
// light and beyond the receiver, so nothing is projected wrongly.
layout(location = 0) in vec3 aPosition;
layout(location = 4) in vec4 aClipX;  // rows of clipFromWorld, one set for each instance
layout(location = 5) in vec4 aClipY;
layout(location = 6) in vec4 aClipZ;
layout(location = 7) in vec4 aClipW;

flat out uint vBit;

// The same triangle must cover the same texels, whichever method draws it.
invariant gl_Position;

void main() {
    vec4 p = vec4(aPosition, 1.0);
    gl_Position = vec4(dot(aClipX, p), dot(aClipY, p), dot(aClipZ, p), dot(aClipW, p));
    vBit = 1u << uint(gl_InstanceID);
}
