// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  What shapes, bonds and functors know of the engine that owns the grains: where its arrays are.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>
#include <flexpm/kernel/assembly/solid_state.hpp>
#include <flexpm/yade/abi/yade_lite.hpp>

namespace yade {

/// Base of the engine that owns the packed arrays, beside its base in YADE.
class AssemblyOwner {
public:
	virtual ~AssemblyOwner();
	/// Grains of the plane; null while it has none.
	virtual flexpm::Assembly* assembled() = 0;
	/// Grains of space, which a solver of solids has instead.
	virtual flexpm::SolidState* solid() { return nullptr; }
	/// Bring up to date what steps leave behind and outsiders read: nodes of rigid polyhedra, and forces on them.
	virtual void showNodes() const { }
	/// Whether no script has erased the contact at this place.
	virtual bool holds(int place) const = 0;
};

/// The arrays of a scene's grains, of the plane or of space, and their engine, which keeps them alive.
struct OwnedAssembly {
	shared_ptr<Engine>  engine; ///< null if the scene has none
	flexpm::Assembly*   plane = nullptr;
	flexpm::SolidState* space = nullptr;

	/// What `call` says of those that there are.
	template <class Call> decltype(auto) with(Call call) const { return space ? call(*space) : call(*plane); }
	flexpm::Grains&                      grains() const { return space ? space->grains : plane->grains; }
	void                                 showNodes() const;
};

/// The same with one contact of it, by its place in the arrays.
struct OwnedContact : OwnedAssembly {
	int place = -1;
};

/// Vectors of YADE and of the kernel.
inline Vector3r       toYade(flexpm::Vector v) { return Vector3r(v.x, v.y, v.z); }
inline flexpm::Vector fromYade(const Vector3r& v) { return { v[0], v[1], v[2] }; }

/// The first grains that the scene's engines own, if any; nodes may be behind, see showNodes().
OwnedAssembly findAssembly(const Scene& scene);

/// The place of the contact with a lasting number, -1 without: contacts of space stay in their places.
int contactAt(const OwnedAssembly& owned, int contact);

/// The same with its nodes shown, which must be there; of the current scene, with this grain, or with the contact of this lasting number.
/// @throws std::runtime_error  if no engine of the scene has grains, or if it has no such grain or contact
OwnedAssembly assemblyOf(const Scene& scene);
OwnedAssembly assemblyOfGrain(int grain);
OwnedContact  ownedContact(int id);

} // namespace yade
