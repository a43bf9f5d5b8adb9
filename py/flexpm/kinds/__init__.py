# SPDX-License-Identifier: GPL-3.0-or-later
"""What each laboratory test is, as plain data: one file a test, in the folder tests."""
