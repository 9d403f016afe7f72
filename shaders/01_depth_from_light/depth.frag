// Nothing to compute: the rasteriser has the depth already.
void main() {
}
