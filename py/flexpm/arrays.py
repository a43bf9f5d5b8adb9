# SPDX-License-Identifier: GPL-3.0-or-later
"""Types of arrays, for annotations."""

from typing import Any

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]
#: Whole numbers, in the kernel of 32 bits.
IntArray = npt.NDArray[np.int_]
BoolArray = npt.NDArray[np.bool_]
#: Numbers of any type, and such a type.
AnyArray = npt.NDArray[Any]
NumberType = np.dtype[Any]
