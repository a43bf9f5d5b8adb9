// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  How Boost saves the kernel's assembly: all members that flexpm::visit_state names.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

#include <boost/serialization/map.hpp>
#include <boost/serialization/nvp.hpp>
#include <boost/serialization/vector.hpp>
#include <boost/serialization/version.hpp>

#include <stdexcept>
#include <string>

namespace boost {
namespace serialization {

	template <class Archive> auto archiver(Archive& archive)
	{
		return [&archive](const char* name, auto& value) { archive& make_nvp(name, value); };
	}

	template <class Archive> void serialize(Archive& archive, flexpm::MeshGroup& group, unsigned) { flexpm::visit_group(group, archiver(archive)); }

	template <class Archive> void serialize(Archive& archive, flexpm::ElasticMaterial& material, unsigned)
	{
		flexpm::visit_elastic(material, archiver(archive));
	}

	template <class Archive> void serialize(Archive& archive, flexpm::LawParameters& law, unsigned) { flexpm::visit_law(law, archiver(archive)); }

	template <class Archive> void serialize(Archive& archive, flexpm::Plate& plate, unsigned) { flexpm::visit_plate(plate, archiver(archive)); }

	/// Of what visit_state() lists and how it lies in memory: to be raised with each change of either.
	constexpr unsigned assemblyVersion = 2;

	template <class Archive> void serialize(Archive& archive, flexpm::Assembly& assembly, unsigned version)
	{
		if (version != assemblyVersion) {
			throw std::runtime_error(
			        "state of the grains = version " + std::to_string(version) + ", must be " + std::to_string(assemblyVersion)
			        + " to fit this flexpm; build and run the specimen again");
		}
		flexpm::visit_state(assembly, archiver(archive));
	}

} // namespace serialization
} // namespace boost

BOOST_CLASS_VERSION(flexpm::Assembly, boost::serialization::assemblyVersion)
