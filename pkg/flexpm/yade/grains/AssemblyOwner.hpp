// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  What shapes, bonds and functors know of the engine that owns the grains: where its arrays are.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>
#include <flexpm/yade/abi/yade_lite.hpp>

namespace yade {

/// Base of the engine that owns the packed arrays, beside its base in YADE.
class AssemblyOwner {
public:
	virtual ~AssemblyOwner();
	/// Null while it has no grains.
	virtual flexpm::Assembly* assembled() = 0;
	/// Whether no script has erased the contact at this place.
	virtual bool holds(int place) const = 0;
};

/// The arrays of a scene's grains, and their engine, which keeps them alive.
struct OwnedAssembly {
	shared_ptr<Engine> engine;
	flexpm::Assembly*  arrays = nullptr; ///< null if the scene has none

	flexpm::Assembly& operator*() const { return *arrays; }
	flexpm::Assembly* operator->() const { return arrays; }
};

/// The same with one contact of it, by its place in the arrays.
struct OwnedContact : OwnedAssembly {
	int place = -1;
};

/// The first grains that the scene's engines own, if any.
OwnedAssembly findAssembly(const Scene& scene);

/// The same, which must be there; of the current scene, with this grain, or with the contact of this lasting number.
/// @throws std::runtime_error  if no engine of the scene has grains, or if it has no such grain or contact
OwnedAssembly assemblyOf(const Scene& scene);
OwnedAssembly assemblyOfGrain(int grain);
OwnedContact  ownedContact(int id);

} // namespace yade
