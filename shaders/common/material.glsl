// The material of what is being drawn, set by GpuScene::drawShaded. Linear reflectances; the texture is stored in sRGB and
// decoded by the sampler.
uniform vec3 uDiffuse;
uniform vec3 uSpecular;
uniform float uShininess;
uniform vec3 uEmission;      // radiance from the front side
uniform bool uHasTexture;
uniform sampler2D uDiffuseTexture;

vec3 materialDiffuse(vec2 uv) {
    // Fetched outside the branch: a derivative taken inside a branch that not all pixels enter is undefined.
    vec3 texel = texture(uDiffuseTexture, uv).rgb;
    return uHasTexture ? uDiffuse * texel : uDiffuse;
}

// Area lights emit from their front side only.
vec3 materialEmission() { return gl_FrontFacing ? uEmission : vec3(0.0); }

// Both sides of every surface are drawn; the normal is turned to the side that is seen.
vec3 facingNormal(vec3 nWorld) {
    vec3 n = normalize(nWorld);
    return gl_FrontFacing ? n : -n;
}
