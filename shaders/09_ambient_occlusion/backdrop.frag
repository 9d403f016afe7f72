// The sky itself, where no surface is.
in vec2 vUv;

uniform sampler2D uSky;          // latitude and longitude, the top row is up
uniform mat4 uWorldFromClip;
uniform vec3 uEye;
uniform bool uParallel;          // an orthographic camera looks the same way everywhere
uniform vec3 uForward;

out vec4 outColor;

const float pi = 3.14159265358979;

void main() {
    vec4 far = uWorldFromClip * vec4(2.0 * vUv - 1.0, 1.0, 1.0);
    vec3 w = uParallel ? uForward : normalize(far.xyz / far.w - uEye);
    vec2 uv = vec2(0.5 + atan(w.x, -w.z) / (2.0 * pi), acos(clamp(w.y, -1.0, 1.0)) / pi);
    ivec2 size = textureSize(uSky, 0);
    outColor = vec4(texelFetch(uSky, min(ivec2(uv * vec2(size)), size - 1), 0).rgb, 1.0);
}
