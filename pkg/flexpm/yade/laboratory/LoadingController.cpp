// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/yade/laboratory/LoadingController.hpp>

namespace yade {

YADE_PLUGIN((LoadingController));

LoadingController::~LoadingController() = default;

} // namespace yade
