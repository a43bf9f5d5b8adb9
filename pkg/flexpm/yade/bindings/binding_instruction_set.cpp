// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Python access to the process: its instruction set and its memory.
#include <flexpm/yade/bindings/bindings.hpp>

#include <flexpm/kernel/core/instruction_set.hpp>
#include <flexpm/kernel/core/memory.hpp>

#include <boost/python.hpp>

#include <string>

namespace py = boost::python;

namespace flexpm_bindings {
namespace {

	py::list instructionSets()
	{
		py::list names;
		for (flexpm::InstructionSet set : flexpm::available_instruction_sets())
			names.append(flexpm::name_of(set));
		return names;
	}

	void useInstructionSet(const std::string& name)
	{
		std::string known;
		for (flexpm::InstructionSet set : flexpm::available_instruction_sets()) {
			if (name == flexpm::name_of(set)) return flexpm::use_instruction_set(set);
			known += (known.empty() ? "" : ", ") + std::string(flexpm::name_of(set));
		}
		throw std::invalid_argument("instruction set = '" + name + "', must be available on this machine; choose one of  " + known);
	}

	std::string instructionSet() { return flexpm::name_of(flexpm::instruction_set()); }

} // namespace

void register_instruction_set_bindings()
{
	py::def("instruction_sets", instructionSets, "Names of the instruction sets of this machine, the widest last.");
	py::def("instruction_set", instructionSet, "Name of the instruction set in use, at first the widest.");
	py::def("use_instruction_set",
	        useInstructionSet,
	        py::arg("name"),
	        "Use an instruction set from now on, in all specimens of the process. Results do not depend on it.");
	py::def("give_back_memory", flexpm::give_back_memory, "Give freed memory back to the system.");
}

} // namespace flexpm_bindings
