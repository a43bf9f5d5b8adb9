// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  All YADE headers the plugin uses, with YADE's own classes reduced to declarations.
/// YADE's libraries export every member that its class macros generate (Python registration, attribute
/// access, factories), so compiling them again would only cost time: 40 s and 2.3 GB a source without this
/// header. Include YADE's headers nowhere else; own classes use the normal YADE_CLASS_... macros after it.
#pragma once

#include <lib/serialization/Serializable.hpp>
// second, so that the macros below replace the real ones of both
#include <lib/factory/ClassFactory.hpp>
#include <lib/serialization/EnumSupport.hpp>

#pragma push_macro("REGISTER_FACTORABLE")
#pragma push_macro("_REGISTER_ATTRIBUTES_DEPREC")
#pragma push_macro("_YADE_CLASS_BASE_DOC_ATTRS_DEPREC_PY")
#pragma push_macro("_YADE_CLASS_PYCLASS_BASE_DOC_ATTRS_DEPREC_PY")
#pragma push_macro("_STATCLASS_PY_REGISTER_CLASS")
#undef REGISTER_FACTORABLE
#undef _REGISTER_ATTRIBUTES_DEPREC
#undef _YADE_CLASS_BASE_DOC_ATTRS_DEPREC_PY
#undef _YADE_CLASS_PYCLASS_BASE_DOC_ATTRS_DEPREC_PY
#undef _STATCLASS_PY_REGISTER_CLASS

// clang-format off
#define REGISTER_FACTORABLE(name)
#define _REGISTER_ATTRIBUTES_DEPREC(klass, base, attrs, deprec) \
	_REGISTER_BOOST_ATTRIBUTES(base, attrs) \
public: \
	void                  pySetAttr(const std::string&, const ::boost::python::object&) override; \
	::boost::python::dict pyDict() const override; \
	void                  callPostLoad() override;
// Not inline: pyRegisterClass becomes the key function, so the vtable stays an undefined symbol of YADE's.
#define _YADE_CLASS_BASE_DOC_ATTRS_DEPREC_PY(klass, base, doc, attrs, deprec, extras) \
	_REGISTER_ATTRIBUTES_DEPREC(klass, base, attrs, deprec) \
	REGISTER_CLASS_AND_BASE(klass, base) \
	virtual void pyRegisterClass(::boost::python::object) override;
#define _YADE_CLASS_PYCLASS_BASE_DOC_ATTRS_DEPREC_PY(klass, pyName, base, doc, attrs, deprec, extras) \
	_REGISTER_ATTRIBUTES_DEPREC(klass, base, attrs, deprec) \
	REGISTER_CLASS_AND_BASE(pyName, base) \
	virtual void pyRegisterClass(::boost::python::object) override;
#define _STATCLASS_PY_REGISTER_CLASS(klass, base, doc, attrs) void pyRegisterClass(::boost::python::object) override;
// clang-format on

#include <core/Aabb.hpp>
#include <core/Body.hpp>
#include <core/BodyContainer.hpp>
#include <core/Bound.hpp>
#include <core/Cell.hpp>
#include <core/Dispatching.hpp>
#include <core/EnergyTracker.hpp>
#include <core/GlobalEngine.hpp>
#include <core/IGeom.hpp>
#include <core/IPhys.hpp>
#include <core/Interaction.hpp>
#include <core/InteractionContainer.hpp>
#include <core/InteractionLoop.hpp>
#include <core/Material.hpp>
#include <core/Omega.hpp>
#include <core/PartialEngine.hpp>
#include <core/Scene.hpp>
#include <core/Shape.hpp>
#include <core/State.hpp>
#include <pkg/common/BoundaryController.hpp>
#include <pkg/common/Box.hpp>
#include <pkg/common/ElastMat.hpp>
#include <pkg/common/Facet.hpp>
#include <pkg/common/GLDrawFunctors.hpp>
#include <pkg/common/InsertionSortCollider.hpp>
#include <pkg/common/NormShearPhys.hpp>
#include <pkg/common/OpenGLRenderer.hpp>
#include <pkg/common/Sphere.hpp>
#include <pkg/common/Wall.hpp>
#include <pkg/dem/DemXDofGeom.hpp>
#include <pkg/dem/ScGeom.hpp>

#pragma pop_macro("REGISTER_FACTORABLE")
#pragma pop_macro("_REGISTER_ATTRIBUTES_DEPREC")
#pragma pop_macro("_YADE_CLASS_BASE_DOC_ATTRS_DEPREC_PY")
#pragma pop_macro("_YADE_CLASS_PYCLASS_BASE_DOC_ATTRS_DEPREC_PY")
#pragma pop_macro("_STATCLASS_PY_REGISTER_CLASS")
