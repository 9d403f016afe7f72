// A linear picture on an sRGB screen. The twin of common/image/tone_map.cpp and common/image/srgb.h, which write the files; a test
// compares the window with the file.
in vec2 vUv;
uniform sampler2D uPicture;
uniform float uExposure;  // 0: values are colours in [0,1] already
uniform bool uScalar;     // only red counts
layout(location = 0) out vec4 fragColor;

const float start = 0.8;  // of white: linear below, compressed above
const float room = 1.0 - start;
const float desaturation = 0.15;

vec3 compressHighlights(vec3 colour) {
    float peak = max(colour.r, max(colour.g, colour.b));
    if (peak <= start) return colour;
    if (isinf(peak)) return vec3(1.0);
    float newPeak = 1.0 - room * room / (peak + room - start);
    float towardsWhite = 1.0 - 1.0 / (desaturation * (peak - newPeak) + 1.0);
    return mix(colour * (newPeak / peak), vec3(newPeak), towardsWhite);
}

vec3 encodeSrgb(vec3 linear) {
    vec3 inside = clamp(linear, 0.0, 1.0);
    return mix(1.055 * pow(inside, vec3(1.0 / 2.4)) - 0.055, 12.92 * inside, vec3(lessThanEqual(inside, vec3(0.0031308))));
}

void main() {
    vec3 colour = texture(uPicture, vUv).rgb;
    if (uScalar) {
        colour = colour.rrr;
    } else if (any(isnan(colour))) {
        colour = vec3(1.0, 0.0, 1.0);  // must be seen
    } else if (uExposure > 0.0) {
        colour = compressHighlights(max(colour * uExposure, vec3(0.0)));
    }
    fragColor = vec4(encodeSrgb(colour), 1.0);
}
