// An occluder in one value: 1 in a hard shadow image, one bit of a byte where logic operations are missing.
uniform vec4 uCovered;

out vec4 outCovered;

void main() {
    outCovered = uCovered;
}
