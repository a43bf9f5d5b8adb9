// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Sizes and virtual tables of the YADE classes that the plugin touches.
#include <flexpm/yade/abi/abi.hpp>
#include <flexpm/yade/abi/elf_layout.hpp>
#include <flexpm/yade/abi/yade_lite.hpp>

namespace flexpm_abi {

using namespace yade;

/// A class without anything of its own: its virtual table, compiled from the headers, must equal that of its base.
template <class Base> struct Probe : Base {
};

namespace {

	template <class Class> struct Tag {
		using type = Class;
	};

	// The two lists: classes that C++ touches, and those that must not be created only to be measured.
	template <class Visitor> void forEachCreated(Visitor visit)
	{
#define FLEXPM_VISIT(name) visit(#name, Tag<name>())
		FLEXPM_VISIT(State);
		FLEXPM_VISIT(Body);
		FLEXPM_VISIT(Interaction);
		FLEXPM_VISIT(Shape);
		FLEXPM_VISIT(Sphere);
		FLEXPM_VISIT(Facet);
		FLEXPM_VISIT(Box);
		FLEXPM_VISIT(Wall);
		FLEXPM_VISIT(Material);
		FLEXPM_VISIT(ElastMat);
		FLEXPM_VISIT(FrictMat);
		FLEXPM_VISIT(Bound);
		FLEXPM_VISIT(Aabb);
		FLEXPM_VISIT(IGeom);
		FLEXPM_VISIT(GenericSpheresContact);
		FLEXPM_VISIT(ScGeom);
		FLEXPM_VISIT(IPhys);
		FLEXPM_VISIT(NormPhys);
		FLEXPM_VISIT(NormShearPhys);
		FLEXPM_VISIT(Engine);
		FLEXPM_VISIT(GlobalEngine);
		FLEXPM_VISIT(BoundaryController);
		FLEXPM_VISIT(PartialEngine);
		FLEXPM_VISIT(TimeStepper);
		FLEXPM_VISIT(Functor);
		FLEXPM_VISIT(BoundFunctor);
		FLEXPM_VISIT(IGeomFunctor);
		FLEXPM_VISIT(IPhysFunctor);
		FLEXPM_VISIT(LawFunctor);
		FLEXPM_VISIT(GlShapeFunctor);
		FLEXPM_VISIT(GlIPhysFunctor);
		FLEXPM_VISIT(BoundDispatcher);
		FLEXPM_VISIT(IGeomDispatcher);
		FLEXPM_VISIT(IPhysDispatcher);
		FLEXPM_VISIT(LawDispatcher);
		FLEXPM_VISIT(InteractionLoop);
		FLEXPM_VISIT(InsertionSortCollider);
		FLEXPM_VISIT(EnergyTracker);
		FLEXPM_VISIT(Cell);
		FLEXPM_VISIT(BodyContainer);
		FLEXPM_VISIT(InteractionContainer);
		FLEXPM_VISIT(Scene);
#undef FLEXPM_VISIT
	}

	template <class Class> const std::type_info& probeType()
	{
		// never called; storing it where the compiler cannot see through makes it emit the virtual table
		static void* (*volatile make)() = []() -> void* { return new Probe<Class>; };
		(void)make;
		return typeid(Probe<Class>);
	}

	Finding sizeFinding(const std::string& name, std::size_t expected, SizeWindow window)
	{
		const std::size_t exact  = factorySize(name, window);
		const bool        ok     = exact ? exact == expected : window.low <= expected && expected <= window.high && window.high < anySize().high;
		std::string       detail = exact ? std::to_string(exact) : std::to_string(window.low) + " to " + std::to_string(window.high);
		detail += " bytes";
		if (!ok) detail += " in YADE, " + std::to_string(expected) + " in its headers";
		return { name, "size", ok, detail };
	}

} // namespace

Findings checkSizes(const std::string& fault)
{
	Findings   found;
	const auto expected = [&](const char* name, std::size_t size) { return fault == name ? size + sizeof(void*) : size; };
	forEachCreated([&](const char* name, auto tag) {
		using Class = typename decltype(tag)::type;
		std::shared_ptr<Factorable> object(ClassFactory::instance().createPure(name));
		found.push_back(sizeFinding(name, expected(name, sizeof(Class)), blockWindow(dynamic_cast<void*>(object.get()))));
	});
	found.push_back(sizeFinding("OpenGLRenderer", expected("OpenGLRenderer", sizeof(OpenGLRenderer)), anySize()));
	return found;
}

Findings checkTables(const std::string& fault)
{
	Findings found;
	forEachCreated([&](const char* name, auto tag) {
		using Class                  = typename decltype(tag)::type;
		const std::type_info& ours   = fault == name ? probeType<Serializable>() : probeType<Class>();
		const VirtualTable    theirs = yadeTable(typeid(Class));
		const std::string     wrong  = difference(theirs, pluginTable(ours));
		found.push_back({ name, "vtable", wrong.empty(), wrong.empty() ? std::to_string(theirs.slots) + " slots" : wrong });
	});
	return found;
}

} // namespace flexpm_abi
