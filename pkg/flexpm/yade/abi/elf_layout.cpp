// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Class sizes and virtual tables of loaded libraries, by dladdr1 and a look at the factories' code.
#include <flexpm/yade/abi/elf_layout.hpp>

#include <cstdint>
#include <cstring>

#include <dlfcn.h>
#include <link.h>
#include <malloc.h>

namespace flexpm_abi {

namespace {

	std::size_t symbolSize(void* address)
	{
		Dl_info info {};
		void*   symbol = nullptr;
		if (!dladdr1(address, &info, &symbol, RTLD_DL_SYMENT) || !symbol) return 0;
		return static_cast<const ElfW(Sym)*>(symbol)->st_size;
	}

	std::string symbolName(void* address)
	{
		Dl_info info {};
		return dladdr(address, &info) && info.dli_sname ? info.dli_sname : "?";
	}

	void* pluginHandle()
	{
		Dl_info info {};
		dladdr(reinterpret_cast<void*>(&pluginHandle), &info);
		return dlopen(info.dli_fname, RTLD_LAZY | RTLD_NOLOAD);
	}

	VirtualTable table(void* handle, const std::type_info& type)
	{
		void* begin = dlsym(handle, (std::string("_ZTV") + type.name()).c_str());
		if (!begin) return {};
		return { static_cast<void**>(begin), static_cast<int>(symbolSize(begin) / sizeof(void*)) };
	}

	bool startsWith(const std::string& s, const char* prefix) { return s.compare(0, std::strlen(prefix), prefix) == 0; }

	// a class always has its own type information and destructors (D0 deleting, D1 complete, thunks included)
	bool isOwnOfEachClass(const std::string& symbol)
	{
		if (startsWith(symbol, "_ZTI")) return true;
		return symbol.find("D0Ev") != std::string::npos || symbol.find("D1Ev") != std::string::npos || symbol.find("D2Ev") != std::string::npos;
	}

} // namespace

SizeWindow anySize() { return { sizeof(void*), 1U << 16 }; }

SizeWindow blockWindow(void* block)
{
	const std::size_t usable = malloc_usable_size(block);
	return { usable > 31 ? usable - 31 : 1, usable }; // glibc rounds up to 16 k + 8 and may add a rest of 16
}

std::size_t factorySize(const std::string& name, SizeWindow window)
{
#if defined(__x86_64__)
	const std::string function = "Create" + name;
	void*             code     = dlsym(RTLD_DEFAULT, ("_ZN4yade" + std::to_string(function.size()) + function + "Ev").c_str());
	if (!code) return 0;
	const auto*       byte   = static_cast<const unsigned char*>(code);
	const std::size_t length = symbolSize(code);
	for (std::size_t i = 0; i + 5 <= length; ++i) {
		if (byte[i] == 0xe8) return 0; // first call reached: it is operator new, and no size was seen before it
		if (byte[i] != 0xbf) continue; // mov $imm32, %edi: first argument of the call
		std::uint32_t size;
		std::memcpy(&size, byte + i + 1, sizeof size);
		if (size >= window.low && size <= window.high) return size;
	}
#else
	(void)name;
	(void)window;
#endif
	return 0;
}

VirtualTable yadeTable(const std::type_info& type) { return table(RTLD_DEFAULT, type); }

VirtualTable pluginTable(const std::type_info& type) { return table(pluginHandle(), type); }

std::string difference(VirtualTable yade, VirtualTable plugin)
{
	if (yade.slots == 0) return "no virtual table in YADE's libraries";
	if (plugin.slots == 0) return "no virtual table in the plugin";
	if (yade.slots != plugin.slots) {
		return std::to_string(yade.slots) + " slots in YADE, " + std::to_string(plugin.slots) + " in its headers";
	}
	for (int i = 0; i < yade.slots; ++i) {
		if (yade.begin[i] == plugin.begin[i]) continue;
		const std::string ours = symbolName(plugin.begin[i]), theirs = symbolName(yade.begin[i]);
		if (!isOwnOfEachClass(ours) || !isOwnOfEachClass(theirs)) {
			return "slot " + std::to_string(i) + " is " + theirs + " in YADE, " + ours + " in its headers";
		}
	}
	return "";
}

} // namespace flexpm_abi
