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
GlbWriter makeKnot();
GlbWriter makeCourtyard();

}  // namespace penumbra::assets
