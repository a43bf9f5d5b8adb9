# SPDX-License-Identifier: GPL-3.0-or-later
"""Types of arrays, for annotations."""

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]
#: Whole numbers, in the kernel of 32 bits.
IntArray = npt.NDArray[np.int_]
BoolArray = npt.NDArray[np.bool_]
