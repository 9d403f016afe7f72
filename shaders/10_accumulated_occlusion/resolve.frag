// From sums to means: what chapters 09 and 11 draw with.
uniform sampler2D uSeen;
uniform sampler2D uReceived;
uniform float uPerDirection;  // 1 / number of directions

layout(location = 0) out vec4 outAmbient;  // bent vector, ambient visibility
layout(location = 1) out vec4 outLight;    // E / pi; w: share of the directions that were looked up

void main() {
    vec4 seen = texelFetch(uSeen, ivec2(gl_FragCoord.xy), 0), received = texelFetch(uReceived, ivec2(gl_FragCoord.xy), 0);
    // [begin:resolve]
    // By its own weights, not by the N/4 that they should add up to: an open point is exactly 1 with any set of directions.
    float perWeight = received.w > 0.0 ? 1.0 / received.w : 0.0;
    outAmbient = seen * perWeight;
    outLight = vec4(received.rgb * perWeight, received.r * uPerDirection);
    // [end:resolve]
}
