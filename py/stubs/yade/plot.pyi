# SPDX-License-Identifier: GPL-3.0-or-later
data: dict[str, list[float]]
