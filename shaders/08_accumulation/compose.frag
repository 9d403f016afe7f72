// The light that one texel of a receiver gets: what Lambert's formula says without occluders, times the visible share of it.
uniform sampler2D uUnoccluded;  // irradiance for a light of emission 1
uniform bool uHasUnoccluded;
uniform sampler2D uSums;        // of visible weights (r) and of all (g), or
uniform sampler2D uSeen;        // the first, four texels in one, and
uniform sampler2D uAll;         // the second
uniform bool uPacked;
uniform int uKnown;             // 0: by the sums; 1: nothing can shadow this receiver
uniform vec3 uEmission;
uniform int uOutput;            // 0 irradiance, 1 visibility, 2 work
uniform vec3 uInFront;          // metres in front of the light's plane: dot(uInFront, (u, v, 1))
uniform bool uRatio;            // false: --weights sum
uniform float uWeightScale;     // what the weights were multiplied by
uniform vec2 uTextureSize;

layout(location = 0) out vec4 outReceived;

vec2 sumsAt(ivec2 texel) {
    if (!uPacked) return texelFetch(uSums, texel, 0).rg;
    ivec2 fragment = ivec2(texel.x / 4, texel.y);
    return vec2(texelFetch(uSeen, fragment, 0)[texel.x % 4], texelFetch(uAll, fragment, 0)[texel.x % 4]);
}

// [begin:ratio]
// A ratio estimator (Heitz, Hill & McGuire 2018): the samples decide only which share is seen, so what all or none of them see
// is exact, however few there are.
float visibility(vec2 sums, float unoccluded, float inFront) {
    if (inFront <= 0.0) return 0.0;
    if (uKnown == 1) return 1.0;
    if (uRatio) return sums.g > 0.0 ? sums.r / sums.g : 0.0;
    // The paper's: cos cos / r^2 of each point, added up. The points' sum is not Lambert's, so even what is lit has noise.
    return unoccluded > 0.0 ? sums.r * inFront / (uWeightScale * unoccluded) : 0.0;
}
// [end:ratio]

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    float unoccluded = uHasUnoccluded ? texelFetch(uUnoccluded, texel, 0).r : 1.0;
    float inFront = dot(uInFront, vec3(gl_FragCoord.xy / uTextureSize, 1.0));
    float V = visibility(sumsAt(texel), unoccluded, inFront);
    if (uOutput == 0) outReceived = vec4(uEmission * unoccluded * V, 1.0);
    if (uOutput == 1) outReceived = vec4(vec3(V), 1.0);
    if (uOutput == 2) {
        bool mixed = V > 0.0 && V < 1.0 && uKnown == 0;
        vec3 known = uKnown == 1 ? vec3(0.55, 0.7, 0.9) : vec3(0.15 + 0.75 * V);
        outReceived = vec4(mixed ? vec3(0.75, 0.08, 0.03) : known, 1.0);
    }
}
