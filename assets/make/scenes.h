// One function per scene; each lives in a file of the scene's name.
#pragma once

#include "assets/make/glb_writer.h"

namespace penumbra::assets {

GlbWriter makeHeckbertHerf();
GlbWriter makeContact();
GlbWriter makeContactPanel();
GlbWriter makeSpheres();
GlbWriter makeGully();
GlbWriter makeRoom();
GlbWriter makeFence();
/// `triangles`: of the knot itself, as near as whole numbers of rings allow; 70 000 are committed.
GlbWriter makeKnot(int triangles = 70'000);
GlbWriter makeCourtyard();

}  // namespace penumbra::assets
