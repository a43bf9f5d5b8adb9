// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Search for the owner among a scene's engines.
#include <flexpm/yade/grains/AssemblyOwner.hpp>

#include <flexpm/kernel/assembly/access.hpp>

namespace yade {

AssemblyOwner::~AssemblyOwner() = default;

void OwnedAssembly::showNodes() const { dynamic_cast<const AssemblyOwner&>(*engine).showNodes(); }

OwnedAssembly findAssembly(const Scene& scene)
{
	for (const auto& engine : scene.engines) {
		auto* owner = dynamic_cast<AssemblyOwner*>(engine.get());
		if (!owner) continue;
		flexpm::SolidState* const solid = owner->solid();
		if (solid && solid->grains.count > 0) return { engine, nullptr, solid };
		if (owner->assembled()) return { engine, owner->assembled(), nullptr };
	}
	return {};
}

OwnedAssembly assemblyOf(const Scene& scene)
{
	auto found = findAssembly(scene);
	if (!found.engine) throw std::runtime_error("GrainSolver: O.engines has no engine with grains; build the specimen first (flexpm.build)");
	found.showNodes();
	return found;
}

OwnedAssembly assemblyOfGrain(int grain)
{
	auto found = assemblyOf(*Omega::instance().getScene());
	if (grain >= 0 && grain < found.grains().count) return found;
	throw std::runtime_error("LaguerreCell.grain = " + std::to_string(grain) + ", is no grain of the solver; build the specimen first (flexpm.build)");
}

int contactAt(const OwnedAssembly& owned, int contact)
{
	if (owned.plane) return flexpm::contact_with_id(*owned.plane, contact);
	return contact < owned.space->contacts.count ? contact : -1;
}

OwnedContact ownedContact(int id)
{
	OwnedContact found { assemblyOf(*Omega::instance().getScene()), -1 };
	found.place = contactAt(found, id);
	if (found.place >= 0 && dynamic_cast<const AssemblyOwner&>(*found.engine).holds(found.place)) return found;
	throw std::runtime_error("contact = " + std::to_string(id) + ", does not exist, has ended or was erased; read the bonds from O.interactions again");
}

} // namespace yade
