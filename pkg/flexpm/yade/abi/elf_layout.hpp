// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Reads class sizes and virtual tables out of YADE's loaded libraries (x86-64 ELF), without YADE's headers.
#pragma once

#include <cstddef>
#include <string>
#include <typeinfo>

namespace flexpm_abi {

/// Smallest and largest object size that fits what the allocator gave out [bytes].
struct SizeWindow {
	std::size_t low;
	std::size_t high;
};

/// Size [bytes] that YADE's exported `yade::Create<name>()` passes to operator new; 0 if it cannot be read.
/// Only a value inside `window` is taken, so that an unrelated constant of the code is not mistaken for it.
std::size_t factorySize(const std::string& name, SizeWindow window);

/// Sizes that could have produced this heap block.
SizeWindow blockWindow(void* block);

/// Any size that a class can have; for classes that must not be created just to be measured.
SizeWindow anySize();

/// Virtual table as the dynamic linker sees it; `slots` is 0 if there is none.
struct VirtualTable {
	void** begin = nullptr;
	int    slots = 0;
};

VirtualTable yadeTable(const std::type_info& type);   ///< of a class of YADE's libraries
VirtualTable pluginTable(const std::type_info& type); ///< of a class compiled into this plugin

/// Empty if both tables have the same slots, apart from type information and destructors; else the difference.
std::string difference(VirtualTable yade, VirtualTable plugin);

} // namespace flexpm_abi
