// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  How Boost saves the kernel's assembly and the state of a solid: all members that flexpm::visit_members names.
#pragma once

#include <flexpm/kernel/assembly/serialization.hpp>
#include <flexpm/kernel/assembly/solid_state.hpp>

#include <boost/serialization/array.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/nvp.hpp>
#include <boost/serialization/vector.hpp>
#include <boost/serialization/version.hpp>

#include <stdexcept>
#include <string>

namespace boost {
namespace serialization {

	template <class Archive, class Part> void archiveMembers(Archive& archive, Part& part)
	{
		flexpm::visit_members(part, [&archive](const char* name, auto& value) { archive& make_nvp(name, value); });
	}

	template <class Archive> void serialize(Archive& archive, flexpm::Layout& part, unsigned) { archiveMembers(archive, part); }
	template <class Archive> void serialize(Archive& archive, flexpm::MeshGroup& part, unsigned) { archiveMembers(archive, part); }
	template <class Archive> void serialize(Archive& archive, flexpm::ElasticMaterial& part, unsigned) { archiveMembers(archive, part); }
	template <class Archive> void serialize(Archive& archive, flexpm::LawParameters& part, unsigned) { archiveMembers(archive, part); }
	template <class Archive> void serialize(Archive& archive, flexpm::PlatePoint& part, unsigned) { archiveMembers(archive, part); }
	template <class Archive> void serialize(Archive& archive, flexpm::Plate& part, unsigned) { archiveMembers(archive, part); }
	template <class Archive> void serialize(Archive& archive, flexpm::NodeSet& part, unsigned) { archiveMembers(archive, part); }
	template <class Archive> void serialize(Archive& archive, flexpm::HeldEdge& part, unsigned) { archiveMembers(archive, part); }
	template <class Archive> void serialize(Archive& archive, flexpm::Grains& part, unsigned) { archiveMembers(archive, part); }
	template <class Archive> void serialize(Archive& archive, flexpm::ContactGroup& part, unsigned) { archiveMembers(archive, part); }
	template <class Archive> void serialize(Archive& archive, flexpm::Contacts& part, unsigned) { archiveMembers(archive, part); }
	template <class Archive> void serialize(Archive& archive, flexpm::Facets& part, unsigned) { archiveMembers(archive, part); }
	template <class Archive> void serialize(Archive& archive, flexpm::EnergyLedger& part, unsigned) { archiveMembers(archive, part); }
	template <class Archive> void serialize(Archive& archive, flexpm::GrainMotion& part, unsigned) { archiveMembers(archive, part); }
	template <class Archive> void serialize(Archive& archive, flexpm::PartMotion& part, unsigned) { archiveMembers(archive, part); }
	template <class Archive> void serialize(Archive& archive, flexpm::LoadingMotion& part, unsigned) { archiveMembers(archive, part); }
	template <class Archive> void serialize(Archive& archive, flexpm::SteadyMotion& part, unsigned) { archiveMembers(archive, part); }

	/// Version of what visit_members() lists and how it lies in memory: to be raised with each change of either.
	constexpr unsigned assemblyVersion = 30;

	template <class Archive> void serialize(Archive& archive, flexpm::Assembly& assembly, unsigned version)
	{
		if (version != assemblyVersion) {
			throw std::runtime_error(
			        "state of the grains = version " + std::to_string(version) + ", must be " + std::to_string(assemblyVersion)
			        + " to fit this flexpm; build and run the specimen again");
		}
		archiveMembers(archive, assembly);
	}

	template <class Archive> void serialize(Archive& archive, flexpm::Tetrahedra& part, unsigned) { archiveMembers(archive, part); }
	template <class Archive> void serialize(Archive& archive, flexpm::FaceGroup& part, unsigned) { archiveMembers(archive, part); }
	template <class Archive> void serialize(Archive& archive, flexpm::FaceCrack& part, unsigned) { archiveMembers(archive, part); }
	template <class Archive> void serialize(Archive& archive, flexpm::FaceContacts& part, unsigned) { archiveMembers(archive, part); }
	template <class Archive> void serialize(Archive& archive, flexpm::PairContact& part, unsigned) { archiveMembers(archive, part); }
	template <class Archive> void serialize(Archive& archive, flexpm::SurfaceTriangles& part, unsigned) { archiveMembers(archive, part); }
	template <class Archive> void serialize(Archive& archive, flexpm::HeldFace& part, unsigned) { archiveMembers(archive, part); }
	template <class Archive> void serialize(Archive& archive, flexpm::RigidBody& part, unsigned) { archiveMembers(archive, part); }

	/// Version of what SolidState lists and how it lies in memory: to be raised with each change of either.
	constexpr unsigned solidVersion = 9;

	/// Call flexpm::prepare_step() after loading.
	template <class Archive> void serialize(Archive& archive, flexpm::SolidState& solid, unsigned version)
	{
		if (version != solidVersion) {
			throw std::runtime_error(
			        "state of the solid = version " + std::to_string(version) + ", must be " + std::to_string(solidVersion)
			        + " to fit this flexpm; build and run the specimen again");
		}
		archiveMembers(archive, solid);
	}

} // namespace serialization
} // namespace boost

BOOST_CLASS_VERSION(flexpm::Assembly, boost::serialization::assemblyVersion)
BOOST_CLASS_VERSION(flexpm::SolidState, boost::serialization::solidVersion)
