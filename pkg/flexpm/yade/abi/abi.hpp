// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Checks that the classes of the running YADE are laid out as in the headers this plugin was built with.
#pragma once

#include <string>
#include <vector>

namespace flexpm_abi {

/// Result of one check of one class.
struct Finding {
	std::string className;
	std::string check; ///< "size", "vtable" or "attribute NAME"
	bool        ok;
	std::string detail; ///< what was found, and what the headers say if that differs
};

using Findings = std::vector<Finding>;

/// Sizes of all YADE classes the plugin touches. `fault` names a class whose expectation is falsified (tests).
Findings checkSizes(const std::string& fault);

/// Virtual tables of the YADE classes the plugin derives from or calls. `fault` as above.
Findings checkTables(const std::string& fault);

/// Offsets of attributes: set by YADE's code, read by ours. `fault` is "Class.attribute".
Findings checkAttributes(const std::string& fault);

/// Python: abi_report(fault) and the functions by which tests compare C++ and YADE on a live scene.
void registerBindings();

} // namespace flexpm_abi
