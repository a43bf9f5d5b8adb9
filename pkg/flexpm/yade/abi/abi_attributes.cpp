// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Attribute offsets of the YADE classes that the plugin reads or writes: set by YADE's code, read by ours.
#include <flexpm/yade/abi/abi.hpp>
#include <flexpm/yade/abi/yade_lite.hpp>

namespace flexpm_abi {

using namespace yade;
namespace py = boost::python;

namespace {

	/// Collects the findings; a falsified attribute is compared with a value that was never set.
	struct Checker {
		std::string fault;
		Findings    found;

		/// `given` is what Python code would assign, `read` gives C++'s view of it.
		template <class Class, class Read> void check(const char* className, const char* name, py::object given, Read read)
		{
			auto object = boost::dynamic_pointer_cast<Class>(ClassFactory::instance().createShared(className));
			object->pySetAttr(name, given);
			const bool falsified = fault == std::string(className) + "." + name;
			const bool ok        = read(*object) != falsified;
			found.push_back({ className, std::string("attribute ") + name, ok, ok ? "same offset" : "at another offset than in its headers" });
		}
	};

// A value different from the default of the attribute must be given, or a wrong offset may go unnoticed.
#define FLEXPM_SAME(Class, name, ...)                                                                                                                          \
	checker.check<Class>(#Class, #name, py::object(decltype(Class::name)(__VA_ARGS__)), [](const Class& object) {                                          \
		return object.name == decltype(Class::name)(__VA_ARGS__);                                                                                      \
	})
// An attribute that holds an object: both sides must see the same one.
#define FLEXPM_SHARED(Class, name, Held)                                                                                                                       \
	{                                                                                                                                                      \
		const auto held = boost::dynamic_pointer_cast<Held>(ClassFactory::instance().createShared(#Held));                                             \
		checker.check<Class>(#Class, #name, py::object(held), [&](const Class& object) { return object.name == held; });                               \
	}

	const Vector3r probe(0.5, -1.25, 2.75);

	void checkBody(Checker& checker)
	{
		const Quaternionr turned(0.5, 0.5, -0.5, 0.5);
		checker.check<State>(
		        "State", "se3", py::make_tuple(probe, turned), [&](const State& s) { return s.pos == probe && s.ori.coeffs() == turned.coeffs(); });
		FLEXPM_SAME(State, vel, probe);
		FLEXPM_SAME(State, mass, 3.5);
		FLEXPM_SAME(State, angVel, probe);
		FLEXPM_SAME(State, angMom, probe);
		FLEXPM_SAME(State, inertia, probe);
		FLEXPM_SAME(State, refPos, probe);
		FLEXPM_SAME(State, blockedDOFs, 41u);
		FLEXPM_SAME(State, isDamped, false);
		FLEXPM_SAME(State, densityScaling, 7.5);
		FLEXPM_SAME(Body, id, 77);
		FLEXPM_SAME(Body, groupMask, 5);
		FLEXPM_SAME(Body, flags, 2);
		FLEXPM_SAME(Body, clumpId, 12);
		FLEXPM_SHARED(Body, material, Material);
		FLEXPM_SHARED(Body, state, State);
		FLEXPM_SHARED(Body, shape, Shape);
		FLEXPM_SHARED(Body, bound, Bound);
		FLEXPM_SAME(Material, id, 9);
		FLEXPM_SAME(Material, label, "probe");
		FLEXPM_SAME(Material, density, 2650.5);
		FLEXPM_SAME(ElastMat, young, 25.5e9);
		FLEXPM_SAME(ElastMat, poisson, 0.125);
		FLEXPM_SAME(FrictMat, frictionAngle, 0.75);
	}

	void checkShapes(Checker& checker)
	{
		FLEXPM_SAME(Shape, color, probe);
		FLEXPM_SAME(Shape, wire, true);
		FLEXPM_SAME(Shape, highlight, true);
		FLEXPM_SAME(Sphere, radius, 1.5);
		FLEXPM_SAME(Facet, vertices, 3, probe);
		FLEXPM_SAME(Box, extents, probe);
		FLEXPM_SAME(Wall, sense, 1);
		FLEXPM_SAME(Wall, axis, 2);
		FLEXPM_SAME(Bound, lastUpdateIter, 19);
		FLEXPM_SAME(Bound, refPos, probe);
		FLEXPM_SAME(Bound, sweepLength, 0.375);
		FLEXPM_SAME(Bound, color, probe);
		FLEXPM_SAME(Bound, min, probe);
		FLEXPM_SAME(Bound, max, probe);
	}

	void checkInteraction(Checker& checker)
	{
		FLEXPM_SAME(Interaction, id1, 5);
		FLEXPM_SAME(Interaction, id2, 6);
		FLEXPM_SAME(Interaction, iterMadeReal, 11);
		FLEXPM_SAME(Interaction, cellDist, 1, -2, 3);
		FLEXPM_SHARED(Interaction, geom, IGeom);
		FLEXPM_SHARED(Interaction, phys, IPhys);
		FLEXPM_SAME(NormPhys, kn, 2.5);
		FLEXPM_SAME(NormPhys, normalForce, probe);
		FLEXPM_SAME(NormShearPhys, ks, 3.5);
		FLEXPM_SAME(NormShearPhys, shearForce, probe);
		FLEXPM_SAME(GenericSpheresContact, normal, probe);
		FLEXPM_SAME(GenericSpheresContact, contactPoint, probe);
		FLEXPM_SAME(GenericSpheresContact, refR1, 1.5);
		FLEXPM_SAME(GenericSpheresContact, refR2, 2.5);
		FLEXPM_SAME(ScGeom, penetrationDepth, 0.25);
	}

	void checkScene(Checker& checker)
	{
		FLEXPM_SAME(Scene, dt, 0.125);
		FLEXPM_SAME(Scene, iter, 123);
		FLEXPM_SAME(Scene, time, 4.5);
		FLEXPM_SAME(Scene, subStepping, true);
		FLEXPM_SAME(Scene, subStep, 3);
		FLEXPM_SAME(Scene, stopAtIter, 456);
		FLEXPM_SAME(Scene, stopAtTime, 8.5);
		FLEXPM_SAME(Scene, isPeriodic, true);
		FLEXPM_SAME(Scene, trackEnergy, true);
		FLEXPM_SAME(Scene, doSort, true);
		FLEXPM_SHARED(Scene, energy, EnergyTracker);
		FLEXPM_SHARED(Scene, cell, Cell);
		FLEXPM_SAME(Engine, dead, true);
		FLEXPM_SAME(Engine, label, "probe");
		FLEXPM_SAME(Engine, ompThreads, 3);
		FLEXPM_SAME(PartialEngine, ids, { 3, 1, 4 });
		FLEXPM_SAME(TimeStepper, active, false);
		FLEXPM_SAME(Functor, label, "probe");
		FLEXPM_SHARED(InteractionLoop, geomDispatcher, IGeomDispatcher);
		FLEXPM_SHARED(InteractionLoop, physDispatcher, IPhysDispatcher);
		FLEXPM_SHARED(InteractionLoop, lawDispatcher, LawDispatcher);
		FLEXPM_SHARED(InsertionSortCollider, boundDispatcher, BoundDispatcher);
		FLEXPM_SAME(InsertionSortCollider, verletDist, 0.0625);
	}

} // namespace

Findings checkAttributes(const std::string& fault)
{
	Checker checker { fault, {} };
	checkBody(checker);
	checkShapes(checker);
	checkInteraction(checker);
	checkScene(checker);
	return checker.found;
}

} // namespace flexpm_abi
