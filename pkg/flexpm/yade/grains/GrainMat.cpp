// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Material of deformable grains.
#include <flexpm/yade/grains/GrainMat.hpp>

namespace yade {

YADE_PLUGIN((GrainMat));

GrainMat::~GrainMat() = default;

} // namespace yade
