// Shapes of large props: barriers, fences, kiosks, tents, stages, trains and fountains.
#pragma once

#include "render/props/prop_builder.h"

namespace throng::render {

void make_barrier(PropBuilder& builder);
void make_fence(PropBuilder& builder);
void make_kiosk(PropBuilder& builder);
void make_tent(PropBuilder& builder);
void make_stage(PropBuilder& builder);
void make_train(PropBuilder& builder);
void make_fountain(PropBuilder& builder);

}  // namespace throng::render
