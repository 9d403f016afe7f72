// Sets bit i where light point i is hidden: the target's logic operation is OR.
flat in uint vBit;

layout(location = 0) out uint outBits;

void main() {
    outBits = vBit;
}
