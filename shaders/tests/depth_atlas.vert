// Many shadow maps with one draw: instance k fills the k-th tile of an atlas.
layout(location = 0) in vec3 aPosition;

uniform vec4 uAtlasColumns[4 * TILES];  // of the matrices that take the world to the tiles

void main() {
    int k = 4 * gl_InstanceID;
    mat4 atlasFromWorld = mat4(uAtlasColumns[k], uAtlasColumns[k + 1], uAtlasColumns[k + 2], uAtlasColumns[k + 3]);
    gl_Position = atlasFromWorld * vec4(aPosition, 1.0);
}
